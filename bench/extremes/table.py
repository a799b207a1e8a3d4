"""The verdicts as tables: text or Markdown."""

import math

from matrix import AXES, levels
from scenes import SCENES


def accepted(judged):
    return all(passed for _, passed in criteria(judged))


def criteria(judged):
    """Sentences with their figures, and whether they hold."""
    wrong = [r for r in judged if r.verdict == "WRONG"]
    stiff = [r for r in judged if r.setting.penalty >= 100.0 and r.setting.increments == 1.0 and r.done
             and not math.isnan(r.deviation)]
    worst = max(stiff, key=lambda r: r.deviation, default=None)
    usual = [r for r in judged if usual_setting(r.setting)]
    converged = sum(r.converged for r in usual)
    share = converged / max(1, len(usual))
    agreement = [(f"forces at the default penalty and above, largest deviation: {100 * worst.deviation:.2f} % "
                  f"({worst.setting})", worst.deviation <= 0.01)] if worst else []
    return [
        (f"wrong: {len(wrong)} of {len(judged)}", not wrong),
        *agreement,
        (f"converged at mu <= 1 or another law and poisson <= 0.499: {converged} of {len(usual)}, "
         f"{100 * share:.1f} %", share >= 0.99),
    ]


def usual_setting(setting):
    return setting.friction != "mu 10" and setting.poisson <= 0.499


HEAD = ["axis", "level", "runs", "right", "refused", "wrong", "largest deviation", "median", "cost", "cut-backs"]


def rows(judged, runs):
    table = []
    for axis in ("scene", *AXES):
        for level in list(SCENES) if axis == "scene" else levels(axis, "block hex8"):
            table.append(row(axis, level, [r for r in judged if getattr(r.setting, axis) == level], runs))
    table.append(row("all", "", judged, runs))
    return table


def row(axis, level, some, runs):
    stiff = sorted(r.deviation for r in some if r.setting.penalty >= 100.0 and not math.isnan(r.deviation))
    costs = [r.iterations / runs(r.setting.reference()).iterations for r in some
             if r.done and runs(r.setting.reference()).done]
    count = {verdict: sum(r.verdict == verdict for r in some) for verdict in ("right", "refused", "WRONG")}
    return [axis, f"{level:g}" if isinstance(level, float) else level, str(len(some)), *map(str, count.values()),
            percent(stiff[-1]) if stiff else "-", percent(stiff[len(stiff) // 2]) if stiff else "-",
            f"{sum(costs) / len(costs):.2f}" if costs else "-", str(sum(r.cutbacks for r in some))]


def percent(value):
    return f"{100 * value:.2g} %"


SERIES = ("penalty", "friction", "increments", "poisson")


def series(runs, made):
    """Forces one axis at a time, of those that were run: the columns are scenes."""
    table = []
    for friction in ("mu 0.1", "mu 1"):
        for axis in SERIES:
            if axis == "friction" and friction == "mu 0.1":
                continue
            for level in levels(axis, "block hex8"):
                table.append([axis, f"{level:g}" if isinstance(level, float) else level,
                              "" if axis == "friction" else friction,
                              *(cell(made, scene, friction, axis, level) for scene in SCENES)])
    return table


def cell(made, scene, friction, axis, level):
    from matrix import changed
    from scenes import Setting
    found = made.get(changed(Setting(scene, friction), axis, level))
    if found is None:
        return ""
    if not found.done:
        return found.verdict
    force = math.sqrt(sum(f * f for f in found.force))
    return f"{force:.5g}" + ("" if math.isnan(found.deviation) else f" ({percent(found.deviation)})")


def aligned(table):
    widths = [max(len(line[i]) for line in table) for i in range(len(table[0]))]
    return "\n".join("  ".join(c.ljust(w) for c, w in zip(line, widths)).rstrip() for line in table)


def marks(judged):
    return [f"{'ok ' if passed else 'NOT'}  {text}" for text, passed in criteria(judged)]


def text(judged, runs):
    return "\n\n".join((aligned([HEAD] + rows(judged, runs)),
                        aligned([["axis", "level", "friction", *SCENES]] + series(runs, runs.made)),
                        "\n".join(marks(judged))))


def pipes(head, table):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head),
            *("| " + " | ".join(line) + " |" for line in table)]


def markdown(judged, runs, machine, options):
    lines = ["# Measured", "",
             f"Written by `./dev bench extremes --markdown bench/extremes/results.md`; {options.samples} samples, "
             f"seed {options.seed}. [README](README.md) says what the columns are.", ""]
    lines += pipes(["", ""], [[key, value] for key, value in machine.items()])
    lines += ["", *(f"- {'holds' if passed else '**does not hold**'}: {text}"
                    for text, passed in criteria(judged)), ""]
    lines += pipes(HEAD, rows(judged, runs))
    lines += ["", "One axis at a time: mean force [N, in the plane N/mm] after six tenths of the way, in brackets the",
              "deviation from the reference.", ""]
    lines += pipes(["axis", "level", "friction", *SCENES], series(runs, runs.made))
    others = [r for r in judged if r.verdict != "right"]
    if others:
        lines += ["", "Not right:", ""] + pipes(["setting", "verdict", "reason"],
                                                [[str(r.setting), r.verdict, r.reason] for r in others])
    return "\n".join(lines) + "\n"
