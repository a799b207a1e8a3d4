#!/usr/bin/env python3
"""How well the die is filled and what the mesh changes cost: filling.json, from the frames of a run.

usage: filling.py RESULTS

filling: volume of the hub within the flash land's radius when the dies stand still, over that of the cavity;
flash: largest radius then; volume: of the forging without load, relative to the preform, less 1; ledger: the largest
change of volume and of plastic work and the largest jump of a force by one remeshing.
"""

import csv
import json
import math
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import make_dies
import frames
import xml.etree.ElementTree as xml

CLOSED = 0.3062                               # s
PREFORM = math.pi * 55.0 ** 2 * 40.62         # mm3
SLICES = 4000


def thickness(points, edges, radius):
    """Of the body at a radius: sum over the pairs of its outline's crossings."""
    heights = []
    for a, b in edges:
        (x0, y0, _), (x1, y1, _) = points[a], points[b]
        if (x0 <= radius) != (x1 <= radius):
            heights.append(y0 + (y1 - y0) * (radius - x0) / (x1 - x0))
    heights.sort()
    return sum(top - low for low, top in zip(heights[0::2], heights[1::2]))


def contact_frame(results, time):
    for item in xml.parse(next(results.glob("*.pvd"))).getroot().iter("DataSet"):
        if item.get("name") == "contact" and abs(float(item.get("timestep")) - time) < 1e-9:
            return results / item.get("file")
    raise SystemExit(f"no frame at {time} s")


def main():
    results = pathlib.Path(sys.argv[1])
    points, edges = frames.surface(contact_frame(results, CLOSED))
    step = make_dies.RIM_OUTER / SLICES
    radii = [(i + 0.5) * step for i in range(SLICES)]
    filled = sum(2.0 * math.pi * r * thickness(points, edges, r) * step for r in radii)
    with open(results / "history.csv", newline="") as file:
        last = list(csv.DictReader(file))[-1]
    ledger = json.loads((results / "summary.json").read_text())["remeshings"]
    figures = {"filling": filled / make_dies.cavity(), "flash": max(x for x, _, _ in points),
               "volume": float(last["volume"]) / PREFORM - 1.0, "ledger": ledger}
    (results / "filling.json").write_text(json.dumps(figures, indent=2) + "\n")
    print(json.dumps(figures))


main()
