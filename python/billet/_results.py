"""Results that the program has written: summary, history, frames."""

from __future__ import annotations

import importlib
import math
import xml.etree.ElementTree as xml
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from ._arrays import Floats, Integers, Values
from ._errors import Error, MissingKey, MissingPackage
from ._program import FilePath, expanded
from ._studies import read_json
from ._table import Table, no_such, read_csv

T = TypeVar("T")


@dataclass(frozen=True)
class FrameData:
    """A part at one time, as NumPy arrays."""

    points: Floats
    """current places, shape (n_points, 3) [mm]"""
    cells: list[Integers]
    """for each kind of cell in turn its cells' points, shape (n_cells, points of a cell)"""
    point_data: dict[str, Values]
    """fields at points, shape (n_points,) or (n_points, components)"""
    cell_data: dict[str, Values]
    """fields of cells, in the order of cells, shape (n_cells,) or (n_cells, components)"""


class Frame:
    """What was written at one time: a file for each part.

    time    [s]
    files   by part: "workpiece", "contact", "tool-NAME"
    """

    def __init__(self, time: float, files: dict[str, Path]) -> None:
        self.time = time
        self.files = files

    def dataset(self, part: str = "workpiece", package: str | None = None) -> Any:
        """A part as an object of a package that draws or analyses it.

        package   "pyvista" (a pyvista.DataSet), "vtk" (a vtkUnstructuredGrid or vtkPolyData) or
                  "meshio" (a meshio.Mesh, of the workpiece); by default the first that is installed

        Raises billet.MissingPackage, which names what to install; billet.MissingKey for no part;
        billet.Error for a file that cannot be read.
        """
        file = self._file(part)
        if package is not None and package not in _READERS:
            raise MissingKey(no_such("package", package, list(_READERS)))
        return _read(_READERS, [package] if package else _able(file), file)

    def arrays(self, part: str = "workpiece") -> FrameData:
        """A part as NumPy arrays, read by vtk, or by meshio.

        Raises billet.MissingPackage without both; billet.MissingKey for no part; billet.Error for a
        file that cannot be read.
        """
        file = self._file(part)
        return _read(_ARRAYS, [name for name in _able(file) if name in _ARRAYS], file)

    def _file(self, part: str) -> Path:
        if part not in self.files:
            raise MissingKey(no_such("part", part, list(self.files)))
        return self.files[part]

    def __repr__(self) -> str:
        return f"<frame at time {self.time:.6g}: {', '.join(self.files)}>"


class Results:
    """The results of a run.

    folder   that they are in; docs/guide/results.md says what each file holds
    """

    def __init__(self, folder: FilePath) -> None:
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise Error(f"{self.folder}: there is no such folder")
        if not (self.folder / "history.csv").exists():
            raise Error(f"{self.folder}: no results of a run: there is no history.csv")

    @cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json. Raises billet.Error while the run is going on, or if it was killed."""
        file = self.folder / "summary.json"
        if not file.exists():
            raise Error(f"{file}: is not there: the run is going on, or was killed")
        return read_json(file)

    @property
    def failed_checks(self) -> list[str]:
        """What the result fails of the checks; empty: it can be used."""
        try:
            return [f"{each['check']}: {each['what']}" for each in self.summary["failed_checks"]]
        except (KeyError, TypeError):
            raise Error(f"{self.folder / 'summary.json'}: says nothing of checks") from None

    @cached_property
    def columns(self) -> Table:
        """history.csv: columns by name, each an array of shape (n_increments,)."""
        return read_csv(self.folder / "history.csv")

    @property
    def history(self) -> Any:
        """history.csv as a pandas.DataFrame if pandas is installed, else as `columns`."""
        try:
            return self.columns.to_pandas()
        except MissingPackage:
            return self.columns

    @cached_property
    def iterations(self) -> Table:
        """iterations.csv: columns by name, one row per iteration of Newton's method."""
        return read_csv(self.folder / "iterations.csv")

    @cached_property
    def frames(self) -> list[Frame]:
        """The frames, the earliest first. Raises billet.Error without a list that can be read."""
        lists = sorted(self.folder.glob("*.pvd"))
        if not lists:
            raise Error(f"{self.folder}: there is no list of frames (.pvd)")
        frames: list[Frame] = []
        for item in _datasets(lists[0]):
            time, part = float(item.get("timestep", "")), item.get("name", "")
            # Where a new mesh is made there are two frames of the same time.
            if not frames or frames[-1].time != time or part in frames[-1].files:
                frames.append(Frame(time, {}))
            frames[-1].files[part] = self.folder / item.get("file", "")
        return frames

    def frame(self, time: float) -> Frame:
        """The frame nearest to a time [s]; of two at a new mesh the later one.

        Raises billet.Error without frames, and for nan and infinity.
        """
        if not math.isfinite(time):
            raise Error(f"time is {time}; allowed is a finite number")
        if not self.frames:
            raise Error(f"{self.folder}: the list of frames (.pvd) is empty")
        return min(reversed(self.frames), key=lambda frame: abs(frame.time - time))

    def __repr__(self) -> str:
        return f"<results in {self.folder}>"


