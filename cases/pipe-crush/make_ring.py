#!/usr/bin/env python3
"""Writes ring.inp, a quarter of the pipe's section, or ../pipe-flat/pipe.inp, its right half: quad8 between two arcs.

usage: make_ring.py [--half] [ACROSS AROUND]     (elements; 4 36, of a half 4 72)
"""

import math
import pathlib
import sys

INSIDE, OUTSIDE = 48.28, 57.15 # mm


def write(path, across, around, half):
    def place(i, j): # of a node, in half elements
        radius, share = INSIDE + (OUTSIDE - INSIDE) * i / (2 * across), j / (2 * around)
        turn = math.pi * (share - 0.5 if half else 0.5 * share)
        on_plane = j == 2 * around or (half and j == 0)
        return (0.0 if on_plane else radius * math.cos(turn)), radius * math.sin(turn)

    nodes = {(i, j): 0 for j in range(2 * around + 1) for i in range(2 * across + 1) if i % 2 == 0 or j % 2 == 0}
    for number, at in enumerate(nodes, 1):
        nodes[at] = number
    ring = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
    with open(path, "w", encoding="utf-8") as out:
        out.write("*NODE\n")
        for at, number in nodes.items():
            out.write("%d, %.9g, %.9g\n" % (number, *place(*at)))
        out.write("*ELEMENT, TYPE=CPE8, ELSET=PIPE\n")
        cells = [(2 * i, 2 * j) for j in range(around) for i in range(across)]
        for number, (i, j) in enumerate(cells, 1):
            out.write(f"{number}, {', '.join(str(nodes[i + di, j + dj]) for di, dj in ring)}\n")
        out.write("*NSET, NSET=OUTSIDE\n")
        for (i, _), number in nodes.items():
            if i == 2 * across:
                out.write(f"{number}\n")


if __name__ == "__main__":
    halved = "--half" in sys.argv
    counts = [int(word) for word in sys.argv[1:] if word != "--half"] or ([4, 72] if halved else [4, 36])
    here = pathlib.Path(__file__).parent
    write(here.parent / "pipe-flat" / "pipe.inp" if halved else here / "ring.inp", *counts, halved)
