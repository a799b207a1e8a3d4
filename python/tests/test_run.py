"""Runs: increments, fields, memory that is kept, copies, callbacks."""

from __future__ import annotations

import copy
import gc
from pathlib import Path

import numpy as np
import pytest

import billet


class Halt(Exception):
    pass


def test_a_loop_takes_every_increment(case: billet.Case) -> None:
    run = billet.Run(case)
    assert (run.status, run.last, len(run.history["time"])) == ("running", None, 0)
    increments = list(run)
    assert [inc.number for inc in increments] == list(range(1, len(increments) + 1))
    assert increments[-1].time == pytest.approx(0.5)
    assert run.status == "done"
    assert run.advance() is None
    assert list(run) == []
    assert run.failed_checks == []
    assert run.ended_by == "end of time"


def test_a_run_that_is_done_is_done_where_it_is_loaded(case: billet.Case) -> None:
    run = billet.Run(case)
    assert run.ended_by == ""
    run.finish()
    other = billet.Run(case)
    other.load(run.save())
    assert (other.status, other.ended_by) == ("done", "end of time")
    longer = billet.Run(case, {"time.end": 0.6})
    longer.load(run.save())
    assert longer.status == "running"
    longer.finish()
    assert longer.time == pytest.approx(0.6)


def test_an_increment_tells_how_it_was_solved(case: billet.Case) -> None:
    inc = next(billet.Run(case))
    assert inc.iterations >= 1
    assert len(inc.residuals) == inc.iterations + 1
    assert inc.residuals[-1] < 1e-5
    assert inc.length == pytest.approx(inc.time)
    assert inc.forces["punch"].shape == (3,)
    assert inc.forces["punch"][1] > 0  # pressed upwards by the part
    assert inc["punch.force_y"] == inc.forces["punch"][1]
    assert inc.displacements["punch"][1] == pytest.approx(-inc.time)
    assert inc["half_height"] == pytest.approx(5 - inc.time, abs=1e-3)
    with pytest.raises(billet.MissingKey, match="did you mean 'half_height'"):
        inc["half_hight"]


def test_history_is_that_of_the_program(case: billet.Case, finished: billet.Results) -> None:
    run = billet.Run(case)
    run.finish()
    assert list(run.history) == list(finished.columns)
    for name in ("time", "punch.force_y", "half_height", "plastic_work"):
        np.testing.assert_allclose(run.history[name], finished.columns[name], rtol=1e-9)


def test_changes_of_a_run_leave_the_case(case: billet.Case, case_file: Path) -> None:
    run = billet.Run(case, {"time.end": 0.1})
    run.finish()
    assert run.time == pytest.approx(0.1)
    assert case["time.end"] == 0.5
    assert billet.Run(case_file, {"time.end": 0.2}).advance() is not None


def test_a_case_may_change_while_a_run_has_its_own(case: billet.Case) -> None:
    run, other = billet.Run(case), billet.Run(case)
    case["tool.punch.friction.m"] = 0.9
    run.finish()
    other.finish()
    assert run.forces["punch"][1] == other.forces["punch"][1]


def test_fields_have_units_and_shapes(case: billet.Case) -> None:
    run = billet.Run(case)
    run.advance()
    n = len(run.positions)
    assert run.dimension == 2
    assert run.positions.shape == (n, 2)
    assert run.elements.shape == (8, 8) and run.elements.max() == n - 1
    stress = run.field("stress")
    assert stress.shape == (n, 6) and stress.unit == "MPa"
    assert run.field("displacement").shape == (n, 3)
    mises = run.field("von_mises")
    assert mises.shape == (n,) and mises.dtype == np.float64
    assert (mises.name, mises.unit) == ("von_mises", "MPa")
    assert mises[2:].unit == "MPa"
    assert type(2 * mises) is np.ndarray and np.sqrt(mises).shape == (n,)
    assert float(mises.max()) > 100
    assert list(run.fields()) == run.field_names
    assert np.array_equal(run.fields()["von_mises"], mises)
    assert run.units["stress"] == "MPa"


def test_von_mises_is_that_of_the_stress(case: billet.Case) -> None:
    """Of one element alone: means at nodes do not mix."""
    case["workpiece.mesh.cells"] = [1, 1]
    case["tool.punch.friction.m"] = 0.0
    run = billet.Run(case)
    run.advance()
    xx, yy, zz, xy, yz, xz = np.asarray(run.field("stress")).T
    mises = np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy**2 + yz**2 + xz**2))
    np.testing.assert_allclose(run.field("von_mises"), mises, rtol=1e-9)


