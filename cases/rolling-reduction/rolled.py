#!/usr/bin/env python3
"""The plate behind the first roll: rolled.json, from the frames and the history of a run.

usage: rolled.py RESULTS

height: half of it, in the middle of the width, from z = 1.6 to 1.9, in the frame nearest to 0.5 s. work: plastic work for a unit of
way from 0.38 to 0.5 s, when the first roll alone acts. over_lower, over_plane_strain: that over the work of homogeneous flow to that height (theory.py).
"""

import csv
import json
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import frames
import theory

SPEED, FIRST, LAST = 4.0, 0.38, 0.5


def main(results):
    _, path = min((abs(time - LAST), path) for time, path in frames.frames(results))
    points, _, _ = frames.nodes(path)
    top = {} # by columns of nodes: the highest
    for x, y, z in points:
        if x < 1e-9 and 1.6 < z < 1.9 and y > 0.3:
            top[round(z, 1)] = max(y, top.get(round(z, 1), 0.0))
    height = sum(y for y in top.values() if y > 0.35) / sum(1 for y in top.values() if y > 0.35)
    with open(results / "history.csv", encoding="utf-8") as file:
        rows = [(float(row["time"]), float(row["plastic_work"])) for row in csv.DictReader(file)]
    (t0, w0), (t1, w1) = ([row for row in rows if FIRST <= row[0] <= LAST][i] for i in (0, -1))
    work = (w1 - w0) / (t1 - t0) / SPEED
    figures = {"height": height, "work": work, "over_lower": work / theory.lower(height),
               "over_plane_strain": work / theory.plane_strain(height)}
    (results / "rolled.json").write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")


main(pathlib.Path(sys.argv[1]))
