"""Forging, extrusion, drawing and rolling, in the plane or about an axis. README.md has a line on each job."""

import math

from scene import FAR, Scene
from shapes import lowest, mirrored, profile, rounded, sampled, turned_volume


def upsetting(draw):
    radius, slender, share, end = draw.log(2, 60), draw.between(0.25, 1.8), draw.way(0.15, 0.65), draw.log(0.02, 2)
    height = 2 * radius * slender
    scene = Scene(draw, "axisymmetric", share * height / end)
    scene.box(draw.plane_element(), (0, 0), (radius, height), 200)
    scene.support("x = 0", "x")
    scene.base("y")
    away = draw.one(0, 0, 0.1 * height)
    scene.plate("upper", height + away, share * height / end, more="touch = true" if away else "")
    if share > 0.4 or draw.chance(0.4):
        scene.remesh()
    return scene.job(f"H/D {slender:.2f}, down by {share:.0%}", end)


def ring(draw):
    outer, bore, share, end = draw.log(3, 60), draw.between(0.35, 0.75), draw.way(0.15, 0.6), draw.log(0.02, 2)
    height = outer * draw.between(0.3, 1.0)
    scene = Scene(draw, "axisymmetric", share * height / end)
    scene.box(draw.plane_element(), (bore * outer, 0), (outer, height), 200)
    scene.base("y")
    scene.plate("upper", height, share * height / end)
    if share > 0.35 or draw.chance(0.4):
        scene.remesh()
    return scene.job(f"bore {bore:.2f} of outside, H/R {height / outer:.2f}, down by {share:.0%}", end)


def heading(draw):
    radius, free, share, end = draw.log(2, 20), draw.between(1.0, 2.2), draw.way(0.3, 0.65), draw.log(0.02, 1)
    held, length = 1.5 * 2 * radius, free * 2 * radius
    scene = Scene(draw, "axisymmetric", share * length / end)
    scene.box(draw.plane_element(), (0, 0), (radius, held + length), 260)
    scene.support("x = 0", "x")
    scene.support("y = 0", "y")
    hole, fillet = 1.01 * radius, draw.between(0.1, 0.3) * radius
    scene.die("die", rounded([(FAR * 2 * radius, held, 0), (hole, held, fillet), (hole, -radius, 0)]))
    scene.plate("punch", held + length, share * length / end)
    scene.remesh()
    return scene.job(f"{free:.1f} D free, down by {share:.0%}", end)


def half_die(draw, outer, land):
    """Corners (radius, depth, fillet) of a turned die with a boss or a rim, a land for the flash and a gutter."""
    boss, web = sorted((draw.between(0.12, 0.25), draw.between(0.3, 0.5)), reverse=draw.chance(0.5))
    middle, draft, fillet = draw.between(0.4, 0.6), math.tan(math.radians(draw.between(4, 10))), draw.between(0.04, 0.09)
    slope, wall = 0.5 * draft * abs(boss - web), draft * (web - land)
    corners = [(-0.3, boss, 0), (middle - slope, boss, fillet), (middle + slope, web, fillet), (1 - wall, web, fillet),
               (1, land, fillet / 2), (1.15, land, fillet / 2), (1.15 + 0.15, 0.15, fillet / 2), (FAR, 0.15, 0)]
    return [(outer * x, outer * y, outer * r) for x, y, r in corners]


def flash(draw):
    outer, share, end = draw.log(8, 80), draw.between(0.1, 0.7), draw.log(0.05, 1)
    land = draw.between(0.02, 0.035)
    above = rounded(half_die(draw, outer, land))
    below = draw.one(above, rounded(half_die(draw, outer, land)))
    halved = below is above and draw.chance(0.5)   # half of the part: the parting plane is one of symmetry
    upper, lower = sampled(above), sampled(below)
    volume = sum((1 - share) * turned_volume(line, outer) + share * turned_volume(line, 1.15 * outer)
                 for line in (upper, lower))
    radius = min(0.85 * outer, (volume / (2 * math.pi * draw.between(0.7, 1.6))) ** (1 / 3))
    height, foot = volume / (math.pi * radius ** 2), -lowest(lower, radius)
    top = height / 2 if halved else foot + height
    way = top - lowest(upper, radius) + 1e-3 * outer
    scene = Scene(draw, "axisymmetric", way / end)
    scene.box(draw.plane_element(), (0, 0 if halved else foot), (radius, top), 220)
    scene.support("x = 0", "x")
    if halved:
        scene.support("y = 0", "y")
    else:
        scene.die("lower", mirrored(below))
    scene.falling_die("upper", above, way, way / end)
    scene.remesh()
    end *= 0.6 if draw.small else 1.0                # small: not down to the flash
    return scene.job(f"billet H/D {height / radius / 2:.2f}, flash filled to {share:.0%}", end)


