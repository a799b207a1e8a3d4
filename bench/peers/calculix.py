"""CalculiX: input deck, run and results.

The tool is a plate of one element whose every degree of freedom is prescribed: rigid, at no cost.
The slave surface is end face and side, so that the side may fold over onto the tool. Sticking is
modelled as a user of CalculiX would: the end nodes move with the tool, and the side meets it with
friction 10 (`friction` as the `sticking` option: end nodes are left to contact as well).
"""

import re
from dataclasses import dataclass

import timed
from models import HALF_LENGTH, HARDENING, POISSON, RADIUS, TRAVEL, YIELD, YOUNG

PLATE_RADIUS, PLATE_THICKNESS = 3 * RADIUS, 5.0
LARGEST_STRAIN = 10.0
OWN_TOLERANCE = 0.005  # R_n of *CONTROLS


CONTACTS = {"surfaces": "SURFACE TO SURFACE", "nodes": "NODE TO SURFACE"}


@dataclass
class Settings:
    element: str
    program: str = "ccx"
    contact: str = "SURFACE TO SURFACE"
    sticking: str = "nodes"        # or "friction"
    penalty: float = 10 * YOUNG    # [MPa/mm]; the manual advises 5 to 50 times Young's modulus
    stick: float = YOUNG           # [MPa/mm]; a tenth of it
    solver: str = "SPOOLES"
    first: float = 0.01            # of the step
    largest: float = 0.05
    tolerance: float = OWN_TOLERANCE  # largest residual over the mean nodal force
    timeout: float = 600.0


def run(model, mu, settings, folder):
    """Solves `model` in `folder`; returns cost, increments, iterations and the force curve."""
    mesh = model.mesh()
    (folder / "billet.inp").write_text(deck(mesh, mu, settings), encoding="utf-8")
    for stale in folder.glob("billet.[!i]*"):
        stale.unlink()
    threads = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS",
                                      "CCX_NPROC_EQUATION_SOLVER", "CCX_NPROC_STIFFNESS")}
    cost = timed.run([settings.program, "-i", "billet"], folder, folder / "ccx.log",
                     settings.timeout, threads)
    curve = force_curve(folder / "billet.dat", force_factor(mesh, model))
    return {**cost.as_dict(), "program": version(folder / "ccx.log"), "element": settings.element,
            "residual": settings.tolerance,
            "nodes": len(mesh.nodes), "elements": len(mesh.elements),
            "increments": len(curve), "iterations": count_iterations(folder / "billet.cvg"),
            "curve": curve, "message": last_error(folder / "ccx.log")}


def deck(mesh, mu, settings):
    end = mesh.nodes_where(mesh.on_end)
    lines = ["*HEADING", "Upsetting of a cylindrical billet"]
    lines += ["*NODE, NSET=NBILLET"]
    lines += [f"{n}, " + ", ".join(f"{c:.12g}" for c in x) for n, x in enumerate(mesh.nodes, 1)]
    lines += [f"*ELEMENT, TYPE={settings.element}, ELSET=BILLET"]
    lines += [row(n, nodes) for n, nodes in enumerate(mesh.elements, 1)]
    lines += node_set("MIDDLE", mesh.nodes_where(lambda x: x[mesh.axial] == 0.0))
    lines += node_set("END", end)
    lines += node_set("XPLANE", mesh.nodes_where(lambda x: x[0] == 0.0))
    if not mesh.plane:
        lines += node_set("YPLANE", mesh.nodes_where(lambda x: x[1] == 0.0))
    lines += plate(mesh, settings) + material(settings) + contact(mesh, mu, settings)
    return "\n".join(lines + step(mesh, mu, settings)) + "\n"


def row(number, nodes):
    """One data line; a long one is continued, as the format wants."""
    words = [str(number)] + [str(n) for n in nodes]
    return ",\n".join(", ".join(words[i:i + 15]) for i in range(0, len(words), 15))


def node_set(name, nodes):
    return [f"*NSET, NSET={name}"] + [row(part[0], part[1:]) for part in
                                      (nodes[i:i + 12] for i in range(0, len(nodes), 12))]


def plate(mesh, settings):
    """The tool: one linear element above the end face.

    Contact between surfaces never finds a face that degenerates at the axis (2.20, silently), so
    that face begins next to it, short of the first contact point; node to surface contact needs it
    to begin at the axis.
    """
    inner = 0.0 if settings.contact == "NODE TO SURFACE" else 0.005 * RADIUS
    first, n = len(mesh.nodes) + 1, len(mesh.elements) + 1
    low, high = HALF_LENGTH, HALF_LENGTH + PLATE_THICKNESS
    wide = PLATE_RADIUS
    if mesh.plane:
        points, kind = [(inner, low), (wide, low), (wide, high), (inner, high)], "CAX4"
    else:
        square = [(0, 0), (wide, 0), (wide, wide), (0, wide)]
        points, kind = [(*p, z) for z in (low, high) for p in square], "C3D8"
    lines = ["*NODE, NSET=NTOOL"]
    lines += [f"{first + i}, " + ", ".join(f"{c:.12g}" for c in p) for i, p in enumerate(points)]
    lines += [f"*ELEMENT, TYPE={kind}, ELSET=TOOL", row(n, range(first, first + len(points)))]
    return lines


