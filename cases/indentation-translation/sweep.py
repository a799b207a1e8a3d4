#!/usr/bin/env python3
"""T/N of both sequences over the friction factor, the same in both: the chart of the paper's Fig. 10.

usage: sweep.py RESULTS [--billet PROGRAM] [--cells NX NY] [M ...]

RESULTS/ratio.csv: m, and T/N of each sequence (sequences.py).
"""

import argparse
import json
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
FACTORS = (0.0, 0.05, 0.09, 0.13, 0.17, 0.23, 0.3)


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("results", type=pathlib.Path)
    words.add_argument("factors", type=float, nargs="*", default=FACTORS, metavar="M")
    words.add_argument("--cells", type=int, nargs=2, default=[128, 16])
    words.add_argument("--billet", default=HERE.parents[1] / "build/bin/billet")
    words = words.parse_args()
    words.results.mkdir(parents=True, exist_ok=True)
    with open(words.results / "ratio.csv", "w", encoding="utf-8") as out:
        out.write("m,first,second\n")
        for m in words.factors:
            results = words.results / f"m-{m:g}"
            subprocess.run([words.billet, "run", HERE / "case.toml", "-o", results, "--quiet",
                            f"--set=workpiece.mesh.cells={words.cells}"] +
                           [f"--set=tool.{tool}.friction.m={m}" for tool in ("first", "second")],
                           stdout=subprocess.DEVNULL, check=True)
            subprocess.run([sys.executable, HERE / "sequences.py", results], check=True)
            figures = json.loads((results / "sequences.json").read_text(encoding="utf-8"))
            row = f"{m:g},{figures['first']['ratio']:.4f},{figures['second']['ratio']:.4f}"
            print(row, flush=True)
            out.write(row + "\n")


if __name__ == "__main__":
    main()
