"""Cases: what a case file says, changed like a dictionary."""

from __future__ import annotations

import copy
import operator
import os
import tomllib
from collections.abc import Iterator, Mapping, MutableMapping, MutableSequence
from typing import Any, NamedTuple

from . import _native
from ._errors import Error, MissingKey
from ._table import no_such
from ._values import key_parts, path_text, toml_key, toml_text, whole_text

Path = tuple[str | int, ...]
"""Keys of tables; items of lists by their name, or by their index as text or as a number."""

_REQUIRED: Any = object()  # of pop: there is no default


class CaseReport(NamedTuple):
    """What `billet check` says of a case that can be run."""

    warnings: list[str]
    """of what is legal and hardly ever meant"""
    advice: list[str]
    """on what the case could do without, or leaves out"""


def _assignments(changes: Mapping[str, Any] | None, above: Path = ()) -> list[str]:
    """ "KEY=VALUE" of each change. Raises billet.Error for what is no mapping."""
    if changes is not None and not isinstance(changes, Mapping):
        raise Error(f"changes are a dictionary, {{'time.end': 2.0}}, not {changes!r:.60}")
    dotted = {_dotted((*above, *key_parts(key))): value for key, value in (changes or {}).items()}
    return [f"{key}={toml_text(value)}" for key, value in dotted.items()]


def _dotted(path: Path) -> str:
    return ".".join(toml_key(str(part)) for part in path)


def _name(item: Any) -> Any:
    """Of a list item; None: it has none."""
    return item.get("name") if isinstance(item, dict) else None


def _index(items: list[Any], part: str | int) -> int:
    """Where a part of a key leads to in a list: by a name, or, if no item has it, by an index."""
    if isinstance(part, str):
        for index, item in enumerate(items):
            if _name(item) == part:
                return index
        if not (part.isascii() and part.isdecimal()):
            raise KeyError(part)
        part = int(part)
    if part >= len(items):
        raise KeyError(part)
    return part


def _item(values: Any, part: str | int) -> Any:
    """What a part of a key leads to: a key of a table, a list item by its name or index."""
    if isinstance(values, dict) and part in values:
        return values[part]
    if isinstance(values, list):
        return values[_index(values, part)]
    raise KeyError(part)


def _names(items: list[Any]) -> list[Any]:
    """The name of each item, or its index if it has none."""
    return [index if _name(item) is None else _name(item) for index, item in enumerate(items)]


def _known(values: Any) -> list[str]:
    if isinstance(values, dict):
        return list(values)
    return list(map(str, _names(values))) if isinstance(values, list) else []


class _Move(NamedTuple):
    """A change after which indices lead to other items."""

    path: Path
    """of a list some items of which have moved; or of what was set as a whole"""
    first: int | None
    """index of the first such item; None: all below the path are others now"""

    def concerns(self, path: Path) -> bool:
        """Whether a path leads elsewhere now; an index and a name may be those of one item."""
        depth = len(self.path)
        if not all(a == b or type(a) is not type(b) for a, b in zip(path, self.path)):
            return False
        if self.first is None:
            return any(isinstance(part, int) for part in path[depth:])
        return len(path) > depth and isinstance(part := path[depth], int) and part >= self.first


class _View:
    """A table or a list of a case, by its key: what is changed in it is changed in the case."""

    def __init__(self, case: Case, path: Path) -> None:
        self._case = case
        self._path = path
        self._seen = len(case._moves)

    def _values(self) -> Any:
        """Raises billet.Error if the view is of a list item that an index does not lead to any more."""
        moves = self._case._moves
        if any(move.concerns(self._path) for move in moves[self._seen :]):
            raise Error(
                f"{self._case._native.name()}: {_dotted(self._path)} may be another item now: the "
                "list has changed since it was taken from the case; take it anew"
            )
        self._seen = len(moves)
        return self._case._find(self._path)

    def _shown(self, path: Path) -> Any:
        value = self._case._find(path)
        if isinstance(value, dict):
            return TableView(self._case, self._case._indexed(path))
        return ListView(self._case, self._case._indexed(path)) if isinstance(value, list) else value

    def _plain(self, item: Any) -> Any:
        value = self[item]  # type: ignore[index]
        return value.copy() if isinstance(value, _View) else value

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
        self._case._set({self._inner(key): value})

    def __delitem__(self, key: str) -> None:
        """Removes what is there. Raises billet.Error, and leaves the case as it was."""
        self._case._erase(self._inner(key))

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
        self._case._set({self._inner(key): value for key, value in dict(other, **more).items()})

    def pop(self, key: str, default: Any = _REQUIRED) -> Any:
        """Removes what is there and returns it, tables and lists as plain ones.

        Raises billet.MissingKey without a default; billet.Error, and leaves the case as it was.
        """
        if default is not _REQUIRED and key not in self:
            return default
        value = self._plain(key)
        del self[key]
        return value

    def clear(self) -> None:
        """Removes all keys at once. Raises billet.Error, and leaves the case as it was."""
        if not self._path:
            raise Error(f"{self._case._native.name()}: a case cannot be empty")
        self._values()
        self._case._set({self._path: {}})


