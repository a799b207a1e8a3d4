#!/usr/bin/env python3
"""Writes roll64.stl, and with numbers as arguments rollN.stl: rolls of N facets, corners on the circle."""

import math
import struct
import sys

RADIUS, CENTRE, FROM, TO = 100.0, 100.8, -1.0, 1.4 # mm


def roll(n):
    """Facets, counter-clockwise from outside; one corner looks at the strip's middle plane."""
    ring = [(RADIUS * math.sin(2 * math.pi * i / n), CENTRE - RADIUS * math.cos(2 * math.pi * i / n))
            for i in range(n)]
    for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]):
        low_a, high_a, low_b, high_b = (ax, ay, FROM), (ax, ay, TO), (bx, by, FROM), (bx, by, TO)
        yield low_a, low_b, high_b
        yield low_a, high_b, high_a
        yield (0.0, CENTRE, FROM), low_b, low_a
        yield (0.0, CENTRE, TO), high_a, high_b


for n in [int(word) for word in sys.argv[1:]] or [64]:
    facets = list(roll(n))
    with open(f"roll{n}.stl", "wb") as out:
        out.write(b"roll".ljust(80) + struct.pack("<I", len(facets)))
        for facet in facets:
            out.write(struct.pack("<12fH", 0, 0, 0, *(c for point in facet for c in point), 0))
