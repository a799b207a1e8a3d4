#!/usr/bin/env python3
"""Writes die.stl, the upper die where it ends, and preform.stl, a quarter of the preform.

The rod lies along x; y = 0 and z = 0 are planes of symmetry.
"""

import math
import pathlib

LENGTH = 56.0                                   # from eye to eye
LAND = 1.5                                      # half the thickness of the flash
BIG_RADIUS, BIG_DEPTH = 17.0, 8.0               # big end
SMALL_RADIUS, SMALL_DEPTH = 11.0, 6.5           # small end
SHANK_BIG, SHANK_SMALL, SHANK_DEPTH = 9.5, 7.0, 4.5  # half widths of the shank next to the ends
DRAFT = 8.0                                     # width over which walls rise
BLEND = 2.0                                     # of ends and shank
BEFORE, BEHIND, ACROSS, STEP = -38.0, 88.0, 36.0, 0.5  # of the die; its squares

OVERFILL = 1.25                                 # of the preform, to fill and for the flash
FLASH = 3.0                                     # width of the flash that the preform has metal for
LEAST_RADIUS = 7.0                              # of the preform
TURNS = 8                                       # of the preform, over a quarter


def wall(distance):
    """1 well inside an outline, 0 outside, smooth over the width of the draft about it."""
    t = min(1.0, max(0.0, 0.5 + distance / DRAFT))
    return t * t * (3.0 - 2.0 * t)


def larger(a, b):
    """The larger of two depths, round where both are alike."""
    blend = min(BLEND, a, b)
    if blend <= 0.0:
        return max(a, b)
    gap = max(blend - abs(a - b), 0.0) / blend
    return max(a, b) + 0.25 * blend * gap * gap


def depth(x, y):
    big = BIG_DEPTH * wall(BIG_RADIUS - math.hypot(x, y))
    small = SMALL_DEPTH * wall(SMALL_RADIUS - math.hypot(x - LENGTH, y))
    width = SHANK_BIG + (SHANK_SMALL - SHANK_BIG) * x / LENGTH
    shank = SHANK_DEPTH * wall(width - abs(y)) if 0.0 <= x <= LENGTH else 0.0
    return larger(larger(big, small), shank)


def half_width(x):
    """Of the outline of the rod; 0 beyond its ends."""
    widths = [0.0]
    for at, radius in ((0.0, BIG_RADIUS), (LENGTH, SMALL_RADIUS)):
        if abs(x - at) < radius:
            widths.append(math.sqrt(radius**2 - (x - at)**2))
    if 0.0 <= x <= LENGTH:
        widths.append(SHANK_BIG + (SHANK_SMALL - SHANK_BIG) * x / LENGTH)
    return max(widths)


def section(x, n=200):
    """Area of a quarter of the section with its flash."""
    end = half_width(x) + FLASH
    if end <= FLASH:
        return 0.0
    return sum((LAND + depth(x, end * (i + 0.5) / n)) for i in range(n)) * end / n


def die():
    nx, ny = round((BEHIND - BEFORE) / STEP), round((ACROSS + 4.0) / STEP)
    at = [[(BEFORE + STEP * i, -4.0 + STEP * j, LAND + depth(BEFORE + STEP * i, -4.0 + STEP * j))
           for j in range(ny + 1)] for i in range(nx + 1)]
    for i in range(nx):
        for j in range(ny):
            a, b, c, d = at[i][j], at[i + 1][j], at[i + 1][j + 1], at[i][j + 1]
            yield a, c, b                       # seen from below
            yield a, d, c


def meridian(step=2.0):
    """Of the preform: x and radius, from the tip before the big end to that behind the small one."""
    first, last = 4.0 - BIG_RADIUS, LENGTH + SMALL_RADIUS - 3.0
    n = round((last - first) / step)
    places = [first + (last - first) * i / n for i in range(n + 1)]
    radii = [max(LEAST_RADIUS, math.sqrt(4.0 * OVERFILL * section(x) / math.pi)) for x in places]
    for _ in range(30):                         # a rolled billet changes slowly along its axis
        radii = [radii[0]] + [0.25 * (a + 2 * b + c) for a, b, c in zip(radii, radii[1:], radii[2:])] + [radii[-1]]
    return list(zip(places, radii))


def preform():
    line = meridian()
    def on(x, radius, k):
        angle = 0.5 * math.pi * k / TURNS
        return (x, 0.0 if k == TURNS else radius * math.cos(angle), 0.0 if k == 0 else radius * math.sin(angle))
    for k in range(TURNS):
        for (x0, r0), (x1, r1) in zip(line, line[1:]):
            a, b, c, d = on(x0, r0, k), on(x0, r0, k + 1), on(x1, r1, k + 1), on(x1, r1, k)
            yield a, b, c
            yield a, c, d
        for (x, r), outward in ((line[0], False), (line[-1], True)):   # flat ends
            centre, low, high = (x, 0.0, 0.0), on(x, r, k), on(x, r, k + 1)
            yield (centre, low, high) if outward else (centre, high, low)
    for k, up in ((0, False), (TURNS, True)):   # the planes of symmetry z = 0 and y = 0
        for (x0, r0), (x1, r1) in zip(line, line[1:]):
            a, b, c, d = (x0, 0.0, 0.0), (x1, 0.0, 0.0), on(x1, r1, k), on(x0, r0, k)
            facets = ((a, b, c), (a, c, d))
            yield from ((p, q, r) if up else (p, r, q) for p, q, r in facets)


def write(name, facets):
    with open(pathlib.Path(__file__).resolve().parent / name, "w", encoding="ascii") as out:
        out.write(f"solid {name}\n")
        for facet in facets:
            out.write("facet normal 0 0 0\nouter loop\n")
            for x, y, z in facet:
                out.write(f"vertex {x:.6g} {y:.6g} {z:.6g}\n")
            out.write("endloop\nendfacet\n")
        out.write(f"endsolid {name}\n")


if __name__ == "__main__":
    write("die.stl", die())
    write("preform.stl", preform())
