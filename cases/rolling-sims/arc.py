#!/usr/bin/env python3
"""What the slab does in the roll gap: arc.csv and rolling.json, from the frames of a run; theory.csv.

usage: arc.py RESULTS

arc.csv: pressure and shear over 2k under the roll over the angle from the exit plane, averaged over the steady
frames. rolling.json: the neutral angle, where the shear changes its sign; the forward slip, how much faster than the roll's
surface the slab leaves; the share of the arc on which the shear is less than 0.9 k. theory.csv: the pressures of theory.py.
"""

import json
import math
import pathlib
import sys
import xml.etree.ElementTree as xml

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import frames
import theory

SURFACE_SPEED, STEADY = 10.0, (5.0, 10.0) # mm/s, s
BINS, WIDTH = 24, 0.5 # of the arc, degrees
CENTRE = theory.H2 / 2 + theory.R


def steady(results, part):
    for item in xml.parse(next(results.glob("*.pvd"))).getroot().iter("DataSet"):
        if item.get("name") == part and STEADY[0] <= float(item.get("timestep")) <= STEADY[1]:
            yield results / item.get("file")


def arc_faces(path):
    """(angle [deg], pressure, shear that draws in, both over 2k) of the faces under the roll, from the exit."""
    root = xml.parse(path).getroot()
    points = list(zip(*(frames.array(root, root.find(".//Points/DataArray"))[i::3] for i in range(3))))
    nodes = frames.array(root, root.find(".//Lines/DataArray[@Name='connectivity']"))
    pressures, shears = (frames.array(root, root.find(f".//CellData/DataArray[@Name='{name}']"))
                         for name in ("contact_pressure", "friction_stress"))
    rows = []
    for a, b, pressure, shear in zip(nodes[0::2], nodes[1::2], pressures, shears[0::3]):
        x, y = (0.5 * (points[a][i] + points[b][i]) for i in (0, 1))
        angle = math.degrees(math.atan2(-x, CENTRE - y))
        if pressure > 0.0 and -1.0 < angle < 12.0 and y > 1.0:
            rows.append((angle, pressure / theory.TWO_K, shear / theory.TWO_K))
    return sorted(rows)


def neutral_angle(rows):
    """Where the shear changes from holding back to drawing in; linear between faces."""
    changes = [a0 + (a1 - a0) * s0 / (s0 - s1) for (a0, _, s0), (a1, _, s1) in zip(rows, rows[1:])
               if s0 < 0.0 <= s1]
    return sum(changes) / len(changes)


def main(results):
    arcs = [arc_faces(path) for path in steady(results, "contact")]
    with open(results / "arc.csv", "w", encoding="utf-8") as out:
        out.write("angle,pressure,shear\n")
        for i in range(BINS):
            rows = [row[1:] for rows in arcs for row in rows if i * WIDTH <= row[0] < (i + 1) * WIDTH]
            if rows:
                mean = [sum(column) / len(rows) for column in zip(*rows)]
                out.write(f"{(i + 0.5) * WIDTH:.3f},{mean[0]:.6g},{mean[1]:.6g}\n")
    with open(results / "theory.csv", "w", encoding="utf-8") as out:
        out.write("angle,orowan\n")
        parts = 200
        for i, s in enumerate(map(min, zip(theory.march(1.0, 1, parts), theory.march(1.0, -1, parts)))):
            out.write(f"{math.degrees(i * theory.ALPHA / parts):.4f},{s / theory.TWO_K:.6g}\n")
    speeds = []
    for path in steady(results, "workpiece"):
        points, _, velocities = frames.nodes(path)
        front = max(x for x, _, _ in points)
        speeds += [v[0] for (x, _, _), v in zip(points, velocities) if x > front - 1.0]
    neutral = [neutral_angle(rows) for rows in arcs]
    shears = [abs(row[2]) for rows in arcs for row in rows if 0.5 <= row[0] <= 9.5]
    figures = {"neutral_angle_deg": sum(neutral) / len(neutral),
               "forward_slip": sum(speeds) / len(speeds) / SURFACE_SPEED - 1.0,
               "arc_below_0.9k": sum(s < 0.45 for s in shears) / len(shears)}
    (results / "rolling.json").write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")


main(pathlib.Path(sys.argv[1]))
