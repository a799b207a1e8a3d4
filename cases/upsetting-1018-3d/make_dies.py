#!/usr/bin/env python3
"""Writes punch.stl and die.stl: square blocks, their working faces in 8 x 8 squares of two facets."""


def grid(corner, along, across, n):
    """Facets of a parallelogram, counter-clockwise seen from the side of along x across."""
    def at(i, j):
        return tuple(c + a * i / n + b * j / n for c, a, b in zip(corner, along, across))
    for i in range(n):
        for j in range(n):
            yield at(i, j), at(i + 1, j), at(i + 1, j + 1)
            yield at(i, j), at(i + 1, j + 1), at(i, j + 1)


def block(low, high, n=8):
    (x0, y0, z0), (x1, y1, z1) = low, high
    dx, dy, dz = (x1 - x0, 0, 0), (0, y1 - y0, 0), (0, 0, z1 - z0)
    yield from grid(low, dy, dx, n)
    yield from grid((x0, y0, z1), dx, dy, n)
    yield from grid(low, dx, dz, n)
    yield from grid((x0, y1, z0), dz, dx, n)
    yield from grid(low, dz, dy, n)
    yield from grid((x1, y0, z0), dy, dz, n)


def write(name, facets):
    with open(name, "w", encoding="ascii") as out:
        out.write("solid block\n")
        for facet in facets:
            out.write("facet normal 0 0 0\nouter loop\n")
            for x, y, z in facet:
                out.write(f"vertex {x:g} {y:g} {z:g}\n")
            out.write("endloop\nendfacet\n")
        out.write("endsolid block\n")


write("punch.stl", block((-3, -3, 18), (13, 13, 22)))
write("die.stl", block((-3, -3, -4), (13, 13, 0)))
