"""Fits, synthetic experiments and healing."""

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import stickslip as ss

LAWS = {"a": 0.008, "b": 0.012, "Dc": 1.5e-5, "mu0": 0.6, "V0": 1e-6}


def steps() -> tuple[np.ndarray, np.ndarray, list[tuple[float, float]]]:
    return ss.velocity_step([1e-6, 1e-5, 3e-6], 3e-4, stiffness=1500.0, samples=250, **LAWS)


def test_a_fit_finds_the_parameters_without_a_guess() -> None:
    t, mu, load = steps()
    assert len(t) == len(mu) and load[0] == (0.0, 1e-6)
    mu = mu + 1e-7 * np.random.default_rng(2).standard_normal(len(t))
    fit = ss.fit(t, mu, load=load, stiffness=1500.0)
    for name, exact in [("a", 0.008), ("b1", 0.012), ("L1", 1.5e-5), ("mu0", 0.6)]:
        assert fit[name] == pytest.approx(exact, rel=1e-4)
    assert fit["b"] == fit["b1"] and fit["k"] == 1500.0
    assert fit.rms < 1.2e-7 and not fit.warnings
    assert np.abs(fit.mu - mu).max() < 1e-6 and fit.laws == ["aging"]


@pytest.mark.parametrize("law", ["aging", "slip"])
def test_true_parameters_lie_within_three_standard_errors(law: str) -> None:
    rng = np.random.default_rng(1)
    t, clean, load = ss.velocity_step([1e-6, 1e-5, 3e-6, 3e-5], 2e-4, stiffness=2000.0, law=law, **LAWS)
    within = 0
    for _ in range(40):
        mu = clean + 1e-3 * rng.standard_normal(len(t))
        fit = ss.fit(t, mu, load=load, stiffness=2000.0, law=law)
        truth = {"a": 0.008, "b1": 0.012, "L1": 1.5e-5}
        within += all(abs(fit[n] - exact) < 3.0 * fit.errors[n] for n, exact in truth.items())
        order = list(fit.parameters)
        assert fit.correlation.shape == (len(order), len(order))
        assert np.allclose(np.diag(fit.correlation), 1.0)
    # 99.2 % of draws are expected; 36 of 40 fail to be with a probability below 1e-4.
    assert within >= 37


def test_a_result_prints_as_a_table() -> None:
    t, mu, load = steps()
    fit = ss.fit(t, mu, load=load, trend="time", law="slip")
    assert all(name in str(fit) for name in ["a", "b1", "L1", "k", "mu0", "trend"])
    assert repr(fit).startswith("FitResult(a=")
    with pytest.raises(KeyError, match="b2"):
        fit["b2"]


def test_healing_grows_with_the_logarithm_of_the_hold() -> None:
    t, mu, load = ss.slide_hold_slide(1e-5, [10.0, 100.0, 1000.0], 3e-4, stiffness=1500.0, samples=300, **LAWS)
    healing = ss.healing(t, mu, load=load)
    assert list(healing.duration) == pytest.approx([10.0, 100.0, 1000.0])
    assert (np.diff(healing.healing) > 0.0).all()
    assert 0.0 < healing.rate < 0.012 * math.log(10.0)


def test_a_measured_displacement_is_a_history() -> None:
    t, mu, load = steps()
    velocities = np.array([max((pair for pair in load if pair[0] <= at), key=lambda pair: pair[0])[1] for at in t])
    displacement = np.concatenate([[0.0], np.cumsum(velocities[:-1] * np.diff(t))])
    one = ss.fit(t, mu, load=load, stiffness=1500.0)
    two = ss.fit(t, mu, displacement=displacement, stiffness=1500.0)
    assert two["a"] == pytest.approx(one["a"], rel=1e-2)


def test_fits_run_in_threads() -> None:
    t, mu, load = steps()
    with ThreadPoolExecutor(4) as pool:
        fits = list(pool.map(lambda _: ss.fit(t, mu, load=load, stiffness=1500.0)["a"], range(16)))
    assert len(set(fits)) == 1


T, MU, LOAD = steps()


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"load": None}, "load or displacement"),
        ({"load": []}, "load"),
        ({"load": [(0.0, -1.0)]}, "velocity"),
        ({"load": [(0.0, 1e-6)]}, "velocity"),
        ({"load": [(0.0, 1e-6), (5.0, 1e-5), (1.0, 1e-6)]}, "time"),
        ({"load": None, "displacement": [1.0]}, "displacements"),
        ({"law": "ageing"}, "law"),
        ({"law": ["aging", "slip", "aging"]}, "state"),
        ({"states": 0}, "state"),
        ({"states": 3}, "state"),
        ({"stiffness": -1.0}, "stiffness"),
        ({"stiffness": math.nan}, "stiffness"),
        ({"fixed": {"k": 1000.0}}, "fixed"),
        ({"fixed": {"b": 0.01, "b1": 0.02}}, "fixed"),
        ({"fixed": {"a": 0.01}, "bounds": {"a": (0.001, 0.1)}}, "bounds"),
        ({"fixed": {"a": 0.008, "b": 0.012, "L": 1.5e-5, "mu0": 0.6}}, "free parameters"),
        ({"window": (5.0, 1.0)}, "window"),
        ({"window": (1e9, 2e9)}, "samples"),
        ({"trend": "wavy"}, "trend"),
        ({"weights": [1.0]}, "weights"),
        ({"weights": [-1.0] * len(T)}, "weight"),
        ({"V0": -1.0}, "reference velocity|V0"),
        ({"fixed": {"q": 1.0}}, "q"),
        ({"fixed": {"b2": 1.0}}, "state"),
        ({"bounds": {"a": (2.0, 1.0)}}, "bound"),
        ({"resolution": -1.0, "load": None, "displacement": list(T)}, "resolution"),
    ],
)
def test_misuse_is_named(changed: dict[str, object], named: str) -> None:
    arguments: dict[str, object] = {"load": LOAD, "stiffness": 1500.0, **changed}
    with pytest.raises((ValueError, ss.StickslipError), match=named):
        ss.fit(T, MU, **arguments)  # type: ignore[arg-type]


@pytest.mark.parametrize("mu", [[0.6] * len(T), [], MU[:5], [math.nan] * len(T), "x", None])
def test_records_are_checked(mu: object) -> None:
    with pytest.raises((ValueError, TypeError)):
        ss.fit(T, mu, load=LOAD)  # type: ignore[arg-type]
