#!/usr/bin/env python3
"""Global coefficient over sliding distance, and wear: pickup.csv, pickup.json, from a run.

usage: pickup.py RESULTS

pickup.csv: way of the cylinder's surface [m], T/N (the paper's eq 2), T the torque over the radius, iterations and seconds so far. pickup.json:
the largest error of the normal force, the wear over K/H N s and over K/H times the friction work over T/N,
iterations per metre of the first and the last third of the slide.
"""

import csv
import json
import pathlib
import sys

RADIUS = 30.0 # mm
SPEED, START, LOAD = 100.0, 0.105, 250.0 # mm/s of the surface; s: middle of the speed's ramp; N/mm
RAMP = 0.12 # s: after which load and speed are constant
K, HARDNESS = 1e-6, 7000.0 # of the tool, MPa


def main(results):
    with open(results / "history.csv", encoding="utf-8") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    worn, error, before, iterations, curve = 0.0, 0.0, 0.0, 0, []
    for row in rows:
        N, T = row["cylinder.force_y"], -row["cylinder.torque_z"] / RADIUS
        iterations += row["iterations"]
        if T > 1e-6:
            worn += K / HARDNESS * (row["friction_work"] - before) * N / T
        before = row["friction_work"]
        if row["time"] >= RAMP:
            error = max(error, abs(N / LOAD - 1.0))
            curve.append((1e-3 * SPEED * (row["time"] - START), T / N, iterations, row["wall_time"]))
    with open(results / "pickup.csv", "w", encoding="utf-8") as out:
        out.write("way,coefficient,iterations,seconds\n")
        out.writelines(f"{way:.6g},{mu:.6g},{n:.0f},{wall:.4g}\n" for way, mu, n, wall in curve)
    third = len(curve) // 3
    rate = [(b[2] - a[2]) / (b[0] - a[0]) for a, b in ((curve[0], curve[third]), (curve[-third], curve[-1]))]
    wear = json.loads((results / "summary.json").read_text(encoding="utf-8"))["tools"]["cylinder"]["wear"]
    (results / "pickup.json").write_text(json.dumps({
        "load_error": error,
        "wear_over_K_N_s": wear["volume"] / (K / HARDNESS * LOAD * 1e3 * curve[-1][0]),
        "wear_over_friction_work": wear["volume"] / worn,
        "iterations_per_metre_first_third": rate[0],
        "iterations_per_metre_last_third": rate[1]}, indent=2) + "\n", encoding="utf-8")


main(pathlib.Path(sys.argv[1]))
