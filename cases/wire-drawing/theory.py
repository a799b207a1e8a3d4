#!/usr/bin/env python3
"""Drawing stress over yield stress of a perfectly plastic wire: homogeneous work, slab, Siebel, Avitzur's upper bound.

usage: theory.py     prints a table for the angles and friction factors of the case, and writes reference.csv, over the angle for m = 0.1

Reduction of the section 20 %, conical die of semi-angle a, shear m sigma_0/sqrt(3) on it, no back pull, no land;
L = ln(R0/Rf):
    homogeneous    2 L
    slab (Sachs)   2 L (1 + m cot(a)/sqrt(3))
    Siebel         2 L (1 + m cot(a)/sqrt(3)) + (2/3) a    the last term for the redundant shearing
    Avitzur 1963   2 f(a) L + (2/sqrt(3)) (a/sin^2 a - cot a + m cot a L)
with Avitzur's f(a) for the flow towards the apex of the cone; it is an upper bound.
"""

import math
import pathlib

LOG = -0.5 * math.log(0.8)


def f(a):
    sine2 = math.sin(a)**2
    root = math.sqrt(1.0 - 11.0 / 12.0 * sine2)
    return (1.0 - math.cos(a) * root + math.log((1.0 + math.sqrt(11.0 / 12.0))
            / (math.sqrt(11.0 / 12.0) * math.cos(a) + root)) / math.sqrt(132.0)) / sine2


def slab(a, m):
    return 2.0 * LOG * (1.0 + m / math.tan(a) / math.sqrt(3.0))


def siebel(a, m):
    return slab(a, m) + 2.0 / 3.0 * a


def avitzur(a, m):
    cot = 1.0 / math.tan(a)
    return 2.0 * f(a) * LOG + 2.0 / math.sqrt(3.0) * (a / math.sin(a)**2 - cot + m * cot * LOG)


if __name__ == "__main__":
    print("angle    m   homogeneous   slab   Siebel   Avitzur")
    for degrees, m in ((3, 0.1), (8, 0.0), (8, 0.1), (8, 0.3), (15, 0.1)):
        a = math.radians(degrees)
        print(f"{degrees:5} {m:4} {2 * LOG:13.4f} {slab(a, m):6.4f} {siebel(a, m):8.4f} {avitzur(a, m):9.4f}")
    best = min(range(1, 4000), key=lambda i: avitzur(math.radians(i / 100), 0.1))
    print(f"Avitzur's best angle for m = 0.1: {best / 100:.1f} degrees, {avitzur(math.radians(best / 100), 0.1):.4f}; "
          f"sin(a) = sqrt(1.5 m L): {math.degrees(math.asin(math.sqrt(0.15 * LOG))):.1f} degrees")
    with open(pathlib.Path(__file__).with_name("reference.csv"), "w", encoding="utf-8") as out:
        out.write("angle,slab,siebel,avitzur\n")
        for half in range(5, 37):
            a = math.radians(half / 2)
            out.write(f"{half / 2},{slab(a, 0.1):.5f},{siebel(a, 0.1):.5f},{avitzur(a, 0.1):.5f}\n")
