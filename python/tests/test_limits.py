"""What Rust would end the process for is an exception: memory that cannot be had, counts beyond the integers."""

import numpy as np
import pytest

import stickslip as ss

MEDIUM = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}
LAWS = {"a": 0.010, "b": 0.015, "Dc": 1e-5}
CELLS = {"a": 0.01, "b": 0.015, "Dc": 1e-2, "normal_stress": 5e7, "shear_stress": 3e7, "theta": 1e7}
SQUARE = ss.Mesh.grid([1.0, 1.0], [2, 2])
HUGE = [10**12, 2**62, 2**64 - 1]


@pytest.mark.parametrize("count", HUGE)
@pytest.mark.parametrize(
    ("call", "named"),
    [
        (lambda n: ss.LineFault([0.0, 1e3], n, **MEDIUM), "cells"),
        (lambda n: ss.LineFault([0.0, 1e3], n, poisson_ratio=0.25, dip=30.0, **MEDIUM), "cells"),
        (lambda n: ss.PlaneFault([0.0, 1e3], [0.0, 1e3], [n, n], **MEDIUM), "cells"),
        (lambda n: ss.PlaneFault([0.0, 1e3], [0.0, 1e3], [n, 1], space="whole", **MEDIUM), "cells"),
        (lambda n: ss.Mesh.grid([1.0, 1.0], [n, n]), "cells"),
        (lambda n: ss.Mesh.grid([1.0, 1.0, 1.0], [n, 1, 1]), "cells"),
        (lambda n: SQUARE.refined(n), "levels"),
        (lambda n: ss.velocity_step([1e-6, 1e-5], 3e-4, k=1500.0, samples=n, **LAWS), "samples"),
        (lambda n: ss.slide_hold_slide(1e-6, [10.0], 3e-4, k=1500.0, samples=n, **LAWS), "samples"),
    ],
)
def test_memory_that_cannot_be_had_is_an_error(call: object, named: str, count: int) -> None:
    with pytest.raises(MemoryError, match=f"^{named}: "):
        call(count)  # type: ignore[operator]


def test_planes_that_are_dense_down_dip_count_their_rows() -> None:
    ss.PlaneFault([0.0, 1e3], [0.0, 1e3], [1, 10**5], space="whole", **MEDIUM)
    with pytest.raises(MemoryError, match="cells"):
        ss.PlaneFault([0.0, 1e3], [0.0, 1e3], [10**3, 10**6], **MEDIUM)


@pytest.mark.parametrize("count", [0, 3, 2**62])
def test_states_of_fits_are_one_or_two(count: int) -> None:
    t, mu, load = ss.velocity_step([1e-6, 1e-5], 3e-4, k=1500.0, **LAWS)
    with pytest.raises(ValueError, match="states"):
        ss.fit(t, mu, load=load, states=count)


@pytest.mark.parametrize("count", [2**64, -1, 1.5, "8", None])
def test_counts_are_integers(count: object) -> None:
    with pytest.raises((ValueError, TypeError), match="cells"):
        ss.LineFault([0.0, 1e3], count, **MEDIUM)  # type: ignore[arg-type]


def test_complex_numbers_are_not_cut() -> None:
    fault = ss.LineFault([0.0, 1e3], 8, **MEDIUM)
    with pytest.raises(TypeError) as raised:
        fault.simulation(**{**CELLS, "a": np.full(8, 0.01 + 1j)})
    assert "a" in "".join(getattr(raised.value, "__notes__", [str(raised.value)]))


@pytest.mark.parametrize("kind", [np.float32, np.int64, object])
def test_arrays_of_other_kinds_are_converted(kind: type) -> None:
    fault = ss.LineFault([0.0, 1e3], 8, **MEDIUM)
    values = np.full(8, 2, dtype=kind)
    run = fault.simulation(**{**CELLS, "Dc": values}).run(1e3)
    assert (run.V == fault.simulation(**{**CELLS, "Dc": 2.0}).run(1e3).V).all()


def test_views_are_read_in_their_order() -> None:
    fault = ss.LineFault([0.0, 1e3], 8, **MEDIUM)
    a = np.linspace(0.01, 0.02, 16)
    strided = fault.simulation(**{**CELLS, "a": a[::-2]}).run(1e5).V
    assert (strided == fault.simulation(**{**CELLS, "a": list(a[::-2])}).run(1e5).V).all()


@pytest.mark.parametrize("value", [5e-324, 1e-300, 1e300, 1.7e308])
@pytest.mark.parametrize("name", ["stiffness", "normal_stress", "a", "b", "Dc", "V0", "theta", "V", "damping", "mass", "load"])
def test_extreme_numbers_run_or_are_refused(name: str, value: float) -> None:
    arguments: dict[str, object] = {"stiffness": 1e10, "normal_stress": 1e6, **LAWS, name: value}
    try:
        run = ss.SpringSlider(**arguments).run(10.0, max_steps=500)  # type: ignore[arg-type]
    except (ss.StickslipError, ValueError) as error:
        assert str(error)
    else:
        assert not np.isnan(run.V).any()


def test_a_failed_fault_can_run_again() -> None:
    fault = ss.LineFault([0.0, 10e3], 40, poisson_ratio=0.25, dip=20.0, **MEDIUM)
    arguments = {"a": 0.02, "b": 0.01, "Dc": 1e-2, "normal_stress": 1e4, "theta": 1e7, "shear_stress": 5e3}
    simulation = fault.simulation(**arguments, plate_rate=1e-9)
    for _ in range(2):
        with pytest.raises(ss.StepError):
            simulation.run(1e11)
    # The last accepted step is in place.
    reached = simulation.time
    assert simulation.run(reached + 1.0).t[0] == reached


def test_a_failed_slider_can_run_again() -> None:
    slider = ss.SpringSlider(1e7, 1e6, V=2e-6, **LAWS)
    ends = set()
    for _ in range(2):
        with pytest.raises(ss.StepError) as raised:
            slider.run(1e4, max_steps=20_000)
        ends.add(float(raised.value.partial.t[-1]))
    assert len(ends) == 1
