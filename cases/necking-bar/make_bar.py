#!/usr/bin/env python3
"""Writes bar.inp, the upper half of the bar, and prints the points of its flow curve for case.toml.

usage: make_bar.py [NX NY]   (cells along the radius and the axis; 10 30)

x is the radius, y the axis, y = 0 the middle of the bar; the radius falls linearly to 0.982 of it there.
The flow curve 450 + 129.24 a + 265 (1 - exp(-16.93 a)) is replaced by chords that are equally far from it.
"""

import math
import pathlib
import sys

RADIUS, HALF_LENGTH, NARROWING = 6.413, 26.667, 0.982 # mm
CHORDS, RATE, LARGEST = 60, 16.93, 5.0 # the chords lie at most 0.07 MPa off


def flow_curve():
    strains = [2.0 / RATE * math.log(CHORDS / (CHORDS - k)) for k in range(CHORDS)] + [LARGEST]
    return [(a, 450.0 + 129.24 * a - 265.0 * math.expm1(-RATE * a)) for a in strains]


def write(path, nx, ny):
    def place(i, j): # of a node, in half cells
        y = HALF_LENGTH * j / (2 * ny)
        return RADIUS * (NARROWING + (1.0 - NARROWING) * y / HALF_LENGTH) * i / (2 * nx), y

    nodes = {}
    for j in range(2 * ny + 1):
        for i in range(2 * nx + 1):
            if i % 2 == 0 or j % 2 == 0:
                nodes[i, j] = len(nodes) + 1
    around = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
    with open(path, "w", encoding="utf-8") as out:
        out.write("*NODE\n")
        for at, number in nodes.items():
            out.write("%d, %.9g, %.9g\n" % (number, *place(*at)))
        out.write("*ELEMENT, TYPE=CAX8, ELSET=bar\n")
        cells = [(2 * i, 2 * j) for j in range(ny) for i in range(nx)]
        for number, (i, j) in enumerate(cells, 1):
            corners = (str(nodes[i + di, j + dj]) for di, dj in around)
            out.write(f"{number}, {', '.join(corners)}\n")
    return len(cells), len(nodes)


if __name__ == "__main__":
    counts = [int(word) for word in sys.argv[1:]] or [10, 30]
    print("%d quad8, %d nodes" % write(pathlib.Path(__file__).with_name("bar.inp"), *counts))
    print(", ".join(f"[{a:.6g}, {stress:.7g}]" for a, stress in flow_curve()))
