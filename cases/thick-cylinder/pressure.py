#!/usr/bin/env python3
"""The pressure on the bore over its radius, compared with the closed form: pressure.csv.

usage: pressure.py RESULTS

pressure is the mean of contact_pressure on the mandrel's face in each frame. limit is the rigid-plastic tube
after Prager and Hodge, 2 k ln(b/a) with b^2 - a^2 = 300 mm^2. elastic_plastic is the same tube with its
elastic strains: every ring keeps its volume, the difference of hoop and radial stress is 4 G ln(r/R) until it
is 2 k, and the pressure is the integral of that difference over ln r.
"""

import math
import pathlib
import sys
import xml.etree.ElementTree as xml

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import frames

BORE, OUTSIDE, TRAVEL = 10.0, 20.0, 75.0 # mm
YIELD, SHEAR_MODULUS = 0.5, 3.8 # MPa
TWO_K = 2.0 / math.sqrt(3.0) * YIELD


def limit(a):
    return TWO_K * math.log(math.sqrt(a * a + OUTSIDE**2 - BORE**2) / a)


def elastic_plastic(a, parts=4000):
    """Simpson's rule over the rings of the wall, in R^2 from bore to outside."""
    low, high = BORE**2, OUTSIDE**2
    step = (high - low) / parts

    def share(square):
        now = square + a * a - BORE**2 # r^2; d(ln r) = d(R^2) / (2 r^2)
        return min(2.0 * SHEAR_MODULUS * math.log(now / square), TWO_K) / (2.0 * now)

    total = share(low) + share(high)
    total += sum((4 if i % 2 else 2) * share(low + i * step) for i in range(1, parts))
    return total * step / 3.0


def contact_frames(results):
    for item in xml.parse(next(results.glob("*.pvd"))).getroot().iter("DataSet"):
        if item.get("name") == "contact":
            yield float(item.get("timestep")), results / item.get("file")


def pressure(path):
    root = xml.parse(path).getroot()
    data = root.find(".//CellData/DataArray[@Name='contact_pressure']")
    touching = [p for p in frames.array(root, data) if p > 0.0]
    return sum(touching) / len(touching) if touching else 0.0


def main(results):
    with open(results / "pressure.csv", "w", encoding="utf-8") as out:
        out.write("bore,pressure,limit,elastic_plastic\n")
        for time, path in contact_frames(results):
            a = BORE + TRAVEL * time
            out.write(f"{a:.6f},{pressure(path):.7g},{limit(a):.7g},{elastic_plastic(a):.7g}\n")


main(pathlib.Path(sys.argv[1]))
