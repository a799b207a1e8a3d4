#!/usr/bin/env python3
"""How far the relief is filled: filling.csv (one row per frame) and coining.json (the last of them).

usage: coining.py RESULTS

The upper face of the workpiece is above the die's land by z - (LAND + travel). `boss`, `petal`
and `ring`: its largest height there over the relief's depth; `volume`: the integral of the height over
that of the relief, on the same nodes. `out_of_balance`: what die, anvil and collar do not carry between
them along z, over the die's force.
"""

import csv
import json
import math
import pathlib
import sys
import xml.etree.ElementTree as xml

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]
import frames
from make_die import DEPTH, LAND, relief

SPEED = 0.05 # mm/s
PARTS = {"boss": (0.0, 1.2), "petal": (1.7, 3.1), "ring": (3.75, 4.45)} # radii, mm


def frame(path):
    """Current points and displacements."""
    root = xml.parse(path).getroot()
    arrays = [root.find(".//Points/DataArray"), root.find(".//PointData/DataArray[@Name='displacement']")]
    flat = [frames.array(root, each) for each in arrays]
    return [list(zip(v[0::3], v[1::3], v[2::3])) for v in flat]


def filling(path, time):
    """Share of the depth reached in each part, share of the volume, over the upper face's nodes."""
    top = [p for p, u in zip(*frame(path)) if p[2] - u[2] > LAND - 1e-9]
    land = LAND - SPEED * time
    heights = [(math.hypot(x, y), z - land, relief(x, y)) for x, y, z in top]
    row = {name: max(h for r, h, _ in heights if low <= r <= high) / DEPTH
           for name, (low, high) in PARTS.items()}
    row["volume"] = sum(max(h, 0.0) for _, h, _ in heights) / sum(d for _, _, d in heights)
    return row


def main(results):
    rows = []
    for item in xml.parse(next(results.glob("*.pvd"))).getroot().iter("DataSet"):
        if item.get("name") == "workpiece":
            time = float(item.get("timestep"))
            rows.append({"time": time, "travel": SPEED * time} | filling(results / item.get("file"), time))
    with open(results / "filling.csv", "w", encoding="utf-8", newline="") as file:
        out = csv.DictWriter(file, rows[0])
        out.writeheader()
        out.writerows(rows)
    with open(results / "history.csv", encoding="utf-8") as file:
        last = list(csv.DictReader(file))[-1]
    forces = [float(last[f"{tool}.force_z"]) for tool in ("die", "anvil", "collar")]
    rows[-1]["out_of_balance"] = abs(sum(forces)) / forces[0]
    (results / "coining.json").write_text(json.dumps(rows[-1], indent=2) + "\n", encoding="utf-8")


main(pathlib.Path(sys.argv[1]))
