"""Tables of numbers, by column."""

from __future__ import annotations

import csv
import difflib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ._arrays import Floats
from ._errors import Error, MissingKey, MissingPackage


class Table(Mapping[str, Floats]):
    """Columns of a table by name, each an array of shape (n_rows,), float64.

    Of increments they are those of history.csv: docs/guide/results.md has their units.
    """

    def __init__(self, columns: Mapping[str, Any]) -> None:
        self._columns = {name: np.asarray(values) for name, values in columns.items()}

    def __getitem__(self, name: str) -> Floats:
        """A column. Raises billet.MissingKey, with the name that may have been meant."""
        if name not in self._columns:
            raise MissingKey(no_such("column", name, list(self._columns)))
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        rows = len(next(iter(self._columns.values()), ()))
        return f"<table of {rows} rows: {', '.join(self._columns)}>"

    def to_pandas(self) -> Any:
        """As a pandas.DataFrame. Raises billet.MissingPackage without pandas."""
        try:
            import pandas
        except ImportError:
            raise MissingPackage(
                "pandas is not installed (Debian: python3-pandas); a table is a mapping of NumPy "
                "arrays without it"
            ) from None
        return pandas.DataFrame(dict(self._columns))


def read_csv(file: Path) -> Table:
    """Reads a table of numbers, the first line of which has the columns' names.

    Raises billet.Error for a file that cannot be read.
    """
    try:
        with file.open(newline="", encoding="utf-8") as stream:
            names, *rows = list(csv.reader(stream))
        values = np.array(rows, dtype=float).reshape(len(rows), len(names))
    except OSError as error:
        raise Error(f"{file}: {error.strerror}") from None
    except (ValueError, csv.Error) as error:
        raise Error(f"{file}: is no table of numbers: {error}") from None
    return Table(dict(zip(names, values.T.copy())))


def no_such(kind: str, name: str, known: list[str]) -> str:
    """'there is no ...', with the name that may have been meant, or those that are known."""
    near = difflib.get_close_matches(str(name), known, n=1)
    remedy = f"did you mean '{near[0]}'?" if near else "known are " + ", ".join(known)
    return f"there is no {kind} '{name}'; {remedy if known else 'there are none'}"
