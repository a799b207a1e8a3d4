#!/usr/bin/env python3
"""Writes bar.inp: the bar before the pass, 18 quadrilaterals in its section times 10 slices of hex20.

usage: make_mesh.py [--linear] [TIMES [SLICES]]
every quadrilateral cut in TIMES x TIMES (1); SLICES along the bar (10); --linear: hex8

The rail lies on its side: x along the bar (its front end at x = 0), y from the head to the foot, z up.
Its section has no symmetry: the lower flange of the foot is longer, the groove in the running
surface lies 12 mm above the middle.
"""

import pathlib
import sys

LENGTH = 260.0 # mm
TOP, HEAD, INNER, FOOT = -85.0, -48.0, 58.0, 85.0 # y of the running surface, of the web's ends, of the base
WEB, SIDE, UPPER, LOWER = 18.0, 38.0, 70.0, -76.0 # half the web, half the head, tips of the flanges
FLANGE_SLOPE, HEAD_SLOPE = 0.185, 0.3 # of the faces between web and flange, web and head
GROOVE_AT, GROOVE_WIDTH, GROOVE_DEPTH = 12.0, 16.0, 6.0


def flange(z):
    """Inner face of the foot at height z."""
    return (INNER + FLANGE_SLOPE * max(abs(z) - WEB, 0.0), z)


def fishing(z):
    """Face of the head towards the web."""
    return (HEAD - HEAD_SLOPE * max(abs(z) - WEB, 0.0), z)


def section():
    """Quadrilaterals of the section, each four corners (y, z), counter-clockwise."""
    foot_z = [LOWER, -47.0, -WEB, 0.0, WEB, 44.0, UPPER]
    head_z = [-SIDE, -WEB, 0.0, WEB, SIDE]
    low, high = GROOVE_AT - GROOVE_WIDTH / 2, GROOVE_AT + GROOVE_WIDTH / 2
    columns = [
        [[(TOP, -SIDE), (TOP, low), (TOP + GROOVE_DEPTH, GROOVE_AT), (TOP, high), (TOP, SIDE)],
         [(-68.0, z) for z in (-SIDE, -8.0, 6.0, 20.0, SIDE)], [fishing(z) for z in head_z]],
        [[fishing(z) for z in head_z[1:4]], [(5.0, z) for z in (-WEB, 0.0, WEB)],
         [flange(z) for z in foot_z[2:5]]],
        [[flange(z) for z in foot_z], [(FOOT, z) for z in foot_z]]]
    for lines in columns:
        for left, right in zip(lines, lines[1:]):
            for i in range(len(left) - 1):
                yield left[i], right[i], right[i + 1], left[i + 1]


def refined(quads, times):
    """Every quadrilateral cut in times x times, evenly along its sides."""
    def at(quad, s, t):
        return tuple((1 - s) * (1 - t) * a + s * (1 - t) * b + s * t * c + (1 - s) * t * d
                     for a, b, c, d in zip(*quad))
    for quad in quads:
        for i in range(times):
            for j in range(times):
                yield [at(quad, (i + k) / times, (j + m) / times) for k, m in ((0, 0), (1, 0), (1, 1), (0, 1))]


def middle(a, b):
    return tuple((p + q) / 2 for p, q in zip(a, b))


def write(path, times, slices, linear):
    numbers = {}

    def node(y, z, station):
        key = (round(y, 9), round(z, 9), station)
        return numbers.setdefault(key, len(numbers) + 1)

    elements = []
    for step in range(slices):
        near, mid, far = 2 * step, 2 * step + 1, 2 * step + 2 # stations, half a slice apart
        for corners in refined(section(), times):
            sides = [middle(corners[i], corners[(i + 1) % 4]) for i in range(4)]
            elements.append([node(*p, near) for p in corners] + [node(*p, far) for p in corners])
            if not linear:
                elements[-1] += ([node(*p, near) for p in sides] + [node(*p, far) for p in sides] +
                                 [node(*p, mid) for p in corners])
    with open(path, "w", encoding="utf-8") as out:
        out.write("*NODE\n")
        for (y, z, station), number in numbers.items():
            x = LENGTH * (station / (2 * slices) - 1.0)
            out.write(f"{number}, {x:.9g}, {y:.9g}, {z:.9g}\n")
        out.write(f"*ELEMENT, TYPE={'C3D8' if linear else 'C3D20'}, ELSET=bar\n")
        for number, nodes in enumerate(elements, 1):
            words = [str(n) for n in [number, *nodes]]
            out.write(",\n".join(", ".join(line) for line in (words[:11], words[11:]) if line) + "\n")
    return len(elements), len(numbers)


if __name__ == "__main__":
    linear = "--linear" in sys.argv
    given = [int(word) for word in sys.argv[1:] if word != "--linear"]
    times, slices = [*given, *(1, 10)[len(given):]]
    n_elements, n_nodes = write(pathlib.Path(__file__).with_name("bar.inp"), times, slices, linear)
    print(f"{n_elements} {'hex8' if linear else 'hex20'}, {n_nodes} nodes")
