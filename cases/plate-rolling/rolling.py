#!/usr/bin/env python3
"""What a strip does in the roll gap: arc.csv and rolling.json, from the frames of a run.

usage: rolling.py RESULTS

arc.csv: pressure and shear under the upper roll over the angle from the exit plane, averaged over
the frames of the steady part. rolling.json: the neutral angle, where the shear changes its sign, and
the forward slip, how much faster than the roll's surface the strip leaves.
"""

import json
import math
import pathlib
import sys
import xml.etree.ElementTree as xml

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import frames

RADIUS, CENTRE, SURFACE_SPEED = 100.0, 100.8, 10.0 # mm, mm, mm/s
STEADY = (1.2, 2.4) # s: after the bite, before the tail is near
BINS, WIDTH = 20, 0.2 # of the arc, degrees


def steady_frames(results, part):
    """Paths of the frames of one part in the steady time."""
    collection = xml.parse(next(results.glob("*.pvd"))).getroot()
    for item in collection.iter("DataSet"):
        if item.get("name") == part and STEADY[0] <= float(item.get("timestep")) <= STEADY[1]:
            yield results / item.get("file")


def arrays(path, section, names):
    """Named arrays of a frame's section; vectors as tuples, one row per point or cell."""
    root = xml.parse(path).getroot()
    data = {e.get("Name"): e for e in root.find(f".//{section}")}
    columns = []
    for name in names:
        values = frames.array(root, data[name])
        width = int(data[name].get("NumberOfComponents") or 1)
        columns.append(values if width == 1 else list(zip(*(values[i::width] for i in range(width)))))
    return columns


def arc_faces(path):
    """(angle [deg], pressure, shear that draws in) of the faces under the upper roll, from the exit."""
    (points,) = arrays(path, "Points", ("Points",))
    (nodes,) = arrays(path, "Lines", ("connectivity",))
    rows = []
    for a, b, pressure, shear in zip(nodes[0::2], nodes[1::2],
                                     *arrays(path, "CellData", ("contact_pressure", "friction_stress"))):
        x, y = (0.5 * (points[a][i] + points[b][i]) for i in (0, 1))
        angle = math.degrees(math.atan2(-x, CENTRE - y))
        if y > 0.0 and pressure > 0.0 and angle < 5.0:
            rows.append((angle, pressure, shear[0]))
    return sorted(rows)


def neutral_angle(rows):
    """Where the shear changes from holding back to drawing in; linear between faces."""
    changes = [a0 + (a1 - a0) * s0 / (s0 - s1) for (a0, _, s0), (a1, _, s1) in zip(rows, rows[1:])
               if s0 < 0.0 <= s1]
    return sum(changes) / len(changes)


def main(results):
    arcs = [arc_faces(path) for path in steady_frames(results, "contact")]
    bins = [[] for _ in range(BINS)]
    for angle, pressure, shear in (row for rows in arcs for row in rows):
        if 0.0 <= angle < BINS * WIDTH:
            bins[int(angle / WIDTH)].append((pressure, shear))
    with open(results / "arc.csv", "w", encoding="utf-8") as out:
        out.write("angle,pressure,shear\n")
        for i, rows in enumerate(bins):
            if rows:
                mean = [sum(column) / len(rows) for column in zip(*rows)]
                out.write(f"{(i + 0.5) * WIDTH:.3f},{mean[0]:.6g},{mean[1]:.6g}\n")
    speeds = []
    for path in steady_frames(results, "workpiece"):
        (points,) = arrays(path, "Points", ("Points",))
        (velocities,) = arrays(path, "PointData", ("velocity",))
        front = max(x for x, _, _ in points)
        speeds += [v[0] for (x, _, _), v in zip(points, velocities) if x > front - 0.5]
    neutral = [neutral_angle(rows) for rows in arcs]
    figures = {"neutral_angle_deg": sum(neutral) / len(neutral),
               "forward_slip": sum(speeds) / len(speeds) / SURFACE_SPEED - 1.0}
    (results / "rolling.json").write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")


main(pathlib.Path(sys.argv[1]))
