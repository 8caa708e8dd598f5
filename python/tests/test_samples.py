"""Samples at asked times: against LSODA's dense output, and without influence on steps."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import stickslip as ss

LAWS = {"a": 0.010, "b": 0.015, "Dc": 1e-5, "mu0": 0.6, "V0": 1e-6}
NORMAL, STIFFNESS, DAMPING, LOAD = 1e6, 2.5e8, 5e6, 1e-6


def slider(**changed: float) -> ss.SpringSlider:
    arguments = {"damping": DAMPING, "V": 1.1e-6, **LAWS, **changed}
    return ss.SpringSlider(STIFFNESS, NORMAL, **arguments)  # type: ignore[arg-type]


STEP = [(0.0, 1e-6), (10.0, 1e-5)]


def stepped() -> ss.SpringSlider:
    """A stable slider with a velocity step, without damping."""
    return ss.SpringSlider(1e10, NORMAL, load=STEP, **LAWS)  # type: ignore[arg-type]


def lsoda(times: np.ndarray) -> np.ndarray:
    """ln V and ln theta of the velocity step, by dense output of LSODA."""
    a, b, length = LAWS["a"], LAWS["b"], LAWS["Dc"]

    def part(velocity: float, span: tuple[float, float], start: list[float]) -> Any:
        def rates(_: float, y: np.ndarray) -> list[float]:
            speed, state = np.exp(y)
            aging = 1.0 / state - speed / length
            return [(1e10 * (velocity - speed) / NORMAL - b * aging) / a, aging]

        solved = solve_ivp(rates, span, start, "LSODA", dense_output=True, rtol=3e-13, atol=1e-13)
        assert solved.success and solved.sol is not None
        return solved

    before = part(1e-6, (0.0, 10.0), [math.log(1e-6), math.log(10.0)])
    after = part(1e-5, (10.0, times[-1]), list(before.y[:, -1]))
    return np.where(times < 10.0, before.sol(np.minimum(times, 10.0)), after.sol(np.maximum(times, 10.0)))


@pytest.mark.parametrize("rtol", [1e-4, 1e-6, 1e-8, 1e-10])
def test_samples_are_those_of_lsoda(rtol: float) -> None:
    times = np.linspace(0.0, 100.0, 10_001)
    run = stepped().run(100.0, rtol=rtol, t_eval=times)
    assert (run.t == times).all()
    exact = lsoda(times)
    assert np.abs(np.log(run.theta) - exact[1]).max() < 10.0 * rtol
    assert np.abs(np.log(run.V) - exact[0]).max() < 10.0 * rtol


def test_samples_are_in_balance() -> None:
    times = np.linspace(0.0, 900.0, 2_000)
    run = slider().run(900.0, t_eval=times)
    assert run.V.max() > 1e-3
    start = 0.6 * NORMAL + LAWS["a"] * math.log(1.1) * NORMAL + DAMPING * 1.1e-6
    spring = start + STIFFNESS * (LOAD * times - run.slip)
    assert run.shear_stress + DAMPING * run.V == pytest.approx(spring, rel=1e-9)
    assert run.mu * NORMAL == pytest.approx(run.shear_stress, rel=1e-9)


def test_samples_change_no_step() -> None:
    plain = slider().run(600.0)
    sampled = slider().run(600.0, t_eval=np.linspace(0.0, 600.0, 777))
    assert plain.state == sampled.state and plain.rejected == sampled.rejected


def test_with_mass_steps_end_at_the_times() -> None:
    times = [0.0, 1.0, 2.5, 20.0]
    run = ss.SpringSlider(1e9, 1e6, mass=1e3, damping=5e6, **LAWS).run(20.0, t_eval=times)
    assert list(run.t) == times


MEDIUM = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}


def fault() -> ss.FaultSimulation:
    line = ss.LineFault([-1e3, 1e3], 40, space="whole", **MEDIUM)
    a = np.where(np.abs(line.centers) < 600.0, 0.010, 0.025)
    friction = {"a": a, "b": 0.015, "Dc": 4e-4, "normal_stress": 50e6, "theta": 4e-4 / 1e-9}
    return line.simulation(**friction, shear_stress=25e6, plate_rate=1e-9)


def test_a_fault_is_sampled_inside_of_its_steps() -> None:
    year = 365.25 * 86400.0
    times = np.linspace(0.0, 2.0 * year, 500)
    tight = fault().run(2.0 * year, rtol=1e-10, stops=times, every=1)
    ends = {time: n for n, time in enumerate(tight.t)}
    exact = [ends[time] for time in times]
    plain, sampled = fault(), fault()
    run = sampled.run(2.0 * year, rtol=1e-6, t_eval=times)
    last = plain.run(2.0 * year, rtol=1e-6)
    assert plain.state() == sampled.state() and run.steps == last.steps < 500
    assert run.V.shape == (500, 40) and (run.t == times).all()
    assert np.abs(np.log(run.V / tight.V[exact])).max() < 1e-5
    assert np.abs(np.log(run.theta / tight.theta[exact])).max() < 1e-5
    assert run.shear_stress == pytest.approx(tight.shear_stress[exact], rel=1e-6)


@pytest.mark.parametrize(
    "wrong", [[2.0, 1.0], [-1.0], [math.nan], [11.0], [], 3.0, "often", [[1.0]], dict]
)
def test_times_are_checked(wrong: object) -> None:
    with pytest.raises((ValueError, TypeError)) as refused:
        slider().run(10.0, t_eval=wrong)  # type: ignore[arg-type]
    assert "t_eval" in str(refused.value)
    with pytest.raises((ValueError, TypeError)) as refused:
        fault().run(10.0, t_eval=wrong)  # type: ignore[arg-type]
    assert "t_eval" in str(refused.value)
