#!/usr/bin/env python3
"""Writes die.stl: the face of a coining die with a shallow relief, 316 x 316 cells of two triangles.

usage: make_die.py [CELLS] [FILE]

The face covers a quarter of the coin and a margin around it. It looks down; its land lies at z = 1.
"""

import array
import math
import pathlib
import sys

LAND, DEPTH = 1.0, 0.08 # mm
LOW, HIGH = -0.5, 6.0   # mm, of the face in x and y
FLANK = 0.3             # mm, half of it


def step(distance):
    """1 well inside, 0 well outside, smooth over the flank; distance to the edge, positive inside."""
    s = min(max(0.5 + 0.5 * distance / FLANK, 0.0), 1.0)
    return s * s * (3.0 - 2.0 * s)


def relief(x, y):
    """Depth of the die's relief above its land: a boss, eight petals, a ring."""
    r = math.hypot(x, y)
    depth = step(0.9 - r) + step(0.35 - abs(r - 4.1))
    for k in range(8):
        c, s = math.cos(k * math.pi / 4), math.sin(k * math.pi / 4)
        along, across = (c * x + s * y - 2.4) / 0.8, (c * y - s * x) / 0.5
        depth += step(0.5 * (1.0 - math.hypot(along, across)))
    return DEPTH * depth


def main():
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 316
    path = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else pathlib.Path(__file__).resolve().parent / "die.stl"
    at = [LOW + (HIGH - LOW) * i / n for i in range(n + 1)]
    points = [[(x, y, LAND + relief(x, y)) for y in at] for x in at]
    blank = (0.0, 0.0, 0.0)
    with open(path, "wb") as out:
        out.write(b"relief".ljust(80) + (2 * n * n).to_bytes(4, "little"))
        for low, high in zip(points, points[1:]):
            for a, b, c, d in zip(low, low[1:], high[1:], high): # clockwise from above
                for facet in ((a, b, c), (a, c, d)):
                    values = array.array("f", blank + facet[0] + facet[1] + facet[2])
                    if sys.byteorder == "big":
                        values.byteswap()
                    out.write(values.tobytes() + b"\0\0")


if __name__ == "__main__":
    main()
