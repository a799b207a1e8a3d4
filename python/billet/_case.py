"""Cases: what a case file says, changed like a dictionary."""

from __future__ import annotations

import copy
import os
import tomllib
from collections.abc import Iterator, Mapping, MutableMapping, MutableSequence
from typing import Any, NamedTuple

from . import _native
from ._errors import Error, MissingKey
from ._table import no_such
from ._values import key_parts, toml_key, toml_text

Path = tuple[str, ...]


class CaseReport(NamedTuple):
    """What `billet check` says of a case that can be run."""

    warnings: list[str]
    """of what is legal and hardly ever meant"""
    advice: list[str]
    """on what the case could do without, or leaves out"""


def _assignments(changes: Mapping[str, Any] | None, above: Path = ()) -> list[str]:
    """ "KEY=VALUE" of each change."""
    dotted = {_dotted((*above, *key_parts(key))): value for key, value in (changes or {}).items()}
    return [f"{key}={toml_text(value)}" for key, value in dotted.items()]


def _dotted(path: Path) -> str:
    return ".".join(map(toml_key, path))


def _item(values: Any, part: str) -> Any:
    """What a part of a key leads to: a key of a table, a list item by its name or index."""
    if isinstance(values, dict) and part in values:
        return values[part]
    if isinstance(values, list):
        for value in values:
            if isinstance(value, dict) and value.get("name") == part:
                return value
        if part.isdecimal() and int(part) < len(values):
            return values[int(part)]
    raise KeyError(part)


def _known(values: Any) -> list[str]:
    if isinstance(values, dict):
        return list(values)
    if isinstance(values, list):
        return [str(v["name"] if isinstance(v, dict) and "name" in v else i) for i, v in enumerate(values)]
    return []


class _View:
    """A table or a list of a case, by its key: what is changed in it is changed in the case."""

    def __init__(self, case: Case, path: Path) -> None:
        self._case = case
        self._path = path

    def _values(self) -> Any:
        return self._case._find(self._path)

    def _shown(self, path: Path) -> Any:
        value = self._case._find(path)
        if isinstance(value, dict):
            return TableView(self._case, path)
        return ListView(self._case, path) if isinstance(value, list) else value

    def _inner(self, key: str) -> Path:
        """The path of a key in here: a key as it stands if there is one of it, else a dotted one."""
        if not isinstance(key, str):
            raise TypeError(f"keys of a case are text, not {key!r}")
        values = self._values()
        plain = isinstance(values, dict) and key in values
        return (*self._path, key) if plain else (*self._path, *key_parts(key))

    def copy(self) -> Any:
        """As plain dictionaries and lists, which no case knows of."""
        return copy.deepcopy(self._values())

    def __eq__(self, other: object) -> bool:
        return bool(self._values() == (other._values() if isinstance(other, _View) else other))

    def __repr__(self) -> str:
        return repr(self._values())

    def __len__(self) -> int:
        return len(self._values())


class TableView(_View, MutableMapping[str, Any]):
    """A table of a case: a mapping of what the case file says there.

    Keys may be dotted, "punch.friction.m"; a tool or a stage is named by its name. What is set,
    in whichever of its tables, is checked by the reader of case files at once.
    """

    __hash__ = None  # type: ignore[assignment]

    def __getitem__(self, key: str) -> Any:
        """A value, or a view of a table or list. Raises billet.MissingKey."""
        return self._shown(self._inner(key))

    def __setitem__(self, key: str, value: Any) -> None:
        """Changes a value, or adds it. Raises billet.Error, and leaves the case as it was."""
        self._case._set([f"{_dotted(self._inner(key))}={toml_text(value)}"])

    def __delitem__(self, key: str) -> None:
        """Removes what is there. Raises billet.Error, and leaves the case as it was."""
        path = self._inner(key)
        self._case._find(path)
        self._case._erase(_dotted(path))

    def __contains__(self, key: object) -> bool:
        try:
            self._case._find(self._inner(key))  # type: ignore[arg-type]
        except (Error, TypeError):
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        return iter(list(self._values()))

    def update(self, other: Mapping[str, Any] = {}, /, **more: Any) -> None:  # type: ignore[override]
        """Several changes at once, which make sense together only.

        Raises billet.Error, and leaves the case as it was.
        """
        self._case._set(_assignments({**other, **more}, self._path))


