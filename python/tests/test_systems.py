"""Several planes in one half space."""

import pickle

import numpy as np
import pytest

import stickslip as ss

MEDIUM = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}
CELLS = {"a": 0.015, "b": 0.010, "Dc": 1e-2, "normal_stress": 5e7, "shear_stress": 3e7, "theta": 1e7}


def plane(**changed: object) -> ss.PlaneFault:
    return ss.PlaneFault([-2e3, 2e3], [0.0, 2e3], [8, 4], **{**MEDIUM, **changed})  # type: ignore[arg-type]


def test_one_plane_is_a_system() -> None:
    alone = plane().simulation(**CELLS, plate_rate=1e-9).run(1e8)
    system = ss.FaultSystem([plane()], strikes=[30.0], origins=[(1e3, 2e3)])
    run = system.simulation(**CELLS, plate_rate=1e-9).run(1e8)
    assert run.slip[-1] == pytest.approx(alone.slip[-1], rel=1e-6)


def test_slip_relieves_a_parallel_plane() -> None:
    system = ss.FaultSystem([plane(), plane()], strikes=[0.0, 0.0], origins=[(0.0, 0.0), (1e3, 0.0)])
    assert len(system) == 64 and system.ranges == [(0, 32), (32, 64)]
    assert (system.centers[32:] - system.centers[:32] == [1e3, 0.0, 0.0]).all()
    # The first is loaded and slips, the second is not.
    rate = np.where(np.arange(64) < 32, 1.0, 0.0)
    run = system.simulation(**CELLS, stress_rate=rate).run(1e6)
    still = plane().simulation(**CELLS).run(1e6)
    assert run.slip[-1, :32].mean() > run.slip[-1, 32:].mean()
    assert run.slip[-1, 32:].mean() < still.slip[-1].mean()


def test_planes_with_free_rakes() -> None:
    free = plane(rake="free")
    system = ss.FaultSystem([free, free], strikes=[0.0, 90.0], origins=[(0.0, 0.0), (9e3, 0.0)])
    run = system.simulation(**{**CELLS, "shear_stress": [3e7, 1e7]}).run(1e5)
    assert run.slip.shape[1:] == (64, 2) and (run.slip[-1] > 0.0).all()


def test_systems_are_pickled_and_say_what_they_are() -> None:
    system = ss.FaultSystem([plane(), plane()], strikes=[0.0, 0.0], origins=[(0.0, 0.0), (1e3, 0.0)])
    other = pickle.loads(pickle.dumps(system))
    assert (other.centers == system.centers).all() and other.strikes == system.strikes
    assert repr(system).startswith("FaultSystem(planes=")


@pytest.mark.parametrize(
    ("planes", "places", "named"),
    [
        ([], {"strikes": [], "origins": []}, "planes"),
        ([plane()], {"strikes": [], "origins": [(0.0, 0.0)]}, "strikes"),
        ([plane()], {"strikes": [0.0], "origins": [(0.0, 0.0)] * 2}, "origins"),
        ([plane(), plane()], {"strikes": [0.0] * 2, "origins": [(0.0, 0.0)] * 2}, "planes"),
        ([plane(), plane(rake="free")], {"strikes": [0.0] * 2, "origins": [(0.0, 0.0), (1e3, 0.0)]}, "planes"),
        ([plane(space="whole")], {"strikes": [0.0], "origins": [(0.0, 0.0)]}, "planes"),
        ([3], {"strikes": [0.0], "origins": [(0.0, 0.0)]}, "planes"),
        ([plane()], {"strikes": [0.0], "origins": [1e3]}, "origins"),
    ],
)
def test_systems_are_checked(planes: list[object], places: dict[str, object], named: str) -> None:
    with pytest.raises((ValueError, TypeError), match=named):
        ss.FaultSystem(planes, **places)  # type: ignore[arg-type]
