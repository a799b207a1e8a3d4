#!/usr/bin/env python3
"""Writes lower.toml and upper.toml, the contours of the dies, and prints the volume of the cavity.

usage: make_dies.py

The radius is x, the axis of the hub y. Each contour is a chain of straight lines whose corners are
rounded; the parting plane is y = 0, where the dies stand when the part is finished.
"""

import math
import pathlib

LAND = 1.25            # half the thickness of the flash [mm]
BOSS = {"lower": 22.0, "upper": 30.0} # depth of the boss from the parting plane
WEB, RIM = 5.0, 14.0   # of web and rim, in both dies
DRAFT = math.tan(math.radians(5.0))
SLOPE = math.tan(math.radians(20.0)) # of the rim's inner wall, for metal that comes from the web
INNER, OUTER = 27.0, 48.7 # radii of the web's edges
RIM_OUTER = 69.0       # of the cavity at the flash
LAND_END, GUTTER, GUTTER_DEPTH, FAR = 77.0, 80.0, 5.0, 110.0


def corners(boss):
    """Corners (r, height below the parting plane, radius of the rounding) from the axis outward."""
    rim_wall = DRAFT * (RIM - LAND)
    return [(-10.0, boss, 0.0), (INNER - DRAFT * (boss - WEB), boss, 4.0), (INNER, WEB, 5.0),
            (OUTER, WEB, 8.0), (OUTER + SLOPE * (RIM - WEB), RIM, 4.0), (RIM_OUTER - rim_wall, RIM, 4.0),
            (RIM_OUTER, LAND, 2.5), (LAND_END, LAND, 2.0), (GUTTER, GUTTER_DEPTH, 2.0), (FAR, GUTTER_DEPTH, 0.0)]


def rounded(points):
    """Lines and arcs: a list of (end, radius), radius None for a line, > 0 turning left."""
    segments = []
    for i in range(1, len(points) - 1):
        (x0, y0, _), (x1, y1, radius), (x2, y2, _) = points[i - 1], points[i], points[i + 1]
        a = ((x1 - x0), (y1 - y0))
        b = ((x2 - x1), (y2 - y1))
        la, lb = math.hypot(*a), math.hypot(*b)
        a, b = (a[0] / la, a[1] / la), (b[0] / lb, b[1] / lb)
        turn = math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])
        cut = radius * math.tan(abs(turn) / 2.0)
        segments.append(((x1 - cut * a[0], y1 - cut * a[1]), None))
        segments.append(((x1 + cut * b[0], y1 + cut * b[1]), math.copysign(radius, turn)))
    segments.append((points[-1][:2], None))
    return segments


def text(points):
    lines = [f"# Written by make_dies.py: [radius, height] in mm; the die is on the left.\n"
             f"start = [{points[0][0]:.6f}, {points[0][1]:.6f}]\n"]
    for (x, y), radius in rounded(points):
        lines.append(f"\n[[segment]]\nto = [{x:.6f}, {y:.6f}]\n" + (f"radius = {radius:g}\n" if radius else ""))
    return "".join(lines)


def sampled(points):
    """The contour as a fine chain of points."""
    chain = [points[0][:2]]
    for (x, y), radius in rounded(points):
        x0, y0 = chain[-1]
        if radius is None:
            chain.append((x, y))
            continue
        chord = math.hypot(x - x0, y - y0)
        half = math.asin(chord / (2.0 * abs(radius)))
        side = math.copysign(1.0, radius)
        mx, my = (x0 + x) / 2, (y0 + y) / 2
        rise = abs(radius) * math.cos(half)
        cx, cy = mx - side * rise * (y - y0) / chord, my + side * rise * (x - x0) / chord
        start = math.atan2(y0 - cy, x0 - cx)
        for i in range(1, 41):
            angle = start + side * 2.0 * half * i / 40
            chain.append((cx + abs(radius) * math.cos(angle), cy + abs(radius) * math.sin(angle)))
    return chain


def volume(chain, end):
    """Of the body of revolution between the parting plane and a contour, out to a radius."""
    total = 0.0
    for (x0, y0), (x1, y1) in zip(chain, chain[1:]):
        a, b = max(x0, 0.0), min(x1, end)
        if b <= a:
            continue
        height = lambda x: abs(y0 + (y1 - y0) * (x - x0) / (x1 - x0))
        total += math.pi * (b - a) * (height(a) * (2 * a + b) + height(b) * (a + 2 * b)) / 3.0
    return total


def contour(name):
    """Corners of a die's contour with their rounding, the die on the left."""
    sign = -1.0 if name == "lower" else 1.0
    points = [(x, sign * y, r) for x, y, r in corners(BOSS[name])]
    return points[::-1] if name == "lower" else points


def cavity(end=RIM_OUTER):
    """Volume between the closed dies out to a radius [mm3]."""
    lower, upper = sampled(contour("lower"))[::-1], sampled(contour("upper"))
    return volume(lower, end) + volume(upper, end)


if __name__ == "__main__":
    folder = pathlib.Path(__file__).parent
    for name in ("lower", "upper"):
        (folder / f"{name}.toml").write_text(text(contour(name)))
    print(f"cavity {cavity():.0f} mm3 to the flash land, flash land {cavity(LAND_END) - cavity():.0f} mm3")
