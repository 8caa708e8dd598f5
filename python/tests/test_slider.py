"""Spring sliders: steady states, bits, threads, misuse."""

import csv
import math
import os
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import stickslip as ss

LAWS = {"a": 0.010, "b": 0.015, "Dc": 1e-5, "mu0": 0.6, "V0": 1e-6}
STEP = [(0.0, 1e-6), (10.0, 1e-5)]


def step(**changed: object) -> ss.SliderRun:
    arguments = {"load": STEP, **LAWS, **changed}
    return ss.SpringSlider(1e10, 1e6, **arguments).run(100.0)  # type: ignore[arg-type]


@pytest.mark.parametrize("law", ["aging", "slip"])
def test_a_velocity_step_ends_in_steady_sliding(law: str) -> None:
    run = step(law=law)
    assert run.mu[0] == pytest.approx(0.6)
    assert run.mu[-1] == pytest.approx(0.6 + (0.010 - 0.015) * math.log(10.0), abs=1e-6)
    assert run.theta[-1] == pytest.approx(1.0, rel=1e-5) and run.V[-1] == pytest.approx(1e-5, rel=1e-5)
    # The direct effect: all but what the spring gives back.
    assert 0.6 + 0.5 * 0.010 * math.log(10.0) < run.mu.max() < 0.6 + 0.010 * math.log(10.0)
    assert len(run) == len(run.t) == len(run.slip) and run.slip[0] == 0.0


def test_a_soft_spring_sticks_and_slips() -> None:
    critical = ss.SpringSlider.critical_stiffness(1e6, a=0.010, b=0.015, Dc=1e-5)
    assert critical == pytest.approx(5e8)
    slider = ss.SpringSlider(0.5 * critical, 1e6, damping=5e6, V=1.1e-6, **LAWS)
    run = slider.run(500.0)
    assert run.V.max() > 1e-3 and run.V.min() < 1e-8


def test_a_block_with_mass_slides_steadily_in_the_end() -> None:
    run = ss.SpringSlider(1e9, 1e6, mass=1e3, damping=5e6, **LAWS, load=STEP).run(200.0)
    assert run.V[-1] == pytest.approx(1e-5, rel=1e-3)


def test_runs_have_the_same_bits_in_threads() -> None:
    alone = step()
    with ThreadPoolExecutor(4) as pool:
        for run in pool.map(lambda _: step(), range(1000)):
            assert (run.V == alone.V).all()


def test_stick_slip_has_the_bits_of_the_command_line(tmp_path: Path) -> None:
    program = os.environ.get("STICKSLIP")
    if program is None:
        pytest.skip("STICKSLIP is not set to the program `stickslip`")
    arguments = ["spring-slider", "stick-slip", "--until", "600", "--max-step", "600", "--full-precision"]
    subprocess.run([program, *arguments, "--out", str(tmp_path)], check=True, capture_output=True)
    with open(tmp_path / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    critical = ss.SpringSlider.critical_stiffness(1e6, a=0.010, b=0.015, Dc=1e-5)
    slider = ss.SpringSlider(0.5 * critical, 1e6, damping=5e6, V=1.01 * 1e-6, **LAWS)
    run = slider.run(600.0, rtol=1e-6)
    columns = {"time": run.t, "slip_rate": run.V, "theta": run.theta, "friction": run.mu, "displacement": run.slip}
    assert run.V.max() > 1e-3 and len(rows) == len(run)
    for name, values in columns.items():
        assert (values == [float(row[name]) for row in rows]).all(), name


def test_a_slip_instability_is_an_error_with_numbers() -> None:
    with pytest.raises(ss.StepError) as raised:
        ss.SpringSlider(1e7, 1e6, V=2e-6, **LAWS).run(1e4, max_steps=20_000)
    error = raised.value
    assert error.kind and error.step > 0 and error.time > 0.0
    assert len(error.partial) > 1 and np.isfinite(error.partial.V).all()


@pytest.mark.parametrize("wrong", [math.nan, math.inf, -1.0, "x", [1.0]])
@pytest.mark.parametrize("name", ["a", "b", "Dc", "mu0", "V0", "damping", "mass", "V", "theta"])
def test_arguments_are_named(name: str, wrong: object) -> None:
    with pytest.raises((ValueError, TypeError), match=name):
        ss.SpringSlider(1e10, 1e6, **{**LAWS, name: wrong})  # type: ignore[arg-type]


@pytest.mark.parametrize("wrong", [math.nan, 0.0, -1.0, "x", None])
@pytest.mark.parametrize("name", ["until", "rtol", "max_steps"])
def test_runs_are_checked(name: str, wrong: object) -> None:
    arguments: dict[str, object] = {"until": 1.0, name: wrong}
    with pytest.raises((ValueError, TypeError), match=name):
        ss.SpringSlider(1e10, 1e6, **LAWS).run(**arguments)  # type: ignore[arg-type]