class ListView(_View, MutableSequence[Any]):
    """A list of a case. Items are found by their index, tools and stages by their name as well.

    A whole number is an index, whatever items are named; a text is a name, or an index if no item
    has that name. Tables that were taken from the list by an index are refused with billet.Error
    once items before them have come or gone.
    """

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
            self._case._set({self._item_path(item): value})

    def __delitem__(self, item: Any) -> None:
        """Removes an item. Raises billet.Error, and leaves the case as it was."""
        if isinstance(item, slice):
            self._replace(lambda values: values.__delitem__(item))
        else:
            self._case._erase(self._item_path(item))

    def __contains__(self, item: object) -> bool:
        """Whether there is such an item, or one of that name."""
        named = isinstance(item, str) and any(_name(value) == item for value in self._values())
        return named or super().__contains__(item)

    def get(self, item: Any, default: Any = None) -> Any:
        """An item by its name or index; the default if there is none."""
        try:
            return self[item]
        except (IndexError, MissingKey):
            return default

    def keys(self) -> list[Any]:
        """The name of each item; its index if it has none."""
        return _names(self._values())

    def insert(self, index: int, value: Any) -> None:
        """Adds an item before another one. Raises billet.Error, and leaves the case as it was."""
        self._replace(lambda values: values.insert(index, value))

    def extend(self, values: Any) -> None:
        """Adds items at the end, all or none. Raises billet.Error, and leaves the case as it was."""
        self._replace(lambda own: own.extend(list(values)))

    def pop(self, index: Any = -1) -> Any:
        """Removes an item and returns it, tables and lists as plain ones. Raises as del does."""
        value = self._plain(index)
        del self[index]
        return value

    def reverse(self) -> None:
        """Turns the order round. Raises billet.Error, and leaves the case as it was."""
        self._replace(lambda values: values.reverse())

    def clear(self) -> None:
        """Removes all items at once. Raises billet.Error, and leaves the case as it was."""
        self._replace(lambda values: values.clear())

    def _replace(self, change: Any) -> None:
        old = self.copy()
        values = list(old)
        change(values)
        same = (i for i, (before, after) in enumerate(zip(old, values)) if before != after)
        first = next(same, min(len(old), len(values)))
        self._case._set({self._path: values}, first)

    def _item_path(self, item: Any) -> Path:
        if isinstance(item, str):
            return self._inner(item)
        n_items = len(self)
        try:
            index = operator.index(item)
        except TypeError:
            raise TypeError(f"items of a list are found by an index or a name, not by {item!r}") from None
        if not -n_items <= index < n_items:
            have = f"there are {n_items} items" if n_items != 1 else "there is one item"
            raise IndexError(f"{_dotted(self._path)}: there is no index {index}: {have}")
        return (*self._path, index % n_items)


