"""The three problems: their case files and what is compared."""

import math
from dataclasses import dataclass

METAL = '''[material.metal]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "linear", yield = 700, hardening = 300 }
'''


@dataclass(frozen=True)
class Choice:
    """What a run chooses; everything else is the program's default."""
    element: str
    cells: tuple
    increments: float = 0.02      # longest, share of the run
    penalty: float = 100.0
    method: str = "penalty"
    form: str = "mixed"
    integrator: str = "radial"
    limit: float = 0.0            # max_penetration [mm], 0: none

    def contact(self):
        limit = f"max_penetration = {self.limit}\n" if self.limit else ""
        return (f'[contact]\nform = "{self.form}"\nmethod = "{self.method}"\npenalty = {self.penalty}\n'
                f'integrator = "{self.integrator}"\n{limit}')


@dataclass(frozen=True, eq=False)
class Problem:
    name: str
    title: str
    default: Choice               # the program's defaults on the mesh that is measured
    linear: tuple                 # element and cells with about as many unknowns
    reference: Choice
    end: float
    stations: tuple               # times at which forces are compared
    columns: tuple                # forces of the tool
    depth: dict                   # of an element beneath the tool, by element [mm]

    def case(self, choice):
        return BODIES[self.name](choice) + METAL + "\n" + choice.contact() + f'''
[time]
end = {self.end}
increments = {{ first = {min(0.01, choice.increments) * self.end!r}, max = {choice.increments * self.end!r} }}

[output]
every = {self.end}
'''


def workpiece(analysis, choice, low, high):
    return f'''analysis = "{analysis}"

[workpiece]
element = "{choice.element}"
material = "metal"
mesh = {{ box = [{low}, {high}], cells = {list(choice.cells)} }}

'''


def plane_supports(*planes):
    return "".join(f'[[support]]\nwhere = "{p} = 0"\nfix = ["{p}"]\n\n' for p in planes)


def billet(choice):
    return workpiece("axisymmetric", choice, [0, 0], [10, 15]) + plane_supports("x", "y") + '''[[tool]]
name = "die"
surface = { plane = { point = [0, 15], normal = [0, -1] } }
motion = { velocity = [0, -1] }
friction = { law = "coulomb", mu = 0.3 }

'''


def punch(choice):
    return workpiece("plane-strain", choice, [0, 0], [6, 4]) + plane_supports("x", "y") + '''[[tool]]
name = "die"
surface = { circle = { centre = [0, 8], radius = 4 } }
motion = { velocity = [0, -1] }
friction = { law = "coulomb", mu = 0.2 }

'''


SIDES, RADIUS, PRESSED = 12, 0.05, 0.2


def kinks():
    """Times of the corners of the path, the run taking 1 s and pressing the first PRESSED of it."""
    return tuple(PRESSED + (1 - PRESSED) * (i + 1) / SIDES for i in range(SIDES))


def rubbing(choice):
    path = [[0, 0, 0, 0], [PRESSED, 0, 0, -0.06]]
    for i, time in enumerate(kinks()):
        angle = 2 * math.pi * (i + 1) / SIDES
        path.append([time, RADIUS * math.sin(angle), RADIUS * (1 - math.cos(angle)), -0.06])
    return workpiece("3d", choice, [0, 0, 0], [4, 4, 2]) + f'''[[support]]
where = "z = 0"
fix = ["x", "y", "z"]

[[tool]]
name = "die"
surface = {{ plane = {{ point = [0, 0, 2], normal = [0, 0, -1] }} }}
motion = {{ displacement = {path} }}
friction = {{ law = "coulomb", mu = 0.1 }}

'''


BODIES = {"billet": billet, "punch": punch, "rubbing": rubbing}


def quarter_steps(end):
    return tuple(end * share for share in (0.25, 0.5, 0.75, 1.0))


SIDE = (1 - PRESSED) / SIDES      # of the path [s]

PROBLEMS = (
    Problem("billet", "Billet between flat dies, Coulomb 0.3, upset by a fifth", Choice("quad8", (10, 12)),
            ("quad4", (20, 24)), Choice("quad8", (30, 36), increments=0.005, penalty=1e4, form="compatible"),
            3.0, quarter_steps(3.0), ("y",), {"quad8": 1.25, "quad4": 0.625}),
    Problem("punch", "Round punch into a block in plane strain, Coulomb 0.2", Choice("quad8", (18, 12)),
            ("quad4", (36, 24)), Choice("quad8", (54, 36), increments=0.005, penalty=1e4, form="compatible"),
            0.4, quarter_steps(0.4), ("y",), {"quad8": 1 / 3, "quad4": 1 / 6}),
    Problem("rubbing", "Block in space, pressed and rubbed once round a polygon of 12 sides, Coulomb 0.1",
            Choice("hex20", (4, 4, 2), increments=SIDE), ("hex8", (8, 8, 4)),
            Choice("hex20", (8, 8, 4), increments=SIDE / 8, penalty=1e4, form="compatible", integrator="exact"),
            1.0, kinks(), ("x", "y", "z"), {"hex20": 1.0, "hex8": 0.5}),
)
