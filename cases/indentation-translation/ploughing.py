#!/usr/bin/env python3
"""A wedge under a constant load pushes a wave: T/N compared with Challen and Oxley's; writes a table.

usage: ploughing.py RESULTS [--billet PROGRAM] [--cells N]   (N along the block; 200)

RESULTS/ploughing.csv: angle of attack, f = m, T/N over the last fifth of the slide, how far it has slid in
contact lengths, the wave model's coefficient, and the difference.

The wave model (Challen and Oxley, Wear 53 (1979) 229): mu = (A sin a + cos(acos f - a)) / (A cos a + sin(acos f - a)),
A = 1 + pi/2 + acos f - 2 a - 2 asin(sin a / sqrt(1 - f)); tan a without friction.
"""

import argparse
import csv
import math
import pathlib
import shutil
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ANGLES, FACTORS = (5, 10), (0.0, 0.1, 0.2, 0.4)
ROUNDING, BACK = 0.3, 30.0 # mm: of the nose; degrees: of the face behind it
LAST = 0.2 # of the slide is averaged


def wave(degrees, f):
    a, c = math.radians(degrees), math.acos(f)
    A = 1 + math.pi / 2 + c - 2 * a - 2 * math.asin(math.sin(a) / math.sqrt(1 - f))
    return (A * math.sin(a) + math.cos(c - a)) / (A * math.cos(a) + math.sin(c - a))


def write_wedge(path, degrees):
    """Two faces that meet in an arc; its lowest point is the origin."""
    front, back = math.radians(degrees), math.radians(BACK)
    arc = [(ROUNDING * math.sin(t), ROUNDING * (1 - math.cos(t))) for t in (-back, front)]
    ends = [(arc[0][0] - 3 * math.cos(back), arc[0][1] + 3 * math.sin(back)),
            (arc[1][0] + 9 * math.cos(front), arc[1][1] + 9 * math.sin(front))]
    words = ["start = [%.10g, %.10g]" % ends[0], "[[segment]]\nto = [%.10g, %.10g]" % arc[0],
             "[[segment]]\nto = [%.10g, %.10g]\nradius = %g" % (*arc[1], ROUNDING),
             "[[segment]]\nto = [%.10g, %.10g]" % ends[1]]
    path.write_text("# Written by ploughing.py.\n" + "\n\n".join(words) + "\n", encoding="utf-8")


def slide(words, degrees, f):
    """T/N and the way in contact lengths of one run."""
    results = words.results / f"wedge-{degrees:g}-{f:g}"
    profile = words.results / f"wedge-{degrees:g}.toml"
    write_wedge(profile, degrees)
    shutil.copy(HERE / "wedge.toml", words.results)
    subprocess.run([words.billet, "run", words.results / "wedge.toml", "-o", results, "--quiet",
                    "--set", f"tool.wedge.surface.profile={profile.name}",
                    "--set", f"tool.wedge.friction.m={f}",
                    "--set", f"workpiece.mesh.cells=[{words.cells}, {round(0.08 * words.cells)}]"],
                   stdout=subprocess.DEVNULL, check=True)
    with open(results / "history.csv", encoding="utf-8") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    end = rows[-1]["time"]
    last = [row for row in rows if row["time"] > end - LAST]
    T, N, length = (sum(row["dt"] * row[k] for row in last)
                    for k in ("wedge.force_x", "wedge.force_y", "contact_area"))
    return -T / N, 8.0 / (length / sum(row["dt"] for row in last))


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("results", type=pathlib.Path)
    words.add_argument("--billet", default=HERE.parents[1] / "build/bin/billet")
    words.add_argument("--cells", type=int, default=200)
    words.add_argument("--angles", type=float, nargs="*", default=ANGLES)
    words = words.parse_args()
    words.results.mkdir(parents=True, exist_ok=True)
    with open(words.results / "ploughing.csv", "w", encoding="utf-8") as out:
        out.write("angle,f,mu,lengths_slid,wave_model,difference\n")
        for degrees in words.angles:
            for f in FACTORS:
                mu, way = slide(words, degrees, f)
                row = f"{degrees:g},{f:g},{mu:.4f},{way:.1f},{wave(degrees, f):.4f},{mu / wave(degrees, f) - 1:+.3f}"
                print(row, flush=True)
                out.write(row + "\n")


if __name__ == "__main__":
    main()
