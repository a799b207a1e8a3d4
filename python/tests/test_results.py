"""What the program has written: summary, history, frames."""

from __future__ import annotations

import builtins
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import billet
from billet import _results


@pytest.fixture
def without(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Lets packages be missing."""

    def hide(*names: str) -> None:
        real = builtins.__import__
        find = _results.importlib.import_module

        def refuse(name: str, *rest: Any, **more: Any) -> Any:
            if name.partition(".")[0] in names:
                raise ImportError(name)
            return real(name, *rest, **more)

        def refuse_module(name: str) -> Any:
            if name.partition(".")[0] in names:
                raise ImportError(name)
            return find(name)

        monkeypatch.setattr(builtins, "__import__", refuse)
        monkeypatch.setattr(_results.importlib, "import_module", refuse_module)

    return hide


def test_the_summary_is_a_dictionary(finished: billet.Results) -> None:
    assert finished.summary["status"] == "done"
    assert finished.summary["tools"]["punch"]["force"][1] > 0
    assert finished.failed_checks == []


def test_history_is_a_data_frame(finished: billet.Results) -> None:
    pandas = pytest.importorskip("pandas")
    assert isinstance(finished.history, pandas.DataFrame)
    assert finished.history["time"].iloc[-1] == 0.5
    assert finished.columns["time"][-1] == 0.5
    assert len(finished.iterations["residual"]) > len(finished.columns["time"])


def test_history_without_pandas_is_a_table(finished: billet.Results, without: Callable[..., None]) -> None:
    without("pandas")
    assert isinstance(finished.history, billet.Table)
    assert finished.history["time"][-1] == 0.5
    with pytest.raises(billet.MissingPackage, match="python3-pandas"):
        finished.columns.to_pandas()


def test_a_column_that_is_not_there_suggests_one(finished: billet.Results) -> None:
    with pytest.raises(KeyError, match="did you mean 'punch.force_y'"):
        finished.columns["punch.forcey"]


def test_frames_hold_every_part(finished: billet.Results) -> None:
    frames = finished.frames
    assert [frame.time for frame in frames] == sorted(frame.time for frame in frames)
    assert frames[0].time == 0 and frames[-1].time == 0.5
    assert set(frames[0].files) == {"workpiece", "contact", "tool-punch"}
    assert finished.frame(0.26).time == pytest.approx(0.25, abs=0.03)
    with pytest.raises(billet.MissingKey, match="known are|did you mean 'tool-punch'"):
        frames[0].arrays("punch")


@pytest.mark.parametrize("hidden", [(), ("vtkmodules",)])
def test_a_frame_as_arrays(
    finished: billet.Results, without: Callable[..., None], hidden: tuple[str, ...], case: billet.Case
) -> None:
    pytest.importorskip("vtkmodules")
    pytest.importorskip("meshio")
    without(*hidden)
    run = billet.Run(case)
    run.finish()
    data = finished.frames[-1].arrays()
    assert data.points.shape == (len(run.positions), 3)
    np.testing.assert_allclose(data.points[:, :2], run.positions, atol=1e-9)
    np.testing.assert_allclose(data.point_data["stress"], run.field("stress"), rtol=1e-7, atol=1e-6)
    assert len(data.cells) == 1
    assert np.array_equal(data.cells[0], run.elements)
    assert data.cell_data["element_quality"].shape == (8,)


def test_a_tool_as_arrays(finished: billet.Results) -> None:
    pytest.importorskip("vtkmodules")
    data = finished.frames[-1].arrays("tool-punch")
    np.testing.assert_allclose(data.points[:, 1], 4.5)
    assert data.cells[0].shape[1] == 2
    contact = finished.frames[-1].arrays("contact")
    assert contact.cell_data["contact_pressure"].max() > 0


def test_a_frame_as_an_object_of_a_package(finished: billet.Results) -> None:
    vtk = pytest.importorskip("vtkmodules.vtkCommonDataModel")
    meshio = pytest.importorskip("meshio")
    frame = finished.frames[-1]
    assert isinstance(frame.dataset(package="vtk"), vtk.vtkUnstructuredGrid)
    assert isinstance(frame.dataset("tool-punch", "vtk"), vtk.vtkPolyData)
    assert isinstance(frame.dataset(package="meshio"), meshio.Mesh)
    assert frame.dataset() is not None
    with pytest.raises(billet.MissingKey, match="known are|did you mean"):
        frame.dataset(package="paraview")


def test_missing_packages_are_named(finished: billet.Results, without: Callable[..., None]) -> None:
    without("vtkmodules", "meshio", "pyvista")
    frame = finished.frames[0]
    with pytest.raises(billet.MissingPackage, match="python3-vtk9.* or meshio"):
        frame.arrays()
    with pytest.raises(ImportError, match="pyvista or vtk"):
        frame.dataset()
    with pytest.raises(billet.MissingPackage, match="vtk .Debian: python3-vtk9.$"):
        frame.arrays("tool-punch")


def test_a_folder_without_results_is_named(tmp_path: Path, finished: billet.Results) -> None:
    with pytest.raises(billet.Error, match="there is no such folder"):
        billet.results(tmp_path / "none")
    with pytest.raises(billet.Error, match="no results of a run"):
        billet.results(tmp_path)
    shutil.copy(finished.folder / "history.csv", tmp_path)
    with pytest.raises(billet.Error, match="going on, or was killed"):
        _ = billet.results(tmp_path).summary
    with pytest.raises(billet.Error, match="no list of frames"):
        _ = billet.results(tmp_path).frames
    (tmp_path / "summary.json").write_text("{")
    with pytest.raises(billet.Error, match="summary.json: is no JSON"):
        _ = billet.results(tmp_path).summary
    (tmp_path / "history.csv").write_text("a,b\n1,x\n")
    with pytest.raises(billet.Error, match="is no table of numbers"):
        _ = billet.results(tmp_path).columns


@pytest.fixture
def damaged(finished: billet.Results, tmp_path: Path) -> billet.Results:
    """A copy of the results, to be damaged."""
    shutil.copytree(finished.folder, tmp_path / "results")
    return billet.results(tmp_path / "results")


def test_a_summary_that_is_none_is_an_error(damaged: billet.Results) -> None:
    for text, what in (("[]", "a JSON object is needed"), ("{}", "says nothing of checks")):
        (damaged.folder / "summary.json").write_text(text)
        with pytest.raises(billet.Error, match=f"summary.json: {what}"):
            _ = billet.results(damaged.folder).failed_checks


@pytest.mark.parametrize(
    "text", ["", "<VTKFile><Coll", '<a><DataSet name="w"/></a>', '<a><DataSet timestep="x"/></a>']
)
def test_a_broken_list_of_frames_is_an_error(damaged: billet.Results, text: str) -> None:
    [file] = damaged.folder.glob("*.pvd")
    file.write_text(text)
    with pytest.raises(billet.Error, match=f"{file.name}: is no list of frames"):
        _ = damaged.frames


def test_a_time_has_a_frame_only_if_there_is_one(damaged: billet.Results, finished: billet.Results) -> None:
    for time in (np.nan, np.inf, -np.inf):
        with pytest.raises(billet.Error, match="allowed is a finite number"):
            finished.frame(time)
    [file] = damaged.folder.glob("*.pvd")
    file.write_text("<VTKFile><Collection/></VTKFile>")
    with pytest.raises(billet.Error, match="the list of frames .* is empty"):
        damaged.frame(0.1)


@pytest.mark.parametrize("part", ["workpiece", "tool-punch"])
@pytest.mark.parametrize("package", ["vtk", "meshio"])
def test_a_frame_that_ends_too_early_is_an_error(
    damaged: billet.Results, part: str, package: str, capfd: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("vtkmodules")
    pytest.importorskip("meshio")
    frame = damaged.frames[-1]
    whole = frame.files[part].read_bytes()
    for kept in (0, 300, len(whole) // 2, len(whole) - 20):
        frame.files[part].write_bytes(whole[:kept])
        with pytest.raises(billet.Error, match="cannot be read as a frame"):
            frame.arrays(part)
        with pytest.raises(billet.Error, match="cannot be read as a frame"):
            frame.dataset(part, package)
    frame.files[part].unlink()
    with pytest.raises(billet.Error, match="No such file"):
        frame.arrays(part)
    assert capfd.readouterr() == ("", "")
