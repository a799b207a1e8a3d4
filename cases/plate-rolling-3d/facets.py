#!/usr/bin/env python3
"""Prints force, torque and ripple with an analytic roll and with STL rolls of 64, 256 and 1024 facets.

Runs build/bin/billet seven times (two minutes); results go to results/facets/.
"""

import csv
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
OUT = ROOT / "results/facets"
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent))
from run_cases import over

WIDTH = 0.4 # mm


def figures(name, surface):
    """Mean force and torque per mm of width, ripple of the force, increments."""
    results = OUT / name
    subprocess.run([ROOT / "build/bin/billet", "run", OUT / "case.toml", "-o", results, "--quiet",
                    "--set", f"tool.roll.surface={surface}"], check=True, stdout=subprocess.DEVNULL)
    with open(results / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    steady = {"column": "time", "between": [1.2, 2.4]}
    force = over(rows, {"column": "roll.force_y", "over": steady})
    torque = -over(rows, {"column": "roll.torque_z", "over": steady})
    ripple = over(rows, {"column": "roll.force_y", "over": steady | {"ripple": True}})
    return force / WIDTH, torque / WIDTH, ripple, len(rows)


def main():
    OUT.mkdir(parents=True, exist_ok=True)
    shutil.copy(HERE / "case.toml", OUT)
    subprocess.run([sys.executable, HERE / "make_rolls.py", "64", "256", "1024"], cwd=OUT, check=True)
    surfaces = {"analytic": "{ cylinder = { point = [0, 100.8, 0], axis = [0, 0, 1], radius = 100 } }"}
    for smooth in ("true", "false"):
        for n in (64, 256, 1024):
            surfaces[f"{n} facets{', smooth' if smooth == 'true' else ''}"] = \
                f'{{ stl = "roll{n}.stl", unit = "mm", smooth = {smooth} }}'
    reference = None
    for name, surface in surfaces.items():
        force, torque, ripple, increments = figures(name.replace(" ", "-").replace(",", ""), surface)
        reference = reference or (force, torque)
        print(f"{name:20} force {force:8.1f} N/mm ({100 * (force / reference[0] - 1):+6.2f} %)   "
              f"torque {torque:8.1f} N ({100 * (torque / reference[1] - 1):+6.2f} %)   "
              f"ripple {100 * ripple:5.2f} %   {increments} increments", flush=True)


main()
