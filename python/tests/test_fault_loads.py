"""Loads of faults: plate rates per cell, stress rates, overstresses in time."""

import math

import numpy as np
import pytest
from test_faults import CELLS, LINE, MEDIUM, YEAR, asinh

import stickslip as ss

RATE = 1e-9
STRENGTHENING = {"a": 0.02, "b": 0.01, "Dc": 1e-2, "normal_stress": 50e6}
FAULTS = {
    "line": lambda: ss.LineFault([0.0, 4e3], 20, **MEDIUM),
    "periodic": lambda: ss.LineFault([0.0, 4e3], 20, space="periodic", **MEDIUM),
    "dipping": lambda: ss.LineFault([0.0, 4e3], 20, poisson_ratio=0.25, dip=30.0, sense="normal", **MEDIUM),
    "plane": lambda: ss.PlaneFault([-1e3, 1e3], [0.0, 1e3], [5, 4], dip=60.0, rake=90.0, **MEDIUM),
    "whole": lambda: ss.PlaneFault([-1e3, 1e3], [0.0, 1e3], [5, 4], space="whole", rake=30.0, **MEDIUM),
}
FIELDS = ["t", "V", "slip", "theta", "shear_stress", "normal_stress"]


def same(one: ss.FaultRun, two: ss.FaultRun) -> bool:
    return all(np.array_equal(getattr(one, field), getattr(two, field)) for field in FIELDS)


@pytest.mark.parametrize("kind", FAULTS)
def test_equal_plate_rates_have_the_bits_of_one(kind: str) -> None:
    fault = FAULTS[kind]()
    arguments = {**STRENGTHENING, "shear_stress": 27e6, "theta": 1e7}
    one = fault.simulation(**arguments, plate_rate=RATE).run(5.0 * YEAR, every=1)
    each = fault.simulation(**arguments, plate_rate=np.full(20, RATE)).run(5.0 * YEAR, every=1)
    assert len(one) > 10 and same(one, each)


@pytest.mark.parametrize("kind", FAULTS)
def test_cells_that_creep_at_their_plate_rates_keep_their_stress(kind: str) -> None:
    fault = FAULTS[kind]()
    rates = RATE * np.linspace(0.5, 2.0, 20)
    a, b, slip_distance, normal = STRENGTHENING.values()
    radiated = 0.5 * MEDIUM["shear_modulus"] / MEDIUM["shear_wave_speed"] * rates
    # Steady friction, theta = Dc/V, and the waves that leave the fault.
    exponents = [(0.6 + b * math.log(1e-6 / rate)) / a for rate in rates]
    friction = [a * asinh(rate / 2e-6 * math.exp(y)) for rate, y in zip(rates, exponents)]
    start = {"shear_stress": normal * np.array(friction) + radiated, "theta": slip_distance / rates}
    simulation = fault.simulation(**STRENGTHENING, **start, slip_rate=rates, plate_rate=rates)
    run = simulation.run(20.0 * YEAR, rtol=1e-9)
    assert run.slip[-1] == pytest.approx(rates * 20.0 * YEAR, rel=1e-7)
    assert run.V[-1] == pytest.approx(rates, rel=1e-7)
    # The normal stress follows slip less back slip.
    assert run.normal_stress[-1] == pytest.approx(normal, rel=1e-7)


def test_an_overstress_that_grows_is_a_stress_rate() -> None:
    # Cells of 64 m, so that forces are stresses without rounding.
    fault = ss.LineFault([0.0, 512.0], 8, **MEDIUM)
    rates = np.linspace(0.01, 0.03, 8)
    one = fault.simulation(**CELLS, stress_rate=rates).run(YEAR, every=1)
    two = fault.simulation(**CELLS, overstress=lambda time: rates * time).run(YEAR, every=1)
    assert len(one) > 10 and same(one, two)


@pytest.mark.parametrize("kind", FAULTS)
def test_an_overstress_adds_to_the_shear_stress(kind: str) -> None:
    fault = FAULTS[kind]()
    arguments = {**STRENGTHENING, "theta": 1e7}
    one = fault.simulation(**arguments, shear_stress=28e6).run(YEAR, every=5)
    two = fault.simulation(**arguments, shear_stress=26e6, overstress=lambda time: 2e6).run(YEAR, every=5)
    assert two.slip[-1] == pytest.approx(one.slip[-1], rel=1e-6)
    assert two.shear_stress[-1] == pytest.approx(one.shear_stress[-1], rel=1e-9)


def test_loads_are_checked() -> None:
    fault = ss.LineFault(**LINE)
    for wrong in [math.nan, math.inf, [1e-9] * 7, [1e-9] * 7 + [math.nan], "fast", [[1e-9] * 8]]:
        with pytest.raises((ValueError, TypeError), match="plate_rate"):
            fault.simulation(**CELLS, plate_rate=wrong)
    with pytest.raises(ValueError, match="overstress"):
        fault.simulation(**CELLS, overstress=1e6)
    for value in [math.nan, [1.0], [0.0] * 7 + [math.inf]]:
        with pytest.raises(ValueError, match="the value of overstress"):
            fault.simulation(**CELLS, overstress=lambda time, value=value: value)
    simulation = fault.simulation(**CELLS, overstress=lambda time: 0.0 if time < 1e3 else 1 / 0)
    with pytest.raises(ZeroDivisionError):
        simulation.run(1e5)
    assert 0.0 < simulation.time <= 1e3