def material(settings):
    return ["*MATERIAL, NAME=METAL", "*ELASTIC", f"{YOUNG}, {POISSON}", "*PLASTIC", f"{YIELD}, 0.",
            f"{YIELD + HARDENING * LARGEST_STRAIN}, {LARGEST_STRAIN}",
            "*SOLID SECTION, ELSET=BILLET, MATERIAL=METAL",
            "*MATERIAL, NAME=STIFF", "*ELASTIC", f"{YOUNG}, {POISSON}",
            "*SOLID SECTION, ELSET=TOOL, MATERIAL=STIFF"]


def contact(mesh, mu, settings):
    def touches(x):
        return mesh.on_side(x)

    faces = mesh.faces_where(touches)
    if not fixed_end(mu, settings):
        faces += mesh.faces_where(mesh.on_end)
    lines = ["*SURFACE, NAME=SLAVE, TYPE=ELEMENT"] + [f"{e}, S{f}" for e, f in faces]
    lines += ["*SURFACE, NAME=MASTER, TYPE=ELEMENT", f"{len(mesh.elements) + 1}, S1"]
    lines += ["*SURFACE INTERACTION, NAME=DRY",
              "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", surface_behavior(settings)]
    lines += ["*FRICTION", f"{10.0 if mu is None else mu}, {settings.stick}"]
    lines += [f"*CONTACT PAIR, INTERACTION=DRY, TYPE={settings.contact}", "SLAVE, MASTER"]
    return lines


def surface_behavior(settings):
    """Node-to-surface contact also wants the pull at a large gap."""
    tension = "" if settings.contact == "SURFACE TO SURFACE" else ", 0.01"
    return f"{settings.penalty}{tension}"


def fixed_end(mu, settings):
    return mu is None and settings.sticking == "nodes"


# At the end of every increment, about as often as billet writes its own.
FIELDS = ["*NODE FILE", "U", "*EL FILE", "S, PEEQ", "*CONTACT FILE", "CDIS, CSTR"]


def step(mesh, mu, settings):
    axial, across = mesh.axial + 1, range(1, mesh.axial + 1)
    lines = ["*STEP, NLGEOM, INC=100000", f"*STATIC, SOLVER={settings.solver}",
             f"{settings.first}, 1., 1e-6, {settings.largest}"] + controls(settings)
    lines += ["*BOUNDARY", "XPLANE, 1, 1, 0."]
    if not mesh.plane:
        lines += ["YPLANE, 2, 2, 0."]
    lines += [f"MIDDLE, {axial}, {axial}, 0."]
    lines += [f"NTOOL, {d}, {d}, 0." for d in across] + [f"NTOOL, {axial}, {axial}, -{TRAVEL}"]
    if fixed_end(mu, settings):
        lines += [f"END, {d}, {d}, 0." for d in across] + [f"END, {axial}, {axial}, -{TRAVEL}"]
    return lines + FIELDS + ["*NODE PRINT, NSET=MIDDLE, TOTALS=ONLY", "RF", "*END STEP"]


def controls(settings):
    """R_n, and R_p for iterations after the ninth, which ccx by itself lets off with 0.02."""
    if settings.tolerance == OWN_TOLERANCE:
        return []
    return ["*CONTROLS, PARAMETERS=FIELD", f"{settings.tolerance:g}, , , , {settings.tolerance:g}"]


def force_factor(mesh, model):
    """Axisymmetric forces are printed for the slice of two degrees into which ccx expands it."""
    return 180.0 if mesh.plane else 1.0 / model.share


def force_curve(path, factor):
    """[(reduction, force in kN)] at each converged increment."""
    if not path.exists():
        return []
    number = r"[-+0-9.E]+"
    pattern = rf"for set MIDDLE and time\s+({number})\s+({number})\s+({number})\s+({number})"
    rows = re.findall(pattern, path.read_text(encoding="utf-8"))
    # the axial component: y in the plane (where the third is zero), z otherwise
    axial = 2 if factor == 180.0 else 3
    return [(float(r[0]) * TRAVEL / HALF_LENGTH, abs(float(r[axial])) * factor / 1000) for r in rows]


def count_iterations(path):
    """Every Newton iteration, those of abandoned attempts included."""
    if not path.exists():
        return 0
    lines = path.read_text(encoding="utf-8").splitlines()
    return sum(1 for line in lines if re.match(r"\s*\d+\s+\d+\s+\d+\s+\d+", line))


def version(log):
    found = re.search(r"CalculiX Version ([\w.]+)", log.read_text(encoding="utf-8", errors="replace"))
    return f"CalculiX {found.group(1).rstrip('.,')}" if found else "CalculiX"


def last_error(log):
    found = re.findall(r"\*ERROR[^\n]*(?:\n[^\n*]+)?",
                       log.read_text(encoding="utf-8", errors="replace"))
    return " ".join(found[-1].split()) if found else ""
