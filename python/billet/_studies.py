"""Studies and charts: matrices of runs, made by the program."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ._arrays import Floats
from ._errors import Error, MissingKey
from ._program import RUNS_ARE_LEFT, FilePath, as_operand, folder_of, options, run_program
from ._table import no_such


def read_json(file: Path, *needed: str) -> dict[str, Any]:
    """Raises billet.Error for a file that is not there, or no JSON object with the needed keys."""
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise Error(f"{file}: {error.strerror}") from None
    except ValueError as error:
        raise Error(f"{file}: is no JSON: {error}") from None
    if not isinstance(found, dict):
        raise Error(f"{file}: a JSON object is needed, {{...}}, not {found!r:.40}")
    for key in needed:
        if key not in found:
            raise Error(f"{file}: has no '{key}'")
    return found


def _folder_when_made(command: str, file: FilePath, output: FilePath | None, words: list[str]) -> Path:
    """The folder of results whose runs have all been made. Raises billet.Error if some are left."""
    said = run_program(command, as_operand(file), "--quiet", *words, accepted=(0, RUNS_ARE_LEFT))
    folder = folder_of(said, output)
    if re.search("left to be (run|made)$", said, re.MULTILINE):
        raise Error(
            f"{folder}: runs are left to be made; each line of {folder / 'commands.txt'} is one, "
            f"then call billet.{command} again"
        )
    return folder


class Study:
    """Results of a study.

    folder   with study.csv, study.md, pictures, and each run's results in runs/
    data     all of study.json, docs/guide/studies.md
    """

    def __init__(self, folder: FilePath) -> None:
        """Reads what `billet study` has written. Raises billet.Error."""
        self.folder = Path(folder)
        self.data = read_json(self.folder / "study.json", "rows")
        self._runs = self.folder.absolute() / "runs"

    @property
    def rows(self) -> list[dict[str, Any]]:
        """One row per run: "settings", "status", "reason", "quantities", "cost", "folder" (absolute)."""
        return [{**row, "folder": self._absolute(row.get("folder", ""))} for row in self.data["rows"]]

    def _absolute(self, folder: str) -> str:
        """Of a run; the program names it relative to the folder that it was called in."""
        return str(self._runs / Path(folder).name) if folder else ""

    def values(self, quantity: str) -> Floats:
        """A quantity of each run, shape (n_rows,); nan where a run has not given it.

        Raises billet.MissingKey.
        """
        known = sorted({name for row in self.rows for name in row.get("quantities", {})})
        if quantity not in known:
            raise MissingKey(no_such("quantity", quantity, known))
        found = (row.get("quantities", {}).get(quantity) for row in self.rows)
        return np.array([np.nan if value is None else value for value in found], dtype=float)

    def __repr__(self) -> str:
        return f"<study of {len(self.rows)} runs in {self.folder}>"


def study(
    file: FilePath,
    output: FilePath | None = None,
    *,
    set: Mapping[str, Any] | None = None,
    processes: int | None = None,
    threads: int | None = None,
    again: bool = False,
) -> Study:
    """Makes the runs of a study that have not been made: `billet study`.

    file        the study file
    output      folder of the results; by default results/NAME
    set         changes of the study file, {"run.threads": 2}
    processes   runs at once; by default as many as the machine has cores for
    threads     of each run, by default 1
    again       makes runs that failed again

    Ctrl-C ends it; the same call goes on. Raises billet.ProgramError; billet.Error if runs are left
    to be made by a queue.
    """
    words = options(output=output, set=set, processes=processes, threads=threads, again=again)
    return Study(_folder_when_made("study", file, output, words))


@dataclass(frozen=True)
class ChartedQuantity:
    """What a chart says of a measured quantity for a law."""

    x: Floats
    """how far the test has gone, shape (n_stations,)"""
    parameters: dict[str, Floats]
    """values of the law's one or two parameters"""
    values: Floats
    """shape (n_values of each parameter, n_stations); nan where a run did not get there"""
    model_error: Floats
    """half widths of 95 % for what mesh and increments leave, shape as of values"""


class Chart:
    """A friction test's chart.

    folder   with chart.csv, chart.json and pictures; what identify takes
    data     all of chart.json
    """

    def __init__(self, folder: FilePath) -> None:
        """Reads what `billet chart` has written. Raises billet.Error."""
        self.folder = Path(folder)
        self.data = read_json(self.folder / "chart.json", "laws", "stations")

    @property
    def laws(self) -> list[str]:
        """Names of the laws."""
        return [law["name"] for law in self.data["laws"]]

    @property
    def quantities(self) -> list[str]:
        """Names of what is measured."""
        return [quantity["name"] for quantity in self.data["laws"][0]["quantities"]]

    def quantity(self, name: str, law: str | None = None) -> ChartedQuantity:
        """A measured quantity over the test, for each value of the parameters.

        law   by default the first

        Raises billet.MissingKey.
        """
        charted = self._named("law", law if law is not None else self.laws[0], self.data["laws"])
        found = self._named("quantity", name, charted["quantities"])
        parameters = {p["name"]: np.array(p["values"], float) for p in charted["parameters"]}
        shape = (*(len(values) for values in parameters.values()), -1)
        return ChartedQuantity(
            np.array(self.data["stations"], float),
            parameters,
            np.array(found["values"], float).reshape(shape),
            np.array(found["model_error"], float).reshape(shape),
        )

    @staticmethod
    def _named(kind: str, name: str, items: list[dict[str, Any]]) -> dict[str, Any]:
        for item in items:
            if item["name"] == name:
                return item
        raise MissingKey(no_such(kind, name, [item["name"] for item in items]))

    def __repr__(self) -> str:
        return f"<chart of {', '.join(self.quantities)} for {', '.join(self.laws)} in {self.folder}>"


def chart(
    file: FilePath,
    output: FilePath | None = None,
    *,
    set: Mapping[str, Any] | None = None,
    processes: int | None = None,
    threads: int | None = None,
    again: bool = False,
) -> Chart:
    """Makes the runs of a friction test's chart that have not been made: `billet chart`.

    Arguments as of billet.study. Raises billet.ProgramError; billet.Error if runs are left to be
    made by a queue.
    """
    words = options(output=output, set=set, processes=processes, threads=threads, again=again)
    return Chart(_folder_when_made("chart", file, output, words))
