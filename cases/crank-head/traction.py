#!/usr/bin/env python3
"""Traction force over relative displacement: traction.csv and traction.json, from a run.

usage: traction.py RESULTS

traction.csv: displacement of the tube's end over the length on the insert [%], force [N], and a
simple estimate: the rate of the hoop work alone, if every ring of the tube keeps its axial distance from
the others and is widened to the insert where that has become wider (rigid-plastic, at the mean plastic
strain after the pulse). traction.json: largest force, how deep the pulse has pressed the tube into the
grooves, that estimate at 3 %, and the axial force at which the tube itself would yield.
"""

import csv
import json
import math
import pathlib
import sys
import xml.etree.ElementTree as xml

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import frames
from make_insert import CREST, FIRST, GROOVES, HEIGHT, PITCH, RADIUS

LENGTH, WALL, MEAN_RADIUS = 54.0, 2.0, 16.0 # mm
PULL = 1.0 # s: when the pull begins
STEP = 0.01 # mm: of the integral along the tube


def insert_radius(y):
    """Radius of the insert at a height."""
    if not FIRST <= y <= FIRST + PITCH * GROOVES:
        return CREST
    from_crest = abs((y - FIRST + PITCH / 2) % PITCH - PITCH / 2)
    if from_crest < PITCH / 4:
        return CREST - RADIUS + math.sqrt(RADIUS**2 - from_crest**2)
    return CREST - HEIGHT + RADIUS - math.sqrt(RADIUS**2 - (PITCH / 2 - from_crest)**2)


def workpiece(results, time):
    """Points and plastic strain of the workpiece's frame at a time."""
    collection = xml.parse(next(results.glob("*.pvd"))).getroot()
    file = next(results / d.get("file") for d in collection.iter("DataSet")
                if d.get("name") == "workpiece" and abs(float(d.get("timestep")) - time) < 1e-9)
    root = xml.parse(file).getroot()
    flat = frames.array(root, root.find(".//Points/DataArray"))
    strain = next(e for e in root.find(".//PointData") if e.get("Name") == "plastic_strain")
    return list(zip(flat[0::3], flat[1::3])), frames.array(root, strain)


def bore(points, first):
    """(y, r) of the tube's inside, upwards; first: the points at the start."""
    inside = min(r for r, _ in first)
    return sorted((y, r) for (r, y), (r0, _) in zip(points, first) if abs(r0 - inside) < 1e-9)


def between(curve, x):
    for (x0, y0), (x1, y1) in zip(curve, curve[1:]):
        if x0 <= x <= x1:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return None


def hoop_force(curve, stress, way):
    """Rate of the hoop work by displacement [N]."""
    force, y = 0.0, curve[0][0]
    while y < curve[-1][0]:
        now = insert_radius(y + way)
        if now > between(curve, y):
            slope = (insert_radius(y + way + STEP) - insert_radius(y + way - STEP)) / (2 * STEP)
            force += 2 * math.pi * WALL * stress * slope * STEP
        y += STEP
    return force


def main(results):
    points, strain = workpiece(results, PULL)
    curve = bore(points, workpiece(results, 0.0)[0])
    stress = 250.0 * (0.005 + sum(strain) / len(strain))**0.2
    with open(results / "history.csv", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if float(row["time"]) >= PULL - 1e-9]
    way = [2.7 * (float(row["time"]) - PULL) for row in rows]
    force = [float(row["insert.force_y"]) for row in rows]
    with open(results / "traction.csv", "w", encoding="utf-8") as out:
        out.write("relative_displacement,force,hoop_estimate\n")
        for u, f in zip(way, force):
            out.write(f"{100 * u / LENGTH:.9g},{f:.9g},{hoop_force(curve, stress, u):.9g}\n")
    (results / "traction.json").write_text(json.dumps({
        "largest_force": max(force),
        "depth_in_grooves": CREST - min(r for _, r in curve),
        "stress": stress,
        "hoop_estimate_at_3_percent": hoop_force(curve, stress, 1.62),
        "tube_yields_at": 2 * math.pi * MEAN_RADIUS * WALL * stress}, indent=2) + "\n", encoding="utf-8")


main(pathlib.Path(sys.argv[1]))
