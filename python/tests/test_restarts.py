"""Pickles, copies, states and checkpoints: another process goes on with the same bits."""

import copy
import math
import multiprocessing
import pickle
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import stickslip as ss

YEAR = 365.25 * 86400.0
LAWS = {"a": 0.010, "b": 0.015, "Dc": 1e-5, "damping": 5e6}
MEDIUM = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}


def slider(n: int) -> ss.SpringSlider:
    return ss.SpringSlider(2.5e8, 1e6, V=(1.1 + 0.1 * n) * 1e-6, **LAWS)


def later(task: tuple[ss.SpringSlider, bytes]) -> ss.SliderRun:
    block, state = task
    return block.run(900.0, start=state)


def test_eight_sliders_go_on_in_other_processes() -> None:
    blocks = [slider(n) for n in range(8)]
    # Steps are planned to the end of a run: both have a first part that ends at 300 s.
    states = [block.run(300.0).state for block in blocks]
    here = [block.run(900.0, start=state) for block, state in zip(blocks, states)]
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(2, mp_context=context) as pool:
        there = list(pool.map(later, zip(blocks, states)))
    for one, other in zip(here, there):
        assert one.t[0] == 300.0 and one.V.max() > 1e-3
        assert one.state == other.state
        for name in ("t", "V", "theta", "mu", "slip", "shear_stress"):
            assert (getattr(one, name) == getattr(other, name)).all()


def same(one: object, other: object) -> None:
    assert type(one) is type(other) and repr(one) == repr(other)
    for name in dir(one):
        value = getattr(one, name)
        if isinstance(value, np.ndarray):
            assert np.array_equal(value, getattr(other, name), equal_nan=value.dtype.kind == "f")
        elif isinstance(value, (int, float, str, bytes, dict)) and name != "__doc__":
            assert value == getattr(other, name) or value != value


def line() -> ss.LineFault:
    return ss.LineFault([-1e3, 1e3], 40, space="whole", **MEDIUM)


def patch() -> ss.FaultSimulation:
    fault = line()
    a = np.where(np.abs(fault.centers) < 600.0, 0.010, 0.025)
    friction = {"a": a, "b": 0.015, "Dc": 4e-4, "normal_stress": 50e6, "theta": 4e-4 / 1e-9}
    return fault.simulation(**friction, shear_stress=25e6, plate_rate=1e-9)


def plain(tmp_path: Path) -> list[object]:
    mesh = ss.Mesh.grid([1.0, 1.0], [3, 3])
    body = ss.Body(mesh, E=5e7, nu=0.3, density=5e3)
    body.contact(mesh.part(lambda x: x[1] == 0.0), normal_stress=1e3, a=0.01, b=0.015, Dc=1e-3, theta=1.0)
    state = body.simulation().step(1e-3)
    load = [(0.0, 1e-6), (30.0, 1e-5)]
    step = ss.SpringSlider(1e10, 1e6, a=0.01, b=0.015, Dc=1e-5, load=load).run(60.0, t_eval=np.arange(0.0, 60.0, 0.1))
    fitted = ss.fit(step.t, step.mu, load=load)
    rests = [(0.0, 1e-5), (10.0, 0.0), (20.0, 1e-5), (30.0, 0.0), (130.0, 1e-5)]
    held = ss.SpringSlider(1e10, 1e6, a=0.01, b=0.015, Dc=1e-6, load=rests).run(150.0, t_eval=np.arange(0.0, 150.0, 0.1))
    plane = ss.PlaneFault([-1e3, 1e3], [0.0, 1e3], [4, 2], rake="free", **MEDIUM)
    file = tmp_path / "global.dat"
    file.write_text("# problem\nt max_slip_rate\n0.0 1.0\n1.0 2.0\n")
    return [
        slider(0),
        slider(0).run(100.0),
        line(),
        plane,
        patch().run(YEAR),
        state,
        state.contacts[0],
        fitted,
        ss.healing(held.t, held.mu, load=rests),
        ss.SeasTable(file),
        ss.SeasFiles(tmp_path, "problem", stations=[1.0, 2.0]),
    ]


