"""The module in a process of Python's: signals, threads, memory, other libraries."""

from __future__ import annotations

import ctypes
import gc
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import billet

# Seconds of work on any machine: no run of these ends before it is interrupted.
MANY_INCREMENTS = {"time.increments.max": 0.001, "workpiece.mesh.cells": [48, 24]}


def resident() -> float:
    """Memory of this process [MB]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def interrupt_after(seconds: float) -> threading.Timer:
    timer = threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    return timer


@pytest.mark.parametrize("way", ["finish", "loop"])
def test_ctrl_c_ends_a_run_between_increments(case: billet.Case, way: str) -> None:
    run = billet.Run(case, MANY_INCREMENTS)
    timer = interrupt_after(0.3)
    with pytest.raises(KeyboardInterrupt):
        if way == "finish":
            run.finish()
        else:
            for _ in run:
                pass
    timer.join()
    done = run.increment
    assert 0 < done < 500 and run.status == "running"
    assert len(run.history["time"]) == done
    same = billet.Run(case, MANY_INCREMENTS)
    while same.increment < done + 2:
        same.advance()
    while run.increment < done + 2:
        run.advance()
    assert run.positions.tobytes() == same.positions.tobytes()


def test_other_threads_work_while_a_run_solves(case: billet.Case) -> None:
    """One increment of a larger part takes long: the interpreter is not held meanwhile."""
    run = billet.Run(case, {"workpiece.mesh.cells": [80, 40]})
    ticks: list[float] = []
    stop = threading.Event()

    def tick() -> None:
        while not stop.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.005)

    thread = threading.Thread(target=tick)
    thread.start()
    begun = time.perf_counter()
    run.advance()
    ended = time.perf_counter()
    stop.set()
    thread.join()
    inside = [t for t in ticks if begun < t < ended]
    assert ended - begun > 0.1
    assert len(inside) > (ended - begun) / 0.1


def test_runs_in_several_threads_take_turns(case: billet.Case) -> None:
    alone = billet.Run(case)
    alone.finish()
    runs = [billet.Run(case) for _ in range(4)]
    threads = [threading.Thread(target=run.finish) for run in runs]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        _ = [(run.time, run.positions.sum()) for run in runs]  # looked at meanwhile
        time.sleep(0.001)
    for run in runs:
        assert run.positions.tobytes() == alone.positions.tobytes()


def growth(case: billet.Case, runs: int) -> float:
    """Memory that so many runs leave behind, after some to warm up [MB]."""
    small = {"workpiece.mesh.cells": [2, 1], "time.end": 0.1}

    def make(n: int) -> None:
        for i in range(n):
            run = billet.Run(case, {**small, "tool.punch.friction.m": 0.001 * (i % 900)})
            run.finish()
            run.copy().field("stress")
        gc.collect()

    make(50)
    before = resident()
    make(runs)
    return resident() - before


def test_runs_leave_no_memory_behind(case: billet.Case) -> None:
    assert growth(case, 150) < 5.0


@pytest.mark.long
def test_a_thousand_runs_leave_no_memory_behind(case: billet.Case) -> None:
    assert growth(case, 1000) < 10.0


def test_numpy_keeps_its_threads_and_its_small_numbers(case: billet.Case) -> None:
    blas = ctypes.CDLL("libopenblas.so.0")
    blas.openblas_set_num_threads(2)
    billet.Run(case).finish()
    assert blas.openblas_get_num_threads() == 2
    tiny = np.array([1e-310])
    assert (tiny * 1.0)[0] == 1e-310
    a = np.random.default_rng(1).normal(size=(200, 200))
    np.testing.assert_allclose(np.linalg.inv(a) @ a, np.eye(200), atol=1e-8)


def test_the_library_shows_nothing_but_its_own_classes() -> None:
    maps = Path("/proc/self/maps").read_text().split()
    library = next(word for word in maps if "libbillet.so" in word)
    shown = subprocess.run(
        ["nm", "-DC", "--defined-only", library], capture_output=True, text=True, check=True
    ).stdout
    names = [line.split(maxsplit=2)[2] for line in shown.splitlines()]
    strange = [name for name in names if "billet::" not in name]
    assert strange == []


def test_vtk_in_the_same_process(case: billet.Case, finished: billet.Results) -> None:
    pytest.importorskip("vtkmodules")
    finished.frames[-1].arrays()
    billet.Run(case).finish()


def test_without_the_package_numpy_first(tmp_path: Path) -> None:
    """In whichever order both are imported, both work."""
    for order in ("numpy, billet", "billet, numpy"):
        code = f"import {order}; print(numpy.ones((9, 9)) @ numpy.ones(9), billet.__version__)"
        subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)


def test_a_run_that_is_dropped_does_not_hold_the_interpreter(case: billet.Case) -> None:
    """A run is freed in its turn, while another one solves and a third thread works."""
    run = billet.Run(case, {"workpiece.mesh.cells": [60, 30]})
    solver = threading.Thread(target=run.finish)
    solver.start()
    for _ in range(5):
        other = billet.Run(case)
        del other
    solver.join()
    assert run.status == "done"


def test_an_increment_is_seen_as_a_whole_from_another_thread(case: billet.Case) -> None:
    run = billet.Run(case, {**MANY_INCREMENTS, "time.end": 0.1})
    solver = threading.Thread(target=run.finish)
    solver.start()
    seen = 0
    while solver.is_alive():
        inc = run.last
        if inc is not None:
            assert inc["time"] == inc.time
            seen += 1
    solver.join()
    assert seen > 0


@pytest.mark.parametrize("n_threads", [1, 3])
def test_python_ends_while_threads_solve(n_threads: int) -> None:
    """After the increment under way, without a word; what is left behind can still be used."""
    code = f"""
import atexit, sys, threading, time
sys.path.insert(0, {str(Path(__file__).parent)!r})
left = []
atexit.register(lambda: left[0].advance())  # after billet's own, which is registered later
import billet
from conftest import DISK
case = billet.Case.from_string(DISK)
case.update({MANY_INCREMENTS!r})
left += [billet.Run(case) for _ in range({n_threads} + 1)]
for run in left[1:]:
    threading.Thread(target=run.finish, daemon=True).start()
time.sleep(0.3)
print("the end")
"""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "the end\n", "")