def cavity(draw):
    """A part in a closed die that it fills at the end: wall, bottom and a punch as wide as the bore."""
    bore, end = draw.log(4, 50), draw.log(0.05, 1)
    recess, inner, draft = draw.between(0.1, 0.35), draw.between(0.3, 0.6), math.tan(math.radians(draw.between(3, 12)))
    fillet, boss = draw.between(0.05, 0.12), draw.chance(0.5)    # the recess is about the axis, or a ring along the wall
    deep, flat = (recess, 0.0) if boss else (0.0, recess)
    slope = 0.5 * draft * recess
    line = rounded([(bore * x, bore * y, bore * r) for x, y, r in (
        (-0.3, deep, 0), (inner - slope, deep, fillet), (inner + slope, flat, fillet), (FAR, flat, 0))])
    closed, full = draw.between(0.3, 1.0) * bore, draw.between(0.95, 0.995)
    volume = full * (turned_volume(sampled(line), bore) + math.pi * bore ** 2 * closed)
    radius = min(0.95 * bore, (volume / (2 * math.pi * draw.between(0.5, 1.6))) ** (1 / 3))
    height = volume / (math.pi * radius ** 2)
    way = height - closed - lowest(sampled(line), radius) + 1e-3 * bore
    scene = Scene(draw, "axisymmetric", way / end)
    scene.box(draw.plane_element(), (0, 0), (radius, height), 220)
    scene.support("x = 0", "x")
    scene.plane("wall", (bore, 0), (-1, 0))
    scene.plate("bottom", 0)
    scene.falling_die("punch", line, way + closed, way / end)
    scene.remesh()
    return scene.job(f"{'boss' if boss else 'rim'}, billet H/D {height / radius / 2:.2f}, full to {full:.1%}", end)


def punch(radius, nose, length, angle=0.0):
    """Outline of a punch that points down, its face at y = 0: cone angle of the face [degrees], rounded edge `nose`."""
    rise, relief = radius * math.tan(math.radians(angle)), 0.9
    return rounded([(-0.5 * radius, 0, 0), (0, 0, 0), (radius, rise, nose), (radius, rise + 2 * nose + 0.1 * radius, 0),
                    (relief * radius, rise + 2 * nose + 0.3 * radius, 0), (relief * radius, length, 0)])


def can(draw):
    bore, ratio, end = draw.log(4, 40), draw.between(0.5, 0.8), draw.log(0.05, 1)
    height, share = bore * draw.between(0.7, 1.6), draw.way(0.25, 0.65)
    radius, way = ratio * bore, share * height
    nose, angle = radius * draw.between(0.1, 0.35), draw.one(0, 0, 5, 10)
    scene = Scene(draw, "axisymmetric", way / end)
    scene.box(draw.plane_element(), (0, 0), (bore, height), 240)
    scene.support("x = 0", "x")
    scene.plane("container", (bore, 0), (-1, 0))
    scene.plate("ejector", 0)
    scene.falling_die("punch", punch(radius, nose, 10 * bore, angle), height, way / end)
    scene.remesh()
    return scene.job(f"punch {ratio:.2f} of bore, in by {share:.0%} of height", end)