def test_plain_data_are_pickled_and_copied(tmp_path: Path) -> None:
    for value in plain(tmp_path):
        same(value, pickle.loads(pickle.dumps(value)))
        same(value, copy.copy(value))
        same(value, copy.deepcopy(value))


def test_a_simulation_says_what_to_pickle() -> None:
    with pytest.raises(TypeError, match="state"):
        pickle.dumps(patch())


def test_events_live_over_runs_and_restarts(tmp_path: Path) -> None:
    whole = patch()
    whole.run(10.0 * YEAR)
    assert len(whole.events) >= 2
    event = whole.events[0]
    parts = patch()
    first = parts.run(10.0 * YEAR, every=1, callback=lambda time, rate: rate > 0.1)
    assert len(first.events) == 1 and np.isnan(first.events[0]["arrest"])
    parts.save(tmp_path / "middle")
    state = pickle.loads(pickle.dumps(parts.state()))
    second = parts.run(10.0 * YEAR)
    assert second.events[0]["onset"] == first.events[0]["onset"]
    assert second.events[0]["arrest"] == pytest.approx(event["arrest"], rel=1e-6)
    # Another program.
    loaded, restored = patch(), patch()
    loaded.load(tmp_path / "middle")
    restored.restore(state)
    for other in (loaded, restored):
        assert other.time == first.t[-1] and len(other.events) == 1
        run = other.run(10.0 * YEAR)
        assert (run.slip == second.slip).all() and (run.t == second.t).all()
        assert (other.events == parts.events).all()


def test_files_of_others_are_refused(tmp_path: Path) -> None:
    one = patch()
    one.save(tmp_path / "one")
    other = ss.LineFault([-1e3, 1e3], 41, space="whole", **MEDIUM)
    friction = {"a": 0.01, "b": 0.015, "Dc": 4e-4, "normal_stress": 50e6, "theta": 4e-4 / 1e-9}
    simulation = other.simulation(**friction, shear_stress=25e6)
    with pytest.raises(ss.FileError, match="one"):
        simulation.load(tmp_path / "one")
    with pytest.raises(OSError, match="none"):
        simulation.load(tmp_path / "none")
    (tmp_path / "text").write_text("no checkpoint")
    with pytest.raises(ss.FileError, match="not a checkpoint"):
        simulation.load(tmp_path / "text")
    with pytest.raises(ValueError):
        simulation.restore(one.state())
    with pytest.raises(ValueError, match="state"):
        simulation.restore(b"bytes")


def test_a_body_goes_on_from_a_checkpoint(tmp_path: Path) -> None:
    def begin() -> ss.BodySimulation:
        mesh = ss.Mesh.grid([1.0, 1.0], [4, 4])
        body = ss.Body(mesh, E=5e7, nu=0.3, density=5e3)
        body.drive(mesh.part(lambda x: x[1] == 1.0), [1e-3, 0.0])
        body.contact(mesh.part(lambda x: x[1] == 0.0), normal_stress=1e3, a=0.01, b=0.015, Dc=1e-3, theta=1.0)
        return body.simulation()

    one = begin()
    one.step(1e-3)
    one.save(tmp_path / "body")
    end = one.step(1e-3)
    other = begin()
    other.load(tmp_path / "body")
    assert (other.step(1e-3).velocity == end.velocity).all()


def test_an_event_at_the_start_begins_there() -> None:
    # As BP5: all cells slip at 3 cm/s at time 0.
    rate, normal = 0.03, 5e7
    friction = {"a": 0.01, "b": 0.015, "Dc": 1e-2, "normal_stress": normal, "theta": 1.0}
    strength = math.asinh(rate / 2e-6 * math.exp((0.6 + 0.015 * math.log(1e-6 / 1e-2)) / 0.01))
    stress = normal * 0.01 * strength + 0.5 * MEDIUM["shear_modulus"] / MEDIUM["shear_wave_speed"] * rate
    simulation = line().simulation(**friction, shear_stress=stress, slip_rate=rate)
    run = simulation.run(1e-3)
    assert len(run.events) == 1
    assert run.events[0]["onset"] == 0.0 and np.isnan(run.events[0]["arrest"])
