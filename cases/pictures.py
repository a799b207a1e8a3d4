#!/usr/bin/env python3
"""Draws the films and curves of the pages of the cases. Needs Python 3.11 and ffmpeg.

usage: cases/pictures.py [--results DIR] [--billet PROGRAM] [NAME...]   (no name: all with results)

What is drawn stands in cases/pictures.toml; results come from `./dev cases NAME`. Writes
cases/NAME/film.gif and, where it is asked for, cases/NAME/stroke.png. Exit status 1 if a picture
could not be drawn, is too large to keep, or is not shown on the page of its case.
"""

import argparse
import pathlib
import subprocess
import sys
import tomllib

sys.dont_write_bytecode = True

CASES = pathlib.Path(__file__).resolve().parent
LARGEST = {".gif": 700_000, ".png": 150_000}  # bytes


def complaints(picture):
    """What is wrong with a picture that was drawn."""
    size = picture.stat().st_size
    if size > LARGEST[picture.suffix]:
        yield f"{size / 1e3:.0f} kB are more than {LARGEST[picture.suffix] / 1e3:.0f}: fewer frames?"
    page = picture.with_name("README.md").read_text(encoding="utf-8")
    if f"({picture.name})" not in page:
        yield "is not shown in README.md"


def draw(program, results, picture, options):
    """Draws one picture; returns what is wrong."""
    done = subprocess.run([program, "render", results, "-o", picture, *options],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return [done.stderr.strip()]
    return list(complaints(picture))


def pictures(name, asked):
    """Names of the pictures of a case and the options they are drawn with."""
    yield "film.gif", ["--animate", "--size", "480x360", "--fps", "8",
                       "--frames", asked.get("frames", "::"), *asked["film"]]
    if curve := asked.get("stroke"):
        yield "stroke.png", ["--curve", *([curve] if isinstance(curve, str) else []), "--size", "640x480"]


def main():
    table = tomllib.loads((CASES / "pictures.toml").read_text(encoding="utf-8"))
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("names", nargs="*", metavar="NAME")
    words.add_argument("--results", type=pathlib.Path, default=CASES.parent / "results")
    words.add_argument("--billet", default=CASES.parent / "build/bin/billet")
    chosen = words.parse_args()
    unknown = sorted(set(chosen.names) - set(table))
    if unknown:
        words.error(f"nothing in pictures.toml for: {', '.join(unknown)}; there are: {', '.join(table)}")
    bad = 0
    for name in chosen.names or [n for n in table if (chosen.results / n / "summary.json").exists()]:
        for file, options in pictures(name, table[name]):
            picture = CASES / name / file
            wrong = draw(chosen.billet, chosen.results / name, picture, options)
            size = f"{picture.stat().st_size / 1e3:.0f} kB" if picture.exists() else ""
            print(f"{'FAIL' if wrong else 'ok  '} cases/{name}/{file} {size}", *wrong, sep="  ", flush=True)
            bad += bool(wrong)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
