"""What is made by the program: runs with results, studies, charts, coefficients."""

from __future__ import annotations

import copy
import os
import pickle
import signal
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import billet

STUDY = """\
[[vary]]
key    = "tool.punch.friction.m"
values = [0.0, 0.2, 0.4]

[[quantity]]
name = "force"
of   = "punch.force_y"
"""

CHART = """\
[x]
name   = "reduction"
of     = "1 - half_height / 5"
values = [0.04, 0.08]

[[y]]
name = "force"
of   = "punch.force_y"

[[law]]
name       = "tresca"
parameters = [{ name = "m", key = "tool.punch.friction.m", values = [0, 0.1, 0.2, 0.4] }]
"""


@pytest.fixture
def study_file(case_file: Path) -> Path:
    file = case_file.with_name("study.toml")
    file.write_text(STUDY)
    return file


@pytest.fixture(scope="module")
def made_chart(tmp_path_factory: pytest.TempPathFactory) -> billet.Chart:
    from conftest import DISK

    folder = tmp_path_factory.mktemp("chart")
    (folder / "case.toml").write_text(DISK)
    (folder / "chart.toml").write_text(CHART)
    return billet.chart(folder / "chart.toml", folder / "results")


def test_a_case_file_is_run_with_its_results(case_file: Path) -> None:
    results = billet.simulate(case_file, case_file.parent / "r", set={"time.end": 0.1})
    assert results.folder == case_file.parent / "r"
    assert results.summary["time"] == 0.1


def test_a_case_in_memory_is_run_with_its_results(case: billet.Case, tmp_path: Path) -> None:
    case["time.end"] = 0.1
    results = billet.simulate(case, tmp_path / "r", threads=1)
    assert results.summary["status"] == "done"
    assert billet.Case.load(tmp_path / "r.toml")["time.end"] == 0.1
    with pytest.raises(billet.Error, match="needs output"):
        billet.simulate(case)
    for output in ("", ".", "..", "/", tmp_path / ".."):
        with pytest.raises(billet.Error, match="needed is the name of a folder"):
            billet.simulate(case, output)


def test_files_of_others_are_not_written_to(case: billet.Case, tmp_path: Path) -> None:
    case["time.end"] = 0.05
    billet.simulate(case, tmp_path / "new" / "mu0.1", set={"tool.punch.friction.m": 0.1}, threads=1)
    billet.simulate(case, tmp_path / "new" / "mu0.2", set={"tool.punch.friction.m": 0.2}, threads=1)
    for m in (0.1, 0.2):
        assert billet.Case.load(tmp_path / "new" / f"mu{m}.toml")["tool.punch.friction.m"] == m
    again = billet.simulate(case, tmp_path / "new" / "mu0.2", set={"time.end": 0.1}, threads=1)
    assert again.summary["time"] == 0.1
    (tmp_path / "mine.toml").write_text("mine")
    with pytest.raises(billet.Error, match="mine.toml is there already"):
        billet.simulate(case, tmp_path / "mine")
    assert (tmp_path / "mine.toml").read_text() == "mine"
    (tmp_path / "file").touch()
    with pytest.raises(billet.Error, match="file"):
        billet.simulate(case, tmp_path / "file" / "r")


@pytest.mark.parametrize("named", ["die.toml", "../die.toml"])
def test_a_case_with_files_is_run_wherever_its_results_are(
    case_file: Path, tmp_path: Path, named: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "cases"
    folder.mkdir()
    (folder / named).write_text("points = [[0, 5], [20, 5]]\n")
    plane = "plane = { point = [0, 5], normal = [0, -1] }"
    text = case_file.read_text().replace(plane, f'profile = "{named}"')
    (folder / "disk.toml").write_text(text)
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path)
    outside = named.startswith("..")
    case = billet.Case.load("cases/disk.toml", {"time.end": 0.05}, allow_outside=outside)
    for output in ("elsewhere/disk", "elsewhere/other", "elsewhere/deep/disk", "elsewhere/disk"):
        results = billet.simulate(case, output, threads=1)
        assert results.folder == Path(output) and results.summary["time"] == 0.05
    assert (folder / "disk.toml").read_text() == text
    written = {file.name for file in folder.glob("*.toml")} - {"die.toml"}
    assert written == {"disk.toml", "disk-2.toml", "disk-3.toml", "other.toml"}
    file = billet.simulate("cases/disk.toml", "r", threads=1, allow_outside=outside)
    assert file.summary["status"] == "done"
    if outside:
        with pytest.raises(billet.ProgramError, match="outside the folder"):
            billet.simulate("cases/disk.toml", "r", threads=1)


def test_what_the_program_refuses_is_an_error_with_its_text(case_file: Path) -> None:
    with pytest.raises(billet.ProgramError, match="time.end: found -1") as error:
        billet.simulate(case_file, case_file.parent / "r", set={"time.end": -1})
    assert error.value.status == 3
    assert not str(error.value).startswith("billet: ")


def test_a_program_that_is_not_there_is_named(monkeypatch: pytest.MonkeyPatch, case_file: Path) -> None:
    monkeypatch.setenv("BILLET_PROGRAM", "/nowhere/billet")
    with pytest.raises(billet.Error, match="BILLET_PROGRAM names /nowhere/billet"):
        billet.simulate(case_file)