class Case(TableView):
    """A case in memory, always one that can be run.

        case = billet.Case.load("case.toml")
        case["tool"]["punch"]["friction"]["m"] = 0.2
        case["tool.punch.friction.m"] = 0.2            # the same
        case.update({"time.end": 2.0, "time.increments.max": 0.1})

    A change that the reader of case files refuses raises billet.Error with the reader's text, and
    is not made. Units are those of the case; texts with a unit, "210 GPa", are allowed as in files.
    """

    def __init__(self, native: _native.Case, allow_outside: bool = False) -> None:
        """Not to be called: Case.load and Case.from_string make cases."""
        if not isinstance(native, _native.Case):
            raise TypeError(
                "a case is made by billet.Case.load(FILE) or billet.Case.from_string(TEXT), "
                f"not by billet.Case({native!r:.80})"
            )
        self._moves: list[_Move] = []
        super().__init__(self, ())
        self._native = native
        self._allow_outside = allow_outside
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
        native = _native.Case.load(path_text(file), _assignments(set), bool(allow_outside))
        return cls(native, bool(allow_outside))

    @classmethod
    def from_string(
        cls, text: str, folder: str | os.PathLike[str] = ".", *, allow_outside: bool = False
    ) -> Case:
        """Reads the text of a case file. Raises billet.Error with every complaint.

        folder   that meshes and surfaces named in the text are relative to
        """
        native = _native.Case.from_text(whole_text(text), path_text(folder), bool(allow_outside))
        return cls(native, bool(allow_outside))

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the case to a file, from which it can be read again.

        Without changes it is the text that was read; a changed case is written without comments.
        Raises billet.Error, also if the files that the case names are not to be found from there.
        """
        self._native.save(path_text(file))

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
        return Case(self._native.copy(), self._allow_outside)

    __copy__ = copy

    def __deepcopy__(self, memo: Any) -> Case:
        return self.copy()

    def __reduce__(self) -> Any:
        return _restored, (self.text, os.path.abspath(self._native.folder()), self._allow_outside)

    def __repr__(self) -> str:
        return f"<case {self._native.name()}: {self.get('title', 'without a title')}>"

    def _content(self) -> Any:
        if self._tree is None:
            self._tree = tomllib.loads(self._native.text())
        return self._tree

    def _find(self, path: Path) -> Any:
        values = self._content()
        for depth, part in enumerate(path):
            try:
                values = _item(values, part)
            except KeyError:
                above = _dotted(path[:depth])
                there = f"{self._native.name()}: {above + ': ' if above else ''}"
                raise MissingKey(there + no_such("key", str(part), _known(values))) from None
        return values

    def _indexed(self, path: Path) -> Path:
        """A path, with numbers where it has indices as text."""
        values, parts = self._content(), list(path)
        for depth, part in enumerate(path):
            try:
                if isinstance(values, list) and part != _name(values[_index(values, part)]):
                    parts[depth] = _index(values, part)
                values = _item(values, part)
            except KeyError:
                break  # what is to be added
        return tuple(parts)

    def _key(self, path: Path) -> str:
        """The dotted key by which the reader of case files finds a path.

        It looks for names first: an item whose index is the name of another is given by its own.
        """
        values, parts = self._content(), list(path)
        for depth, part in enumerate(path):
            if isinstance(part, int):
                keys = (str(part), _name(values[part]))
                own = [key for key in keys if isinstance(key, str) and _index(values, key) == part]
                if not own:
                    raise Error(f"{self._native.name()}: {_dotted(path[:depth])} has no key for item {part}")
                parts[depth] = own[0]
            try:
                values = _item(values, part)
            except KeyError:
                break  # what is to be added
        return _dotted(tuple(parts))

    def _set(self, changes: Mapping[Path, Any], first: int | None = None) -> None:
        """Sets values by their paths.

        first   of a list that is set: the first item that is another one now
        """
        texts = {path: toml_text(value) for path, value in changes.items()}
        moves = [_Move(self._indexed(p), first) for p, text in texts.items() if text[0] in "[{"]
        self._native.set([f"{self._key(path)}={text}" for path, text in texts.items()])
        self._changed(moves)

    def _erase(self, path: Path) -> None:
        self._find(path)
        above = self._find(path[:-1])
        moves = []
        if isinstance(above, list):
            moves.append(_Move(self._indexed(path[:-1]), _index(above, path[-1])))
        self._native.erase(self._key(path))
        self._changed(moves)

    def _changed(self, moves: list[_Move]) -> None:
        self._tree = None
        self._moves += moves


def _restored(text: str, folder: str, allow_outside: bool) -> Case:
    return Case.from_string(text, folder, allow_outside=allow_outside)
