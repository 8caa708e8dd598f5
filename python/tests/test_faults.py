"""Faults by boundary integrals: BP1-QD, planes, events, callbacks, misuse."""

import csv
import math
import os
import signal
import subprocess
import threading
from pathlib import Path

import numpy as np
import pytest

import stickslip as ss

YEAR = 365.25 * 86400.0
MEDIUM = {"shear_modulus": 32.038120320e9, "shear_wave_speed": 3464.0}
PLATE = 1e-9
NORMAL = 50e6
B, MU0, V0, DC = 0.015, 0.6, 1e-6, 8e-3


def asinh(x: float) -> float:
    """The inverse hyperbolic sine of a positive number, in the operations of Rust's standard library."""
    return math.log1p(x + x / (math.hypot(1.0, 1.0 / x) + 1.0 / x))


def bp1(cell: float = 400.0) -> tuple[ss.LineFault, ss.FaultSimulation]:
    """The benchmark BP1-QD: a vertical strike-slip fault that starts at the plate rate everywhere."""
    fault = ss.LineFault([0.0, 40e3], round(40e3 / cell), **MEDIUM)
    a = [0.010 + (0.025 - 0.010) * min(max((z - 15e3) / 3e3, 0.0), 1.0) for z in fault.centers]
    radiated = 0.5 * MEDIUM["shear_modulus"] / MEDIUM["shear_wave_speed"] * PLATE
    strength = MU0 + B * math.log(V0 / PLATE)
    shear = NORMAL * 0.025 * asinh(PLATE / (2.0 * V0) * math.exp(strength / 0.025)) + radiated
    log_theta = []
    for ak in a:
        y = (shear - radiated) / NORMAL / ak
        friction = ak * (y + math.log1p(-math.exp(-2.0 * y)) + math.log(V0 / PLATE))
        log_theta.append((friction - MU0) / B + math.log(DC / V0))
    friction = {"a": a, "b": B, "Dc": DC, "mu0": MU0, "V0": V0, "normal_stress": NORMAL}
    start = {"shear_stress": shear, "log_theta": log_theta, "slip_rate": PLATE, "plate_rate": PLATE}
    return fault, fault.simulation(**friction, **start)


