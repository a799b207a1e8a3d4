"""Sheets, tubes and walls: they bend, fold and are drawn."""

import math

from scene import FAR, Scene
from shapes import mapped_mesh, rounded


def bending(draw):
    thick, end, layers = draw.log(0.8, 5), draw.log(0.05, 2), draw.one(2, 3)
    edge, nose, way = thick * draw.between(2, 4), thick * draw.between(1.5, 5), thick * draw.between(3, 6)
    air = draw.chance(0.5)
    span = edge + nose + thick * draw.between(1.5, 5)      # from the middle to the centre of the die's edge
    way = draw.way(0.3, 0.8) * (span - 0.5 * edge) if air else nose + draw.way(3, 6) * thick
    scene = Scene(draw, "plane-strain", way / end)
    left, right = (0.0, span + 0.7 * way + 2 * thick) if air else (-6 * thick, edge + way)
    cells = [max(8, round((right - left) / (0.6 * thick))), layers]
    scene.mesh("quad8", f"box = [[{left}, 0], [{right:.6g}, {thick}]], cells = {cells}")
    if air:
        scene.support("x = 0", "x")
        scene.tool("die", f"circle = {{ centre = [{span:.6g}, {-edge}], radius = {edge} }}")
        scene.tool("punch", f"circle = {{ centre = [0, {thick + nose:.8g}], radius = {nose} }}",
                   f"velocity = [0, {-way / end:.6g}]")
    else:
        scene.support(f"x = {left}", "xy")
        scene.die("die", rounded([(edge, -20 * thick, 0), (edge, 0, edge), (left - thick, 0, 0)]))
        scene.die("pad", rounded([(left - thick, thick, 0), (0, thick, 0.3 * thick), (0, 4 * thick, 0)]))
        gap = edge + thick * draw.between(1.05, 1.3)
        edge_line = rounded([(gap, 10 * thick, 0), (gap, 0, nose), (gap + 30 * thick, 0, 0)])
        scene.falling_die("punch", edge_line, 1.0001 * thick, way / end)
    scene.stage("bend", end)
    scene.stage("spring back", 1.1 * end, "unload = true")
    return scene.job(f"{'air' if air else 'wiping'}, t {thick}, radius {nose / thick:.1f} t, by {way / thick:.1f} t",
                     1.1 * end, True)


def folding(draw):
    """Thin walls that buckle, fold and touch themselves."""
    kind, thick, end = draw.one("pipe", "rib", "tube"), draw.log(0.5, 8), draw.log(0.05, 2)
    slender, layers = draw.between(6, 12), draw.one(2, 3)
    along = round(slender * (1.5 if draw.small else 3.0))
    if kind == "pipe":           # its half, crushed across
        outer, height, low = slender * thick, 2 * slender * thick, -slender * thick
        way = draw.way(0.4, 0.95) * (height - 2 * thick)
        def place(u, v):
            radius, angle = outer - thick * (1 - u), math.pi * (v - 0.5)
            return radius * math.cos(angle), radius * math.sin(angle)
    else:                        # standing upright, a little bowed, or as a tube of that length
        height, low, bow = slender * thick, 0.0, draw.between(0.02, 0.15) * thick
        inner = thick * draw.between(6, 14) if kind == "tube" else -0.5 * thick
        way = draw.way(0.3, 0.7) * height
        def place(u, v):
            return inner + thick * u + bow * math.sin(math.pi * v), height * v
    scene = Scene(draw, "axisymmetric" if kind == "tube" else "plane-strain", way / end)
    scene.mesh_file("quad8", "wall.inp", mapped_mesh("quad8", (layers, along), place))
    if kind == "pipe":
        scene.support("x = 0", "x")
    if kind == "rib":
        scene.support("y = 0", "xy")
    scene.plate("lower", low)
    scene.plate("upper", low + height, way / end)
    if draw.chance(0.5):
        scene.remesh()
    return scene.job(f"{kind}, {slender:.0f} t, down by {way / height:.0%}", end)


