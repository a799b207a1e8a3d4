"""The small scenes and their case files: every length times `length`, every stress times `stress`."""

from dataclasses import dataclass, replace

YOUNG, YIELD, HARDENING = 200e3, 700.0, 300.0


@dataclass(frozen=True)
class Units:
    """Factors on lengths and stresses [-], and the name in the case file."""
    name: str
    length: float
    stress: float = 1.0

    @property
    def system(self):
        return "m-N-s-Pa-degC" if self.stress != 1.0 else "mm-N-s-MPa-degC"


UNITS = {u.name: u for u in (Units("x1", 1.0), Units("x1e-6", 1e-6), Units("x1e6", 1e6),
                             Units("x2^20", 2.0**20), Units("m-Pa", 1e-3, 1e6))}


@dataclass(frozen=True)
class Setting:
    """One run of the matrix."""
    scene: str
    friction: str = "mu 0.1"
    penalty: float = 100.0
    increments: float = 1.0       # factor on the default lengths
    units: str = "x1"
    poisson: float = 0.3
    short: bool = False           # only a part of the travel: increments are too many for all of it

    def reference(self):
        """The run that tells what is right: the same problem as the defaults solve it."""
        return replace(self, penalty=100.0, increments=1.0, units="x1")

    def lets_go(self):
        """Whether metal leaves the tool while friction still holds it with more shear than pressure."""
        return SCENES[self.scene].passes and self.friction in HOLDING

    def __str__(self):
        return (f"{self.scene}, {self.friction}, penalty {self.penalty:g}, increments x{self.increments:g}, "
                f"units {self.units}, poisson {self.poisson:g}")


HOLDING = ("mu 10", "sticking", "tresca 1")  # more shear than pressure, and a good part of the metal's strength
PLAIN = ("mu 0", "mu 0.1", "mu 0.5", "mu 1", "mu 10", "sticking", "tresca 1", "shaw", "asperity",
         "thick-film", "viscoplastic", "evolution")


def frictions(scene):
    return PLAIN + (("tensor",) if scene.startswith("block") else ())


def friction(name, u):
    """The table of a tool in units `u`."""
    if name.startswith("mu "):
        return f'law = "coulomb", mu = {name[3:]}'
    return {
        "sticking": 'law = "sticking"',
        "tresca 1": 'law = "tresca", m = 1',
        "shaw": 'law = "shaw", k = "shear-yield", f = 0.5',
        "asperity": 'law = "asperity", m_local = 0.5, k = "shear-yield", f = 0.5',
        "thick-film": f'law = "thick-film", viscosity = {1.0 * u.stress!r}, film = {0.01 * u.length!r}',
        "viscoplastic": f'law = "viscoplastic", beta = {100 * u.stress!r}, v0 = {u.length!r}, mv = 0.2',
        "evolution": f'law = "coulomb", mu = 0.1, evolution = [[0, 1], [{0.05 * u.length!r}, 3]]',
        "tensor": 'law = "coulomb", mu = 0.2, tensor = [[1, 0], [0, 0.5]], direction = [1, 1, 0]',
    }[name]


@dataclass(frozen=True)
class Scene:
    name: str
    analysis: str
    element: str
    box: tuple
    cells: tuple
    supports: str
    surface: str
    motion: str
    end: float
    passes: bool = False          # faces come and go: forces have a ripple
    part: float = 0.1             # of the travel where increments are short

    def end_of(self, setting):
        return self.end * (self.part if setting.short else 1.0)

    def force_factor(self, u):
        """Of a force in units `u`; plane strain: per unit of thickness."""
        return u.stress * (u.length if self.analysis == "plane-strain" else u.length**2)


def support(where, fixed):
    return f'[[support]]\nwhere = "{where}"\nfix = {list(fixed)}\n'


FLAT = support("x = 0", "x") + support("y = 0", "y")
UPSETTING = dict(analysis="axisymmetric", box=((0, 0), (10, 10)), supports=FLAT,
                 surface="plane = {{ point = [0, {L10}], normal = [0, -1] }}",
                 motion="velocity = [0, -{L1}]", end=1.0)
STRIP = dict(analysis="plane-strain", box=((-8.0, 0), (-2.0, 1)), passes=True, part=0.3,
             supports=support("y = 0", "y") +
             '[[support]]\nwhere = "x = {L-8}"\nmove = {{ x = [[0, 0], [3, {L3}]] }}\n',
             surface="circle = {{ centre = [0, {L20.9}], radius = {L20} }}",
             motion="rotation = {{ point = [0, {L20.9}], speed = 0.0525 }}", end=3.0)
BLOCK = dict(analysis="3d", box=((0, 0, 0), (4, 4, 2)), supports=support("z = 0", "xyz"),
             surface="plane = {{ point = [0, 0, {L2}], normal = [0, 0, -1] }}",
             motion="displacement = [[0, 0, 0, 0], [0.5, 0, 0, -{L0.08}], [1, {L0.1}, {L0.05}, -{L0.12}]]",
             end=1.0)

SCENES = {scene.name: scene for scene in (
    Scene("upsetting quad4", element="quad4", cells=(8, 8), **UPSETTING),
    Scene("upsetting quad8", element="quad8", cells=(4, 4), **UPSETTING),
    Scene("strip quad4", element="quad4", cells=(24, 5), **STRIP),
    Scene("strip quad8", element="quad8", cells=(8, 2), **STRIP),
    Scene("block hex8", element="hex8", cells=(3, 3, 2), **BLOCK),
)}


class Lengths(dict):
    """`{L20.9}` in a template: that many mm in the units of the case."""

    def __init__(self, factor):
        super().__init__()
        self.factor = factor

    def __missing__(self, key):
        return repr(float(key[1:]) * self.factor)


def case(setting):
    scene, u = SCENES[setting.scene], UNITS[setting.units]
    lengths = Lengths(u.length)
    box = [[x * u.length for x in corner] for corner in scene.box]
    end = scene.end_of(setting)
    first, largest = (min(end, share * scene.end * setting.increments) for share in (0.01, 0.02))
    return f'''analysis = "{scene.analysis}"
units = "{u.system}"

[workpiece]
element = "{scene.element}"
material = "metal"
mesh = {{ box = {box}, cells = {list(scene.cells)} }}

[material.metal]
elastic = {{ young = {YOUNG * u.stress!r}, poisson = {setting.poisson} }}
flow = {{ law = "linear", yield = {YIELD * u.stress!r}, hardening = {HARDENING * u.stress!r} }}

{filled(scene.supports, lengths)}
[[tool]]
name = "die"
surface = {{ {filled(scene.surface, lengths)} }}
motion = {{ {filled(scene.motion, lengths)} }}
friction = {{ {friction(setting.friction, u)} }}

[contact]
penalty = {setting.penalty!r}

[time]
end = {end!r}
increments = {{ first = {first!r}, max = {largest!r} }}

[output]
every = {end!r}
'''


def filled(template, lengths):
    """Fills in `{L20.9}`: a dot in a key would be an attribute for str.format."""
    import re
    text = re.sub(r"\{L(-?[0-9.]+)\}", lambda found: lengths["L" + found[1]], template)
    return text.replace("{{", "{").replace("}}", "}")