def test_bp1_is_that_of_the_command_line(tmp_path: Path) -> None:
    program = os.environ.get("STICKSLIP")
    if program is None:
        pytest.skip("STICKSLIP is not set to the program `stickslip`")
    arguments = ["earthquakes", "--cell", "400", "--years", "10", "--full-precision", "--out", str(tmp_path)]
    subprocess.run([program, *arguments], check=True, capture_output=True)
    with open(tmp_path / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    _, simulation = bp1()
    run = simulation.run(10.0 * YEAR, rtol=1e-4, every=1, stops=[255.0, 4095.0])
    # The station at 7.5 km lies between the centres of cells 18 and 19.
    slip = {time: 0.75 * cells[18] + 0.25 * cells[19] for time, cells in zip(run.t, run.slip)}
    found = [(slip.get(float(row["time"])), float(row["slip"])) for row in rows]
    assert len(found) > 20 and all(one is not None for one, _ in found)
    assert all(one == two for one, two in found)


def test_slip_keeps_up_with_the_plates_where_friction_strengthens() -> None:
    fault, simulation = bp1(800.0)
    run = simulation.run(50.0 * YEAR, every=5)
    assert run.V.shape == run.slip.shape == run.theta.shape == (len(run.t), len(fault))
    # At the lower end the fault creeps at the plate rate; slip is the integral of the rate.
    assert run.slip[-1, -1] == pytest.approx(PLATE * 50.0 * YEAR, rel=1e-1)
    mean = 0.5 * (run.V[1:] + run.V[:-1]) * np.diff(run.t)[:, None]
    assert mean.sum(axis=0)[-1] == pytest.approx(run.slip[-1, -1], rel=1e-2)
    assert (run.normal_stress == NORMAL).all() and len(run.events) == 0


def test_events_are_a_structured_array() -> None:
    # A patch that weakens in a line of a whole space, driven by a stress rate.
    fault = ss.LineFault([-1e3, 1e3], 40, space="whole", **MEDIUM)
    x = fault.centers
    a = np.where(np.abs(x) < 600.0, 0.010, 0.025)
    friction = {"a": a, "b": 0.015, "Dc": 4e-4, "normal_stress": 50e6, "theta": 4e-4 / 1e-9}
    start = {"shear_stress": 25e6, "plate_rate": 1e-9}
    run = fault.simulation(**friction, **start).run(10.0 * YEAR, every=20)
    assert len(run.events) >= 2
    assert (run.events["arrest"] > run.events["onset"]).all()
    assert (run.events["peak_slip_rate"] > 1e-2).all()
    moment = MEDIUM["shear_modulus"] * run.events["mean_slip"] * run.events["area"]
    assert run.events["moment"] == pytest.approx(moment)
    assert (np.diff(run.events["onset"]) > 0.0).all()


def plane() -> tuple[ss.PlaneFault, dict[str, object]]:
    fault = ss.PlaneFault([-4e3, 4e3], [0.0, 4e3], [16, 8], dip=60.0, rake=90.0, **MEDIUM)
    friction = {"a": 0.02, "b": 0.015, "Dc": 1e-2, "normal_stress": 50e6, "theta": 1e-2 / 1e-9}
    return fault, {**friction, "shear_stress": 25e6, "plate_rate": 1e-9}


def test_a_plane_dips_and_its_normal_stress_follows_slip() -> None:
    fault, arguments = plane()
    assert fault.centers.shape == (128, 2) and len(fault) == 128
    assert tuple(fault.centers[1] - fault.centers[0]) == (500.0, 0.0)
    run = fault.simulation(**arguments).run(5.0 * YEAR, every=5)
    fields = run.slip[-1].reshape(8, 16)
    # The scene is symmetric along strike.
    assert np.abs(fields - fields[:, ::-1]).max() < 1e-9 * np.abs(fields).max()
    assert np.ptp(run.normal_stress[-1]) > 0.0


def test_a_callback_sees_samples_and_ends_the_run() -> None:
    seen: list[float] = []

    def watch(time: float, rate: float) -> bool:
        assert rate > 0.0
        seen.append(time)
        return len(seen) == 3

    _, simulation = bp1(800.0)
    run = simulation.run(10.0 * YEAR, every=2, callback=watch)
    assert seen == list(run.t[1:]) and run.steps == 6
    assert simulation.time == run.t[-1]
    # The next run goes on.
    assert simulation.run(10.0 * YEAR).t[0] == run.t[-1]


def test_exceptions_of_a_callback_end_the_run() -> None:
    _, simulation = bp1(800.0)
    with pytest.raises(ZeroDivisionError):
        simulation.run(YEAR, callback=lambda time, rate: 1 / 0)
    busy = []

    def again(time: float, rate: float) -> None:
        try:
            simulation.run(YEAR)
        except RuntimeError as error:
            busy.append(str(error))

    simulation.run(YEAR, callback=again)
    assert busy and all("callback" in message for message in busy)


def test_faults_run_in_threads() -> None:
    ends: list[float] = []

    def go() -> None:
        ends.append(float(bp1(800.0)[1].run(5.0 * YEAR).slip[-1, 0]))

    threads = [threading.Thread(target=go) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(ends) == 4 and len(set(ends)) == 1


def test_failed_steps_say_where_and_keep_the_samples() -> None:
    # Without friction to speak of the dip of 5 degrees opens under slip.
    fault = ss.LineFault([0.0, 10e3], 40, poisson_ratio=0.25, dip=20.0, **MEDIUM)
    arguments = {"a": 0.02, "b": 0.01, "Dc": 1e-2, "normal_stress": 1e4, "theta": 1e7}
    start = {"shear_stress": 5e3, "plate_rate": 1e-9}
    with pytest.raises(ss.StepError) as raised:
        fault.simulation(**arguments, **start).run(1000.0 * YEAR)
    error = raised.value
    assert error.kind == "Tension" and error.normal_stress < 0.0 and error.vertex < 40
    assert error.step > 0 and error.time > 0.0
    assert len(error.partial.t) >= 1
    assert "allow_opening=True" in str(error) and "::" not in str(error)


def test_a_run_ends_at_its_largest_number_of_steps() -> None:
    simulation = ss.LineFault(**LINE).simulation(**CELLS)
    with pytest.raises(ss.StepError) as raised:
        simulation.run(1e12, max_steps=5, every=1)
    error = raised.value
    assert error.kind == "TooManySteps" and error.steps == 5
    assert len(error.partial.t) == 6 and "::" not in str(error)
    # Its steps stand, and the next call has its own.
    assert simulation.time == error.partial.t[-1] > 0.0
    with pytest.raises(ss.StepError):
        simulation.run(1e12, max_steps=5)


def test_a_slip_rate_out_of_balance_says_what_to_change() -> None:
    with pytest.raises(ss.SceneError) as raised:
        ss.LineFault(**LINE).simulation(**{**CELLS, "slip_rate": 1.0})
    assert raised.value.kind == "Unbalanced"
    assert "give no slip rate" in str(raised.value)


def test_a_fluid_lowers_the_normal_stress() -> None:
    fault = ss.LineFault([-500.0, 500.0], 50, space="whole", **MEDIUM)
    rim = np.abs(fault.centers)
    arguments = {"a": 0.02, "b": 0.015, "Dc": 1e-3, "normal_stress": 50e6, "shear_stress": 25e6, "theta": 1e6}

    def pressure(time: float) -> np.ndarray:
        return 5e6 * min(time / 1e6, 1.0) * np.exp(-rim / 100.0)

    wet = fault.simulation(**arguments, pressure=pressure).run(1e6, every=5)
    dry = fault.simulation(**arguments, pressure=lambda time: 0.0).run(1e6, every=5)
    assert wet.normal_stress[-1] == pytest.approx(50e6 - pressure(1e6))
    assert (dry.normal_stress == 50e6).all()
    # Slip is largest where the fluid is injected.
    more = wet.slip[-1] - dry.slip[-1]
    assert more.argmax() in (24, 25) and more.max() > 2.0 * more.min()


def test_exceptions_of_a_pressure_are_raised() -> None:
    fault = ss.LineFault([-500.0, 500.0], 8, space="whole", **MEDIUM)
    simulation = fault.simulation(**CELLS, pressure=lambda time: 0.0 if time < 1e3 else 1 / 0)
    with pytest.raises(ZeroDivisionError):
        simulation.run(1e5)
    # The samples up to there are with it.
    try:
        fault.simulation(**CELLS, pressure=lambda time: 0.0 if time < 1e3 else 1 / 0).run(1e5)
    except ZeroDivisionError as error:
        partial = getattr(error, "partial")
        assert 0.0 < partial.t[-1] < 1e3
    with pytest.raises(ValueError, match="pressure"):
        fault.simulation(**CELLS, pressure=lambda time: [1.0])
    with pytest.raises(ValueError, match="pressure"):
        fault.simulation(**CELLS, pressure=3)


def test_an_interruption_ends_a_run_at_a_step() -> None:
    def interrupt(number: int, frame: object) -> None:
        raise KeyboardInterrupt

    _, simulation = bp1()
    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        with pytest.raises(KeyboardInterrupt):
            simulation.run(1e5 * YEAR, rtol=1e-9)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    reached = simulation.time
    assert reached > 0.0
    assert simulation.run(reached + 1e3).t[0] == reached


LINE = {"ends": [0.0, 1e3], "cells": 8, **MEDIUM}
CELLS = {"a": 0.01, "b": 0.015, "Dc": 1e-2, "normal_stress": 5e7, "shear_stress": 3e7, "theta": 1e7}


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"ends": [1e3, 0.0]}, "end"),
        ({"ends": [-1.0, 1.0]}, "depth"),
        ({"ends": [0.0, math.nan]}, "end"),
        ({"ends": [0.0]}, "ends"),
        ({"cells": 0}, "cells"),
        ({"cells": -1}, "cells"),
        ({"cells": 1.5}, "cells"),
        ({"shear_modulus": 0.0}, "shear modulus"),
        ({"shear_modulus": math.inf}, "shear modulus"),
        ({"shear_modulus": "stiff"}, "shear_modulus"),
        ({"shear_wave_speed": -1.0}, "wave speed"),
        ({"space": "quarter"}, "space"),
        ({"poisson_ratio": 0.5}, "Poisson"),
        ({"poisson_ratio": math.nan, "space": "whole"}, "Poisson"),
        ({"poisson_ratio": 0.25, "dip": 0.0}, "dip"),
        ({"poisson_ratio": 0.25, "dip": 95.0}, "dip"),
        ({"dip": 30.0}, "dip"),
        ({"dip": math.nan}, "dip"),
        ({"poisson_ratio": 0.25, "space": "whole", "dip": 30.0}, "dip"),
        ({"poisson_ratio": 0.25, "sense": "up"}, "sense"),
    ],
)
def test_lines_are_checked(changed: dict[str, object], named: str) -> None:
    with pytest.raises((ValueError, TypeError, OverflowError), match=named):
        ss.LineFault(**{**LINE, **changed})  # type: ignore[arg-type]


