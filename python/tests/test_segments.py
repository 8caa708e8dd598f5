"""Faults along polylines."""

import pickle
from pathlib import Path

import numpy as np
import pytest

import stickslip as ss

MEDIUM = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}
CELLS = {"a": 0.015, "b": 0.010, "Dc": 1e-2, "normal_stress": 5e7, "shear_stress": 3e7, "theta": 1e7}


def test_a_straight_line_is_a_dipping_line() -> None:
    segments = ss.Segments.down([(60.0, 10e3)], 500.0)
    assert len(segments) == 20 and segments.faults.tolist() == [0] * 20
    fault = ss.SegmentFault(segments, poisson_ratio=0.25, **MEDIUM)
    line = ss.LineFault([0.0, 10e3], 20, poisson_ratio=0.25, dip=60.0, **MEDIUM)
    assert segments.distances == pytest.approx(line.centers)
    runs = [each.simulation(**CELLS, plate_rate=1e-9).run(1e8) for each in (fault, line)]
    assert runs[0].slip[-1] == pytest.approx(runs[1].slip[-1], rel=1e-6)
    assert runs[0].normal_stress[-1] == pytest.approx(runs[1].normal_stress[-1], rel=1e-6)


def test_slip_displaces_the_surface() -> None:
    """A vertical strike-slip fault from the surface to a depth of D: u = (slip/pi) atan(D/x), by sides of the fault."""
    fault = ss.SegmentFault(ss.Segments([(0.0, 0.0), (0.0, -5e3)]).divided(250.0), **MEDIUM)
    slip, x = np.ones(len(fault)), np.array([-8e3, -1e3, 2e3, 10e3])
    moved = fault.displacement_at(np.column_stack([x, 0 * x]), slip)
    assert moved[:, 1] == pytest.approx(np.arctan(5e3 / x) / np.pi, abs=1e-12)
    stress = fault.stress_at(np.column_stack([x, 0 * x]), slip)
    # Free of traction.
    assert stress.shape == (4, 3, 3) and abs(stress[:, 2]).max() < 1e-6 * abs(stress).max()


def test_one_velocity_loads_faults_that_dip_apart() -> None:
    left = ss.Segments.down([(30.0, 8e3)], 1e3)
    both = left.joined(ss.Segments([(20e3, 0.0), (20e3 + 4e3, -4e3)]).divided(1e3))
    fault = ss.SegmentFault(both, poisson_ratio=0.25, **MEDIUM)
    assert both.faults.tolist() == [0] * 8 + [1] * 6
    rates = fault.along([-1e-9, 0.0, 0.0])
    assert rates[:8] == pytest.approx(1e-9 * np.cos(np.radians(30.0)))
    assert rates[8:] == pytest.approx(1e-9 * np.cos(np.radians(45.0)))
    run = fault.simulation(**CELLS, plate_rate=rates).run(1e6)
    assert run.V.shape[1] == 14


def test_tables_are_read(tmp_path: Path) -> None:
    path = tmp_path / "two.csv"
    path.write_text("x,z,fault\n0,0,1\n1e3,-1e3,1\n5e3,0,2\n5e3,-2e3,2\n")
    segments = ss.Segments.from_csv(path)
    assert [line.tolist() for line in segments.lines] == [[[0.0, 0.0], [1e3, -1e3]], [[5e3, 0.0], [5e3, -2e3]]]
    path.write_text("x,z\n0,nonsense\n")
    with pytest.raises(ss.FaultError, match="line 2"):
        ss.Segments.from_csv(path)
    with pytest.raises(OSError):
        ss.Segments.from_csv(tmp_path / "none.csv")


def test_bends_are_reported_and_spread() -> None:
    sharp = ss.Segments.down([(60.0, 5e3), (30.0, 5e3)], 250.0)
    smooth = ss.Segments.down([(60.0, 5e3), (30.0, 5e3)], 250.0, spread=4e3, start=(1e3, 0.0))
    assert sharp.quality["largest_bend"] == pytest.approx(30.0)
    assert smooth.quality["largest_bend"] < 3.0 and smooth.lines[0][0].tolist() == [1e3, 0.0]


def test_segments_are_pickled_and_say_what_they_are() -> None:
    segments = ss.Segments.down([(60.0, 2e3), (30.0, 2e3)], 500.0)
    fault = ss.SegmentFault(segments, poisson_ratio=0.25, sense="normal", **MEDIUM)
    other = pickle.loads(pickle.dumps(fault))
    assert (other.centers == fault.centers).all() and other.sense == "normal"
    assert (other.segments.lengths == segments.lengths).all()
    assert repr(segments).startswith("Segments(lines=") and repr(fault).startswith("SegmentFault(segments=")


@pytest.mark.parametrize(
    ("lines", "named"),
    [
        ([], "polyline"),
        ([(0.0, 0.0)], "point"),
        ([(0.0, 0.0), (0.0, 0.0)], "length"),
        ([[(0.0, -1.0), (2.0, -1.0)], [(1.0, -2.0), (1.0, 0.0)]], "cross"),
        (3.0, "lines"),
        ([(0.0, 0.0, 0.0)], "lines"),
    ],
)
def test_segments_are_checked(lines: object, named: str) -> None:
    with pytest.raises((ValueError, TypeError), match=named):
        ss.Segments(lines)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"shear_modulus": 0.0}, "shear_modulus"),
        ({"poisson_ratio": 0.5}, "poisson_ratio"),
        ({"space": "periodic"}, "space"),
        ({"sense": "left"}, "sense"),
    ],
)
def test_segment_faults_are_checked(changed: dict[str, object], named: str) -> None:
    segments = ss.Segments([(0.0, 0.0), (0.0, -1e3)])
    with pytest.raises(ValueError, match=named):
        ss.SegmentFault(segments, **{**MEDIUM, **changed})  # type: ignore[arg-type]
    above = ss.Segments([(0.0, 1e3), (0.0, -1e3)])
    with pytest.raises(ss.FaultError, match="above the free surface"):
        ss.SegmentFault(above, **MEDIUM)