class ListView(_View, MutableSequence[Any]):
    """A list of a case. Items are found by their index, tools and stages by their name as well."""

    __hash__ = None  # type: ignore[assignment]

    def __getitem__(self, item: Any) -> Any:
        """An item, or a plain list of several. Raises IndexError, billet.MissingKey."""
        if isinstance(item, slice):
            return self.copy()[item]
        return self._shown(self._item_path(item))

    def __setitem__(self, item: Any, value: Any) -> None:
        """Changes an item. Raises billet.Error, and leaves the case as it was."""
        if isinstance(item, slice):
            self._replace(lambda values: values.__setitem__(item, value))
        else:
            self._case._set([f"{_dotted(self._item_path(item))}={toml_text(value)}"])

    def __delitem__(self, item: Any) -> None:
        """Removes an item. Raises billet.Error, and leaves the case as it was."""
        if isinstance(item, slice):
            self._replace(lambda values: values.__delitem__(item))
        else:
            self._case._erase(_dotted(self._item_path(item)))

    def insert(self, index: int, value: Any) -> None:
        """Adds an item before another one. Raises billet.Error, and leaves the case as it was."""
        self._replace(lambda values: values.insert(index, value))

    def _replace(self, change: Any) -> None:
        values = self.copy()
        change(values)
        self._case._set([f"{_dotted(self._path)}={toml_text(values)}"])

    def _item_path(self, item: Any) -> Path:
        if isinstance(item, str):
            return self._inner(item)
        index = range(len(self))[item]  # as of any sequence
        return (*self._path, str(index))


class Case(TableView):
    """A case in memory, always one that can be run.

        case = billet.Case.load("case.toml")
        case["tool"]["punch"]["friction"]["m"] = 0.2
        case["tool.punch.friction.m"] = 0.2            # the same
        case.update({"time.end": 2.0, "time.increments.max": 0.1})

    A change that the reader of case files refuses raises billet.Error with the reader's text, and
    is not made. Units are those of the case; texts with a unit, "210 GPa", are allowed as in files.
    """

    def __init__(self, native: _native.Case) -> None:
        """Not to be called: Case.load and Case.from_string make cases."""
        super().__init__(self, ())
        self._native = native
        self._tree: dict[str, Any] | None = None

    @classmethod
    def load(
        cls,
        file: str | os.PathLike[str],
        set: Mapping[str, Any] | None = None,
        *,
        allow_outside: bool = False,
    ) -> Case:
        """Reads a case file.

        set             changes to begin with, {"tool.punch.friction.m": 0.2}
        allow_outside   the case may name files outside of its folder

        Raises billet.Error with every complaint of `billet check`.
        """
        return cls(_native.Case.load(os.fspath(file), _assignments(set), allow_outside))

    @classmethod
    def from_string(
        cls, text: str, folder: str | os.PathLike[str] = ".", *, allow_outside: bool = False
    ) -> Case:
        """Reads the text of a case file. Raises billet.Error with every complaint.

        folder   that meshes and surfaces named in the text are relative to
        """
        return cls(_native.Case.from_text(text, os.fspath(folder), allow_outside))

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the case to a file, from which it can be read again.

        Without changes it is the text that was read; a changed case is written without comments.
        Raises billet.Error, also if the files that the case names are not to be found from there.
        """
        self._native.save(os.fspath(file))

    def check(self) -> CaseReport:
        """Builds the scene and says what `billet check` warns of and advises.

        Raises billet.Error for a scene that cannot be run.
        """
        return CaseReport(*self._native.check())

    @property
    def text(self) -> str:
        """As the text of a case file."""
        return self._native.text()

    @property
    def resolved_text(self) -> str:
        """The same with every default filled in, as case.resolved.toml of results."""
        return self._native.resolved_text()

    def copy(self) -> Case:
        """Another case, which may be changed without this one."""
        return Case(self._native.copy())

    __copy__ = copy

    def __deepcopy__(self, memo: Any) -> Case:
        return self.copy()

    def __reduce__(self) -> Any:
        return _restored, (self.text, self._native.folder())

    def __repr__(self) -> str:
        return f"<case {self._native.name()}: {self.get('title', 'without a title')}>"

    def _find(self, path: Path) -> Any:
        if self._tree is None:
            self._tree = tomllib.loads(self._native.text())
        values: Any = self._tree
        for depth, part in enumerate(path):
            try:
                values = _item(values, part)
            except KeyError:
                above = _dotted(path[:depth])
                there = f"{self._native.name()}: {above + ': ' if above else ''}"
                raise MissingKey(there + no_such("key", part, _known(values))) from None
        return values

    def _set(self, assignments: list[str]) -> None:
        self._native.set(assignments)
        self._tree = None

    def _erase(self, key: str) -> None:
        self._native.erase(key)
        self._tree = None


def _restored(text: str, folder: str) -> Case:
    return Case.from_string(text, folder or ".")