@pytest.mark.parametrize("wrong", [math.nan, math.inf, [1.0], [[1.0] * 8], "x", {}])
@pytest.mark.parametrize("name", [*CELLS, "log_theta", "mu0", "V0", "slip_rate", "stress_rate"])
def test_cells_are_checked(name: str, wrong: object) -> None:
    with pytest.raises((ValueError, TypeError), match=name):
        ss.LineFault(**LINE).simulation(**{**CELLS, name: wrong})  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["a", "Dc", "theta"])
def test_positive_parameters_are_positive(name: str) -> None:
    for wrong in [0.0, -1.0, [1.0] * 7 + [0.0]]:
        with pytest.raises(ValueError, match=name):
            ss.LineFault(**LINE).simulation(**{**CELLS, name: wrong})  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"until": -1.0}, "until"),
        ({"until": math.nan}, "until"),
        ({"until": "long"}, "until"),
        ({"until": 1.0, "every": 0}, "every"),
        ({"until": 1.0, "rtol": 0.0}, "rtol"),
        ({"until": 1.0, "max_steps": 0}, "max_steps"),
        ({"until": 1.0, "rtol": math.nan}, "rtol"),
        ({"until": 1.0, "callback": 3}, "callback"),
        ({"until": 1.0, "threshold": (0.0, 0.0)}, "threshold"),
        ({"until": 1.0, "threshold": (1e-3, 1e-2)}, "threshold"),
        ({"until": 1.0, "stops": [math.nan]}, "stops"),
    ],
)
def test_runs_are_checked(changed: dict[str, object], named: str) -> None:
    simulation = ss.LineFault(**LINE).simulation(**CELLS)
    with pytest.raises((ValueError, TypeError), match=named):
        simulation.run(**changed)  # type: ignore[arg-type]