def test_an_unknown_field_suggests_one(case: billet.Case) -> None:
    with pytest.raises(billet.Error, match="did you mean 'von_mises'"):
        billet.Run(case).field("vonmises")


def test_positions_are_the_runs_own_memory_and_stay(case: billet.Case) -> None:
    run = billet.Run(case)
    run.advance()
    first = run.positions
    assert np.shares_memory(first, run.positions)
    with pytest.raises(ValueError):
        first[0, 0] = 1.0
    before, address = first.copy(), first.ctypes.data
    column = first[:, 1]
    run.advance()
    assert first.ctypes.data == address and np.array_equal(first, before)
    assert not np.shares_memory(first, run.positions)
    assert not np.array_equal(first, run.positions)
    del first, run
    gc.collect()
    assert np.array_equal(column, before[:, 1])


def test_elements_stay_with_their_mesh(case: billet.Case) -> None:
    run = billet.Run(case)
    elements = run.elements
    before = elements.copy()
    run.advance()
    assert np.shares_memory(elements, run.elements)
    del run
    gc.collect()
    assert np.array_equal(elements, before)


def test_a_new_mesh_leaves_the_old_arrays(case: billet.Case) -> None:
    case["remesh"] = {"when": {"interval": 0.1}, "size": {"default": 2.5}}
    run = billet.Run(case)
    elements, positions = run.elements, run.positions
    kept = (elements.copy(), positions.copy())
    run.finish()
    assert run.history["remeshings"][-1] >= 1
    assert run.elements.shape[1] == 6 and elements.shape[1] == 8
    assert np.array_equal(elements, kept[0]) and np.array_equal(positions, kept[1])


def test_branches_of_a_state_take_the_way_of_the_run_to_the_bit(case: billet.Case) -> None:
    run = billet.Run(case)
    run.advance()
    state = run.state.copy()
    at, positions = state.time, state.positions.copy()
    strain = state.field("plastic_strain").copy()
    branch, again = state.run(), state.run()
    for one in (run, branch, again):
        one.finish()
    assert run.state.time == run.time > at == state.time
    assert (state.positions == positions).all()
    assert (state.field("plastic_strain") == strain).all()
    assert (run.positions == branch.positions).all() and (run.positions == again.positions).all()
    end = run.positions.copy()
    run.state = state
    assert run.time == at and (run.positions == positions).all()
    assert len(run.history["time"]) == run.increment
    run.finish()
    assert (run.positions == end).all()
    assert repr(state).startswith("<state at time ")
    with pytest.raises(ValueError, match="keep run.state.copy()"):
        run.state = run.state
    with pytest.raises(TypeError, match="a state is expected, not bytes"):
        run.state = run.save()  # type: ignore[assignment]


def test_a_state_outlives_its_run_and_a_failure(case: billet.Case) -> None:
    case.update({"time.end": 6.0, "stop": {"on_tools_overloaded": False, "on_full_cavity": False}})
    case["time.increments"] = {"min": 0.04, "first": 0.5}
    run = billet.Run(case)
    state = copy.deepcopy(run.state)
    with pytest.raises(billet.NotConverged):
        run.finish()
    run.state = state
    assert (run.status, run.time) == ("running", 0.0)
    del run
    assert state.time == 0.0 and state.field("displacement").max() == 0.0
    assert copy.copy(state).run().time == 0.0


def test_a_state_of_another_case_is_refused(case: billet.Case) -> None:
    run, other = billet.Run(case), billet.Run(case, {"workpiece.mesh.cells": [5, 2]})
    other.advance()
    run.advance()
    at = run.time
    with pytest.raises(billet.Error, match="another case|other .* than this case"):
        run.state = other.state
    assert run.time == at
    run.finish()


def test_a_copy_takes_the_same_way_to_the_bit(case: billet.Case) -> None:
    run = billet.Run(case)
    for _ in range(3):
        run.advance()
    branch = run.copy()
    assert (branch.time, branch.increment) == (run.time, run.increment)
    run.finish()
    branch.finish()
    for name in run.history:
        if name != "wall_time":
            assert run.history[name].tobytes() == branch.history[name].tobytes(), name
    for name, field in run.fields().items():
        assert field.tobytes() == branch.fields()[name].tobytes(), name


def test_the_bits_do_not_depend_on_threads(case: billet.Case) -> None:
    runs = [billet.Run(case, threads=n) for n in (1, 2)]
    for run in runs:
        run.finish()
    assert runs[0].positions.tobytes() == runs[1].positions.tobytes()
    for wrong in (0, -1, 2**31, 2**70, 1.5, "2"):
        with pytest.raises(billet.Error, match=f"threads is {wrong!r}; allowed is a whole number"):
            billet.Run(case, threads=wrong)  # type: ignore[arg-type]
    assert billet.Run(case, threads=np.int64(1)).increment == 0  # type: ignore[arg-type]


