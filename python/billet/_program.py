"""The program billet, for what writes results and makes many runs."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _native
from ._case import Case, _assignments
from ._errors import Error, ProgramError

if TYPE_CHECKING:
    from ._results import Results

FilePath = str | os.PathLike[str]

FAILED_CHECKS = 8  # a run that has come to its end, whose result fails a check


def program() -> Path:
    """The program that is used: of BILLET_PROGRAM, of this package, or of PATH, in this order.

    Raises billet.Error if there is none.
    """
    named = os.environ.get("BILLET_PROGRAM")
    if named:
        found = shutil.which(named)
        if found is None:
            raise Error(f"BILLET_PROGRAM names {named}, which is no program")
        return Path(found)
    package = Path(__file__).parent
    native = Path(str(_native.__file__)).resolve().parent  # in a build the other files are links
    for folder in (package / "bin", native / "../../bin", native / "../../../../bin"):
        file = folder / "billet"
        if os.access(file, os.X_OK):
            return file.resolve()
    found = shutil.which("billet")
    if found is None:
        raise Error("the program billet is not found; BILLET_PROGRAM=FILE names it, or add its folder to PATH")
    return Path(found)


RUNS_ARE_LEFT = 1  # of a study or a chart that a queue makes


def run_program(*words: FilePath, accepted: tuple[int, ...] = (0,)) -> str:
    """Calls the program; returns what it printed.

    Ctrl-C, or whatever else a handler of signals raises, ends it as in a terminal: after a whole
    increment, with what it has so far on disk. Raises billet.ProgramError with what it said.
    """
    command = [os.fsdecode(word) for word in (program(), *words)]
    with subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        errors="surrogateescape",  # names of files may be anything
    ) as process:
        try:
            said, complained = process.communicate()
        except BaseException:
            process.send_signal(signal.SIGINT)
            process.communicate()
            raise
    if process.returncode not in accepted:
        raise ProgramError(_message(complained, process.returncode), process.returncode)
    return said


def _message(complained: str, status: int) -> str:
    text = complained.strip().removeprefix("billet: ")
    if status < 0:
        name = signal.Signals(-status).name
        return f"billet was ended by {name}" + (f": {text}" if text else "")
    return text or f"billet has ended with status {status}"


def options(
    *,
    output: FilePath | None = None,
    set: Mapping[str, Any] | None = None,
    processes: int | None = None,
    threads: int | None = None,
    again: bool = False,
) -> list[str]:
    """Words of the command line."""
    words: list[str] = []
    if output is not None:
        words += ["-o", as_operand(output)]
    for assignment in _assignments(set):
        words += ["--set", assignment]
    if processes is not None:
        words += ["--processes", str(processes)]
    if threads is not None:
        words += ["--threads", str(threads)]
    return [*words, "--again"] if again else words


def expanded(path: FilePath) -> Path:
    """A path whose ~/ is the home folder, as the program takes it."""
    return Path(os.fsdecode(path)).expanduser()


def as_operand(file: FilePath) -> str:
    """A file's name as the program takes it for one, though it begins with '-'."""
    name = os.fsdecode(file)
    return os.path.join(os.curdir, name) if name.startswith("-") else name


def folder_of(said: str, output: FilePath | None = None) -> Path:
    """The folder of results: as asked for, or where the program says they are."""
    if output is not None:
        return expanded(output)
    lines = [line for line in said.splitlines() if line.startswith("results: ")]
    if not lines:
        raise Error(f"billet does not say where its results are:\n{said}")
    return Path(lines[-1].removeprefix("results: "))


def simulate(
    case: Case | FilePath,
    output: FilePath | None = None,
    *,
    set: Mapping[str, Any] | None = None,
    threads: int | None = None,
    allow_outside: bool = False,
) -> Results:
    """Runs a case by the program, with everything it writes: `billet run`.

    case            a case file, or a Case, which is written to a file for it: OUTPUT.toml, or, if
                    it names files relative to its folder, NAME.toml or NAME-2.toml ... in there
    output          folder of the results; by default results/NAME as of `billet run`
    set             changes, {"tool.punch.friction.m": 0.2}
    threads         by default all of the machine
    allow_outside   the case may name files outside of its folder; a Case knows by itself

    Returns billet.results of the folder. Raises billet.ProgramError with the status of the program;
    billet.Error if there is an OUTPUT.toml that billet.simulate has not written. A run that fails a
    check is returned, see Results.failed_checks.
    """
    from ._results import results

    if isinstance(case, Case):
        if output is None:
            raise Error("simulate: a case in memory needs output, the folder of its results")
        if set:
            case = case.copy()
            case.update(set)
            set = None  # the file has it
        allow_outside = allow_outside or case._allow_outside
        case = _written(case, expanded(output))
    words = options(output=output, set=set, threads=threads)
    if allow_outside:
        words.append("--allow-outside")
    said = run_program("run", as_operand(case), "--quiet", *words, accepted=(0, FAILED_CHECKS))
    return results(folder_of(said, output))


_WRITTEN = "# Written by billet.simulate for "


def _written(case: Case, output: Path) -> Path:
    """The file that a case is written to for results in a folder. Raises billet.Error."""
    if output.name in ("", ".."):
        raise Error(f"simulate: output is '{output}'; needed is the name of a folder, such as results/a")
    if _names_files(case):
        folder, candidates = Path(case._native.folder() or "."), 1000
    else:
        folder, candidates = output.parent, 1
    text = case.text.removeprefix("\ufeff")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        words = os.path.relpath(output, folder)
        mark = _WRITTEN + json.dumps(words) + ", which writes it anew.\n"
        for i in range(1, candidates + 1):
            file = folder / f"{output.name}{f'-{i}' if i > 1 else ''}.toml"
            if _write(file, mark, text):
                return file
    except OSError as error:
        raise Error(f"simulate: {error.filename or folder}: {error.strerror}") from None
    raise Error(f"simulate: {file} is there already, and not by billet.simulate; choose another output")


def _names_files(case: Case) -> bool:
    """Whether a case names files relative to its folder: it is none in an empty one."""
    with tempfile.TemporaryDirectory() as empty:
        try:
            _native.Case.from_text(case.text, empty, case._allow_outside)
        except Error:
            return True
    return False


def _write(file: Path, mark: str, text: str) -> bool:
    """Writes a mark and a text. False: there is such a file, and it does not begin with the mark."""
    try:
        with file.open("x", encoding="utf-8") as stream:
            stream.write(mark + text)
    except FileExistsError:
        with file.open("rb") as old:
            if old.readline() != mark.encode():
                return False
        file.write_text(mark + text, encoding="utf-8")
    return True
