#!/usr/bin/env python3
"""What the pass makes of the groove and of the bar: pass.json and groove.csv, from the frames of a run.

usage: defect.py RESULTS

Measured on the middle third of the bar's length, in the last frame and in the first. The groove: its outline
between the shoulders, beneath the line through them. pass.json: depth, width of the mouth (where it is deeper than
0.1 mm), angle at the root between the lines to both sides of the mouth, area of its section; thickness of web and
head and height of the rail; elongation; radii to which the bar is bent; forward slip of the front end over the
rolls' speed at the web, and backward slip of the rear end, while the bar is in the gap. groove.csv: the outlines, mean over the
sections of nodes.
"""

import json
import math
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import make_mesh as bar
import frames

ROLL_SPEED = 900.0 # mm/s, surface of the horizontal rolls at the web
STEADY = 0.2 # s, an instant in the steady part
MOUTH = 0.1 # mm
TINY = 1e-6


def read(path):
    """Points now, points at the start, velocities."""
    points, moved, velocities = frames.nodes(path)
    return points, [tuple(a - b for a, b in zip(p, u)) for p, u in zip(points, moved)], velocities


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def middle_third(starts):
    """Numbers of the nodes of the middle third, by stations along the bar."""
    rear = min(x for x, _, _ in starts)
    stations = {}
    for i, (x, _, _) in enumerate(starts):
        if abs(x - rear - bar.LENGTH / 2) < bar.LENGTH / 6 + TINY:
            stations.setdefault(round(x, 4), []).append(i)
    full = max(len(nodes) for nodes in stations.values()) # those between have no nodes inside sides
    return [nodes for _, nodes in sorted(stations.items()) if len(nodes) == full]


def on_flank(start):
    """Whether a point of the section at the start lies on the groove."""
    _, y, z = start
    away = abs(z - bar.GROOVE_AT)
    surface = bar.TOP + bar.GROOVE_DEPTH * (1.0 - 2.0 * away / bar.GROOVE_WIDTH)
    return away < bar.GROOVE_WIDTH / 2 + TINY and abs(y - surface) < TINY


def outline(points, starts, stations):
    """Points (z, depth) of the groove from shoulder to shoulder, mean over the stations."""
    lines = []
    for nodes in stations:
        flank = sorted((i for i in nodes if on_flank(starts[i])), key=lambda i: starts[i][2])
        (_, y0, z0), (_, y1, z1) = points[flank[0]], points[flank[-1]]
        lines.append([(points[i][2], points[i][1] - y0 - (y1 - y0) * (points[i][2] - z0) / (z1 - z0))
                      for i in flank])
    return [(mean(line[i][0] for line in lines), mean(line[i][1] for line in lines))
            for i in range(len(lines[0]))]


def measures(line):
    """Depth, width, angle, area of the groove with the given outline."""
    sides = []
    for way in (line, line[::-1]):
        for (z0, d0), (z1, d1) in zip(way, way[1:]):
            if d1 > MOUTH:
                sides.append(z0 + (z1 - z0) * max(MOUTH - d0, 0.0) / (d1 - d0))
                break
    root, depth = max(line, key=lambda point: point[1])
    if len(sides) < 2:
        return {"depth": depth, "width": 0.0, "angle": 180.0, "area": 0.0}
    angle = sum(math.degrees(math.atan2(abs(side - root), depth)) for side in sides)
    area = sum((z1 - z0) * (d0 + d1) / 2 for (z0, d0), (z1, d1) in zip(line, line[1:]))
    return {"depth": depth, "width": sides[1] - sides[0], "angle": angle, "area": area}


def thickness(points, starts, nodes, axis, low, high):
    """Mean distance along `axis` between the faces that lay at low(start) and high(start)."""
    faces = [[points[i][axis] for i in nodes if face(starts[i])] for face in (low, high)]
    return mean(faces[1]) - mean(faces[0])


def near(value):
    return lambda x: abs(x - value) < TINY


def section(points, starts, stations):
    """Sizes of the section."""
    nodes = [i for station in stations for i in station]
    on_web = lambda s, z: abs(s[2] - z) < TINY and abs(s[1] - 5.0) < 30.0
    on_head = lambda s, z: abs(s[2] - z) < TINY and abs(s[1] + 68.0) < 9.0
    return {"web": thickness(points, starts, nodes, 2, lambda s: on_web(s, -bar.WEB), lambda s: on_web(s, bar.WEB)),
            "head": thickness(points, starts, nodes, 2, lambda s: on_head(s, -bar.SIDE),
                              lambda s: on_head(s, bar.SIDE)),
            "height": thickness(points, starts, nodes, 1,
                                lambda s: abs(s[1] - bar.TOP) < TINY and abs(s[2]) < 30.0,
                                lambda s: abs(s[1] - bar.FOOT) < TINY and abs(s[2]) < 30.0),
            "foot": thickness(points, starts, nodes, 2, lambda s: abs(s[2] - bar.LOWER) < TINY,
                              lambda s: abs(s[2] - bar.UPPER) < TINY)}


def bend(points, stations, axis):
    """1/radius of the line of the sections' middles, positive where it bends towards + axis [1/m]."""
    line = [(mean(points[i][0] for i in nodes), mean(points[i][axis] for i in nodes)) for nodes in stations]
    centre = mean(x for x, _ in line)
    x = [a - centre for a, _ in line]
    y = [b for _, b in line]
    n, s2, s3, s4 = len(x), sum(a ** 2 for a in x), sum(a ** 3 for a in x), sum(a ** 4 for a in x)
    sy, sxy, sx2y = sum(y), sum(a * b for a, b in zip(x, y)), sum(a * a * b for a, b in zip(x, y))
    # Least squares of c0 + c1 x + c2 x^2 with sum(x) = 0, by Cramer.
    determinant = n * (s2 * s4 - s3 * s3) - s2 ** 3
    c2 = (n * (s2 * sx2y - s3 * sxy) - s2 * s2 * sy) / determinant
    return 2000.0 * c2


def main():
    results = pathlib.Path(sys.argv[1])
    all_frames = list(frames.frames(results))
    first, last = read(all_frames[0][1]), read(all_frames[-1][1])
    stations = middle_third(first[1])
    lines = {name: outline(frame[0], first[1], stations) for name, frame in (("before", first), ("after", last))}
    with open(results / "groove.csv", "w", encoding="utf-8") as out:
        out.write("z_before,depth_before,z_after,depth_after\n")
        for before, after in zip(lines["before"], lines["after"]):
            out.write(",".join(f"{value:.9g}" for value in (*before, *after)) + "\n")
    found = {name: measures(line) | section(frame[0], first[1], stations)
             for (name, line), frame in zip(lines.items(), (first, last))}
    length = [mean(frame[0][i][0] for i in stations[-1]) - mean(frame[0][i][0] for i in stations[0])
              for frame in (first, last)]
    found["elongation"] = length[1] / length[0]
    found["bend_towards_foot"] = bend(last[0], stations, 1)
    found["bend_upwards"] = bend(last[0], stations, 2)
    _, starts, velocities = read(min(all_frames, key=lambda frame: abs(frame[0] - STEADY))[1])
    for name, end in (("forward_slip", max), ("entry", min)):
        x_end = end(x for x, _, _ in starts)
        speed = mean(v[0] for v, s in zip(velocities, starts) if abs(s[0] - x_end) < TINY)
        found[name] = speed / ROLL_SPEED - 1.0
    (results / "pass.json").write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")


main()
