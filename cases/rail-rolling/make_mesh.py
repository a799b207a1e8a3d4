#!/usr/bin/env python3
"""Writes bar.inp: the bar before the pass, 18 quadrilaterals in its section times 10 slices of hex20.

usage: make_mesh.py [--linear | --tetra] [TIMES [SLICES]]
every quadrilateral cut in TIMES x TIMES (1); SLICES along the bar (10); --linear: hex8;
--tetra: every hexahedron cut into six tet10

The rail lies on its side: x along the bar (its front end at x = 0), y from the head to the foot, z up.
Its section has no symmetry: the lower flange of the foot is longer, the groove in the running
surface lies 12 mm above the middle.
"""

import pathlib
import sys

LENGTH = 260.0 # mm
TOP, HEAD, INNER, FOOT = -85.0, -48.0, 58.0, 85.0 # y of the running surface, of the web's ends, of the base
WEB, SIDE, UPPER, LOWER = 18.0, 38.0, 70.0, -76.0 # half the web, half the head, tips of the flanges
FLANGE_SLOPE, HEAD_SLOPE = 0.185, 0.3 # of the faces between web and flange, web and head
GROOVE_AT, GROOVE_WIDTH, GROOVE_DEPTH = 12.0, 16.0, 6.0


def flange(z):
    """Inner face of the foot at height z."""
    return (INNER + FLANGE_SLOPE * max(abs(z) - WEB, 0.0), z)


def fishing(z):
    """Face of the head towards the web."""
    return (HEAD - HEAD_SLOPE * max(abs(z) - WEB, 0.0), z)


def section():
    """Quadrilaterals of the section, each four corners (y, z), counter-clockwise."""
    foot_z = [LOWER, -47.0, -WEB, 0.0, WEB, 44.0, UPPER]
    head_z = [-SIDE, -WEB, 0.0, WEB, SIDE]
    low, high = GROOVE_AT - GROOVE_WIDTH / 2, GROOVE_AT + GROOVE_WIDTH / 2
    columns = [
        [[(TOP, -SIDE), (TOP, low), (TOP + GROOVE_DEPTH, GROOVE_AT), (TOP, high), (TOP, SIDE)],
         [(-68.0, z) for z in (-SIDE, -8.0, 6.0, 20.0, SIDE)], [fishing(z) for z in head_z]],
        [[fishing(z) for z in head_z[1:4]], [(5.0, z) for z in (-WEB, 0.0, WEB)],
         [flange(z) for z in foot_z[2:5]]],
        [[flange(z) for z in foot_z], [(FOOT, z) for z in foot_z]]]
    for lines in columns:
        for left, right in zip(lines, lines[1:]):
            for i in range(len(left) - 1):
                yield left[i], right[i], right[i + 1], left[i + 1]


def refined(quads, times):
    """Every quadrilateral cut in times x times, evenly along its sides."""
    def at(quad, s, t):
        return tuple((1 - s) * (1 - t) * a + s * (1 - t) * b + s * t * c + (1 - s) * t * d
                     for a, b, c, d in zip(*quad))
    for quad in quads:
        for i in range(times):
            for j in range(times):
                yield [at(quad, (i + k) / times, (j + m) / times) for k, m in ((0, 0), (1, 0), (1, 1), (0, 1))]


def middle(a, b):
    return tuple((p + q) / 2 for p, q in zip(a, b))


class Nodes:
    """Numbers of places (y, z, station), from 1 on in the order in which they are asked for."""

    def __init__(self):
        self.numbers = {}

    def at(self, point, station):
        key = (round(point[0], 9), round(point[1], 9), station)
        return self.numbers.setdefault(key, len(self.numbers) + 1)


def hexahedra(nodes, times, slices, linear):
    """Nodes of each hex8 or hex20; stations are half a slice apart."""
    for step in range(slices):
        near, mid, far = 2 * step, 2 * step + 1, 2 * step + 2
        for corners in refined(section(), times):
            element = [nodes.at(p, k) for k in (near, far) for p in corners]
            if not linear:
                sides = [middle(corners[i], corners[(i + 1) % 4]) for i in range(4)]
                element += [nodes.at(p, k) for k in (near, far) for p in sides]
                element += [nodes.at(p, mid) for p in corners]
            yield element


def cut_prism(corners, numbers):
    """The three tetrahedra of a prism, corners[0:3] under corners[3:6].

    The diagonal of each of its quadrilaterals starts at the lowest number, so that neighbours agree.
    """
    k = min(range(6), key=lambda i: numbers[i])
    turn = k % 3
    order = [turn, (turn + 1) % 3, (turn + 2) % 3]
    if k >= 3: # the other end is the bottom; turned about so that the volume stays positive
        order = [order[0], order[2], order[1]]
        bottom, top = [i + 3 for i in order], order
    else:
        bottom, top = order, [i + 3 for i in order]
    a, b, c = (corners[i] for i in bottom)
    d, e, f = (corners[i] for i in top)
    opposite = [numbers[i] for i in (bottom[1], bottom[2], top[1], top[2])]
    if min(opposite) in (opposite[0], opposite[3]): # the far diagonal goes from b to f
        return [(a, b, c, f), (a, b, f, e), (a, e, f, d)]
    return [(a, b, c, e), (a, e, c, f), (a, e, f, d)]


def tetrahedra(nodes, times, slices):
    """Nodes of each tet10, six of a hexahedron."""
    for step in range(slices):
        ends = (2 * step, 2 * step + 2)
        for quad in refined(section(), times):
            numbers = [nodes.at(p, ends[0]) for p in quad]
            first = min(range(4), key=lambda i: numbers[i])
            for half in ((0, 1, 2), (0, 2, 3)):
                corners = [(quad[(first + i) % 4], k) for k in ends for i in half]
                for tetrahedron in cut_prism(corners, [nodes.at(*corner) for corner in corners]):
                    yield [nodes.at(*corner) for corner in tetrahedron] + [
                        nodes.at(middle(tetrahedron[i][0], tetrahedron[j][0]),
                                 (tetrahedron[i][1] + tetrahedron[j][1]) // 2)
                        for i, j in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))]


KINDS = {"C3D8": "hex8", "C3D20": "hex20", "C3D10": "tet10"}


def write(path, kind, times, slices):
    nodes = Nodes()
    elements = list(tetrahedra(nodes, times, slices) if kind == "C3D10" else
                    hexahedra(nodes, times, slices, kind == "C3D8"))
    with open(path, "w", encoding="utf-8") as out:
        out.write("*NODE\n")
        for (y, z, station), number in nodes.numbers.items():
            x = LENGTH * (station / (2 * slices) - 1.0)
            out.write(f"{number}, {x:.9g}, {y:.9g}, {z:.9g}\n")
        out.write(f"*ELEMENT, TYPE={kind}, ELSET=bar\n")
        for number, element in enumerate(elements, 1):
            words = [str(n) for n in [number, *element]]
            out.write(",\n".join(", ".join(line) for line in (words[:11], words[11:]) if line) + "\n")
    print(f"{len(elements)} {KINDS[kind]}, {len(nodes.numbers)} nodes")


if __name__ == "__main__":
    words = sys.argv[1:]
    kind = "C3D8" if "--linear" in words else "C3D10" if "--tetra" in words else "C3D20"
    given = [int(word) for word in words if not word.startswith("--")]
    times, slices = [*given, *(1, 10)[len(given):]]
    write(pathlib.Path(__file__).with_name("bar.inp"), kind, times, slices)
