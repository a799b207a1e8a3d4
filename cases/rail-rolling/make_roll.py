#!/usr/bin/env python3
"""Writes roll.toml: the half-section of both horizontal rolls, which form web, head and foot in the pass."""

import math
import pathlib

AXIS = 465.25 # mm, of a roll above the middle of the web
# Corners of the pass (height above the middle of the rail, z above the middle of the web) and the radii of
# their rounding, from the head to the foot.
PASS = [(80.5, 110.0, 0.0), (80.5, 36.0, 2.0), (54.725, 36.0, 0.0), (48.5, 15.25, 8.0),
        (-57.5, 15.25, 12.0), (-75.02875, 110.0, 0.0)]


def unit(a, b):
    length = math.dist(a, b)
    return (b[0] - a[0]) / length, (b[1] - a[1]) / length


def segments():
    """End points (height, radius) of the profile and the signed radius of the way to each."""
    corners = [(y, AXIS - z, rounding) for y, z, rounding in PASS]
    yield corners[0][:2], 0.0
    for before, (h, r, rounding), after in zip(corners, corners[1:], corners[2:]):
        if rounding == 0.0:
            yield (h, r), 0.0
            continue
        come, go = unit(before[:2], (h, r)), unit((h, r), after[:2])
        turn = come[0] * go[1] - come[1] * go[0]
        cut = rounding * math.tan(math.asin(turn) / 2) * math.copysign(1, turn)
        yield (h - cut * come[0], r - cut * come[1]), 0.0
        yield (h + cut * go[0], r + cut * go[1]), math.copysign(rounding, turn)
    yield corners[-1][:2], 0.0


with open(pathlib.Path(__file__).with_name("roll.toml"), "w", encoding="utf-8") as out:
    out.write("# Written by make_roll.py: [height along the axis from the middle of the rail, radius] in mm,\n"
              "# from the head to the foot; the roll is on the left.\n")
    for i, ((h, r), radius) in enumerate(segments()):
        key = "start" if i == 0 else "to"
        out.write("\n[[segment]]\n" * (i > 0) + f"{key} = [{h:.6f}, {r:.6f}]\n")
        if radius:
            out.write(f"radius = {radius:g}\n")
