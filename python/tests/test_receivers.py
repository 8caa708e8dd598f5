"""Displacement and stress at points off faults."""

import pickle
from typing import Any

import numpy as np
import pytest

import stickslip as ss

MEDIUM: dict[str, Any] = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}
FRICTION: dict[str, Any] = {"a": 0.015, "b": 0.010, "Dc": 1e-2, "normal_stress": 5e7, "shear_stress": 3e7, "theta": 1e7}
X = np.array([-50e3, -8e3, -1e3, 2e3, 10e3, 80e3])


def test_creep_below_a_locked_fault_is_an_arctangent() -> None:
    """Locked above d, slip of D below: u = (D/pi) atan(x/d), and the stress D mu d / (pi (x^2 + d^2)) at the surface."""
    fault = ss.LineFault([0.0, 15e3], 150, **MEDIUM)
    stations = fault.receivers(np.column_stack([X, 0.0 * X]))
    assert len(stations) == len(X) and stations.points.tolist() == [[x, 0.0, 0.0] for x in X]
    moved = stations.creep(2.0)
    assert moved[:, 1] == pytest.approx(2.0 / np.pi * np.arctan(X / 15e3), abs=1e-12)
    assert not moved[:, [0, 2]].any()
    # What slip of the cells adds to one half of all of it; the stress of a whole plane is zero.
    assert stations.displacement(2.0)[:, 1] == pytest.approx(np.sign(X) - moved[:, 1], abs=1e-12)
    stress = stations.stress(np.full(150, 2.0))
    strain = -2.0 / np.pi * 15e3 / (X**2 + 15e3**2)
    assert stress.shape == (len(X), 3, 3)
    assert stress[:, 0, 1] == pytest.approx(32e9 * strain, rel=1e-9)
    assert abs(stress[:, 2]).max() < 1e-9 * abs(stress).max()


