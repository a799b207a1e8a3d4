"""docs/trade.md and its picture from the figures."""

import math
import re
import subprocess
import tempfile
from pathlib import Path

HEAD = ["element", "form", "method", "change by softness", "error", "deepest contact point", "deepest point",
        "increments", "iterations", "cut-backs", "cost"]
PATHS = ["increments a side", "integrator", "error of the shear", "error of the force", "iterations", "cost"]
BEGIN, END = "<!-- measured: {} -->", "<!-- end of {} -->"


def percent(value):
    return "-" if math.isnan(value) else f"{100 * value:.2g} %"


def method(choice):
    name = f"penalty {choice.penalty:g}" if choice.method == "penalty" else "augmented"
    return name + (", limit h/1000" if choice.limit else "")


def rows(problem, measured, runs):
    unit = runs(problem, problem.default).cost.cpu
    table = []
    for made, softness, error in measured:
        c = made.choice
        table.append([c.element, c.form, method(c), percent(softness), percent(error), percent(made.depth),
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
    draw(path, [problem.name for problem in enforced])


def replaced(page, name, content):
    begin, end = BEGIN.format(name), END.format(name)
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if not pattern.search(page):
        raise SystemExit(f"the page has no place for {name}: {begin}")
    return pattern.sub(lambda _: f"{begin}\n{content}\n{end}", page)


def table(page, name):
    """Rows of the table between the marks of `name`, as dictionaries."""
    begin = page.index(BEGIN.format(name))
    lines = [line for line in page[begin:page.index(END.format(name))].splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return [dict(zip(cells[0], row)) for row in cells[2:]]


def number(text):
    return float(text.split()[0]) if text[0].isdigit() else math.nan


def draw(path, problems):
    """Draws the tables of the page: softness and iterations by penalty, integrators by increments and cost."""
    page = path.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        sweeps = {name: sweep_files(Path(folder), name, table(page, name)) for name in problems}
        turns = turn_files(Path(folder), table(page, "integrators"))
        soft = [lines(f"{name}", "penalty", "change of the force by softness [%]", files, "1:2")
                for name, files in sweeps.items()]
        work = [lines(f"{name}", "penalty", "iterations", files, "1:3") for name, files in sweeps.items()]
        soft.append(lines("integrators", "increments a side", "error of the shear [%]", turns, "1:2"))
        work.append(lines("integrators", "iterations", "error of the shear [%]", turns, "3:2"))
        script = (f'set terminal pngcairo size {400 * len(soft)},760 font "Sans,9"\n'
                  f'set output "{path.with_suffix(".png")}"\nset multiplot layout 2,{len(soft)}\nset grid\n'
                  'set logscale xy\nset format x "%g"\nset format y "%g"\n' + "\n".join(soft + work) + "\n")
        subprocess.run(["gnuplot"], input=script, text=True, check=True)


def sweep_files(folder, name, rows):
    files = {}
    for element, form in dict.fromkeys((row["element"], row["form"]) for row in rows):
        file = folder / f"{name}-{element}-{form}"
        points = [(row["method"].split()[1], number(row["change by softness"]), row["iterations"])
                  for row in rows if (row["element"], row["form"]) == (element, form)
                  and row["method"].startswith("penalty") and "limit" not in row["method"]]
        # what is compared with has no change: nothing to draw on a logarithmic axis
        file.write_text("".join(f"{x} {y if y > 0 else 'NaN'} {z}\n" for x, y, z in points), encoding="utf-8")
        files[f"{element}, {form}" if element[-1] in "80" and element != "hex8" else element] = file
    return files


def turn_files(folder, rows):
    files = {}
    for name in dict.fromkeys(row["integrator"] for row in rows):
        files[name] = folder / f"integrator-{name}"
        files[name].write_text("".join(
            f"{row['increments a side']} {number(row['error of the shear'])} {row['iterations']}\n"
            for row in rows if row["integrator"] == name), encoding="utf-8")
    return files


def lines(title, x, y, files, columns):
    plots = [f'"{file}" using {columns} with linespoints lw 2 pt {4 + 2 * i} ps 1.3 title "{name}"'
             for i, (name, file) in enumerate(files.items())]
    return f'set title "{title}"\nset xlabel "{x}"\nset ylabel "{y}"\nplot ' + ", ".join(plots)
