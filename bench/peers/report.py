"""What the runs of one model have in common and where they differ: text or Markdown."""

STATIONS = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6)


def force_at(curve, reduction):
    """Force at a reduction, linear between increments; None beyond the end of the run."""
    for (r0, f0), (r1, f1) in zip(curve, curve[1:]):
        if r0 <= reduction <= r1 + 1e-9 and r1 > r0:
            return f0 + (f1 - f0) * (reduction - r0) / (r1 - r0)
    return None


def reached(run):
    return run["curve"][-1][0] if run["curve"] else 0.0


def outcome(run):
    """How far it came: '60.0 %' or 'stopped at 35.1 % after 9.2 s: why'."""
    if run["status"] == 0 and reached(run) > STATIONS[-1] - 1e-6:
        return percent(reached(run))
    why = "time limit" if run["timed_out"] else run["message"] or f"status {run['status']}"
    return f"stopped at {percent(reached(run))} after {run['wall']:.0f} s: {why[:70]}"


def percent(share):
    return f"{100 * share:.1f} %"


def force(run, reduction):
    value = force_at(run["curve"], reduction)
    return "-" if value is None else f"{value:.1f}"


def difference(first, second, reduction):
    a, b = force_at(first["curve"], reduction), force_at(second["curve"], reduction)
    return "-" if a is None or b is None else f"{100 * (b / a - 1):+.1f} %"


def rows(result):
    """One row a run, billet's the last; under each of the peer's how billet compares with it."""
    runs = result["runs"]
    ours = next((run for run in runs if is_billet(run)), None)
    table = []
    for run in runs:
        table.append([result["model"], result["friction"], f"{run['program']} {run['element']}",
                      f"{run['residual']:g}", f"{run['cpu']:.2f}", f"{run['wall']:.2f}",
                      f"{run['memory']:.0f}", str(run["increments"]), str(run["iterations"]),
                      f"{run['iterations'] / max(1, run['increments']):.1f}",
                      *[force(run, s) for s in STATIONS], outcome(run)])
        if ours is not None and run is not ours:
            table.append(differences(run, ours))
    return table


def is_billet(run):
    return run["program"].startswith("billet")


def differences(peer, ours):
    """Cost of the peer over ours; our forces against the peer's."""
    def ratio(key):
        return f"{peer[key] / ours[key]:.2f} x" if ours[key] else "-"

    same = abs(reached(peer) - reached(ours)) < 1e-3
    return ["", "", "  over billet", "", ratio("cpu"), ratio("wall"), ratio("memory"),
            ratio("increments"), ratio("iterations"), "",
            *[difference(peer, ours, s) for s in STATIONS], "" if same else "ends differ"]


HEAD = ["model", "friction", "program", "residual", "CPU s", "wall s", "MB", "increments", "iterations",
        "per increment", *[f"kN at {100 * s:.0f} %" for s in STATIONS], "reached"]


def text(results):
    table = [HEAD] + [row for result in results for row in rows(result)]
    widths = [max(len(row[i]) for row in table) for i in range(len(HEAD))]
    return "\n".join("  ".join(cell.ljust(w) for cell, w in zip(row, widths)).rstrip()
                     for row in table)


def markdown(results, machine):
    lines = ["# Measured", "", "Written by `bench/peers/compare --markdown`.", "", "| | |", "|---|---|"]
    lines += [f"| {key} | {value} |" for key, value in machine.items()]
    lines += ["", "| " + " | ".join(HEAD) + " |", "|" + "---|" * len(HEAD)]
    lines += ["| " + " | ".join(row) + " |" for result in results for row in rows(result)]
    return "\n".join(lines) + "\n"