def test_a_run_is_saved_and_loaded(case: billet.Case) -> None:
    run = billet.Run(case)
    for _ in range(3):
        run.advance()
    saved = run.save()
    run.finish()
    other = billet.Run(case)
    other.load(saved)
    assert (other.increment, len(other.history["time"])) == (3, 3)
    assert other.last is not None and other.last.number == 3
    other.finish()
    assert other.positions.tobytes() == run.positions.tobytes()
    run.load(saved)
    assert run.increment == 3 and run.status == "running"
    run.load(bytearray(saved))
    with pytest.raises(TypeError, match="a saved run is bytes, not str"):
        run.load("text")  # type: ignore[arg-type]


def test_bytes_of_another_case_are_refused_and_nothing_is_lost(case: billet.Case) -> None:
    run = billet.Run(case)
    run.advance()
    saved = run.save()
    for other in (billet.Run(case, {"tool.punch.friction.m": 0.4}), billet.Run(case, {"workpiece.mesh.cells": [5, 2]})):
        other.advance()
        before = other.positions.tobytes()
        with pytest.raises(billet.Error, match="another case"):
            other.load(saved)
        assert other.positions.tobytes() == before
        other.finish()
    flipped = bytearray(saved)
    flipped[len(saved) // 2] ^= 4
    for broken in (b"", b"rubbish", saved[: len(saved) // 2], saved[:40], bytes(flipped)):
        with pytest.raises(billet.Error):
            run.load(broken)
    run.finish()
    assert run.status == "done"


def test_a_run_may_go_on_beyond_the_saved_end(case: billet.Case) -> None:
    run = billet.Run(case)
    run.finish()
    longer = billet.Run(case, {"time.end": 0.6})
    longer.load(run.save())
    longer.finish()
    assert longer.time == pytest.approx(0.6)


def test_an_exception_of_a_callback_leaves_the_run_usable(case: billet.Case) -> None:
    plain = billet.Run(case)
    plain.finish()
    run = billet.Run(case)

    @run.on_increment
    def halt(inc: billet.Increment) -> None:
        if inc.number == 2:
            raise Halt

    with pytest.raises(Halt):
        run.finish()
    assert run.increment == 2
    assert run.field("von_mises").max() > 0
    run.finish()
    assert run.status == "done"
    assert run.positions.tobytes() == plain.positions.tobytes()


def test_callbacks_see_every_increment_in_their_order(case: billet.Case) -> None:
    run, seen = billet.Run(case), []
    first = run.on_increment(lambda inc: seen.append(("a", inc.number)))
    run.on_increment(lambda inc: seen.append(("b", run.copy().increment)))
    next(run)
    run.callbacks.remove(first)
    next(run)
    assert seen == [("a", 1), ("b", 1), ("b", 2)]


def test_a_loop_that_is_left_goes_on(case: billet.Case) -> None:
    run = billet.Run(case)
    for inc in run:
        if inc.time > 0.2:
            break
    assert next(run).number == inc.number + 1


def test_what_cannot_be_solved_is_an_error_and_the_run_can_be_looked_at(case: billet.Case) -> None:
    """Beyond the height of the disk there is no metal left."""
    case.update({"time.end": 6.0, "stop": {"on_tools_overloaded": False, "on_full_cavity": False}})
    case["time.increments"] = {"min": 0.04, "first": 0.5}
    run = billet.Run(case)
    with pytest.raises(billet.NotConverged, match="could be solved: "):
        run.finish()
    assert run.status == "not-converged"
    assert run.field("von_mises").shape == (len(run.positions),)
    with pytest.raises(billet.NotConverged):
        run.advance()


def test_twenty_cases_in_one_process(case: billet.Case) -> None:
    forces = []
    for m in np.linspace(0.0, 0.95, 20):
        case["tool.punch.friction.m"] = m
        run = billet.Run(case)
        run.finish()
        forces.append(run.forces["punch"][1])
    assert np.all(np.diff(forces) > 0) # friction costs force


def test_stop_iteration_of_a_callback_is_not_the_end(case: billet.Case) -> None:
    run = billet.Run(case)

    @run.on_increment
    def halt(inc: billet.Increment) -> None:
        if inc.number in (2, 3):
            raise StopIteration

    with pytest.raises(StopIteration):
        run.finish()
    assert run.increment == 2
    with pytest.raises(RuntimeError, match="a callback of the run has raised StopIteration"):
        list(run)
    assert run.increment == 3
    run.finish()
    assert run.status == "done"