def double_cup(draw):
    bore, end, share = draw.log(5, 40), draw.log(0.05, 1), draw.way(0.25, 0.6)
    height, above, below = bore * draw.between(0.8, 1.8), draw.between(0.5, 0.75) * bore, draw.between(0.5, 0.75) * bore
    way = share * height
    scene = Scene(draw, "axisymmetric", way / end)
    scene.box(draw.plane_element(), (0, 0), (bore, height), 240)
    scene.support("x = 0", "x")
    scene.plane("container", (bore, 0), (-1, 0))
    scene.falling_die("upper", punch(above, draw.between(0.1, 0.3) * above, 10 * bore), height, way / end)
    scene.die("lower", mirrored(punch(below, draw.between(0.1, 0.3) * below, 10 * bore)))
    scene.remesh()
    return scene.job(f"punches {above / bore:.2f} and {below / bore:.2f} of bore, by {share:.0%} of height", end)


def conical_die(angle, radius, exit_radius, top):
    """From a bore of `radius` down to `exit_radius`; the cone, of that half angle [degrees], begins at y = 0."""
    angle, land = math.radians(angle), 0.3 * radius
    depth = (radius - exit_radius) / math.tan(angle)
    return rounded([(radius, top, 0), (radius, 0, 0.5 * radius), (exit_radius, -depth, 0.4 * radius),
                    (exit_radius, -depth - land, 0.3 * radius), (1.04 * exit_radius, -depth - 2 * land, 0),
                    (1.04 * exit_radius, -depth - 10 * radius, 0)])


def extrusion(draw):
    radius, end, share = draw.log(3, 40), draw.log(0.05, 1), draw.way(0.3, 0.7)
    reduction, length, angle = draw.between(0.15, 0.6), radius * draw.between(1.5, 3), draw.between(15, 45)
    line = conical_die(angle, radius, radius * math.sqrt(1 - reduction), 10 * radius)
    front, way = line[1][1], share * length          # the bar stands where the rounding of the bore begins
    scene = Scene(draw, "axisymmetric", way / end)
    scene.box(draw.plane_element(), (0, front), (radius, front + length), 260)
    scene.support("x = 0", "x")
    scene.die("die", line)
    scene.plate("ram", front + length, way / end)
    scene.remesh()
    return scene.job(f"reduction {reduction:.0%}, {angle:.0f} degrees, in by {share:.0%} of length", end)


def drawing(draw):
    radius, end, reduction = draw.log(1, 15), draw.log(0.1, 2), draw.between(0.06, 0.15)
    thin, length, way = radius * math.sqrt(1 - reduction), radius * draw.between(3, 5), radius * draw.way(2, 3.5)
    angle = draw.between(6, 18)
    line = conical_die(angle, radius, thin, 10 * radius)
    front, off = line[5][1], 1e-3 * radius           # the bar is pointed: its front is in the land already
    bar = [(radius, length, 0)] + line[1:5] + [(thin, front, 0)]
    scene = Scene(draw, "axisymmetric", way / end, oiled=True)
    scene.mesh_file("tri6", "bar.toml", profile(bar + [(off, front, 0), (off, length, 0)], True, -off),
                    radius / (4 if draw.small else 6))
    scene.support("x = 0", "x")
    scene.support(f"y = {front:.8g}", move=f"y = [[0, 0], [{end}, {-way:.6g}]]")
    scene.die("die", line)
    if draw.chance(0.5):
        scene.remesh()
    return scene.job(f"reduction {reduction:.0%}, {angle:.0f} degrees, by {way / radius:.1f} radii", end)


def indentation(draw):
    plane, width, end = draw.chance(0.5), draw.log(3, 50), draw.log(0.02, 2)
    height, share, kind = width * draw.between(0.4, 1.2), draw.way(0.08, 0.35), draw.one("round", "wedge")
    radius = draw.between(0.3, 1.2) * width
    way = min(share * height, 0.7 * radius)
    scene = Scene(draw, "plane-strain" if plane else "axisymmetric", way / end)
    scene.box(draw.plane_element(), (0, 0), (width, height), 300)
    scene.support("x = 0", "x")
    scene.plate("table", 0)
    if kind == "round":
        scene.tool("punch", f"circle = {{ centre = [0, {height + radius:.8g}], radius = {radius:.6g} }}",
                   f"velocity = [0, {-way / end:.6g}]")
    else:
        slope, nose = math.tan(math.radians(draw.between(15, 50))), draw.between(0.15, 0.3) * width
        line = rounded([(-2 * width, 2 * width * slope, 0), (0, 0, nose), (2 * width, 2 * width * slope, 0)])
        scene.falling_die("punch", line, height - lowest(sampled(line), width) + 1e-3 * width, way / end)
    if share > 0.15 or draw.chance(0.5):
        scene.remesh()
    return scene.job(f"{kind}, {'plane' if plane else 'turned'}, in by {way / height:.0%} of height", end)


