#!/usr/bin/env python3
"""Writes barrelling.csv: the barrelling factor over the height strain, a column a friction factor m.

The quantity of the paper's Fig. 8, with the assumed flow curve. Mesh 20 x 30, at least 200
increments. Runs build/bin/billet six times (half a minute); results go to results/barrelling/.
"""

import csv
import math
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent))
import shape

FACTORS = (0.0, 0.04, 0.08, 0.12, 0.16, 0.3)
STRAINS = [0.05 * step for step in range(23)]


def curve(m):
    """The factor at STRAINS, linear between frames."""
    results = ROOT / "results/barrelling" / f"m{m:g}"
    subprocess.run([ROOT / "build/bin/billet", "run", HERE / "case.toml", "-o", results, "--quiet",
                    "--set", f"tool.punch.friction.m={m:g}", "--set", "workpiece.mesh.cells=[20,30]",
                    "--set", "time.increments.max=0.1", "--set", "output.every=0.2"],
                   check=True, stdout=subprocess.DEVNULL)
    shape.write(results, "upsetting-1018", {"axis": "y", "tool": "punch", "height": 7.5})
    with open(results / "shape.csv", encoding="utf-8") as file:
        points = [(math.log(7.5 / float(row["height"])), float(row["barrelling"]))
                  for row in csv.DictReader(file)]
    values = []
    for strain in STRAINS:
        (x0, y0), (x1, y1) = next((p, q) for p, q in zip(points, points[1:])
                                  if p[0] <= strain and (strain <= q[0] or q is points[-1]))
        values.append(y0 + (y1 - y0) * (strain - x0) / (x1 - x0))
    return values


def main():
    curves = [curve(m) for m in FACTORS]
    with open(HERE / "barrelling.csv", "w", encoding="utf-8") as out:
        out.write("# computed by billet: barrelling.py\nheight_strain,"
                  + ",".join(f"m{m:g}" for m in FACTORS) + "\n")
        for row in zip(STRAINS, *curves):
            out.write(",".join(f"{value:.5g}" for value in row) + "\n")


main()
