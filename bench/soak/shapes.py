"""Outlines of dies with rounded corners, facets of STL files and mapped meshes, as texts of input files."""

import itertools
import math


def rounded(corners):
    """Ends of lines and arcs (x, y, radius; > 0 turns left, 0: a line) of a chain of corners (x, y, radius).

    A rounding takes at most 45 % of the shorter adjacent side, so that neighbours never overlap."""
    ends = [(*corners[0][:2], 0.0)]
    for (x0, y0, _), (x1, y1, radius), (x2, y2, _) in zip(corners, corners[1:], corners[2:]):
        back, on = math.hypot(x1 - x0, y1 - y0), math.hypot(x2 - x1, y2 - y1)
        a, b = ((x1 - x0) / back, (y1 - y0) / back), ((x2 - x1) / on, (y2 - y1) / on)
        turn = math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])
        cut = min(radius * math.tan(abs(turn) / 2), 0.45 * min(back, on))
        if cut < 1e-9:
            ends.append((x1, y1, 0.0))
            continue
        ends.append((x1 - cut * a[0], y1 - cut * a[1], 0.0))
        ends.append((x1 + cut * b[0], y1 + cut * b[1], math.copysign(cut / math.tan(abs(turn) / 2), turn)))
    return ends + [(*corners[-1][:2], 0.0)]


def mirrored(ends):
    """The chain upside down and walked the other way, so that the tool stays on its left."""
    radii = [radius for *_, radius in ends[:0:-1]]
    return [(x, -y, radius) for (x, y, _), radius in zip(ends[::-1], [0.0] + radii)]


def profile(ends, closed=False, shift=0.0):
    """File of a profile or of an outline, moved by `shift` along x."""
    lines = [f"start = [{ends[0][0] + shift:.8g}, {ends[0][1]:.8g}]"] + (["closed = true"] if closed else [])
    for x, y, radius in ends[1:]:
        lines += ["[[segment]]", f"to = [{x + shift:.8g}, {y:.8g}]"] + ([f"radius = {radius:.8g}"] if radius else [])
    return "\n".join(lines) + "\n"


def sampled(ends, pieces=24):
    """Points on a chain of lines and arcs."""
    points = [ends[0][:2]]
    for x, y, radius in ends[1:]:
        x0, y0 = points[-1]
        if radius:
            chord, side = math.hypot(x - x0, y - y0), math.copysign(1.0, radius)
            half = math.asin(min(1.0, chord / (2 * abs(radius))))
            rise = side * abs(radius) * math.cos(half) / chord
            cx, cy = (x0 + x) / 2 - rise * (y - y0), (y0 + y) / 2 + rise * (x - x0)
            start = math.atan2(y0 - cy, x0 - cx)
            points += [(cx + abs(radius) * math.cos(start + 2 * side * half * i / pieces),
                        cy + abs(radius) * math.sin(start + 2 * side * half * i / pieces)) for i in range(1, pieces)]
        points.append((x, y))
    return points


def pairs(points, end):
    """Pieces of a chain that goes to larger x, from the axis to `end`."""
    def at(x0, y0, x1, y1, x):
        return y0 + (y1 - y0) * (x - x0) / (x1 - x0)

    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        low, high = max(x0, 0.0), min(x1, end)
        if low < high:
            yield low, at(x0, y0, x1, y1, low), high, at(x0, y0, x1, y1, high)


def turned_volume(points, end):
    """Between y = 0 and a chain, turned about the y axis, out to the radius `end`."""
    return sum(math.pi * (b - a) * (ya * (2 * a + b) + yb * (a + 2 * b)) / 3 for a, ya, b, yb in pairs(points, end))


def lowest(points, end):
    """Smallest height of a chain from the axis to `end`."""
    return min(min(ya, yb) for _, ya, _, yb in pairs(points, end))


def stl(facets):
    text = "solid body\n"
    for facet in facets:
        text += "facet normal 0 0 0\nouter loop\n"
        text += "".join("vertex %.7g %.7g %.7g\n" % tuple(point) for point in facet)
        text += "endloop\nendfacet\n"
    return text + "endsolid body\n"


def height_field(height, xs, ys):
    """Facets of the lower side of a die z = height(x, y) over a grid."""
    at = [[(x, y, height(x, y)) for y in ys] for x in xs]
    for i, j in itertools.product(range(len(xs) - 1), range(len(ys) - 1)):
        a, b, c, d = at[i][j], at[i + 1][j], at[i + 1][j + 1], at[i][j + 1]
        yield a, c, b
        yield a, d, c


def prism(outline, height):
    """Facets of a prism; `outline` is counter-clockwise, and its first corner sees all the others."""
    low, high = [(x, y, 0.0) for x, y in outline], [(x, y, height) for x, y in outline]
    for i in range(1, len(outline) - 1):
        yield low[0], low[i + 1], low[i]
        yield high[0], high[i], high[i + 1]
    for i in range(len(outline)):
        j = (i + 1) % len(outline)
        yield low[i], low[j], high[j]
        yield low[i], high[j], high[i]


def mapped_mesh(kind, cells, place):
    """A mesh file: a grid of quad4, quad8 or hex8 whose nodes lie at `place(u, v[, w])`, each from 0 to 1."""
    step = 2 if kind == "quad8" else 1
    number, lines = {}, ["*NODE"]
    for node in itertools.product(*(range(step * n + 1) for n in cells)):
        if kind == "quad8" and node[0] % 2 and node[1] % 2:
            continue
        number[node] = len(number) + 1
        point = place(*(i / step / n for i, n in zip(node, cells)))
        lines.append(f"{number[node]}, " + ", ".join(f"{x:.9g}" for x in point))
    ring = [(0, 0), (step, 0), (step, step), (0, step)]
    corners = ring if len(cells) == 2 else [(*c, 0) for c in ring] + [(*c, 1) for c in ring]
    corners = corners + ([(1, 0), (2, 1), (1, 2), (0, 1)] if kind == "quad8" else [])
    lines.append("*ELEMENT, TYPE=" + {"quad4": "CPE4", "quad8": "CPE8", "hex8": "C3D8"}[kind])
    for n, cell in enumerate(itertools.product(*(range(n) for n in cells)), 1):
        lines.append(f"{n}, " + ", ".join(str(number[tuple(step * i + d for i, d in zip(cell, c))]) for c in corners))
    return "\n".join(lines) + "\n"
