"""Scenes with tools of any size, and how deep a tool lies in the part, found without the program."""

import math
import random
import xml.etree.ElementTree as xml
from dataclasses import dataclass, field

PLANE = ("circle", "wedge", "nose")
SPACE = ("sphere", "cylinder", "cone", "ring", "stl ball", "stl spike")
ELEMENTS = {2: ("quad4", "quad8"), 3: ("hex8", "hex20")}


def faces(file, shape):
    """Faces of a frame's contact surface: lists of points, corners in turn."""
    root = xml.parse(file).getroot()
    flat = shape.array(root, root.find(".//Points/DataArray"))
    points = list(zip(flat[0::3], flat[1::3], flat[2::3]))
    found = []
    for kind in ("Lines", "Polys"):
        arrays = {e.get("Name"): e for e in root.find(f".//{kind}")}
        nodes, start = shape.array(root, arrays["connectivity"]), 0
        for end in shape.array(root, arrays["offsets"]):
            found.append([points[i] for i in nodes[start:end]])
            start = end
    return found


def ball(centre, radius, subdivisions=2):
    """Triangles of an icosahedron whose edges are halved."""
    g = (1 + math.sqrt(5)) / 2
    corners = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
               (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    triangles = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
                 (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11),
                 (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    cut = [tuple(corners[i] for i in t) for t in triangles]
    for _ in range(subdivisions):
        def middle(a, b):
            return tuple((x + y) / 2 for x, y in zip(a, b))
        cut = [t for a, b, c in cut for t in ((a, middle(a, b), middle(a, c)), (b, middle(b, c), middle(a, b)),
                                              (c, middle(a, c), middle(b, c)),
                                              (middle(a, b), middle(b, c), middle(a, c)))]

    def out(p):
        length = math.sqrt(sum(x * x for x in p))
        return tuple(c + radius * x / length for c, x in zip(centre, p))
    return [tuple(out(p) for p in t) for t in cut]


def spike(tip, half_width, height):
    """A pyramid on its tip."""
    top = [(tip[0] + sx * half_width, tip[1] + sy * half_width, tip[2] + height)
           for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    sides = [(tip, top[(i + 1) % 4], top[i]) for i in range(4)]
    return sides + [(top[0], top[1], top[2]), (top[0], top[2], top[3])]


@dataclass
class Scene:
    dim: int
    kind: str
    element_kind: str
    analysis: str
    cells: int
    element: float                 # size of the elements
    radius: float                  # of the tool
    at: tuple                      # where its lowest point is over the block [x, y]
    stroke: float                  # it goes down by
    aside: float                   # and to the side by
    angle: float                   # of a wedge, cone or spike, half of it [deg]
    increments: int                # 0: automatic
    contact: str = ""
    triangles: list = field(default_factory=list)

    def __str__(self):
        return (f"{self.kind} of {self.radius / self.element:.3g} elements, {self.analysis}, {self.element_kind}, "
                f"stroke {self.stroke / self.element:.2g}, aside {self.aside / self.element:.2g}, "
                f"increments {self.increments or 'automatic'} {self.contact}")

    @property
    def height(self):
        return 4 * self.element

    def tip(self):
        """Lowest point of the tool at the start: on the block."""
        return (*self.at, self.height) if self.dim == 3 else (self.at[0], self.height, 0.0)

    def surface(self):
        x, y, z = self.tip()
        r, e = self.radius, self.element
        if self.kind == "circle":
            return f"{{ circle = {{ centre = [{x!r}, {y + r!r}], radius = {r!r} }} }}"
        if self.kind == "wedge":
            w = 3 * e * math.tan(math.radians(self.angle))
            return f"{{ points = [[{x - w!r}, {y + 3 * e!r}], [{x!r}, {y!r}], [{x + w!r}, {y + 3 * e!r}]] }}"
        if self.kind == "nose":      # a blade with a round edge
            return '{ profile = "nose.toml" }'
        if self.kind == "sphere":
            return f"{{ sphere = {{ centre = [{x!r}, {y!r}, {z + r!r}], radius = {r!r} }} }}"
        if self.kind == "cylinder":
            return (f"{{ cylinder = {{ point = [{x!r}, {y!r}, {z + r!r}], axis = [{math.sin(self.angle)!r}, "
                    f"{math.cos(self.angle)!r}, 0], radius = {r!r} }} }}")
        if self.kind == "cone":
            return f"{{ cone = {{ apex = [{x!r}, {y!r}, {z!r}], axis = [0, 0, 1], half_angle = {self.angle!r} }} }}"
        if self.kind == "ring":
            return (f"{{ torus = {{ centre = [{x!r}, {y!r}, {z + r!r}], axis = [0, 0, 1], major = {max(e, 2 * r)!r}, "
                    f"minor = {r!r} }} }}")
        return '{ stl = "tool.stl", unit = "mm" }'

    def write(self, folder):
        size = self.cells * self.element / 2
        box = (f"[[{-size!r}, {-size!r}, 0], [{size!r}, {size!r}, {self.height!r}]], cells = [{self.cells}, "
               f"{self.cells}, 4]" if self.dim == 3 else
               f"[[{0.0 if self.analysis == 'axisymmetric' else -size!r}, 0], [{size!r}, {self.height!r}]], cells = "
               f"[{self.cells // 2 if self.analysis == 'axisymmetric' else self.cells}, 4]")
        down = f"[{self.aside!r}, 0, {-self.stroke!r}]" if self.dim == 3 else f"[{self.aside!r}, {-self.stroke!r}]"
        base = "z" if self.dim == 3 else "y"
        fixed = '["x", "y", "z"]' if self.dim == 3 else '["x", "y"]'
        lines = [f'analysis = "{self.analysis}"', "[workpiece]", f'element = "{self.element_kind}"',
                 'material = "m"', f"mesh = {{ box = {box} }}", "[material.m]",
                 "elastic = { young = 210000, poisson = 0.3 }",
                 'flow = { law = "linear", yield = 300, hardening = 300 }', "[[support]]",
                 f'where = "{base} = 0"', f"fix = {fixed}"]
        if self.analysis == "axisymmetric":
            lines += ["[[support]]", 'where = "x = 0"', 'fix = ["x"]']
        lines += ["[[tool]]", 'name = "tool"', f"surface = {self.surface()}", f"motion = {{ velocity = {down} }}",
                  'friction = { law = "coulomb", mu = 0.1 }', "[time]", "end = 1"]
        if self.increments:
            lines.append(f"increments = {{ first = {1 / self.increments!r}, max = {1 / self.increments!r} }}")
        if self.contact:
            lines += ["[contact]", self.contact]
        (folder / "case.toml").write_text("\n".join(lines) + "\n", encoding="utf-8")
        x, y, z = self.tip()
        if self.kind == "nose":
            top, r = y + 3 * self.element + 2 * self.radius, self.radius
            (folder / "nose.toml").write_text(
                f"start = [{x - r!r}, {top!r}]\n[[segment]]\nto = [{x - r!r}, {y + r!r}]\n[[segment]]\n"
                f"to = [{x + r!r}, {y + r!r}]\nradius = {r!r}\n[[segment]]\nto = [{x + r!r}, {top!r}]\n",
                encoding="utf-8")
        if self.kind.startswith("stl"):
            # Facets that are off a large ball by less than a hundredth of an element.
            halvings = 2 if self.radius < self.element else 4
            triangles = (ball((x, y, z + self.radius), self.radius, halvings) if self.kind == "stl ball" else
                         spike((x, y, z), self.radius, self.radius / math.tan(math.radians(self.angle))))
            text = "solid tool\n"
            for t in triangles:
                text += "facet normal 0 0 0\nouter loop\n"
                text += "".join(f"vertex {p[0]:.9g} {p[1]:.9g} {p[2]:.9g}\n" for p in t)
                text += "endloop\nendfacet\n"
            (folder / "tool.stl").write_text(text + "endsolid tool\n", encoding="utf-8")

    def lowest(self, dx, dy):
        """Height of the tool's lower surface over its lowest point, at an offset; None: it is not there."""
        r, a = self.radius, math.tan(math.radians(self.angle)) if self.angle else 0.0
        if self.kind in ("circle", "nose"):
            return r - math.sqrt(r * r - dx * dx) if abs(dx) <= r else None
        if self.kind == "wedge":
            return abs(dx) / a
        if self.kind in ("sphere", "stl ball"):
            d2 = dx * dx + dy * dy
            return r - math.sqrt(r * r - d2) if d2 <= r * r else None
        if self.kind == "cylinder":
            d = dx * math.cos(self.angle) - dy * math.sin(self.angle)
            return r - math.sqrt(r * r - d * d) if abs(d) <= r else None
        if self.kind == "cone":
            return math.hypot(dx, dy) / a
        if self.kind == "ring":
            d = math.hypot(dx, dy) - max(self.element, 2 * r)
            return r - math.sqrt(r * r - d * d) if abs(d) <= r else None
        d = max(abs(dx), abs(dy))    # a pyramid
        return d / a if d <= r else None

    def offsets(self):
        """Where the tool's lower surface is looked at, from its lowest point."""
        reach = min(self.radius, 1.5 * self.element) if self.kind != "wedge" else 1.5 * self.element
        if self.kind == "cone":
            reach = 1.5 * self.element
        ways = [reach * i / 12 for i in range(-12, 13)] + [0.0]
        if self.dim == 2:
            return [(d, 0.0) for d in ways]
        if self.kind == "ring":
            major = max(self.element, 2 * self.radius)
            return [((major + d) * math.cos(t), (major + d) * math.sin(t))
                    for d in ways[::4] for t in (2 * math.pi * k / 48 for k in range(48))]
        if self.kind == "cylinder":   # along it as well
            along = [self.element * i / 3 for i in range(-9, 10)]
            return [(d * math.cos(self.angle) + s * math.sin(self.angle),
                     s * math.cos(self.angle) - d * math.sin(self.angle)) for d in ways[::4] for s in along]
        return [(a, b) for a in ways[::2] for b in ways[::2]]

    def depth(self, surface):
        """How far the tool's lower surface is beneath the top of the part, straight up, at most.

        Leaning walls make it more than the distance: a tenth of an element is not judged by their depth."""
        top = Top(surface, self.dim)
        x, y, z = self.tip()
        low = z if self.dim == 3 else y
        most = 0.0
        for dx, dy in self.offsets():
            rise = self.lowest(dx, dy)
            if rise is None:
                continue
            at = (x + self.aside + dx, y + dy) if self.dim == 3 else (x + self.aside + dx, 0.0)
            bottom = low - self.stroke + rise
            distance = top.depth_of((at[0], at[1], bottom) if self.dim == 3 else (at[0], bottom, 0.0))
            most = max(most, distance)
        return most


class Top:
    """The contact faces, curved ones in pieces; a point beneath the upper ones is in the part."""

    def __init__(self, surface, dim):
        self.dim, self.pieces = dim, []
        for face in surface:
            if dim == 2:
                line = curve(face)
                self.pieces += list(zip(line, line[1:]))
            else:
                self.pieces += patch(face)

    def depth_of(self, p):
        """Distance of a point in the part from its surface; 0 outside."""
        return self.distance(p) if self.inside(p) else 0.0

    def inside(self, p):
        """Whether a way up crosses the surface an odd number of times (the base is not part of it)."""
        crossings = 0
        for piece in self.pieces:
            height = self.height(piece, p)
            if height is not None and height > p[self.dim - 1]:
                crossings += 1
        return crossings % 2 == 1 and p[self.dim - 1] > 0.0

    def height(self, piece, p):
        if self.dim == 2:
            (x0, y0, _), (x1, y1, _) = piece
            if (x0 <= p[0]) == (x1 <= p[0]):
                return None
            return y0 + (y1 - y0) * (p[0] - x0) / (x1 - x0)
        a, b, c = piece
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if area == 0.0:
            return None
        u = ((p[0] - a[0]) * (c[1] - a[1]) - (p[1] - a[1]) * (c[0] - a[0])) / area
        v = ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / area
        if u < 0.0 or v < 0.0 or u + v >= 1.0:
            return None
        return a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2])

    def distance(self, p):
        return min(from_segment(p, *piece) if self.dim == 2 else from_triangle(p, *piece) for piece in self.pieces)


PIECES = 8                         # an edge of a curved face is drawn in


def curve(nodes):
    """A parabola through three nodes in turn as a chain of points; two nodes as they are."""
    if len(nodes) == 2:
        return nodes
    a, m, b = nodes
    chain = []
    for k in range(PIECES + 1):
        t = 2 * k / PIECES - 1
        chain.append(tuple(t * (t - 1) / 2 * x + (1 - t * t) * y + t * (t + 1) / 2 * z for x, y, z in zip(a, m, b)))
    return chain


def patch(nodes):
    """Triangles of a face with four corners, or with middles between them, in turn."""
    steps = PIECES if len(nodes) == 8 else 2

    def point(r, s):
        if len(nodes) == 4:
            shares = [(1 + r * a) * (1 + s * b) / 4 for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        else:
            corner = [(1 + r * a) * (1 + s * b) * (r * a + s * b - 1) / 4
                      for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            middle = [(1 - r * r) * (1 - s) / 2, (1 + r) * (1 - s * s) / 2, (1 - r * r) * (1 + s) / 2,
                      (1 - r) * (1 - s * s) / 2]
            shares = [share for pair in zip(corner, middle) for share in pair]
        return tuple(sum(w * p[i] for w, p in zip(shares, nodes)) for i in range(3))

    grid = [[point(2 * i / steps - 1, 2 * j / steps - 1) for i in range(steps + 1)] for j in range(steps + 1)]
    return [t for j in range(steps) for i in range(steps)
            for t in ((grid[j][i], grid[j][i + 1], grid[j + 1][i + 1]),
                      (grid[j][i], grid[j + 1][i + 1], grid[j + 1][i]))]


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def from_segment(p, a, b):
    way = minus(b, a)
    square = dot(way, way)
    share = min(1.0, max(0.0, dot(minus(p, a), way) / square)) if square > 0.0 else 0.0
    return math.dist(p, tuple(x + share * w for x, w in zip(a, way)))


def from_triangle(p, a, b, c):
    ab, ac = minus(b, a), minus(c, a)
    n = (ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0])
    area = dot(n, n)
    if area > 0.0:
        ap = minus(p, a)
        cross = lambda u, v: (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        v, w = dot(cross(ap, ac), n) / area, dot(cross(ab, ap), n) / area
        if v >= 0.0 and w >= 0.0 and v + w <= 1.0:
            return abs(dot(ap, n)) / math.sqrt(area)
    return min(from_segment(p, a, b), from_segment(p, b, c), from_segment(p, c, a))


def scenes(number, seed):
    """Random scenes, the same for the same seed."""
    rng = random.Random(seed)
    for _ in range(number):
        dim = rng.choice((2, 2, 3))
        kind = rng.choice(PLANE if dim == 2 else SPACE)
        element = 10 ** rng.uniform(-1, 1)
        radius = element * 10 ** rng.uniform(-4, 1)
        axisymmetric = dim == 2 and rng.random() < 0.3
        cells = 12 if dim == 2 else rng.choice((4, 5, 6))
        x = element * rng.uniform(1.5, 3.5) if axisymmetric else element * rng.uniform(-0.8, 0.8)
        if axisymmetric:           # a tool beyond the axis is another one
            radius = min(radius, 0.9 * x)
        if kind in ("stl spike", "wedge", "nose"):
            radius = min(radius, 1.5 * element)
        scene = Scene(dim, kind, rng.choice(ELEMENTS[dim]),
                      "3d" if dim == 3 else "axisymmetric" if axisymmetric else "plane-strain", cells, element, radius,
                      (x, element * rng.uniform(-0.8, 0.8)), element * rng.choice((0.15, 0.3, 0.5, 1.0)),
                      element * rng.choice((0.0, 0.0, 0.3)), rng.uniform(2, 60) if kind != "cylinder" else
                      rng.uniform(0, 3), rng.choice((0, 0, 1, 3, 10, 30)))
        if rng.random() < 0.2:
            scene.contact = rng.choice(('form = "compatible"', 'method = "augmented"', "penalty = 1000"))
        yield scene