def faults() -> list[tuple[Any, Any, Any]]:
    """A fault of each kind, a point of a cell and the normal there, and the slip of the side of the normal."""
    cos, sin = np.cos(np.radians(60.0)), np.sin(np.radians(60.0))
    dipping = [-cos, 0.0, sin]
    line = ss.LineFault([0.0, 4e3], 4, **MEDIUM)
    thrust = ss.LineFault([0.0, 4e3], 4, poisson_ratio=0.25, dip=60.0, **MEDIUM)
    plane = ss.PlaneFault([-2e3, 2e3], [0.0, 4e3], [4, 4], dip=60.0, rake=0.0, **MEDIUM)
    whole = ss.PlaneFault([-2e3, 2e3], [-2e3, 2e3], [4, 4], space="whole", rake=90.0, **MEDIUM)
    segments = ss.SegmentFault(ss.Segments.down([(60.0, 4e3)], 1e3), poisson_ratio=0.25, **MEDIUM)
    # A strike of 90 degrees is east, and the plane dips south.
    system = ss.FaultSystem([plane], strikes=[90.0], origins=[[0.0, 0.0]])
    corners = [[-2e3, 0.0, -1e3], [2e3, 0.0, -1e3], [2e3, 0.0, -4e3], [-2e3, 0.0, -4e3]]
    surface = ss.SurfaceFault(ss.Triangles(corners, [[0, 1, 2], [0, 2, 3]]), rake=0.0, **MEDIUM)
    up = [0.0, -sin, cos]
    return [
        (line, ([0.0, 0.0, -1.5e3], [1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]),
        (thrust, ([1.5e3 * cos, 0.0, -1.5e3 * sin], [sin, 0.0, cos]), dipping),
        (plane, ([500.0, -1.5e3 * cos, -1.5e3 * sin], up), [1.0, 0.0, 0.0]),
        (whole, ([500.0, 400.0, 0.0], [0.0, 0.0, 1.0]), [0.0, 1.0, 0.0]),
        (segments, ([1.5e3 * cos, 0.0, -1.5e3 * sin], [sin, 0.0, cos]), dipping),
        (system, ([500.0, -1.5e3 * cos, -1.5e3 * sin], up), [1.0, 0.0, 0.0]),
        # Left-lateral: from the south the north moves west.
        (surface, ([500.0, 0.0, -2e3], [0.0, 1.0, 0.0]), [-1.0, 0.0, 0.0]),
    ]


@pytest.mark.parametrize("number", range(7))
def test_displacement_jumps_by_the_slip(number: int) -> None:
    """One metre of slip between two points that are so near that the rock between does not strain; tractions are equal."""
    fault, (place, normal), direction = faults()[number]
    beside = np.array([1e-3, -1e-3])[:, None] * np.array(normal) + np.array(place)
    stations = fault.receivers(beside)
    slip = np.ones(len(fault))
    above, below = stations.displacement(slip)
    assert above - below == pytest.approx(np.array(direction), abs=1e-5)
    tractions = stations.stress(slip) @ np.array(normal)
    assert tractions[0] == pytest.approx(tractions[1], abs=1e-5 * abs(tractions).max())


def test_a_free_rake_has_two_components() -> None:
    fault = ss.PlaneFault([-2e3, 2e3], [1e3, 4e3], [4, 3], rake="free", dip=60.0, **MEDIUM)
    along, up_dip = (ss.PlaneFault([-2e3, 2e3], [1e3, 4e3], [4, 3], rake=rake, dip=60.0, **MEDIUM) for rake in (0.0, 90.0))
    points = [(1e3, 2e3), (-3e3, 500.0)]
    rng = np.random.default_rng(3)
    slip = rng.uniform(size=(5, 12, 2))
    moved = fault.receivers(points).displacement(slip)
    assert moved.shape == (5, 2, 3)
    parts = [each.receivers(points).displacement(slip[..., c]) for c, each in enumerate((along, up_dip))]
    assert moved == pytest.approx(parts[0] + parts[1], abs=1e-14)
    # Of the shape of the fault, at one time.
    assert fault.receivers(points).displacement(slip[1].reshape(3, 4, 2)) == pytest.approx(moved[1])
    assert fault.receivers(points).creep([1.0, 2.0]) == pytest.approx(
        along.receivers(points).creep(1.0) + up_dip.receivers(points).creep(2.0)
    )


def test_histories_follow_slip() -> None:
    fault = ss.LineFault([0.0, 20e3], 20, **MEDIUM)
    stations = fault.receivers([(8e3, 0.0), (-8e3, 0.0)], plate_rate=1e-9)
    cycle = fault.simulation(**FRICTION, plate_rate=1e-9)
    run = cycle.run(1e8, receivers=stations)
    creep = stations.creep(1e-9)
    time = run.t[:, None, None]
    assert run.receiver_displacement == pytest.approx(stations.displacement(run.slip) + creep * time, abs=1e-14)
    assert run.receiver_velocity == pytest.approx(stations.displacement(run.V) + creep, abs=1e-20)
    # Further calls go on, at asked times.
    later = cycle.run(2e8, receivers=stations, t_eval=[1.5e8, 2e8])
    assert later.receiver_displacement.shape == (2, 2, 3)
    assert (later.receiver_displacement[:, 0, 1] > run.receiver_displacement[-1, 0, 1]).all()
    assert cycle.run(3e8).receiver_displacement.shape[1] == 0
    again = pickle.loads(pickle.dumps(run))
    assert (again.receiver_velocity == run.receiver_velocity).all()
    copy = pickle.loads(pickle.dumps(stations))
    assert (copy.points == stations.points).all() and (copy.creep(1.0) == stations.creep(1.0)).all()
    assert (fault.simulation(**FRICTION, plate_rate=1e-9).run(1e8, receivers=copy).receiver_displacement == run.receiver_displacement).all()


def test_wrong_points_and_slips_are_told() -> None:
    fault = ss.LineFault([0.0, 4e3], 4, **MEDIUM)
    with pytest.raises(ss.FaultError, match="10 m above the free surface") as error:
        fault.receivers([(1e3, 0.0), (1e3, 10.0)])
    assert (error.value.kind, error.value.receiver) == ("AboveSurface", 1)  # type: ignore[attr-defined]
    with pytest.raises(ss.FaultError, match="edge of cell"):
        fault.receivers([(0.0, -1e3)])
    with pytest.raises(ss.FaultError, match="periodic"):
        ss.LineFault([0.0, 4e3], 4, space="periodic", **MEDIUM).receivers([(1e3, 0.0)])
    with pytest.raises(ss.ArgumentTypeError, match=r"points: must be an array of shape \(n, 2\) or \(n, 3\)"):
        fault.receivers([1e3, 0.0])
    stations = fault.receivers([(1e3, 0.0)])
    for slip in (np.ones(3), np.ones((4, 1)), np.ones((2, 2, 4))):
        with pytest.raises(ValueError, match="slip must be an array with one for each of 4 cells"):
            stations.displacement(slip)
    with pytest.raises(ValueError, match="slip, cell 2, must be finite"):
        stations.stress([0.0, 0.0, np.nan, 0.0])
    segments = ss.SegmentFault(ss.Segments.down([(60.0, 4e3)], 1e3), poisson_ratio=0.25, **MEDIUM)
    with pytest.raises(ss.FaultError, match="one plane"):
        segments.receivers([(1e3, 0.0)]).creep(1.0)
    other = ss.LineFault([0.0, 4e3], 5, **MEDIUM).simulation(**FRICTION)
    with pytest.raises(ValueError, match="receivers must be those of the fault of the simulation, with 5 cells"):
        other.run(1e6, receivers=stations)
