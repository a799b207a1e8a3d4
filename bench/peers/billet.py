"""billet: case file, run and results. The mesh is the peer's: generated in the plane, a file in 3D."""

import csv
import json

import calculix
import timed
from models import HALF_LENGTH, HARDENING, POISSON, RADIUS, TRAVEL, YIELD, YOUNG

TOLERANCE = 1e-6  # solver.tolerance, its default


def run(model, mu, program, threads, timeout, folder):
    """Solves `model` in `folder`; returns cost, increments, iterations and the force curve."""
    mesh = model.mesh()
    (folder / "case.toml").write_text(case(model, mesh, mu), encoding="utf-8")
    if not mesh.plane:
        (folder / "billet.inp").write_text(mesh_file(mesh, model), encoding="utf-8")
    results = folder / "results"
    (results / "history.csv").unlink(missing_ok=True)
    command = [str(program), "run", "case.toml", "-o", "results", "--threads", str(threads), "--quiet"]
    cost = timed.run(command, folder, folder / "billet.log", timeout)
    history = read_history(results / "history.csv")
    curve = [(-float(row["punch.displacement_" + axial(mesh)]) / HALF_LENGTH,
              abs(float(row["punch.force_" + axial(mesh)])) / model.share / 1000) for row in history]
    return {**cost.as_dict(), "program": version(results / "summary.json"),
            "element": model.element, "residual": TOLERANCE, "nodes": len(mesh.nodes), "elements": len(mesh.elements),
            "increments": len(history), "iterations": count_iterations(results, history),
            "curve": curve, "message": last_line(folder / "billet.log", cost.status)}


def axial(mesh):
    return "xyz"[mesh.axial]


def case(model, mesh, mu):
    down = [0.0] * mesh.axial + [-1.0]
    top = [0.0] * mesh.axial + [HALF_LENGTH]
    friction = '{ law = "sticking" }' if mu is None else f'{{ law = "coulomb", mu = {mu} }}'
    planes = ["x", "y"] if mesh.plane else ["x", "y", "z"]
    supports = "\n".join(f'[[support]]\nwhere = "{p} = 0"\nfix   = ["{p}"]\n' for p in planes)
    return f'''title    = "Upsetting of a cylindrical billet, {model.name}"
analysis = "{'axisymmetric' if mesh.plane else '3d'}"

[workpiece]
element  = "{model.element}"
material = "metal"
mesh     = {source(model, mesh)}

[material.metal]
elastic = {{ young = {YOUNG}, poisson = {POISSON} }}
flow    = {{ law = "linear", yield = {YIELD}, hardening = {HARDENING} }}

{supports}
[[tool]]
name     = "punch"
surface  = {{ plane = {{ point = {top}, normal = {down} }} }}
motion   = {{ velocity = {down} }}
friction = {friction}

[time]
end = {TRAVEL}
'''


def source(model, mesh):
    if mesh.plane:
        return f"{{ box = [[0, 0], [{RADIUS}, {HALF_LENGTH}]], cells = {list(model.cells)} }}"
    return '{ file = "billet.inp" }'


def mesh_file(mesh, model):
    kind = {"hex8": "C3D8", "hex20": "C3D20"}[model.element]
    lines = ["*NODE"] + [f"{n}, " + ", ".join(f"{c:.12g}" for c in x)
                         for n, x in enumerate(mesh.nodes, 1)]
    lines += [f"*ELEMENT, TYPE={kind}, ELSET=BILLET"]
    lines += [calculix.row(n, nodes) for n, nodes in enumerate(mesh.elements, 1)]
    return "\n".join(lines) + "\n"


def read_history(path):
    if not path.exists():
        return []
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def count_iterations(results, history):
    """Every Newton iteration, those of abandoned attempts included: linear systems solved."""
    path = results / "summary.json"
    if path.exists():
        summary = json.loads(path.read_text(encoding="utf-8"))
        return summary["iterations"] + summary["iterations_of_failed_tries"]
    return sum(int(float(row["iterations"])) for row in history)


def version(summary):
    if not summary.exists():
        return "billet"
    return "billet " + str(json.loads(summary.read_text(encoding="utf-8")).get("version", ""))


def last_line(log, status):
    lines = log.read_text(encoding="utf-8", errors="replace").split("\n")
    return next((line for line in reversed(lines) if line.strip()), "") if status else ""
