#!/usr/bin/env python3
"""Writes die.stl, the upper die where it ends, and preform.stl, an eighth of the preform.

The hub has a boss about z and four arms along x and y; z = 0, x = 0 and y = 0 are planes of symmetry.
"""

import math
import pathlib

LAND = 4.5                                    # half the thickness between the arms
BOSS_RADIUS, BOSS_DEPTH, BOSS_DRAFT = 13.0, 7.5, 9.0
ARM_WIDTH, ARM_LENGTH, ARM_DEPTH, ARM_DRAFT = 9.0, 31.0, 4.5, 7.0
BLEND = 1.5                                   # of boss and arms
REACH, STEP = 48.0, 1.0                       # of the die; its squares

RADIUS, HALF_HEIGHT, EDGE = 16.5, 19.0, 11.0  # of the preform; radius of its edge


def wall(distance, draft):
    """1 well inside an outline, 0 outside, smooth over the width of the draft about it."""
    t = min(1.0, max(0.0, 0.5 + distance / draft))
    return t * t * (3.0 - 2.0 * t)


def depth(x, y):
    x, y = abs(x), abs(y)
    boss = BOSS_DEPTH * wall(BOSS_RADIUS - math.hypot(x, y), BOSS_DRAFT)
    arms = ARM_DEPTH * max(wall(ARM_WIDTH - b, ARM_DRAFT) * wall(ARM_LENGTH - a, ARM_DRAFT) for a, b in ((x, y), (y, x)))
    gap = max(BLEND - abs(boss - arms), 0.0) / BLEND
    return max(boss, arms) + 0.25 * BLEND * gap * gap


def die():
    n = round((REACH + 4.0) / STEP)
    at = [[(-4.0 + STEP * i, -4.0 + STEP * j, LAND + depth(-4.0 + STEP * i, -4.0 + STEP * j))
           for j in range(n + 1)] for i in range(n + 1)]
    for i in range(n):
        for j in range(n):
            a, b, c, d = at[i][j], at[i + 1][j], at[i + 1][j + 1], at[i][j + 1]
            yield a, c, b                     # seen from below
            yield a, d, c


def meridian(steps=8):
    """Of the preform from the pole to the equator: radius, height."""
    inner, top = RADIUS - EDGE, HALF_HEIGHT - EDGE
    flat = [(inner * i / 3, HALF_HEIGHT) for i in range(1, 3)]
    edge = [(inner + EDGE * math.sin(a), top + EDGE * math.cos(a))
            for a in (0.5 * math.pi * i / steps for i in range(steps + 1))]
    return flat + edge + [(RADIUS, top * (1 - i / 4)) for i in range(1, 4)] + [(RADIUS, 0.0)]


def preform(turns=10):
    def on(radius, height, k):
        angle = 0.5 * math.pi * k / turns
        x, y = radius * math.cos(angle), radius * math.sin(angle)
        return (0.0 if k == turns else x, 0.0 if k == 0 else y, height)
    pole, centre = (0.0, 0.0, HALF_HEIGHT), (0.0, 0.0, 0.0)
    line = meridian()
    for k in range(turns):
        yield pole, on(*line[0], k), on(*line[0], k + 1)
        for low, high in zip(line[1:], line):
            a, b, c, d = on(*low, k), on(*low, k + 1), on(*high, k + 1), on(*high, k)
            yield a, b, c
            yield a, c, d
        yield centre, on(*line[-1], k + 1), on(*line[-1], k)
    for k, turned in ((0, False), (turns, True)):   # the planes of symmetry y = 0 and x = 0
        rim = [pole] + [on(*p, k) for p in line]
        for a, b in zip(rim, rim[1:]):
            yield (centre, a, b) if turned else (centre, b, a)


def write(name, facets):
    with open(pathlib.Path(__file__).resolve().parent / name, "w", encoding="ascii") as out:
        out.write(f"solid {name}\n")
        for facet in facets:
            out.write("facet normal 0 0 0\nouter loop\n")
            for x, y, z in facet:
                out.write(f"vertex {x:.6g} {y:.6g} {z:.6g}\n")
            out.write("endloop\nendfacet\n")
        out.write(f"endsolid {name}\n")


write("die.stl", die())
write("preform.stl", preform())
