#!/usr/bin/env python3
"""Load and neck of the bar over its elongation: force.csv and neck.csv, from a run's results.

usage: necking.py RESULTS

force.csv: the mean load of each increment, the work done on the bar over the way of its end, at the middle of
the increment. neck.csv: the radius in the middle of the bar over that of the bar, one row per frame.
"""

import csv
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import frames

RADIUS, ELONGATION_RATE = 6.413, 1.0 # mm, mm/s; half of it at the end of the half bar


def write(path, names, rows):
    with open(path, "w", encoding="utf-8") as out:
        out.write(names + "\n")
        out.writelines(",".join(f"{value:.9g}" for value in row) + "\n" for row in rows)


def loads(history):
    """(elongation, force) of each increment."""
    with open(history, encoding="utf-8") as file:
        rows = [(0.0, 0.0)] + [(float(row["time"]), float(row["external_work"])) for row in csv.DictReader(file)]
    for (t0, work0), (t1, work1) in zip(rows, rows[1:]):
        way = 0.5 * ELONGATION_RATE * (t1 - t0)
        yield 0.5 * ELONGATION_RATE * (t0 + t1), (work1 - work0) / way


def necks(results):
    """(elongation, radius over the initial one) of each frame."""
    for time, path in frames.frames(results):
        points = frames.nodes(path)[0]
        middle = min(y for _, y, _ in points)
        yield ELONGATION_RATE * time, max(x for x, y, _ in points if y == middle) / RADIUS


def main(results):
    write(results / "force.csv", "elongation,force", loads(results / "history.csv"))
    write(results / "neck.csv", "elongation,neck", sorted(necks(results)))


main(pathlib.Path(sys.argv[1]))
