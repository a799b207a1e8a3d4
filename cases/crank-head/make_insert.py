#!/usr/bin/env python3
"""Writes insert.toml: the outline of the humped insert, arcs that join with one tangent.

usage: make_insert.py > insert.toml
"""

PITCH, HEIGHT, GROOVES = 12.0, 1.0, 4 # mm: from crest to crest; of the humps; number
CREST, FIRST = 14.5, 3.0 # mm: radius; where the first groove begins
ENDS = (-20.0, 80.0) # mm: the insert is longer than the tube

RADIUS = (PITCH**2 / 16 + HEIGHT**2 / 4) / HEIGHT # of an arc with chord PITCH / 2, rise HEIGHT / 2
MIDDLE = CREST - HEIGHT / 2


def segment(x, y, radius=None):
    print(f"\n[[segment]]\nto = [{x:.10g}, {y:.10g}]" + (f"\nradius = {radius:.10g}" if radius else ""))


def write():
    print(f"# Written by make_insert.py: crests at {CREST:g}, grooves at {CREST - HEIGHT:g}.")
    print("# The tool lies on the left of the way up.")
    print(f"start = [{CREST:g}, {ENDS[0]:g}]")
    segment(CREST, FIRST)
    for groove in range(GROOVES):
        y = FIRST + PITCH * groove
        segment(MIDDLE, y + PITCH / 4, RADIUS) # half a hump
        segment(MIDDLE, y + 3 * PITCH / 4, -RADIUS) # the groove
        segment(CREST, y + PITCH, RADIUS)
    segment(CREST, ENDS[1])


if __name__ == "__main__":
    write()
