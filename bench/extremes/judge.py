"""Runs a setting and judges what came of it."""

import csv
import json
import math
import sys
from dataclasses import dataclass, replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "peers"))
import timed
from matrix import INCREMENTS
from scenes import SCENES, UNITS, case

TYPED = range(2, 9)                # statuses that name a cause; 70 and signals are failures of the program
FAILED_CHECKS = 8                  # the run has come to its end
LATE = 0.6                         # forces are means over the run after this share of it
AGREEMENT = 0.01                   # with the reference, increments of the same length
OTHER_INCREMENTS = 0.05            # a run in one increment, or in a hundred times as many
SAME_IN_UNITS = 1e-5               # penalty 1e6 turns rounding into that; of the strip AGREEMENT: see README
SAME_BITS = 1e-13                  # lengths times a power of two: not even rounding differs
BALANCE = 0.05                     # energy that may be missing
SHORTER = (1.0, 0.5, 0.25, 0.125) # increments of the reference where they decide what metal that lets go does
SOFT = 1.05                        # a soft tool presses no harder than a hard one, to this
SOFT_LONG = 1.15                   # the same where a roll takes its whole way in a few increments


@dataclass
class Run:
    setting: object
    cost: timed.Cost
    message: str
    force: tuple = ()              # mean over the late part, in N and mm [N or N/mm]
    balance: float = math.nan
    increments: int = 0
    iterations: int = 0
    cutbacks: int = 0
    flaw: str = ""                 # what must not be, whatever the reference says
    verdict: str = ""              # right, refused, WRONG
    reason: str = ""
    deviation: float = math.nan    # from the reference, or from the range of references: see README

    @property
    def done(self):
        return self.cost.status == 0 and not self.flaw

    @property
    def converged(self):
        """Has come to its end, be it with a result that its own checks refuse."""
        return self.cost.status in (0, FAILED_CHECKS) and not self.flaw


def run(setting, program, timeout, folder, again):
    """again: takes what an earlier run of the same case left there."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "case.toml").write_text(case(setting), encoding="utf-8")
    command = [str(program), "run", "case.toml", "-o", "results", "--threads", "1", "--quiet"]
    cost = (earlier(folder / "results") if again
            else timed.run(command, folder, folder / "billet.log", timeout))
    made = Run(setting, cost, message(folder / "billet.log"))
    made.flaw = flaw_of_ending(cost, made.message)
    if cost.status == 0 and not made.flaw:
        read(made, folder / "results")
    return made


def earlier(results):
    """How an earlier run ended; its times are gone."""
    ended = results / "summary.json"
    if not ended.exists():
        return timed.Cost(math.nan, math.nan, math.nan, -9, True)
    status = json.loads(ended.read_text(encoding="utf-8"))["exit_status"]
    return timed.Cost(math.nan, math.nan, math.nan, status, False)


def message(log):
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
    said = [line for line in lines if line.startswith(("billet:", "failed check"))]
    return said[0] if said else next((line for line in reversed(lines) if "not" in line), "")


def flaw_of_ending(cost, said):
    if cost.timed_out:
        return "did not end in time"
    if cost.status < 0:
        return f"killed by signal {-cost.status}"
    if cost.status != 0 and (cost.status not in TYPED or not said):
        return f"status {cost.status} without a name: {said}"
    return ""


def read(made, results):
    """Figures of a run that reached its end."""
    with open(results / "history.csv", encoding="utf-8") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    if not all(math.isfinite(value) for row in rows for value in row.values()):
        made.flaw = "a figure of the history is not a number"
        return
    scene, units = SCENES[made.setting.scene], UNITS[made.setting.units]
    summary = json.loads((results / "summary.json").read_text(encoding="utf-8"))
    end = scene.end_of(made.setting)
    if abs(rows[-1]["time"] - end) > 1e-9 * end:
        made.flaw = f"status 0 at time {rows[-1]['time']:g} of {end:g}"
    made.force = tuple(figure(rows, f"die.force_{axis}", end, scene) / scene.force_factor(units)
                       for axis in "xyz")
    made.balance = summary["energy"]["relative_error"]
    made.increments, made.iterations = summary["increments"], summary["iterations"]
    made.cutbacks = summary["cutbacks"]


def figure(rows, column, end, scene):
    """The last force; its late mean where faces come and go."""
    return late_mean(rows, column, end) if scene.passes else rows[-1][column]


def late_mean(rows, column, end):
    """Mean over time after LATE of the run; linear between increments, from zero at the start."""
    points = [(0.0, 0.0)] + [(row["time"], row[column]) for row in rows]
    start, total = LATE * end, 0.0
    for (t0, y0), (t1, y1) in zip(points, points[1:]):
        if t1 > start:
            a = max(t0, start)
            ya = y0 + (y1 - y0) * (a - t0) / (t1 - t0)
            total += 0.5 * (ya + y1) * (t1 - a)
    return total / (end - start)


def norm(force):
    return math.sqrt(sum(f * f for f in force))


def deviation(made, other):
    return norm([a - b for a, b in zip(made.force, other.force)]) / norm(other.force)


def scatter(made, runs):
    """From the range in which the forces of the reference lie with increments ×1, ×½, ×¼ and ×⅛."""
    reference = made.setting.reference()
    finer = [run for run in (runs(replace(reference, increments=factor)) for factor in SHORTER) if run.done]
    beyond = [max(min(forces) - own, 0.0, own - max(forces))
              for own, forces in zip(made.force, zip(*(run.force for run in finer)))]
    return norm(beyond) / norm(runs(reference).force)


def judge(made, runs):
    """Sets the verdict; `runs` makes a run of a setting."""
    reference = runs(made.setting.reference())
    made.reason = made.flaw
    if made.done and reference.done:
        lets_go = made.setting.lets_go() and made.setting.increments <= 1.0
        made.deviation = scatter(made, runs) if lets_go else deviation(made, reference)
        made.reason = fault(made, reference, runs)
    if made.reason:
        made.verdict = "WRONG"
    elif made.cost.status != 0:
        made.verdict, made.reason = "refused", made.message
    else:
        made.verdict = "right"
        if not reference.done:
            made.reason = "reference refused"


def fault(made, reference, runs):
    setting = made.setting
    if setting.increments <= 1.0 and made.balance > BALANCE:  # work of one long step is not known well
        return f"energy balance off by {made.balance:.2g}"
    if setting.units != "x1":
        if complaint := other_units(made, runs(replace(setting, units="x1"))):
            return complaint
    if setting.penalty < 100.0:
        hard = runs(replace(setting, penalty=100.0))
        share = norm(made.force) / norm(hard.force) if hard.done else 0.0
        allowed = SOFT if setting.increments <= 1.0 else SOFT_LONG
        return "" if share < allowed else f"soft tool, but {share:.3f} of the force on a hard one"
    allowed = AGREEMENT if setting.increments == 1.0 else OTHER_INCREMENTS
    return "" if made.deviation < allowed else f"{100 * made.deviation:.2g} % off the reference"


def other_units(made, twin):
    if not twin.done:
        return ""
    allowed = AGREEMENT
    if made.setting.units == "x2^20":
        allowed = SAME_BITS
    elif made.increments != twin.increments and made.setting.increments > 1.0:
        allowed = OTHER_INCREMENTS
    elif not SCENES[made.setting.scene].passes and made.setting.increments <= 1.0:
        allowed = SAME_IN_UNITS
    off = deviation(made, twin)
    return "" if off <= allowed else f"other units, {off:.2g} off"
