#!/usr/bin/env python3
"""Runs cases and prints their figures next to references. Needs Python 3.11, nothing else.

usage: cases/run_cases.py [--list] [--results DIR] [--billet PROGRAM] [NAME...]   (no name: all)

What is compared is listed in cases/NAME/check.toml; cases/README.md describes it. The balance of
energy is checked in every case. Exit status 1 if a run or a check fails.
"""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys
import tomllib

sys.dont_write_bytecode = True

CASES = pathlib.Path(__file__).resolve().parent
ENERGY_TOLERANCE = 0.005


def over(rows, check):
    """Mean over time, or ripple (largest less smallest over the mean), while `over` holds."""
    low, high = check["over"]["between"]
    points = [(float(row["time"]), float(row[check["column"]])) for row in rows
              if low <= float(row[check["over"]["column"]]) <= high]
    way = sum(t1 - t0 for (t0, _), (t1, _) in zip(points, points[1:]))
    mean = sum((t1 - t0) * (y0 + y1) / 2 for (t0, y0), (t1, y1) in zip(points, points[1:])) / way
    if check["over"].get("ripple"):
        return (max(y for _, y in points) - min(y for _, y in points)) / abs(mean)
    return mean


def value_of(results, check):
    """The figure that a check is about: `column` of `file`, with a - in front its negative."""
    if check["column"].startswith("-"):
        return -value_of(results, check | {"column": check["column"][1:]})
    path = results / check["file"]
    if path.suffix == ".json":
        value = json.loads(path.read_text(encoding="utf-8"))
        for key in check["column"].split("."):
            value = value[int(key)] if isinstance(value, list) else value[key]
        return float(value)
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if "over" in check:
        return over(rows, check)
    if "at" not in check:
        return float(rows[-1][check["column"]])
    at = check["at"]
    points = [(float(row[at["column"]]), float(row[check["column"]])) for row in rows]
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if min(x0, x1) <= at["value"] <= max(x0, x1) and x0 != x1:
            return y0 + (y1 - y0) * (at["value"] - x0) / (x1 - x0)
    raise ValueError(f"{check['file']}: {at['column']} does not reach {at['value']}")


def judge(value, check, results):
    """What was wanted, how far off it is, whether that is good enough."""
    if isinstance(check.get("expect"), str): # another column
        check = check | {"expect": value_of(results, check | {"column": check["expect"]})}
    if "between" in check:
        low, high = check["between"]
        return f"{low:.6g} ... {high:.6g}", "", low <= value <= high
    off = value / check["expect"] - 1.0
    wanted = f"{check['expect']:.6g} +- {100 * check['tolerance']:.2g} %"
    return wanted, f"{100 * off:+.2f} %", abs(off) <= check["tolerance"]


def wanted_of(name):
    """Content of the case's check.toml, if it has one."""
    path = CASES / name / "check.toml"
    return tomllib.loads(path.read_text(encoding="utf-8")) if path.exists() else {}


def evaluate(name, content, results):
    """Prints the checks of a run of a case; returns the number of failed ones."""
    if "script" in content:
        subprocess.run([sys.executable, CASES / name / content["script"], results], check=True)
    energy = {"file": "summary.json", "column": "energy.relative_error",
              "between": [0.0, ENERGY_TOLERANCE], "source": "balance of energy"}
    failed = 0
    for check in content.get("check", []) + [energy]:
        value = value_of(results, check)
        wanted, off, good = judge(value, check, results)
        good = good and math.isfinite(value)
        at = check.get("at")
        quantity = check["column"] + (f" at {at['column']} {at['value']:g}" if at else "")
        print(f"  {'ok  ' if good else 'FAIL'} {quantity:42} {value:12.6g}   "
              f"{wanted:24} {off:>8}   {check.get('source', '')}")
        failed += not good
    return failed


def run_once(program, name, content, results):
    """Runs a case with the settings `set`; returns the number of failures."""
    settings = [word for setting in content.get("set", []) for word in ("--set", setting)]
    done = subprocess.run([program, "run", CASES / name / "case.toml", "-o", results, "--quiet", *settings],
                          stdout=subprocess.PIPE, text=True, check=False)
    print("".join(f"  {line}\n" for line in done.stdout.splitlines()), end="")
    if done.returncode != 0:
        print(f"  FAIL billet run: exit status {done.returncode}")
        return 1
    return evaluate(name, content, results)


def run(program, name, results):
    """Runs a case and its variants; returns the number of failures."""
    print(f"{name}:", flush=True)
    content = wanted_of(name)
    if "before" in content:
        subprocess.run([sys.executable, CASES / name / content["before"]], check=True)
    failed = run_once(program, name, content, results)
    for variant in content.get("variant", []):
        print(f"{name}, {variant['name']}:", flush=True)
        failed += run_once(program, name, variant, results.with_name(f"{name}-{variant['name']}"))
    return failed


def main():
    known = sorted(path.parent.name for path in CASES.glob("*/case.toml"))
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("names", nargs="*", metavar="NAME")
    words.add_argument("--list", action="store_true", help="only list the cases")
    words.add_argument("--results", type=pathlib.Path, default=CASES.parent / "results")
    words.add_argument("--billet", default=CASES.parent / "build/bin/billet")
    chosen = words.parse_args()
    unknown = sorted(set(chosen.names) - set(known))
    if unknown:
        words.error(f"no such case: {', '.join(unknown)}; there are: {', '.join(known)}")
    if chosen.list:
        for name in known:
            case = tomllib.loads((CASES / name / "case.toml").read_text(encoding="utf-8"))
            print(f"{name:24} {case.get('title', '')}")
        return 0
    failed = {name: run(chosen.billet, name, chosen.results / name) for name in chosen.names or known}
    bad = [name for name, count in failed.items() if count]
    print(f"{len(failed) - len(bad)} of {len(failed)} cases good" + (f"; not: {', '.join(bad)}" if bad else ""))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