def rolling(draw):
    thick, ratio, reduction = draw.log(1, 40), draw.between(8, 40), draw.between(0.08, 0.3)
    radius, half, thin, speed = ratio * thick, thick / 2, thick * (1 - reduction) / 2, draw.between(0.1, 3)
    arc = math.sqrt(radius ** 2 - (radius + thin - half) ** 2)
    length, whole = 3.5 * arc + thick, draw.chance(0.3)
    end = float(f"{draw.way(0.6, 1.0) * length / (speed * radius):.4g}")
    scene = Scene(draw, "plane-strain", 0.1 * speed * radius)
    layers, element = draw.one((4, "quad4"), (5, "quad4"), (2, "quad8"), (3, "quad8"))
    along = round(length / min(arc / (4 if draw.small else 7), 1.5 * half / layers * 2))
    low, front = (-half if whole else 0), -1.001 * arc
    scene.mesh(element, f"box = [[{front - length:.8g}, {low}], [{front:.8g}, {half}]], "
                        f"cells = [{along}, {layers * (2 if whole else 1)}]")
    for side in (1, -1) if whole else (1,):
        centre = f"[0, {side * (radius + thin):.8g}]"
        scene.tool("upper" if side > 0 else "lower", f"circle = {{ centre = {centre}, radius = {radius} }}",
                   f"rotation = {{ point = {centre}, speed = {side * speed} }}")
    if not whole:
        scene.support("y = 0", "y")
    # Slower than the rolls: what they do not bite is pushed through, what they do leaves the pusher behind.
    scene.plane("pusher", (round(front - length, 6), 0), (1, 0),
                f"velocity = [{0.6 * speed * radius * (1 - reduction):.6g}, 0]", rubs=False)
    return scene.job(f"{'two rolls' if whole else 'half'}, R/h {ratio:.0f}, reduction {reduction:.0%}", end)


def spike(draw):
    radius, slender, share, end = draw.log(4, 50), draw.between(0.4, 1.2), draw.way(0.25, 0.6), draw.log(0.05, 1)
    height, hole = 2 * radius * slender, draw.between(0.3, 0.5) * radius
    deep = 2 * height
    pole = hole - min(math.tan(math.radians(draw.between(4, 15))) * deep, 0.6 * hole)
    way = share * height
    scene = Scene(draw, "axisymmetric", way / end)
    scene.box(draw.plane_element(), (0, 0), (radius, height), 220)
    scene.support("x = 0", "x")
    scene.plate("lower", 0)
    fillet = draw.between(0.1, 0.25) * radius
    line = rounded([(-hole, deep, 0), (pole, deep, 0.3 * pole), (hole, 0, fillet), (FAR * radius, 0, 0)])
    scene.falling_die("upper", line, height, way / end)
    scene.remesh()
    return scene.job(f"hole {hole / radius:.2f} R, H/D {slender:.2f}, down by {share:.0%}", end)


def hammer(draw):
    radius, slender, speed = draw.log(5, 60), draw.between(0.5, 1.4), draw.between(3000, 7000)
    height, blows, strain = 2 * radius * slender, draw.one(1, 1, 2, 3), draw.way(0.1, 0.35)
    scene = Scene(draw, "axisymmetric", speed)
    energy = scene.strength * math.pi * radius ** 2 * height * strain
    scene.box(draw.plane_element(), (0, 0), (radius, height), 200)
    scene.support("x = 0", "x")
    scene.plate("anvil", 0)
    if draw.chance(0.5):
        scene.remesh()
    scene.plane("tup", (0, height), (0, -1), f'press = {{ kind = "hammer", direction = [0, -1], energy = {energy:.5g}, '
                                             f"velocity = {speed}, efficiency = {draw.one(1.0, 0.9)} }}")
    for blow in range(1, blows + 1):
        scene.stage(f"blow {blow}", 0.2 * blow - 0.1)
        if blow < blows:
            scene.stage(f"lift {blow}", 0.2 * blow, "unload = true")
    return scene.job(f"{blows} blow(s), H/D {slender:.2f}, each for a strain of {strain:.2f}", 0.2 * blows - 0.1, True)


