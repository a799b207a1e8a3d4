"""docs/trade.md and its picture from the figures."""

import math
import re
import subprocess
import tempfile
from dataclasses import replace
from pathlib import Path

HEAD = ["element", "form", "enforcement", "change by softness", "error", "deepest contact point", "deepest point",
        "increments", "iterations", "cut-backs", "cost"]
PATHS = ["increments a side", "integrator", "error of the shear", "error of the force", "iterations", "cost"]
BEGIN, END = "<!-- measured: {} -->", "<!-- end of {} -->"


def percent(value):
    return "-" if math.isnan(value) else f"{100 * value:.2g} %"


def enforcement(choice):
    name = f"penalty {choice.penalty:g}" if choice.method == "penalty" else "augmented"
    return name + (", limit h/1000" if choice.limit else "")


def rows(problem, measured, runs):
    unit = runs(problem, problem.default).cost.cpu
    table = []
    for made, softness, error in measured:
        c = made.choice
        table.append([c.element, c.form, enforcement(c), percent(softness), percent(error), percent(made.depth),
                      percent(made.bound), str(made.increments), str(made.iterations), str(made.cutbacks),
                      f"{made.cost.cpu / unit:.2f}" if made.done else f"status {made.cost.status}"])
    return table


def path_rows(turned):
    if not turned:
        return []
    unit = turned[0][1].cost.cpu
    return [[str(parts), made.choice.integrator, percent(shear), percent(force), str(made.iterations),
             f"{made.cost.cpu / unit:.2f}"] for parts, made, shear, force in turned]


def pipes(head, table):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "---|" * len(head),
                      *("| " + " | ".join(line) + " |" for line in table)])


def aligned(table):
    widths = [max(len(line[i]) for line in table) for i in range(len(table[0]))]
    return "\n".join("  ".join(c.ljust(w) for c, w in zip(line, widths)).rstrip() for line in table)


def text(enforced, turned, runs):
    parts = [problem.title + "\n" + aligned([HEAD] + rows(problem, measured, runs))
             for problem, measured in enforced.items()]
    return "\n\n".join(parts + ([aligned([PATHS] + path_rows(turned))] if turned else []))


def write(path, enforced, turned, runs, machine):
    """Replaces the tables in the page between their marks; the words around them are the author's."""
    page = path.read_text(encoding="utf-8")
    for problem, measured in enforced.items():
        unit = runs(problem, problem.default).cost.cpu
        fine = runs(problem, problem.reference)
        said = (f"Cost 1 is {unit:.2f} s of processor time; the reference costs {fine.cost.cpu / unit:.0f}.\n\n")
        page = replaced(page, problem.name, said + pipes(HEAD, rows(problem, measured, runs)))
    if turned:
        page = replaced(page, "integrators", pipes(PATHS, path_rows(turned)))
    page = replaced(page, "machine", pipes(["", ""], [[k, v] for k, v in machine.items()]))
    path.write_text(page, encoding="utf-8")
    draw(path.with_suffix(".png"), enforced, turned, runs)


def replaced(page, name, content):
    begin, end = BEGIN.format(name), END.format(name)
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if not pattern.search(page):
        raise SystemExit(f"the page has no place for {name}: {begin}")
    return pattern.sub(lambda _: f"{begin}\n{content}\n{end}", page)


def draw(picture, enforced, turned, runs):
    """Error by cost, a panel a problem; error by increments for the integrators."""
    with tempfile.TemporaryDirectory() as folder:
        panels = [panel(Path(folder), problem, measured, runs) for problem, measured in enforced.items()]
        if turned:
            panels.append(integrator_panel(Path(folder), turned))
        script = (f'set terminal pngcairo size {430 * len(panels)},430 font "Sans,9"\nset output "{picture}"\n'
                  f'set multiplot layout 1,{len(panels)}\nset grid\nset logscale xy\nset key top right\n'
                  'set format y "%g %%"\n' + "\n".join(panels) + "\n")
        subprocess.run(["gnuplot"], input=script, text=True, check=True)


def panel(folder, problem, measured, runs):
    unit = runs(problem, problem.default).cost.cpu
    plots = []
    for element, form in dict.fromkeys((m.choice.element, m.choice.form) for m, _, _ in measured):
        file = folder / f"{problem.name}-{element}-{form}"
        points = [(made.cost.cpu / unit, 100 * error, enforcement(made.choice)) for made, _, error in measured
                  if (made.choice.element, made.choice.form) == (element, form) and made.done]
        file.write_text("".join(f'{x} {y} "{name}"\n' for x, y, name in points), encoding="utf-8")
        plots.append(f'"{file}" using 1:2 with points pt {5 + 2 * (form == "mixed")} ps 1.2 title "{element}, {form}", '
                     f'"{file}" using 1:2:3 with labels offset 0,0.7 font "Sans,6" notitle')
    return (f'set title "{problem.name}"\nset xlabel "cost, defaults 1"\nset ylabel "error of the force"\n'
            "plot " + ", ".join(plots))


def integrator_panel(folder, turned):
    plots = []
    for name in dict.fromkeys(made.choice.integrator for _, made, _, _ in turned):
        file = folder / f"integrator-{name}"
        file.write_text("".join(f"{parts} {100 * shear}\n" for parts, made, shear, _ in turned
                                if made.choice.integrator == name), encoding="utf-8")
        plots.append(f'"{file}" using 1:2 with linespoints lw 2 title "{name}"')
    return ('set title "rubbing: integrators"\nset xlabel "increments a side"\n'
            'set ylabel "error of the shear force"\nplot ' + ", ".join(plots))
