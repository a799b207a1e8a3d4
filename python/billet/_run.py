"""Runs in memory: advanced by increments, looked at, copied, stored."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _native
from ._arrays import Floats, Integers
from ._case import Case
from ._errors import MissingKey, NotConverged
from ._table import Table, no_such
from ._values import Field, whole_number, whole_text

Callback = Callable[["Increment"], Any]


@dataclass(frozen=True)
class Increment:
    """An increment that was solved; units are those of the case."""

    number: int
    """from 1"""
    time: float
    """at its end [s]"""
    length: float
    """[s]"""
    iterations: int
    """of Newton's method"""
    cutbacks: int
    """tries that failed before it"""
    residuals: list[float]
    """relative, at its start and after each iteration [-]"""
    events: list[str]
    """what happened at its end, a line each"""
    row: Mapping[str, float] = field(repr=False)
    """its row of history.csv, measures among it"""
    tools: tuple[str, ...] = field(repr=False)
    """their names, in the order of the case"""

    def __getitem__(self, column: str) -> float:
        """A value of its row of history.csv: inc["bore"], inc["punch.force_y"].

        Raises billet.MissingKey.
        """
        if column not in self.row:
            raise MissingKey(no_such("column", column, list(self.row)))
        return self.row[column]

    @property
    def forces(self) -> dict[str, Floats]:
        """Of the workpiece on each tool, shape (3,) [N]; in plane strain per length [N/mm]."""
        return self._vectors("force")

    @property
    def torques(self) -> dict[str, Floats]:
        """Of these forces about each tool's point of rotation, shape (3,) [N mm]."""
        return self._vectors("torque")

    @property
    def displacements(self) -> dict[str, Floats]:
        """Of each tool by its motion, shape (3,) [mm]."""
        return self._vectors("displacement")

    def _vectors(self, what: str) -> dict[str, Floats]:
        return {
            tool: np.array([self.row[f"{tool}.{what}_{axis}"] for axis in "xyz"])
            for tool in self.tools
        }


class _AsItIs:
    """What there is to see of a run, or of a state of it."""

    _native: _native.Run

    @property
    def time(self) -> float:
        """At the end of the last increment [s]."""
        return self._native.time()

    @property
    def increment(self) -> int:
        """Number of the last increment; 0: there has been none."""
        return self._native.increment()

    @property
    def positions(self) -> Floats:
        """Where the nodes are, shape (n_nodes, dimension) [mm].

        The run's own memory, read-only. It stays as it is when the run goes on: that copies it for
        the run, if the array is still held then.
        """
        return self._native.positions()

    @property
    def elements(self) -> Integers:
        """Nodes of the elements, shape (n_elements, nodes_per_element), int32.

        The mesh's own memory, read-only and never copied; a new mesh has another array.
        """
        return self._native.elements()

    @property
    def field_names(self) -> list[str]:
        """Names of the fields at the nodes: "displacement", "von_mises", "plastic_strain", ..."""
        return self._native.field_names()

    def field(self, name: str) -> Field:
        """A field at the nodes as it is now, with its unit; the array is yours.

        Shape (n_nodes,); of vectors (n_nodes, 3), X, Y, Z; of stress (n_nodes, 6), XX, YY, ZZ, XY,
        YZ, XZ. Raises billet.Error for a name that is none of field_names.
        """
        found, unit, values = self._native.field(whole_text(name))
        return Field(values, found, unit)

    def fields(self) -> dict[str, Field]:
        """All fields at the nodes by name, which takes hardly longer than one."""
        return {name: Field(values, name, unit) for name, unit, values in self._native.fields()}


class State(_AsItIs):
    """What a run has come to; a copy of it stays as it is.

    run.state is the run's own, which changes as the run goes on, and run.state.copy() a state that
    does not. Units are those of the case.
    """

    def __init__(self, native: _native.Run) -> None:
        """For Run.state, which is the way to have one."""
        self._native = native

    def copy(self) -> State:
        """The state as it is now. The linear solver begins anew, in the run as in the copy.

        Raises billet.Error where a file that the case names is gone.
        """
        return State(self._native.copy())

    __copy__ = copy

    def __deepcopy__(self, memo: Any) -> State:
        return self.copy()

    def run(self) -> Run:
        """A run of its own that goes on from here, without callbacks; the state stays as it is.

        Raises billet.Error where a file that the case names is gone.
        """
        return Run._of(self._native.copy())

    def __repr__(self) -> str:
        at = f"time {self.time:.6g} {self._native.units()['time']}, increment {self.increment}"
        return f"<state at {at}>"


