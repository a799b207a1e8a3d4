#!/usr/bin/env python3
"""What a pass makes of the plate: passes.json, from the frames of a run.

usage: passes.py RESULTS

For each pass, over the middle half of its length: thickness, width (each of the whole plate, the width
as the mean over the thickness) and length after it; how much faster than the roll's surface the end
leaves. Mean force and torque are in history.csv.
"""

import json
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import frames

SURFACE_SPEED = 10.0 # mm/s
PASSES = {"first": (3.0, 7.0), "second": (11.0, 16.0)} # s: an instant in the steady part; after the pass


def nearest(results, time):
    return frames.nodes(min(frames.frames(results), key=lambda frame: abs(frame[0] - time))[1])


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def after(points, displacements):
    """Mean thickness and width of the middle half, largest length."""
    x = [p[0] for p in points]
    low, high = min(x), max(x)
    middle = [(p, [a - b for a, b in zip(p, u)]) for p, u in zip(points, displacements)
              if abs(p[0] - 0.5 * (low + high)) < 0.25 * (high - low)]
    top, side = max(start[2] for _, start in middle), max(start[1] for _, start in middle)
    edge = [p for p, start in middle if start[1] > side - 1e-6]
    return {"thickness": 2.0 * mean(p[2] for p, start in middle if start[2] > top - 1e-6),
            "width": 2.0 * mean(p[1] for p in edge), "length": high - low}


def main(results):
    figures = {}
    for name, (steady, done) in PASSES.items():
        points, _, velocities = nearest(results, steady)
        ahead = max(points, key=lambda p: p[0]) if name == "first" else min(points, key=lambda p: p[0])
        speed = mean(abs(v[0]) for p, v in zip(points, velocities) if abs(p[0] - ahead[0]) < 2.0)
        points, displacements, _ = nearest(results, done)
        figures[name] = after(points, displacements) | {"forward_slip": speed / SURFACE_SPEED - 1.0}
    (results / "passes.json").write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")


main(pathlib.Path(sys.argv[1]))
