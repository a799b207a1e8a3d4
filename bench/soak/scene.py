"""What all jobs are made of: random numbers, metals, friction, and the text of a case."""

import math
import random
from dataclasses import dataclass

import shapes

FAR = 3.0                              # dies reach this many times farther than the part


@dataclass
class Job:
    """Input files of a run, its case among them."""
    what: str
    end: float                     # of the time asked for [s]
    files: dict


class Draw:
    """Random numbers of one job. `small` makes meshes coarse and ways short; `friction` replaces the law that is drawn."""

    def __init__(self, family, seed, small=False, friction=None):
        self.random, self.small, self.friction = random.Random(f"{family} {seed}"), small, friction

    def between(self, low, high):
        return float(f"{self.random.uniform(low, high):.4g}")

    def log(self, low, high):
        return float(f"{math.exp(self.random.uniform(math.log(low), math.log(high))):.4g}")

    def way(self, low, high):
        """A share of a way that a tool goes."""
        share = self.between(low, high)
        return min(share, low + 0.2 * (high - low)) if self.small else share

    def plane_element(self):
        return self.one("quad4", "quad4", "quad8", "quad8", "tri6")

    def one(self, *options):
        return self.random.choice(options)

    def chance(self, share):
        return self.random.random() < share


# Yield stress at a strain of some tenths and 1/s [MPa], temperature [degC].
LIBRARY = {"c15-cold": (400, None), "42crmo4-cold": (850, None), "almgsi-cold": (160, None), "ofhc-copper": (250, 20),
           "aa6082-t6": (480, 20), "c45": (950, 20), "c45-hot": (70, 1100), "rail-steel-hot": (110, 1000)}


def metal(draw):
    """(name, lines of [material.metal], strength [MPa], temperature or None)."""
    if draw.chance(0.25):
        name = draw.one(*LIBRARY)
        return name, f'library = "{name}"', *LIBRARY[name]
    law = draw.one("perfect", "linear", "swift", "swift", "ludwik", "voce", "hockett-sherby", "table", "norton-hoff",
                   "perzyna", "johnson-cook")
    strength = draw.log(100, 700)
    if law == "norton-hoff":
        strength = draw.log(30, 120)
    s, share = strength, draw.between(0.1, 1)
    keys = {
        "perfect": f"yield = {s}",
        "linear": f"yield = {s:.4g}, hardening = {s * share:.4g}",
        "swift": f"K = {1.3 * s:.4g}, eps0 = {0.02 * share:.3g}, n = {0.3 * share:.3g}",
        "ludwik": f"yield = {0.5 * s:.4g}, K = {0.7 * s:.4g}, n = {0.2 + 0.5 * share:.3g}",
        "voce": f"yield = {0.6 * s:.4g}, saturation = {1.2 * s:.4g}, rate = {15 * share:.3g}",
        "hockett-sherby": f"yield = {0.5 * s:.4g}, saturation = {1.3 * s:.4g}, N = {4 * share:.3g}, p = 0.75",
        "table": f"points = [[0, {0.6 * s:.4g}], [0.05, {0.8 * s:.4g}], [0.3, {s}], [1, {1.2 * s:.4g}]]",
        "norton-hoff": f"K = {s / math.sqrt(3):.4g}, m = {0.25 * share:.3g}, n = {draw.one(0, 0.1)}, eps0 = 0.02",
        "perzyna": f'eta = 1e-3, m = {0.3 * share:.3g}, base = {{ law = "swift", K = {s}, eps0 = 0.01, n = 0.15 }}',
        "johnson-cook": f"A = {0.5 * s:.4g}, B = {0.6 * s:.4g}, n = 0.3, C = {0.03 * share:.3g}, rate0 = 1, m = 1, "
                        "T_room = 20, T_melt = 1400",
    }
    young = 70e3 if s < 200 else draw.one(110e3, 210e3)
    text = f'elastic = {{ young = {young:g}, poisson = {draw.one(0.3, 0.34)} }}\nflow = {{ law = "{law}", {keys[law]} }}'
    heated = law == "johnson-cook" and draw.chance(0.5)
    text += '\nheating = 0.9\ndensity = 7.8e-9\nheat_capacity = "480 J/kg/K"' if heated else ""
    return f"{law} {strength:.0f}", text, strength, 20 if law == "johnson-cook" else None


