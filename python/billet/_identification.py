"""Coefficients of friction laws from what was measured."""

from __future__ import annotations

import csv
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ._arrays import Floats
from ._errors import Error, MissingKey, ProgramError
from ._program import FilePath, run_program
from ._studies import Chart, read_json
from ._table import no_such


@dataclass(frozen=True)
class Parameter:
    """A parameter of a law as it was found."""

    name: str
    value: float
    """the likeliest"""
    low: float
    """of the interval of 95 %"""
    high: float
    from_beginning_of_chart: bool
    """the interval goes on below low, beyond the chart"""
    to_end_of_chart: bool
    """it goes on above high"""


@dataclass(frozen=True)
class FittedLaw:
    """A law fitted to measurements."""

    name: str
    parameters: dict[str, Parameter]
    chi_squared: float
    """of what is left [-]"""
    degrees_of_freedom: int
    p: float | None
    """of as much being left by chance [-]; None where nothing is left to tell by"""
    comparison: str
    """whether the data prefer another law"""


@dataclass(frozen=True)
class Identification:
    """What measurements say of the laws of a chart."""

    laws: dict[str, FittedLaw]
    likeliest: str
    """name of the law"""
    warnings: list[str]
    advice: list[str]
    """on further measurements"""
    text: str = field(repr=False)
    """the same for a person"""

    def __getitem__(self, parameter: str) -> Parameter:
        """A parameter of the likeliest law. Raises billet.MissingKey."""
        parameters = self.laws[self.likeliest].parameters
        if parameter not in parameters:
            raise MissingKey(no_such("parameter", parameter, list(parameters)))
        return parameters[parameter]

    def __str__(self) -> str:
        return self.text


def identify(chart: Chart | FilePath, measurements: Mapping[str, Any] | FilePath) -> Identification:
    """Reads coefficients off a chart: `billet identify`.

    chart          a Chart, or the folder of one
    measurements   a CSV file, or columns of it: the chart's x, any of its quantities, and for each
                   NAME_uncertainty (half an interval of 95 %) or NAME_standard, or neither;
                   {"reduction": [0.4], "barrelling": [1.04], "barrelling_uncertainty": [0.005]}

    Raises billet.ProgramError for measurements that are too few, or outside of the chart.
    """
    folder = chart.folder if isinstance(chart, Chart) else Path(chart)
    with tempfile.TemporaryDirectory() as work:
        file: FilePath = Path(work) / "measurements.csv"
        if isinstance(measurements, Mapping) or hasattr(measurements, "columns"):
            _write(measurements, Path(file))
        else:
            file = measurements
        try:
            said = run_program("identify", folder, file, "-o", work)
        except ProgramError as error:
            message = str(error).replace(f"{Path(work) / 'measurements.csv'}", "measurements")
            raise ProgramError(message, error.status) from None
        found = read_json(Path(work) / "identification.json")
    text = "\n".join(line for line in said.splitlines() if not line.startswith("results: "))
    laws = {law["name"]: _law(law) for law in found["laws"]}
    return Identification(laws, found["likeliest"], found["warnings"], found["advice"], text)


def _write(columns: Any, file: Path) -> None:
    names = list(columns)
    values = [_numbers(name, columns[name]) for name in names]
    if len({len(each) for each in values}) > 1:
        lengths = ", ".join(f"{name} {len(each)}" for name, each in zip(names, values))
        raise Error(f"measurements: the columns differ in length: {lengths}")
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(names)
        writer.writerows([repr(float(value)) for value in row] for row in zip(*values))


def _numbers(name: Any, values: Any) -> Floats:
    try:
        numbers: Floats = np.atleast_1d(np.asarray(values, dtype=float))
    except (TypeError, ValueError) as error:
        raise Error(f"measurements: the column {name} is not of numbers: {error}") from None
    if numbers.ndim > 1:
        raise Error(f"measurements: the column {name} has {numbers.ndim} dimensions; allowed is one")
    return numbers


def _law(law: dict[str, Any]) -> FittedLaw:
    return FittedLaw(
        law["name"],
        {each["name"]: Parameter(**each) for each in law["parameters"]},
        law["chi_squared"],
        law["degrees_of_freedom"],
        law["p"],
        law["comparison"],
    )
