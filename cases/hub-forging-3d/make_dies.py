#!/usr/bin/env python3
"""Writes die.stl, the upper die where it ends, and preform.stl, an eighth of the preform.

The hub has a boss about z and four arms along x and y; z = 0, x = 0 and y = 0 are planes of symmetry.
"""

import math
import pathlib

LAND = 1.5                                    # half the thickness of the flash
BOSS_RADIUS, BOSS_DEPTH, BOSS_DRAFT = 13.0, 7.5, 9.0
ARM_WIDTH, ARM_LENGTH, ARM_DEPTH, ARM_DRAFT = 9.0, 31.0, 4.5, 7.0
BLEND = 1.5                                   # of boss and arms
REACH, STEP = 48.0, 0.5                       # of the die; its squares

# Of the preform: half width and length of an arm, radius in the middle, heights of boss and arms
# and where the one goes over into the other, order of the rounding between arms.
WIDTH, LENGTH, MIDDLE = 7.5, 28.0, 13.5
BOSS_HEIGHT, ARM_HEIGHT, OVER_AT, OVER_WITHIN = 17.0, 12.5, 10.5, 18.0
ORDER = 8
TURNS, INNER, OUTER = 30, 9, 9                # facets: around, and along the way to the outline


def step(t):
    t = min(1.0, max(0.0, t))
    return t * t * (3.0 - 2.0 * t)


def wall(distance, draft):
    """1 well inside an outline, 0 outside, smooth over the width of the draft about it."""
    return step(0.5 + distance / draft)


def depth(x, y):
    x, y = abs(x), abs(y)
    boss = BOSS_DEPTH * wall(BOSS_RADIUS - math.hypot(x, y), BOSS_DRAFT)
    arms = ARM_DEPTH * max(wall(ARM_WIDTH - b, ARM_DRAFT) * wall(ARM_LENGTH - a, ARM_DRAFT) for a, b in ((x, y), (y, x)))
    blend = min(BLEND, boss, arms)
    if blend <= 0.0:
        return max(boss, arms)
    gap = max(blend - abs(boss - arms), 0.0) / blend
    return max(boss, arms) + 0.25 * blend * gap * gap


def die():
    n = round((REACH + 4.0) / STEP)
    at = [[(-4.0 + STEP * i, -4.0 + STEP * j, LAND + depth(-4.0 + STEP * i, -4.0 + STEP * j))
           for j in range(n + 1)] for i in range(n + 1)]
    for i in range(n):
        for j in range(n):
            a, b, c, d = at[i][j], at[i + 1][j], at[i + 1][j + 1], at[i][j + 1]
            yield a, c, b                     # seen from below
            yield a, d, c


def arm(along, across):
    """Distance of the outline of an arm from the axis, in a direction."""
    end = LENGTH - WIDTH                      # where its round end begins
    side = WIDTH / max(across, 1e-9)
    if side * along <= end:
        return side
    return end * along + math.sqrt(WIDTH**2 - (end * across)**2)


def outline(angle):
    along, across = math.cos(angle), math.sin(angle)
    radii = (MIDDLE, arm(along, across), arm(across, along))
    return sum(r**ORDER for r in radii) ** (1.0 / ORDER)


def top(radius, share):
    """Height of the preform; share of the way to its outline."""
    over = step(0.5 + (OVER_AT - radius) / OVER_WITHIN)
    return (ARM_HEIGHT + (BOSS_HEIGHT - ARM_HEIGHT) * over) * math.sqrt(1.0 - share**4)


def preform():
    round_from = math.asin(0.49)              # of the edge: by equal turns of the surface
    shares = [0.7 * i / INNER for i in range(1, INNER)]
    shares += [math.sqrt(math.sin(round_from + (0.5 * math.pi - round_from) * i / OUTER)) for i in range(OUTER)] + [1.0]

    def on(share, k, high):
        angle = 0.5 * math.pi * k / TURNS
        radius = share * outline(angle)
        x, y = radius * math.cos(angle), radius * math.sin(angle)
        return (0.0 if k == TURNS else x, 0.0 if k == 0 else y, top(radius, share) if high and share < 1.0 else 0.0)

    pole, centre = (0.0, 0.0, BOSS_HEIGHT), (0.0, 0.0, 0.0)
    for k in range(TURNS):
        yield pole, on(shares[0], k, True), on(shares[0], k + 1, True)
        yield centre, on(shares[0], k + 1, False), on(shares[0], k, False)
        for low, high in zip(shares[1:], shares):
            a, b, c, d = (on(share, turn, True) for share, turn in ((low, k), (low, k + 1), (high, k + 1), (high, k)))
            yield a, b, c
            yield a, c, d
            a, b, c, d = (on(share, turn, False) for share, turn in ((low, k), (low, k + 1), (high, k + 1), (high, k)))
            yield a, c, b
            yield a, d, c
    for k, turned in ((0, False), (TURNS, True)):   # the planes of symmetry y = 0 and x = 0
        rims = [[at] + [on(share, k, high) for share in shares] for at, high in ((pole, True), (centre, False))]
        for (a, b), (c, d) in zip(zip(rims[0], rims[0][1:]), zip(rims[1], rims[1][1:])):
            for facet in ((a, c, d), (a, d, b)):
                if len(set(facet)) == 3:
                    yield facet[::-1] if turned else facet


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