def friction(draw, strength, speed, oiled):
    """A law of friction; laws that know speeds are told how fast metal slides [mm/s]. Sheet, tubes and wire are oiled."""
    mu, m = draw.log(0.02, 0.1 if oiled else 0.35), draw.between(0.05, 0.25 if oiled else 0.9)
    shear = f"{0.3 * m * strength:.4g}"
    return draw.one(
        f'{{ law = "coulomb", mu = {mu} }}', f'{{ law = "coulomb", mu = {mu} }}',
        f'{{ law = "coulomb", mu = {mu}, cap = "shear-yield" }}',
        f'{{ law = "coulomb", mu = {mu}, cap = "shear-yield", evolution = [[0, 1], [5, 1.5]] }}',
        f'{{ law = "tresca", m = {m} }}', f'{{ law = "tresca", m = {m} }}', f'{{ law = "levanov", m = {m} }}',
        f'{{ law = "shaw", k = "shear-yield", f = {m} }}',
        f'{{ law = "asperity", m_local = {m}, k = "shear-yield", f = {m} }}',
        f'{{ law = "thick-film", viscosity = {0.02 * m * strength / speed:.3g}, film = 0.1 }}',
        f'{{ law = "viscoplastic", beta = {shear}, v0 = {speed:.3g}, mv = 0.2 }}',
        '{ law = "frictionless" }' if oiled else '{ law = "sticking" }', '{ law = "frictionless" }')


class Scene:
    """A case that is put together piece by piece. `speed` is that of the tools [mm/s]."""

    def __init__(self, draw, analysis, speed, oiled=False):
        self.draw, self.analysis, self.files = draw, analysis, {}
        self.metal, material, self.strength, temperature = metal(draw)
        drawn = friction(draw, self.strength, speed, oiled)
        self.friction = draw.friction or drawn
        self.element, self.remeshed = "", False
        self.head = f'analysis = "{analysis}"\n' + (f"temperature = {temperature}\n" if temperature is not None else "")
        self.pieces = [f"[material.metal]\n{material}"]

    def mesh(self, element, text):
        self.element = element
        self.pieces.append(f'[workpiece]\nelement = "{element}"\nmaterial = "metal"\nmesh = {{ {text} }}')

    def box(self, element, low, high, number):
        """A box of about `number` linear elements, or half (plane) or a quarter (space) as many quadratic ones."""
        sizes = [b - a for a, b in zip(low, high)]
        quadratic = element in ("quad8", "tri6", "hex20", "tet10")
        number *= (0.4 if self.draw.small else 1.0) * ((0.5 if len(sizes) == 2 else 0.25) if quadratic else 1.0)
        side = (math.prod(sizes) / number) ** (1 / len(sizes))
        self.mesh(element, f"box = [{list(low)}, {list(high)}], cells = {[max(2, round(s / side)) for s in sizes]}")

    def mesh_file(self, element, name, text, size=None):
        """A mesh or, with a size of elements, a body or outline to be meshed."""
        self.files[name] = text
        key = {"inp": "file", "stl": "stl", "toml": "outline"}[name.rsplit(".", 1)[1]]
        self.mesh(element, f'{key} = "{name}"' + (f", size = {size:.4g}" if size else ""))

    def support(self, where, fix="", move=""):
        held = f"fix = {list(fix)}" if fix else f"move = {{ {move} }}"
        self.pieces.append(f'[[support]]\nwhere = "{where}"\n{held}')

    def tool(self, name, surface, motion="", rubs=True, more=""):
        lines = ["[[tool]]", f'name = "{name}"', f"surface = {{ {surface} }}"] + ([more] if more else [])
        lines += ([f"motion = {{ {motion} }}"] if motion else []) + ([f"friction = {self.friction}"] if rubs else [])
        self.pieces.append("\n".join(lines))

    def plane(self, name, point, normal, motion="", **more):
        self.tool(name, f"plane = {{ point = {list(point)}, normal = {list(normal)} }}", motion, **more)

    def plate(self, name, height, speed=0.0, **more):
        """A flat tool over the part that goes down, or without speed one below it."""
        across = [0, 0] if self.analysis == "3d" else [0]
        self.plane(name, across + [height], across + [-1 if speed else 1],
                   f"velocity = {across + [-speed]}" if speed else "", **more)

    def base(self, axis):
        """At height 0: a plane of symmetry, or a plate."""
        if self.draw.chance(0.5):
            self.support(f"{axis} = 0", axis)
        else:
            self.plate("lower", 0)

    def die(self, name, ends, motion="", **more):
        self.files[f"{name}.toml"] = shapes.profile(ends)
        self.tool(name, f'profile = "{name}.toml"', motion, **more)

    def falling_die(self, name, ends, lift, speed):
        """A die that starts `lift` above where it is drawn and goes down."""
        self.die(name, ends, f"velocity = [0, {-speed:.6g}]", more=f"place = {{ translate = [0, {lift:.8g}] }}")

    def stage(self, name, end, more=""):
        self.pieces.append(f'[[stage]]\nname = "{name}"\nend = {end:.6g}' + (f"\n{more}" if more else ""))

    def remesh(self, text=""):
        self.remeshed = True
        self.pieces.append(f"[remesh]\n{text}")

    def job(self, what, end, staged=False):
        law = self.friction.strip("{} ").replace("law = ", "").replace('"', "")
        what = f"{what}; {self.element}{', remesh' if self.remeshed else ''}; {self.metal}; {law}"
        time = "" if staged else f"\n[time]\nend = {end:.6g}\n"
        case = f'title = "{what.split(";")[0]}"\n{self.head}\n' + "\n\n".join(self.pieces) + "\n" + time
        return Job(what, end, self.files | {"case.toml": case})
