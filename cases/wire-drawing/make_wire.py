#!/usr/bin/env python3
"""Writes wire-A.inp and die-A.toml for semi-angles A of the die, the wire with its drawn front in the die already.

usage: make_wire.py [A...]   (degrees; 3 8 15)

x is the radius, y the axis, the wire is drawn upward; the throat of the die is at y = 0. The die is a cone that
runs into an arc of 2 mm; there is no land. The wire stands 0.01 mm off the die, straight above its throat.
"""

import math
import pathlib
import sys

WIRE, DRAWN, NOSE, OFF = 5.0, 5.0 * math.sqrt(0.8), 2.0, 0.01 # mm; a fifth off the section
FRONT, BACK, SIDE, ACROSS = 2.0, 12.0, 0.3, 12 # mm above the throat; of full radius; of an element; elements over the radius


def die_radius(y, alpha):
    """Of the die at a height below its throat."""
    tangent = -NOSE * math.sin(alpha)
    if y > tangent:
        return DRAWN + NOSE - math.sqrt(NOSE**2 - y**2)
    return DRAWN + NOSE * (1.0 - math.cos(alpha)) + (tangent - y) * math.tan(alpha)


def entry(alpha):
    """Height at which the cone has the radius of the wire."""
    return -NOSE * math.sin(alpha) - (WIRE - DRAWN - NOSE * (1.0 - math.cos(alpha))) / math.tan(alpha)


def write_die(path, alpha):
    x, y = DRAWN + NOSE * (1.0 - math.cos(alpha)), NOSE * math.sin(alpha)
    away = (2.0 * math.sin(alpha), 2.0 * math.cos(alpha))
    low = entry(alpha) - 4.0
    path.write_text(
        "# Written by make_wire.py. The tool lies on the left of the way down.\n"
        f"start = [{x + away[0]:.10g}, {y + away[1]:.10g}]\n\n"
        f"[[segment]]\nto = [{x:.10g}, {y:.10g}]\n\n"
        f"[[segment]]\nto = [{x:.10g}, {-y:.10g}]\nradius = {NOSE:g}\n\n"
        f"[[segment]]\nto = [{die_radius(low, alpha):.10g}, {low:.10g}]\n", encoding="utf-8")


def write_wire(path, alpha):
    low = entry(alpha) - BACK
    rows = round((FRONT - low) / SIDE)
    with open(path, "w", encoding="utf-8") as out:
        out.write("*NODE\n")
        for j in range(rows + 1):
            y = low + (FRONT - low) * j / rows
            radius = min(WIRE, die_radius(min(y, 0.0), alpha) - OFF)
            for i in range(ACROSS + 1):
                out.write(f"{j * (ACROSS + 1) + i + 1}, {radius * i / ACROSS:.9g}, {y:.9g}\n")
        out.write("*ELEMENT, TYPE=CAX4, ELSET=WIRE\n")
        for j in range(rows):
            for i in range(ACROSS):
                a = j * (ACROSS + 1) + i + 1
                out.write(f"{j * ACROSS + i + 1}, {a}, {a + 1}, {a + ACROSS + 2}, {a + ACROSS + 1}\n")
        out.write("*NSET, NSET=FRONT\n")
        for i in range(ACROSS + 1):
            out.write(f"{rows * (ACROSS + 1) + i + 1}\n")
        out.write("*NSET, NSET=AXIS\n")
        for j in range(rows + 1):
            out.write(f"{j * (ACROSS + 1) + 1}\n")


if __name__ == "__main__":
    for word in sys.argv[1:] or ["3", "8", "15"]:
        angle = math.radians(float(word))
        write_die(pathlib.Path(__file__).with_name(f"die-{word}.toml"), angle)
        write_wire(pathlib.Path(__file__).with_name(f"wire-{word}.inp"), angle)