def test_a_study_has_values_by_run(study_file: Path) -> None:
    study = billet.study(study_file, study_file.parent / "r", processes=1)
    assert len(study.rows) == 3
    assert np.all(np.diff(study.values("force")) > 0)
    assert (study.folder / "study.csv").exists()
    assert all(billet.results(Path(row["folder"]) / "results").columns["time"][-1] == 0.5 for row in study.rows)
    with pytest.raises(billet.MissingKey, match="did you mean 'force'"):
        study.values("forces")
    again = time.perf_counter()
    billet.study(study_file, study_file.parent / "r")
    assert time.perf_counter() - again < 5  # nothing is run again


def test_a_broken_study_has_the_programs_text(study_file: Path) -> None:
    study_file.write_text(STUDY.replace("punch.force_y", "punsh.force_y").replace("key ", "kay "))
    with pytest.raises(billet.ProgramError, match="study.toml:2"):
        billet.study(study_file, study_file.parent / "r")


def test_ctrl_c_ends_a_study_that_goes_on_later(study_file: Path) -> None:
    slow = {"set": {"time.increments.max": 0.0005, "workpiece.mesh.cells": [10, 5]}}
    begun = time.perf_counter()
    threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        billet.study(study_file, study_file.parent / "r", set=slow, processes=1)
    assert time.perf_counter() - begun < 20
    assert (study_file.parent / "r" / "runs").is_dir()


def test_a_chart_has_its_values(made_chart: billet.Chart) -> None:
    assert (made_chart.laws, made_chart.quantities) == (["tresca"], ["force"])
    force = made_chart.quantity("force")
    assert force.values.shape == (4, 2) and force.model_error.shape == (4, 2)
    assert list(force.parameters["m"]) == [0, 0.1, 0.2, 0.4]
    assert list(force.x) == [0.04, 0.08]
    assert np.all(np.diff(force.values, axis=0) > 0)
    with pytest.raises(billet.MissingKey, match="did you mean 'tresca'"):
        made_chart.quantity("force", "treska")


def test_a_coefficient_comes_back_from_a_chart(made_chart: billet.Chart) -> None:
    force = made_chart.quantity("force")
    measured = {"reduction": force.x, "force": force.values[2], "force_standard": [50.0, 50.0]}
    found = billet.identify(made_chart, measured)
    assert found["m"].value == pytest.approx(0.2, abs=2e-3)
    assert found["m"].low < 0.2 < found["m"].high
    assert found.likeliest == "tresca"
    assert "tresca: m = " in str(found)
    pandas = pytest.importorskip("pandas")
    assert billet.identify(made_chart.folder, pandas.DataFrame(measured)) == found


def test_measurements_that_do_not_fit_the_chart_are_refused(made_chart: billet.Chart, tmp_path: Path) -> None:
    with pytest.raises(billet.ProgramError, match="reduction"):
        billet.identify(made_chart, {"reduktion": [0.04], "force": [1e5]})
    with pytest.raises(billet.Error, match="differ in length: reduction 1, force 2"):
        billet.identify(made_chart, {"reduction": [0.04], "force": [1e5, 2e5]})
    with pytest.raises(billet.Error, match="the column force is not of numbers"):
        billet.identify(made_chart, {"reduction": [0.04], "force": ["much"]})
    with pytest.raises(billet.ProgramError, match="^measurements"):
        billet.identify(made_chart, {"reduction": [0.04, 0.08], "farce": [1e5, 2e5]})
    with pytest.raises(billet.ProgramError, match="none.csv"):
        billet.identify(made_chart, tmp_path / "none.csv")
    with pytest.raises(billet.Error, match="chart.json"):
        billet.Chart(tmp_path)
    for text, what in (("[]", "a JSON object is needed"), ("{}", "has no 'laws'")):
        (tmp_path / "chart.json").write_text(text)
        with pytest.raises(billet.Error, match=f"chart.json: {what}"):
            billet.Chart(tmp_path)


def test_an_error_of_the_program_goes_between_processes() -> None:
    error = billet.ProgramError("why", 3)
    for again in (pickle.loads(pickle.dumps(error)), copy.copy(error)):
        assert (str(again), again.status) == ("why", 3)


@pytest.mark.parametrize("name", [b"r\xe9s", "a\nb", "-r", "~/r"])
def test_results_go_to_folders_of_any_name(
    case_file: Path, tmp_path: Path, name: str | bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    case = billet.Case.load(case_file, {"time.end": 0.05})
    assert billet.simulate(case, os.fsdecode(name), threads=1).summary["status"] == "done"
    assert not (tmp_path / "~").exists()
    assert (tmp_path / "home" / "r").exists() == (name == "~/r")


def test_a_signal_whose_handler_raises_ends_the_run(case_file: Path, tmp_path: Path) -> None:
    def leave(number: int, frame: object) -> None:
        raise SystemExit

    before = signal.signal(signal.SIGALRM, leave)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.5)
        begun = time.monotonic()
        with pytest.raises(SystemExit):
            changes = {"time.increments.max": 1e-4}  # long enough to be ended
            billet.simulate(case_file, tmp_path / "r", set=changes, threads=1)
        assert time.monotonic() - begun < 10.0
    finally:
        signal.signal(signal.SIGALRM, before)


def test_runs_that_a_queue_makes_are_left(study_file: Path) -> None:
    with pytest.raises(billet.Error, match=r"commands\.txt is one, then call billet\.study again"):
        billet.study(study_file, study_file.parent / "queue", set={"run.engine": "commands"})


def test_changes_are_a_dictionary(case_file: Path) -> None:
    with pytest.raises(billet.Error, match="changes are a dictionary"):
        billet.Case.load(case_file, [("time.end", 1.0)])  # type: ignore[arg-type]
