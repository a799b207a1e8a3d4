"""The models that are compared: Lippmann's billet, six meshes.

Radius 10 mm, length 30 mm, E = 200 GPa, nu = 0.3, yield stress 700 MPa, linear hardening 300 MPa,
compressed to 40 % of its length between flat rigid dies.
"""

from dataclasses import dataclass

import meshes

RADIUS, HALF_LENGTH, REDUCTION = 10.0, 15.0, 0.6
YOUNG, POISSON, YIELD, HARDENING = 200e3, 0.3, 700.0, 300.0
TRAVEL = REDUCTION * HALF_LENGTH


@dataclass(frozen=True)
class Model:
    name: str
    element: str
    cells: tuple
    peer_element: str      # what a user of CalculiX would take
    peer_choices: tuple    # what else he might
    peer_contact: str = "nodes"
    quick: bool = False    # part of a run without arguments

    def mesh(self):
        make = meshes.rectangle if self.element.startswith("quad") else meshes.quarter_cylinder
        return make(self.element, RADIUS, HALF_LENGTH, *self.cells)

    @property
    def share(self):
        """The part of the circumference that is modelled: a force is divided by it."""
        return 1.0 if self.element.startswith("quad") else 0.25


MODELS = {model.name: model for model in (
    Model("axi-quad8-10x12", "quad8", (10, 12), "CAX8R", ("CAX8",), quick=True),
    Model("axi-quad4-20x24", "quad4", (20, 24), "CAX4", ("CAX4R",), quick=True),
    Model("axi-quad4-40x48", "quad4", (40, 48), "CAX4", ("CAX4R",)),
    Model("3d-hex8-1040", "hex8", (5, 4, 16), "C3D8", ("C3D8I", "C3D8R"), quick=True),
    Model("3d-hex20-1040", "hex20", (5, 4, 16), "C3D20R", ("C3D20",), "surfaces"),
    Model("3d-hex8-4950", "hex8", (9, 8, 22), "C3D8", ("C3D8I", "C3D8R")),
)}

FRICTIONS = {"sticking": None, "coulomb": 0.3}
