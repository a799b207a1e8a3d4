#!/usr/bin/env python3
"""Forces over travel of the two sequences, and their means: travel.csv, sequences.json, from a run.

usage: sequences.py RESULTS

travel.csv: sequence, travel along the bar [mm], normal and tangential force [N] and their ratio. sequences.json:
for each sequence mean forces and ratio while the indenter travels from 3 to 8 mm, the largest swing of the
normal force about its straight line in that window, and the process window as the paper reports its tests.
"""

import csv
import json
import pathlib
import sys

WINDOW = (3.0, 8.0) # mm of travel
NORMAL = {"plane-strain": "y", "3d": "z"}


def travel(rows, tool, normal):
    """(time step, travel, N, T) while a tool translates."""
    for row in rows:
        way, N = float(row[f"{tool}.displacement_x"]), float(row[f"{tool}.force_{normal}"])
        if way > 0.0 and N > 0.0:
            yield float(row["dt"]), way, N, -float(row[f"{tool}.force_x"])


def means(points):
    """Means over the window, and the swing about a straight line over the mean."""
    inside = [p for p in points if WINDOW[0] <= p[1] <= WINDOW[1]]
    total = sum(p[0] for p in inside)
    N, T, x = (sum(p[0] * p[i] for p in inside) / total for i in (2, 3, 1))
    slope = sum((p[1] - x) * (p[2] - N) for p in inside) / sum((p[1] - x)**2 for p in inside)
    off = [p[2] - N - slope * (p[1] - x) for p in inside]
    return {"normal": N, "tangential": T, "ratio": T / N, "swing": (max(off) - min(off)) / N}


def main(results):
    with open(results / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    summary = json.loads((results / "summary.json").read_text(encoding="utf-8"))
    figures = {}
    with open(results / "travel.csv", "w", encoding="utf-8") as out:
        out.write("sequence,travel,normal,tangential,ratio\n")
        for number, tool in enumerate(("first", "second"), 1):
            points = list(travel(rows, tool, NORMAL[summary["analysis"]]))
            for _, way, N, T in points:
                out.write(f"{number},{way:.6g},{N:.6g},{T:.6g},{T / N:.5g}\n")
            figures[tool] = means(points) | {"window": summary["tools"][tool]["process_window"]}
    figures["second_over_first"] = figures["second"]["ratio"] / figures["first"]["ratio"]
    (results / "sequences.json").write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")


main(pathlib.Path(sys.argv[1]))
