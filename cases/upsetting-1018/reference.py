#!/usr/bin/env python3
"""Writes reference.csv here and in ../upsetting-1018-3d: forces between which upsetting must lie.

Homogeneous compression without friction, F = sigma_y(eps) A, and the slab method with Tresca
friction, F = sigma_y(eps) A (1 + 2 m R / (3 sqrt(3) h)); eps = ln(h0/h), A = A0 h0/h. The second is
also the upper bound of a disk that stays cylindrical (rigid-plastic, constant yield stress).
"""

import math
import pathlib

M, K, EPS0, N = 0.08, 740.0, 0.01, 0.2
HEIGHT, END = 15.0, 1.1
HERE = pathlib.Path(__file__).resolve().parent


def forces(strain, area0):
    """Forces on the section of initial area area0 of the whole specimen [N]."""
    height = HEIGHT * math.exp(-strain)
    area = area0 * math.exp(strain)
    lower = K * (EPS0 + strain) ** N * area
    return lower, lower * (1.0 + 2.0 * M * math.sqrt(area / math.pi) / (3.0 * math.sqrt(3.0) * height))


def write(path, area0, part, travel):
    """part: modelled share of the section; travel: the punch's share of the reduction."""
    with open(path, "w", encoding="utf-8") as out:
        out.write("# closed forms, written by cases/upsetting-1018/reference.py\n"
                  "stroke,height_strain,homogeneous,slab\n")
        for step in range(2, 45):
            strain = END * step / 44
            stroke = travel * HEIGHT * (1.0 - math.exp(-strain))
            lower, upper = (part * force for force in forces(strain, area0))
            out.write(f"{stroke:.6f},{strain:.4f},{lower:.2f},{upper:.2f}\n")


write(HERE / "reference.csv", math.pi * 25.0, 1.0, 0.5)
# The mesh of the case in space has an octagonal quarter, 16 corners in all.
write(HERE.parent / "upsetting-1018-3d/reference.csv", 8.0 * math.sin(math.pi / 8.0) * 25.0, 0.25, 1.0)