def tube(draw):
    """The end of a tube is curled outward in a groove, or flared by a cone."""
    kind, thick, end = draw.one("curl", "flare"), draw.log(0.5, 4), draw.log(0.1, 2)
    inner, length, layers = thick * draw.between(8, 15), thick * draw.between(10, 16), draw.one(2, 3)
    groove, angle = thick * draw.between(2, 3.5), math.radians(draw.between(12, 30))
    wide = draw.way(0.1, 0.3) * inner
    way = min(draw.way(1.2, 3) * groove, 0.5 * length) if kind == "curl" else min(wide / math.tan(angle), 0.5 * length)
    scene = Scene(draw, "axisymmetric", way / end, oiled=True)
    cells = [layers, round(length / thick * (1.0 if draw.small else 1.6))]
    scene.mesh("quad8", f"box = [[{inner}, {-length}], [{inner + thick:.8g}, 0]], cells = {cells}")
    scene.support(f"y = {-length}", "xy")
    if kind == "curl":
        pin = inner - 0.01 * thick
        low, blunt = -length / 3, 0.3 * thick
        line = [(-pin, low, 0), (pin - blunt, low, 0), (pin, low + blunt, 0), (pin, 0, 0),
                (pin + groove, groove, -groove), (pin + 2 * groove, 0, -groove),
                (pin + 2 * groove + 0.5 * thick, -0.5 * thick, 0.5 * thick), (pin + 9 * groove, -0.5 * thick, 0)]
    else:
        line = [(inner - 4 * thick, -4 * thick / math.tan(angle), 0), (FAR * inner, (FAR - 1) * inner / math.tan(angle), 0)]
    scene.die("punch", line, f"velocity = [0, {-way / end:.6g}]")
    if draw.chance(0.5):
        scene.remesh()
    return scene.job(f"{kind}, R/t {inner / thick:.0f}, {f'groove {groove / thick:.1f} t, ' * (kind == 'curl')}"
                     f"by {way / thick:.1f} t", end)


def cup(draw):
    """A blank is drawn into a cup under a blank holder, and springs back."""
    thick, end, layers = draw.log(0.6, 3), draw.log(0.1, 2), draw.one(2, 2, 3)
    radius, edge, nose = thick * draw.between(18, 32), thick * draw.between(4, 7), thick * draw.between(4, 7)
    hole, flange = radius + 1.3 * thick, thick * draw.between(7, 12)
    blank, way = hole + edge + flange, draw.way(0.4, 0.9) * (edge + flange)   # the holder keeps a part of the flange
    scene = Scene(draw, "axisymmetric", way / end, oiled=True)
    along = round(blank / thick * (0.7 if draw.small else 1.2))
    scene.mesh("quad8", f"box = [[0, 0], [{blank:.6g}, {thick}]], cells = [{along}, {layers}]")
    scene.support("x = 0", "x")
    scene.die("die", rounded([(FAR * blank, 0, 0), (hole, 0, edge), (hole, -5 * radius, 0)]))
    scene.falling_die("punch", rounded([(-radius, 0, 0), (radius, 0, nose), (radius, 5 * radius, 0)]), thick, way / end)
    force = 0.005 * scene.strength * math.pi * (blank ** 2 - (hole + edge) ** 2)
    scene.die("holder", rounded([(hole + edge / 2, 9 * thick, 0), (hole + edge / 2, thick, thick), (FAR * blank, thick, 0)]),
              f"force = {{ direction = [0, -1], value = {force:.4g} }}", more="touch = true")
    scene.stage("draw", end)
    scene.stage("spring back", 1.1 * end, "unload = true")
    return scene.job(f"ratio {blank / radius:.2f}, R/t {radius / thick:.0f}, by {way / radius:.0%} of radius", 1.1 * end,
                     True)
