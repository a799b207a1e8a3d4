#!/usr/bin/env python3
"""Bounds for the push of the first roll alone, on a quarter of the plate: prints them.

usage: theory.py [HEIGHT]     half the height that the plate leaves with; 0.375, that of the gap

Rigid-plastic metal, no friction: the push times the way is the plastic work, h0 times the work of a unit of volume. That is W(e),
the integral of 5 (1 + e/0.02)^0.4, for the strain e that a particle has gone through.
    lower bound     e = ln(h0/h1), the smallest equivalent strain that goes with that loss of height
    plane strain    e = 2/sqrt(3) ln(h0/h1), homogeneous, no spread
    upper bound     the velocity is the same over each section, v = v0 h0/h(z), and the height shrinks in proportion: at the
                    entry each layer turns towards the middle at once, a shear of its angle, and back along the arc. e is
                    integrated along the layers. The field is admissible with and without spread.
"""

import math
import sys

H0, H1, R = 0.5, 0.375, 2.0


def work(e):
    return 5.0 * 0.02 / 1.4 * ((1.0 + e / 0.02)**1.4 - 1.0)


def lower(h1=H1):
    return H0 * work(math.log(H0 / h1))


def plane_strain(h1=H1):
    return H0 * work(2.0 / math.sqrt(3.0) * math.log(H0 / h1))


def upper(layers=50, parts=1000):
    arc = math.sqrt(R**2 - (R - (H0 - H1))**2)
    total = 0.0
    for j in range(layers):
        share = (j + 0.5) / layers # of the height
        e = share * arc / math.sqrt(R**2 - arc**2) / math.sqrt(3.0)
        for i in range(parts):
            s = arc * (1.0 - (i + 0.5) / parts) # distance to the exit
            root = math.sqrt(R**2 - s * s)
            h, h1, h2 = H1 + R - root, -s / root, R**2 / root**3 # height and its derivatives along z
            stretch, shear = -H0 * h1 / h**2, 0.5 * H0 * share * h * (h2 / h**2 - 2.0 * h1**2 / h**3)
            e += 2.0 / math.sqrt(3.0) * math.hypot(stretch, shear) * arc / parts * h / H0
        total += work(e) / layers
    return H0 * total


if __name__ == "__main__":
    height = float(sys.argv[1]) if len(sys.argv) > 1 else H1
    print(f"lower bound {lower(height):.4f}   plane strain {plane_strain(height):.4f}", end="")
    print(f"   upper bound {upper():.4f}" if height == H1 else "")