class Run(_AsItIs):
    """A run of a case, in memory: nothing is written to disk.

        for inc in billet.Run(case):
            print(inc.time, inc.forces["punch"])

    A run can be left between two increments in any way (break, an exception of a callback, Ctrl-C)
    and goes on from there. Other threads of Python work while it solves; runs take turns.
    """

    def __init__(
        self,
        case: Case | str | os.PathLike[str],
        set: Mapping[str, Any] | None = None,
        *,
        threads: int = 1,
    ) -> None:
        """Prepares the scene of a case, or of a case file.

        set       changes of the case for this run, {"tool.punch.friction.m": 0.2}
        threads   that work on the run; its bits do not depend on them

        The case may be changed afterwards: the run has its own. Raises billet.Error.
        """
        if not isinstance(case, Case):
            case = Case.load(case, set)
        elif set:
            case = case.copy()
            case.update(set)
        self._prepare(_native.Run(case._native, whole_number("threads", threads)))

    def _prepare(self, native: _native.Run) -> None:
        self._native = native
        self._state = State(native)
        self._columns = native.history_columns()
        self._tools = tuple(native.tools())
        self.callbacks: list[Callback] = []
        """Called after each increment; see on_increment."""

    # --- going on ---------------------------------------------------------------------------

    def __iter__(self) -> Iterator[Increment]:
        """The increments to come: a loop that was left goes on where it was."""
        return self

    def __next__(self) -> Increment:
        try:
            inc = self.advance()
        except StopIteration as error:  # of a callback; a loop would end without a word
            raise RuntimeError("a callback of the run has raised StopIteration") from error
        if inc is None:
            raise StopIteration
        return inc

    def advance(self) -> Increment | None:
        """Solves for one increment, or for as many as a new mesh needs, and calls the callbacks.

        Returns the increment; None: the run had come to its end. An exception of a callback comes
        out of here; the increment is solved all the same, and the run can go on.

        Raises billet.NotConverged if it cannot be solved, billet.Error at a limit of memory.
        """
        status, solved = self._native.advance()
        if solved is None:
            if status == "not-converged":
                raise NotConverged(
                    f"no increment after time {self.time:.6g} {self.units['time']} could be "
                    f"solved: {self._native.reason()}"
                )
            return None
        inc = self._increment(*solved)
        for callback in list(self.callbacks):
            callback(inc)
        return inc

    def finish(self) -> None:
        """Advances to the end. Raises as advance does; Ctrl-C ends it between two increments."""
        while self.advance() is not None:
            pass

    def on_increment(self, callback: Callback) -> Callback:
        """Has a function called after each increment, with the increment; can be a decorator.

        Returns the function; run.callbacks.remove(function) ends it.
        """
        self.callbacks.append(callback)
        return callback

    @property
    def status(self) -> str:
        """ "running", "done" or "not-converged"."""
        return self._native.status()

    @property
    def ended_by(self) -> str:
        """Why a run that is done has ended; "" before.

        "end of time", or before it "full cavity", "tools overloaded", "tools together", "lap" or
        "energy used up".
        """
        return self._native.ended_by()

    @property
    def failed_checks(self) -> list[str]:
        """Checks of `billet run` that the run does not pass as it is now; empty: it can be used."""
        return self._native.failed_checks()

    # --- what has been ----------------------------------------------------------------------

    @property
    def state(self) -> State:
        """What the run has come to: shape, fields, contact, history. It changes as the run goes on.

            saved = run.state.copy()
            run.state = saved               # back to there
            branch = saved.run()            # another run from there

        Raises ValueError for the run's own state, which is no copy, and billet.Error for a state of
        another case, or where a file of the case is gone; the run is then left as it was.
        """
        return self._state

    @state.setter
    def state(self, state: State) -> None:
        if not isinstance(state, State):
            raise TypeError(f"a state is expected, not {type(state).__name__}")
        if state is self._state:
            raise ValueError("run.state changes with the run: keep run.state.copy()")
        self._native.load(state._native.save())

    @property
    def last(self) -> Increment | None:
        """The last increment; None: there has been none."""
        last = self._native.last()
        return None if last is None else self._increment(*last)

    def _increment(self, inc: _native.Increment, row: list[float]) -> Increment:
        return Increment(
            inc.number,
            inc.time,
            inc.length,
            inc.iterations,
            inc.cutbacks,
            inc.residuals,
            inc.events,
            dict(zip(self._columns, row)),
            self._tools,
        )

    @property
    def history(self) -> Table:
        """The increments so far: columns as of history.csv, each of shape (n_increments,)."""
        return Table(dict(zip(self._columns, self._native.history().T)))

    # --- what there is to see ---------------------------------------------------------------

    @property
    def units(self) -> dict[str, str]:
        """Labels of "length", "force", "time", "stress" and "temperature"."""
        return self._native.units()

    @property
    def dimension(self) -> int:
        """2: x, y, or radius and axis; 3: x, y, z."""
        return self._native.dimension()

    @property
    def tools(self) -> tuple[str, ...]:
        """Names of the tools, in the order of the case."""
        return self._tools

    @property
    def forces(self) -> dict[str, Floats]:
        """Of the workpiece on each tool now, shape (3,) [N]; in plane strain per length [N/mm]."""
        return {t: np.array(self._native.tool_force(i)) for i, t in enumerate(self._tools)}

    @property
    def torques(self) -> dict[str, Floats]:
        """Of these forces about each tool's point of rotation, shape (3,) [N mm]."""
        return {t: np.array(self._native.tool_torque(i)) for i, t in enumerate(self._tools)}

    # --- storing ----------------------------------------------------------------------------

    def copy(self) -> Run:
        """Another run that goes on from here; both take the same way, to the bit.

        It has the history so far and no callbacks.
        """
        return Run._of(self._native.copy())

    @classmethod
    def _of(cls, native: _native.Run) -> Run:
        run = cls.__new__(cls)
        run._prepare(native)
        return run

    __copy__ = copy

    def __deepcopy__(self, memo: Any) -> Run:
        return self.copy()

    def save(self) -> bytes:
        """The run as it is now. The linear solver begins anew, here as where it is loaded."""
        return self._native.save()

    def load(self, saved: bytes | bytearray | memoryview) -> None:
        """Goes on from where a run of the same case was saved; history comes with it.

        Raises billet.Error for bytes of another case or version, and leaves the run as it was.
        """
        try:
            self._native.load(bytes(memoryview(saved)))
        except TypeError:
            raise TypeError(f"a saved run is bytes, not {type(saved).__name__}") from None

    def __repr__(self) -> str:
        at = f"time {self.time:.6g} {self.units['time']}, increment {self.increment}"
        return f"<run, {self.status}, {at}>"
