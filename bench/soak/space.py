"""Parts in space: a block under a relief, a ring or a cross between plates."""

import math

from scene import Scene
from shapes import height_field, mapped_mesh, prism, stl


def relief(draw):
    """A quarter of a block under a die with ribs, domes or crosses that stand out or are sunk, out of an STL file."""
    a, b, end = draw.log(4, 40), draw.between(0.6, 1.2), draw.log(0.1, 1)
    b, height, pattern, hollow = a * b, a * draw.between(0.5, 1.0), draw.one("rib", "dome", "cross"), draw.chance(0.5)
    deep, wide, element = draw.between(0.15, 0.3) * height, draw.between(0.3, 0.5) * a, draw.one("hex8", "hex8", "tet10")
    way = draw.way(0.15, 0.3) * height
    blend = 1.5 * deep                       # width of the slope next to a feature

    def surface(x, y):
        inside = {"rib": wide - abs(x), "dome": wide - math.hypot(x, y), "cross": wide - min(abs(x), abs(y))}[pattern]
        t = min(1.0, max(0.0, 0.5 + inside / blend))
        share = t * t * (3 - 2 * t)
        return deep * (share if hollow else 1 - share)

    grid = [(-0.2 + 2.2 * i / 36) for i in range(37)]
    scene = Scene(draw, "3d", way / end)
    scene.files["die.stl"] = stl(height_field(surface, [a * g for g in grid], [b * g for g in grid]))
    scene.box(element, (0, 0, 0), (a, b, height), 500)
    for axis in "xy":
        scene.support(f"{axis} = 0", axis)
    scene.plate("table", 0)
    smooth = draw.one("true", "false")
    scene.tool("die", f'stl = "die.stl", unit = "mm", smooth = {smooth}', f"velocity = [0, 0, {-way / end:.6g}]",
               more=f"place = {{ translate = [0, 0, {height:.8g}] }}")
    if element == "tet10":
        scene.remesh()
    return scene.job(f"{pattern} {'sunk' if hollow else 'raised'}, smooth {smooth}, down by {way / height:.0%}", end)


def solid(draw):
    """A quarter of a ring with an oval bore, or of a cross, between plates."""
    kind, size, end, share = draw.one("ring", "cross"), draw.log(5, 50), draw.log(0.05, 1), draw.way(0.15, 0.4)
    height, wide = size * draw.between(0.4, 0.8), size * draw.between(0.35, 0.55)
    oval, cells = draw.between(0, 0.2), (4, 9, 4) if draw.small else (6, 14, 6)
    scene = Scene(draw, "3d", share * height / end)
    if kind == "ring":
        def place(u, v, w):
            angle = 0.5 * math.pi * v
            bore = wide * (1 + oval * math.cos(2 * angle))
            radius = bore + (size - bore) * u
            return radius * math.cos(angle), radius * math.sin(angle), height * w
        scene.mesh_file("hex8", "ring.inp", mapped_mesh("hex8", cells, place))
    else:
        outline = [(wide, wide), (wide, size), (0, size), (0, 0), (size, 0), (size, wide)]
        scene.mesh_file("tet10", "cross.stl", stl(prism(outline, height)), size * (0.4 if draw.small else 0.25))
    for axis in "xy":
        scene.support(f"{axis} = 0", axis)
    scene.base("z")
    scene.plate("upper", height, share * height / end)
    if share > (0.3 if kind == "ring" else 0.2):
        scene.remesh()
    return scene.job(f"{kind}, arms or bore {wide / size:.2f}, down by {share:.0%}", end)
