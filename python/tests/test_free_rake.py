"""Planes whose slip has two components."""

import math
from pathlib import Path

import numpy as np
import pytest
from test_faults import MEDIUM, YEAR

import stickslip as ss

COUNT = 8
CELLS = COUNT * COUNT
FRICTION = {"b": 0.015, "Dc": 1e-3, "normal_stress": 50e6, "theta": 1e6}


def square(poisson_ratio: float, rake: object = "free") -> ss.PlaneFault:
    size = [-1e3, 1e3]
    return ss.PlaneFault(size, size, [COUNT, COUNT], space="whole", poisson_ratio=poisson_ratio, rake=rake, **MEDIUM)


def weak(fault: ss.PlaneFault) -> np.ndarray:
    """A patch off the centre that weakens, in rock that strengthens."""
    return np.where(np.hypot(*(fault.centers - [300.0, 100.0]).T) < 600.0, 0.010, 0.025)


def test_without_poissons_effect_an_oblique_load_slips_along_itself() -> None:
    direction = np.array([math.cos(math.radians(30.0)), math.sin(math.radians(30.0))])
    free, fixed = square(0.0), square(0.0, rake=30.0)
    a = weak(free)
    load = {"shear_stress": 28e6, "plate_rate": 1e-9, "stress_rate": 1e-3}
    oblique = {name: value * direction for name, value in load.items()}
    runs = [
        fault.simulation(a=a, **FRICTION, **loads).run(YEAR, every=5, rtol=1e-8)
        for fault, loads in [(free, oblique), (fixed, load)]
    ]
    two, one = runs
    assert two.slip.shape == two.V.shape == two.shear_stress.shape == (len(two), CELLS, 2)
    assert two.theta.shape == two.normal_stress.shape == (len(two), CELLS)
    across = two.slip @ [-direction[1], direction[0]]
    assert np.abs(across).max() < 1e-12 * two.slip.max()
    assert two.slip[-1] @ direction == pytest.approx(one.slip[-1], rel=1e-6)
    assert two.shear_stress[-1] @ direction == pytest.approx(one.shear_stress[-1], rel=1e-6)
    assert np.ptp(one.slip[-1]) > 0.1 * one.slip[-1].max()


def turned(values: np.ndarray) -> np.ndarray:
    """Pairs of cells after a turn by 90 degrees from strike to up dip: rows are down dip."""
    rows = np.rot90(values.reshape(COUNT, COUNT, 2))
    return np.stack([-rows[..., 1], rows[..., 0]], axis=-1).reshape(CELLS, 2)


def test_a_turn_of_the_loads_turns_the_slip() -> None:
    fault = square(0.25)
    a = weak(fault)
    x, y = fault.centers.T
    stress = np.stack([28e6 + 1e3 * y, 3e6 - 2e3 * x], axis=-1)
    rates = 1e-9 * np.stack([1.0 + x / 2e3, y / 4e3], axis=-1)

    def run(a: np.ndarray, stress: np.ndarray, rates: np.ndarray) -> ss.FaultRun:
        simulation = fault.simulation(a=a, **FRICTION, shear_stress=stress, plate_rate=rates)
        return simulation.run(YEAR, every=5, rtol=1e-9)

    straight = run(a, stress, rates)
    rotated = run(np.rot90(a.reshape(COUNT, COUNT)).ravel(), turned(stress), turned(rates))
    scale = np.abs(straight.slip[-1]).max()
    assert np.abs(rotated.slip[-1] - turned(straight.slip[-1])).max() < 1e-7 * scale
    # Both components slip.
    assert np.abs(straight.slip[-1]).max(axis=0).min() > 1e-2 * scale


def test_cells_slide_along_their_shear_stress() -> None:
    fault = ss.PlaneFault([-2e3, 2e3], [0.0, 2e3], [8, 4], dip=40.0, rake="free", **MEDIUM)
    friction = {"a": 0.02, "b": 0.015, "Dc": 1e-2, "normal_stress": 50e6, "theta": 1e7}
    loads = {"shear_stress": [20e6, 18e6], "overstress": lambda time: [2e6, 1e6 * min(time / YEAR, 1.0)]}
    run = fault.simulation(**friction, **loads, plate_rate=[1e-9, 5e-10]).run(YEAR, every=5)
    cosines = (run.V * run.shear_stress).sum(axis=-1)
    lengths = np.linalg.norm(run.V, axis=-1) * np.linalg.norm(run.shear_stress, axis=-1)
    assert cosines == pytest.approx(lengths, rel=1e-9)
    assert np.ptp(run.normal_stress[-1]) > 0.0


def test_files_have_both_components(tmp_path: Path) -> None:
    fault = square(0.25)
    center = fault.centers[27]
    files = ss.SeasFiles(tmp_path, "free", stations=[center], line=[[x, center[1]] for x in (-375.0, 125.0)])
    simulation = fault.simulation(a=weak(fault), **FRICTION, shear_stress=[28e6, 9e6])
    run = simulation.run(YEAR / 10.0, every=1, seas=files)
    (station,) = tmp_path.glob("fltst_*")
    table = ss.SeasTable(station)
    assert table["slip_2"] == pytest.approx(run.slip[:, 27, 0], rel=1e-9)
    # Component 3 is down dip, the second one of slip up dip.
    assert table["slip_3"] == pytest.approx(-run.slip[:, 27, 1], rel=1e-9)
    for name, sign, component in [("slip_2_strike.dat", 1.0, 0), ("slip_3_strike.dat", -1.0, 1)]:
        lines = ss.SeasTable(tmp_path / name)
        assert lines.values[:, -1] == pytest.approx(sign * run.slip[:, fault_cell(fault, 125.0, center[1]), component])
    assert {"stress_2_strike.dat", "stress_3_strike.dat"} < {file.name for file in tmp_path.iterdir()}


def fault_cell(fault: ss.PlaneFault, x: float, y: float) -> int:
    return int(np.hypot(*(fault.centers - [x, y]).T).argmin())


@pytest.mark.parametrize("name", ["shear_stress", "plate_rate", "stress_rate", "slip_rate"])
def test_pairs_are_checked(name: str) -> None:
    fault, fixed = square(0.25), square(0.25, rake=0.0)
    right = {"a": 0.02, **FRICTION, "shear_stress": [28e6, 9e6]}
    one_too_few = np.ones((CELLS - 1, 2))
    not_finite = np.ones((CELLS, 2))
    not_finite[5, 1] = math.nan
    shapes = [1.0, [1.0] * CELLS, [1.0] * 3, one_too_few, np.ones((CELLS, 3)), [[1.0] * 3] * CELLS]
    for wrong in [*shapes, not_finite, [math.nan, 0.0], "x"]:
        with pytest.raises((ValueError, TypeError), match=name):
            fault.simulation(**{**right, name: wrong})
    with pytest.raises(ValueError, match=rf"{name}\[5\]"):
        fault.simulation(**{**right, name: not_finite})
    with pytest.raises(TypeError):
        fault.simulation(**{**right, name: np.ones((CELLS, 2), dtype=complex)})
    for pairs in [[1.0, 0.0], np.ones((CELLS, 2))]:
        with pytest.raises(ValueError, match=name):
            fixed.simulation(**{**right, "shear_stress": 28e6, name: pairs})


@pytest.mark.parametrize("rake", ["any", "", None, [0.0, 1.0], math.nan])
def test_rakes_are_checked(rake: object) -> None:
    with pytest.raises((ValueError, TypeError), match="rake"):
        square(0.25, rake=rake)
