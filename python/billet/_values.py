"""Arrays that know their unit, and Python values as TOML."""

from __future__ import annotations

import json
import math
import numbers
import operator
import os
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ._errors import Error


class Field(np.ndarray[Any, np.dtype[np.float64]]):
    """An array of values at the nodes, with its name and unit.

    name   as in frames: "von_mises"
    unit   "MPa"; "1" of pure numbers

    Slices and copies keep both; results of arithmetic are plain arrays, since their unit is another.
    """

    name: str
    unit: str

    def __new__(cls, values: Any, name: str, unit: str) -> Field:
        field = np.asarray(values).view(cls)
        field.name, field.unit = name, unit
        return field

    def __array_finalize__(self, source: Any) -> None:
        self.name = getattr(source, "name", "")
        self.unit = getattr(source, "unit", "")

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        def plain(value: Any) -> Any:
            return value.view(np.ndarray) if isinstance(value, Field) else value

        if "out" in options:
            options["out"] = tuple(plain(out) for out in options["out"])
        return getattr(ufunc, method)(*(plain(value) for value in inputs), **options)

    def __repr__(self) -> str:
        return f"{self.view(np.ndarray)!r} {self.name} [{self.unit}]"

    def __reduce__(self) -> Any:
        return Field, (np.array(self), self.name, self.unit)


def toml_text(value: Any) -> str:
    """A Python value as TOML on one line.

    Raises billet.Error for what TOML has no word for.
    """
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return _number(float(value))
    if isinstance(value, (str, os.PathLike)):
        text = whole_text(os.fsdecode(value))
        return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, np.ndarray):
        return toml_text(value.tolist())
    if isinstance(value, Mapping):
        items = (f"{toml_key(str(key))} = {toml_text(item)}" for key, item in value.items())
        return "{" + ", ".join(items) + "}"
    if isinstance(value, Sequence):
        return "[" + ", ".join(map(toml_text, value)) + "]"
    remedy = "; del case[KEY] removes a key" if value is None else ""
    raise Error(f"a case cannot hold {value!r} of type {type(value).__name__}{remedy}")


def _number(value: float) -> str:
    if math.isfinite(value):
        return repr(value)
    return "nan" if math.isnan(value) else ("inf" if value > 0 else "-inf")


def whole_text(text: str) -> str:
    """A text that can be written as UTF-8. Raises billet.Error for half a character in it."""
    if not isinstance(text, str):
        raise TypeError(f"a text is needed, not {text!r} of type {type(text).__name__}")
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise Error(f"{text!r} is no text that can be written: {error.reason}") from None
    return text


def path_text(file: str | bytes | os.PathLike[Any]) -> str:
    """The name of a file or a folder. Raises billet.Error for one that is no UTF-8."""
    return whole_text(os.fsdecode(file))


def whole_number(name: str, value: Any) -> int:
    """A number of threads, say, that is at least 1. Raises billet.Error."""
    most = 2**31 - 1
    try:
        number = operator.index(value)
    except TypeError:
        number = 0
    if not 1 <= number <= most:
        raise Error(f"{name} is {value!r}; allowed is a whole number of at least 1, at most {most}")
    return number


def toml_key(part: str) -> str:
    """A part of a dotted key, in quotes where needed."""
    whole_text(part)
    if re.fullmatch(r"[A-Za-z0-9_-]+", part):
        return part
    if '"' not in part and "\\" not in part:
        return f'"{part}"'
    if "'" not in part:
        return f"'{part}'"
    raise Error(f"no key of a case can be {part!r}: it has both kinds of quotes")


_PART = re.compile(r"""\s*(?:"([^"]*)"|'([^']*)'|([^."'\s][^."']*?))\s*(?:\.|$)""")


def key_parts(key: str) -> list[str]:
    """The parts of a dotted key: 'tool."punch 2".friction' has three.

    Raises billet.Error for what is no key.
    """
    parts, at = [], 0
    while True:
        found = _PART.match(key, at)
        if found is None:
            raise Error(f"{key!r} is no key; allowed is a dotted one such as 'tool.punch.friction.m'")
        parts.append(next(part for part in found.groups() if part is not None))
        at = found.end()
        if at == len(key) and not key.endswith("."):
            return parts