def crank_start(radius, rod, way):
    """Angle of the crank from which its slide has `way` to go [degrees]."""
    low, high = 0.0, math.pi
    for _ in range(60):
        angle = (low + high) / 2
        left = radius * (1 + math.cos(angle)) - rod + math.sqrt(rod ** 2 - (radius * math.sin(angle)) ** 2)
        low, high = (angle, high) if left > way else (low, angle)
    return math.degrees(low)


def press(draw):
    kind, radius, share = draw.one("crank", "screw"), draw.log(5, 60), draw.way(0.2, 0.5)
    bore, height = draw.one(0.0, 0.5) * radius, draw.between(0.6, 1.8) * radius
    speed = draw.between(2, 12)                # of crank or flywheel [rad/s]
    way = share * height
    scene = Scene(draw, "axisymmetric", way * speed)
    scene.box(draw.plane_element(), (bore, 0), (radius, height), 200)
    if not bore:
        scene.support("x = 0", "x")
    scene.plate("anvil", 0)
    if kind == "crank":
        crank, rod = way * draw.between(1, 3), way * 12
        start = crank_start(crank, rod, 1.01 * way)
        motion = (f'kind = "crank", direction = [0, -1], radius = {crank:.6g}, rod = {rod:.6g}, speed = {speed}, '
                  f"start = {start:.6g}")
        end = math.radians(190 - start) / speed
        if share > 0.35:
            scene.remesh()
    else:
        energy, pitch = scene.strength * math.pi * (radius ** 2 - bore ** 2) * height * share, draw.between(100, 300)
        motion = (f'kind = "screw", direction = [0, -1], inertia = {2 * energy / speed ** 2:.6g}, pitch = {pitch}, '
                  f"speed = {speed}")
        end = 40 * height / (pitch * speed)
    scene.plane("slide", (0, height + 0.01 * way), (0, -1), f"press = {{ {motion} }}")
    return scene.job(f"{kind}, {'ring' if bore else 'cylinder'}, down by about {share:.0%}", end)


def sequence(draw):
    """Upset, let go, then pierced by another tool, and let go again."""
    radius, slender, end = draw.log(5, 50), draw.between(0.6, 1.4), draw.log(0.1, 1)
    height, first, second = 2 * radius * slender, draw.way(0.15, 0.4), draw.way(0.1, 0.35)
    left, ball = (1 - first) * height, draw.between(0.4, 0.8) * radius
    deep = min(second * left, 0.7 * ball)
    scene = Scene(draw, "axisymmetric", 2 * first * height / end)
    scene.box(draw.plane_element(), (0, 0), (radius, height), 240)
    scene.support("x = 0", "x")
    scene.plate("lower", 0)
    scene.plane("upper", (0, height), (0, -1), f"displacement = [[0, 0, 0], [{0.4 * end:.6g}, 0, {-first * height:.6g}]]")
    scene.tool("punch", f"circle = {{ centre = [0, {1.01 * left + ball:.8g}], radius = {ball:.6g} }}",
               f"displacement = [[{0.5 * end:.6g}, 0, 0], [{0.9 * end:.6g}, 0, {-deep - 0.01 * left:.6g}]]")
    for name, share, more in (("upset", 0.4, 'tools = ["lower", "upper"]'), ("let go", 0.5, "unload = true"),
                              ("pierce", 0.9, 'tools = ["lower", "punch"]'), ("take out", 1, "unload = true")):
        scene.stage(name, share * end, more)
    scene.remesh()
    return scene.job(f"H/D {slender:.2f}, down by {first:.0%}, pierced by {deep / left:.0%}", end, True)
