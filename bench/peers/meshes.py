"""Meshes of the upsetting models: plain lists, the same for every program.

A mesh models one half of the height (z or y from 0 at the symmetry plane to `height` at the tool);
in 3D also one quarter of the circumference. Nodes and elements count from 1. Node order within an
element is that of Abaqus and CalculiX.
"""

import math
from dataclasses import dataclass, field

QUAD_FACES = ((1, 2), (2, 3), (3, 4), (4, 1))
HEX_FACES = ((1, 2, 3, 4), (5, 8, 7, 6), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 8, 4), (4, 8, 5, 1))
QUAD_EDGES = QUAD_FACES
HEX_EDGES = ((1, 2), (2, 3), (3, 4), (4, 1), (5, 6), (6, 7), (7, 8), (8, 5),
             (1, 5), (2, 6), (3, 7), (4, 8))


@dataclass
class Mesh:
    kind: str                                    # quad4, quad8, hex8 or hex20
    radius: float
    height: float
    cells: tuple                                 # what a structured generator needs to repeat it
    nodes: list = field(default_factory=list)    # coordinates, two or three
    elements: list = field(default_factory=list)  # node numbers

    @property
    def plane(self):
        """True for axisymmetric meshes."""
        return self.kind.startswith("quad")

    @property
    def axial(self):
        """Index of the coordinate along the axis of the cylinder."""
        return 1 if self.plane else 2

    def nodes_where(self, holds):
        return [number for number, x in enumerate(self.nodes, 1) if holds(x)]

    def faces_where(self, holds):
        """(element, face) pairs, counted from 1, all of whose corners satisfy `holds`."""
        faces = QUAD_FACES if self.plane else HEX_FACES
        return [(number, face) for number, element in enumerate(self.elements, 1)
                for face, corners in enumerate(faces, 1)
                if all(holds(self.nodes[element[c - 1] - 1]) for c in corners)]

    def on_end(self, x):
        return abs(x[self.axial] - self.height) < 1e-9 * self.height

    def on_side(self, x):
        distance = x[0] if self.plane else math.hypot(x[0], x[1])
        return abs(distance - self.radius) < 1e-9 * self.radius


def rectangle(kind, radius, height, n_radius, n_height):
    """Axisymmetric half model: radius 0..R along x, 0..height along y."""
    mesh = Mesh(kind, radius, height, (n_radius, n_height))
    mesh.nodes = [(radius * i / n_radius, height * j / n_height)
                  for j in range(n_height + 1) for i in range(n_radius + 1)]
    row = n_radius + 1
    for j in range(n_height):
        for i in range(n_radius):
            first = j * row + i + 1
            mesh.elements.append([first, first + 1, first + row + 1, first + row])
    return with_middle_nodes(mesh) if kind == "quad8" else mesh


def quarter_cylinder(kind, radius, height, n_core, n_ring, n_height):
    """Quarter of a cylinder: a core of n_core x n_core cells, n_ring rings around it, extruded."""
    points, quads = quarter_disc(radius, n_core, n_ring)
    mesh = Mesh(kind, radius, height, (n_core, n_ring, n_height))
    for k in range(n_height + 1):
        mesh.nodes += [(x, y, height * k / n_height) for x, y in points]
    for k in range(n_height):
        lower, upper = k * len(points), (k + 1) * len(points)
        mesh.elements += [[n + lower for n in quad] + [n + upper for n in quad] for quad in quads]
    return with_middle_nodes(mesh) if kind == "hex20" else mesh


def quarter_disc(radius, n_core, n_ring):
    """Points and counter-clockwise quadrangles of a quarter disc."""
    side, corner = 0.5 * radius, 0.4 * radius
    numbers, points, quads = {}, [], []

    def number(key, x, y):
        if key not in numbers:
            points.append((x, y))
            numbers[key] = len(points)
        return numbers[key]

    def core(i, j):
        s, t = i / n_core, j / n_core
        return number((i, j, 0), s * (1 - t) * side + s * t * corner,
                      t * (1 - s) * side + s * t * corner)

    def spoke(k, ring):
        i, j = (n_core, k) if k <= n_core else (2 * n_core - k, n_core)
        inner = core(i, j)
        if ring == 0:
            return inner
        x, y = points[inner - 1]
        angle = math.pi / 4 * k / n_core
        w = ring / n_ring
        outer = (radius * math.cos(angle), radius * math.sin(angle))
        if k in (0, 2 * n_core):  # exactly on the symmetry planes
            outer = (radius, 0.0) if k == 0 else (0.0, radius)
        return number((i, j, ring), x + w * (outer[0] - x), y + w * (outer[1] - y))

    for j in range(n_core):
        for i in range(n_core):
            quads.append([core(i, j), core(i + 1, j), core(i + 1, j + 1), core(i, j + 1)])
    for ring in range(n_ring):
        for k in range(2 * n_core):
            quads.append([spoke(k, ring), spoke(k, ring + 1),
                          spoke(k + 1, ring + 1), spoke(k + 1, ring)])
    return points, quads


def with_middle_nodes(mesh):
    """Adds the middle nodes of the quadratic element; those on the side surface lie on the circle."""
    edges = QUAD_EDGES if mesh.plane else HEX_EDGES
    middles = {}
    for element in mesh.elements:
        for a, b in edges:
            ends = tuple(sorted((element[a - 1], element[b - 1])))
            if ends not in middles:
                mesh.nodes.append(middle(mesh, *(mesh.nodes[n - 1] for n in ends)))
                middles[ends] = len(mesh.nodes)
            element.append(middles[ends])
    return mesh


def middle(mesh, a, b):
    x = [(p + q) / 2 for p, q in zip(a, b)]
    if not mesh.plane and mesh.on_side(a) and mesh.on_side(b):
        scale = mesh.radius / math.hypot(x[0], x[1])
        x[:2] = [scale * x[0], scale * x[1]]
    return tuple(x)
