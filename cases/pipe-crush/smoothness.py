#!/usr/bin/env python3
"""How smooth the force is: smoothness.json and smooth.csv, from the history of a run.

usage: smoothness.py RESULTS

The force on the platen from 4 to 70 mm of approach compared with a polynomial of degree 6 (least squares): `ripple` is the
largest deviation minus the smallest one over the mean force, `rms` the root mean square deviation over it.
"""

import csv
import json
import math
import pathlib
import sys

FIRST, LAST, DEGREE = 4.0, 70.0, 6 # mm


def fit(points):
    """Coefficients in Chebyshev's polynomials by the normal equations."""
    rows = [[math.cos(k * math.acos(max(-1.0, min(1.0, x)))) for k in range(DEGREE + 1)] for x, _ in points]
    size = DEGREE + 1
    a = [[sum(row[i] * row[j] for row in rows) for j in range(size)] + [sum(row[i] * y for row, (_, y) in zip(rows, points))]
         for i in range(size)]
    for i in range(size):
        for j in range(i + 1, size):
            factor = a[j][i] / a[i][i]
            a[j] = [q - factor * p for p, q in zip(a[i], a[j])]
    c = [0.0] * size
    for i in reversed(range(size)):
        c[i] = (a[i][size] - sum(a[i][k] * c[k] for k in range(i + 1, size))) / a[i][i]
    return c, [sum(p * q for p, q in zip(c, row)) for row in rows]


def main(results):
    with open(results / "history.csv", encoding="utf-8") as file:
        pairs = [(-2.0 * float(row["platen.displacement_y"]), 2.0 * float(row["platen.force_y"])) for row in csv.DictReader(file)]
    pairs = [(d, f) for d, f in pairs if FIRST <= d <= LAST + 1e-9]
    _, smooth = fit([((2.0 * d - FIRST - LAST) / (LAST - FIRST), f) for d, f in pairs])
    off = [f - s for (_, f), s in zip(pairs, smooth)]
    mean = sum(f for _, f in pairs) / len(pairs)
    with open(results / "smooth.csv", "w", encoding="utf-8") as out:
        out.write("approach,force,smooth\n")
        for (d, f), s in zip(pairs, smooth):
            out.write(f"{d:.6g},{f:.6g},{s:.6g}\n")
    figures = {"ripple": (max(off) - min(off)) / mean, "rms": math.sqrt(sum(o * o for o in off) / len(off)) / mean}
    (results / "smoothness.json").write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")


main(pathlib.Path(sys.argv[1]))