def results(folder: FilePath) -> Results:
    """The results of a run, by its folder. Raises billet.Error if there are none."""
    return Results(expanded(folder))


# --- readers of frames --------------------------------------------------------------------------

def _datasets(file: Path) -> list[xml.Element]:
    """What a list of frames holds, with a time each. Raises billet.Error."""
    try:
        items = list(xml.parse(file).getroot().iter("DataSet"))
        for item in items:
            float(item.get("timestep", ""))
        return items
    except OSError as error:
        raise Error(f"{file}: {error.strerror}") from None
    except (xml.ParseError, ValueError) as error:
        raise Error(f"{file}: is no list of frames: {error}") from None


def _read(readers: dict[str, Callable[[Path], T]], packages: list[str], file: Path) -> T:
    """By the first of some packages that is installed. Raises billet.Error, billet.MissingPackage."""
    try:
        with file.open("rb"):
            pass
    except OSError as error:
        raise Error(f"{file}: {error.strerror}") from None
    for name in packages:
        try:
            return readers[name](file)
        except ImportError:
            continue
        except Error:
            raise
        except Exception as error:
            what = str(error) or type(error).__name__
            raise Error(f"{file}: cannot be read as a frame: {what}") from error
    raise _missing(packages, file)


_DEBIAN = {"vtk": "python3-vtk9", "meshio": "python3-meshio"}


def _able(file: Path) -> list[str]:
    """Packages that read a file: meshio knows no surfaces."""
    return [name for name in _READERS if name != "meshio" or file.suffix == ".vtu"]


def _missing(packages: list[str], file: Path) -> MissingPackage:
    named = (f"{name} (Debian: {_DEBIAN[name]})" if name in _DEBIAN else name for name in packages)
    return MissingPackage(f"{file.name}: to read frames install " + " or ".join(named))


def _by_pyvista(file: Path) -> Any:
    return importlib.import_module("pyvista").read(file)


def _by_meshio(file: Path) -> Any:
    return importlib.import_module("meshio.vtu").read(file)  # meshio.read ends Python at an error


def _by_vtk(file: Path) -> Any:
    readers = importlib.import_module("vtkmodules.vtkIOXML")
    kind = "UnstructuredGrid" if file.suffix == ".vtu" else "PolyData"
    reader = getattr(readers, f"vtkXML{kind}Reader")()
    reader.SetFileName(str(file))
    shows = reader.GetGlobalWarningDisplay()
    reader.SetGlobalWarningDisplay(0)  # VTK writes of errors to the terminal
    try:
        reader.Update()
    finally:
        reader.SetGlobalWarningDisplay(shows)
    if reader.GetErrorCode() or reader.GetOutput().GetPoints() is None:
        raise Error(f"{file}: cannot be read as a frame: it is damaged, or ends too early")
    return reader.GetOutput()


def _arrays_by_vtk(file: Path) -> FrameData:
    as_array = importlib.import_module("vtkmodules.util.numpy_support").vtk_to_numpy
    data = _by_vtk(file)

    def fields(of: Any) -> dict[str, Values]:
        arrays = (of.GetArray(i) for i in range(of.GetNumberOfArrays()))
        return {array.GetName(): as_array(array).copy() for array in arrays}

    groups = [data.GetCells()] if file.suffix == ".vtu" else [data.GetLines(), data.GetPolys()]
    cells: list[Integers] = []
    for group in groups:
        cells += _by_size(as_array(group.GetConnectivityArray()), as_array(group.GetOffsetsArray()))
    points = as_array(data.GetPoints().GetData()).copy()
    return FrameData(points, cells, fields(data.GetPointData()), fields(data.GetCellData()))


def _by_size(connectivity: Integers, offsets: Integers) -> list[Integers]:
    """Cells that follow each other with as many points each, as one array."""
    sizes = np.diff(offsets)
    if len(sizes) == 0:
        return []
    starts = np.flatnonzero(np.diff(sizes, prepend=-1))
    groups = zip(starts, [*starts[1:], len(sizes)])
    return [
        connectivity[offsets[first] : offsets[end]].reshape(end - first, sizes[first]).copy()
        for first, end in groups
    ]


def _arrays_by_meshio(file: Path) -> FrameData:
    mesh = _by_meshio(file)
    cell_data = {name: np.concatenate(values) for name, values in mesh.cell_data.items()}
    return FrameData(
        mesh.points, [block.data for block in mesh.cells], dict(mesh.point_data), cell_data
    )


_READERS: dict[str, Callable[[Path], Any]] = {
    "pyvista": _by_pyvista,
    "vtk": _by_vtk,
    "meshio": _by_meshio,
}
_ARRAYS: dict[str, Callable[[Path], FrameData]] = {
    "vtk": _arrays_by_vtk,
    "meshio": _arrays_by_meshio,
}
