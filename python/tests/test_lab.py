"""Fits, synthetic experiments and healing."""

import math
import os
import signal
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import stickslip as ss

LAWS = {"a": 0.008, "b": 0.012, "Dc": 1.5e-5, "mu0": 0.6, "V0": 1e-6}


def steps() -> tuple[np.ndarray, np.ndarray, list[tuple[float, float]]]:
    return ss.velocity_step([1e-6, 1e-5, 3e-6], 3e-4, k=1500.0, samples=250, **LAWS)


def test_a_fit_finds_the_parameters_without_a_guess() -> None:
    t, mu, load = steps()
    assert len(t) == len(mu) and load[0] == (0.0, 1e-6)
    mu = mu + 1e-7 * np.random.default_rng(2).standard_normal(len(t))
    fit = ss.fit(t, mu, load=load, k=1500.0)
    for name, exact in [("a", 0.008), ("b1", 0.012), ("L1", 1.5e-5), ("mu0", 0.6)]:
        assert fit[name] == pytest.approx(exact, rel=1e-4)
    assert fit["b"] == fit["b1"] and fit["k"] == 1500.0
    assert fit.rms < 1.2e-7 and not fit.warnings
    assert np.abs(fit.mu - mu).max() < 1e-6 and fit.laws == ["aging"]


@pytest.mark.parametrize("law", ["aging", "slip"])
def test_true_parameters_lie_within_three_standard_errors(law: str) -> None:
    rng = np.random.default_rng(1)
    t, clean, load = ss.velocity_step([1e-6, 1e-5, 3e-6, 3e-5], 2e-4, k=2000.0, law=law, **LAWS)
    within = 0
    for _ in range(40):
        mu = clean + 1e-3 * rng.standard_normal(len(t))
        fit = ss.fit(t, mu, load=load, k=2000.0, law=law)
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
    t, mu, load = ss.slide_hold_slide(1e-5, [10.0, 100.0, 1000.0], 3e-4, k=1500.0, samples=300, **LAWS)
    healing = ss.healing(t, mu, load=load)
    assert list(healing.duration) == pytest.approx([10.0, 100.0, 1000.0])
    assert (np.diff(healing.healing) > 0.0).all()
    assert 0.0 < healing.rate < 0.012 * math.log(10.0)


def test_a_measured_displacement_is_a_history() -> None:
    t, mu, load = steps()
    velocities = np.array([max((pair for pair in load if pair[0] <= at), key=lambda pair: pair[0])[1] for at in t])
    displacement = np.concatenate([[0.0], np.cumsum(velocities[:-1] * np.diff(t))])
    one = ss.fit(t, mu, load=load, k=1500.0)
    two = ss.fit(t, mu, displacement=displacement, k=1500.0)
    assert two["a"] == pytest.approx(one["a"], rel=1e-2)


def test_lengths_in_a_wrong_unit_are_warned_of() -> None:
    t, mu, load = steps()
    places = np.concatenate([[0.0], np.cumsum([v * dt for (_, v), dt in zip(load, np.diff([*[s for s, _ in load], t[-1]]))])])
    displacement = np.interp(t, [*[start for start, _ in load], t[-1]], places)
    right = ss.fit(t, mu, displacement=displacement, k=1500.0)
    assert [v for _, v in right.load] == pytest.approx([1e-6, 1e-5, 3e-6], rel=1e-3) and not right.warnings
    wrong = ss.fit(t, mu, displacement=1e6 * displacement)
    assert any("metres" in warning for warning in wrong.warnings) and "1.000e1 m/s" in str(wrong)


def test_fits_run_in_threads() -> None:
    t, mu, load = steps()
    with ThreadPoolExecutor(4) as pool:
        fits = list(pool.map(lambda _: ss.fit(t, mu, load=load, k=1500.0)["a"], range(16)))
    assert len(set(fits)) == 1


def test_laws_by_name_are_those_of_the_slider() -> None:
    # Velocity steps of a slider with the same laws, quasi-static.
    further = {"kato-tullis": {"Vc": 1e-8}, "nagata": {"c": 2.0}}
    for law in ["aging", "slip", "perrin-rice-zheng", "kato-tullis", "nagata"]:
        laws = {**LAWS, "a": 0.03, "b": 0.033} if law == "nagata" else LAWS
        t, mu, load = ss.velocity_step([1e-6, 5e-6, 2e-6], 2e-4, k=3000.0, law=law, samples=100, **laws)
        slider = ss.SpringSlider(3e9, 1e6, law=law, load=load, **laws, **further.get(law, {}))
        run = slider.run(t[-1], rtol=1e-9, t_eval=t)
        assert np.abs(run.mu - mu).max() < 1e-7, law


def test_parameters_of_laws_are_fitted_by_name() -> None:
    laws = {**LAWS, "a": 0.03, "b": 0.033, "Dc": 5e-6}
    t, clean, load = ss.velocity_step([1e-6, 1e-5, 3e-6], 3e-4, k=1500.0, law="nagata", **laws)
    mu = clean + 1e-4 * np.random.default_rng(3).standard_normal(len(t))
    fit = ss.fit(t, mu, load=load, k=1500.0, law="nagata", free=["c1"])
    for name, exact in [("a", 0.03), ("b1", 0.033), ("L1", 5e-6), ("c1", 2.0)]:
        assert abs(fit[name] - exact) < 4.0 * fit.errors[name]
    held = ss.fit(t, mu, load=load, k=1500.0, law="nagata")
    assert held["c"] == 2.0 and "c1" not in held.errors


def test_stiffness_and_normal_stress_are_k() -> None:
    t, mu, load = steps()
    same = ss.velocity_step(
        [1e-6, 1e-5, 3e-6], 3e-4, stiffness=1.5e9, normal_stress=1e6, samples=250, **LAWS
    )
    assert (same[1] == mu).all()
    fit = ss.fit(t, mu, load=load, stiffness=1.5e9, normal_stress=1e6)
    assert fit["k"] == 1500.0
    with pytest.raises(ValueError, match="normal_stress"):
        ss.velocity_step([1e-6, 1e-5], 3e-4, stiffness=1.5e9, **LAWS)
    with pytest.raises(ValueError, match="k"):
        ss.velocity_step([1e-6, 1e-5], 3e-4, **LAWS)


def test_steps_at_displacements_have_the_times_of_their_velocities() -> None:
    t, mu, load = steps()
    one = ss.fit(t, mu, load=load, k=1500.0)
    starts = [time for time, _ in load]
    velocities = np.array([velocity for _, velocity in load])
    at = np.searchsorted(starts[1:], t, side="left")
    places = np.concatenate([[0.0], np.cumsum(velocities[:-1] * np.diff(starts))])
    displacement = places[at] + velocities[at] * (t - np.array(starts)[at])
    steps_at = list(zip(places, velocities))
    two = ss.fit(None, mu, displacement=displacement, steps_at=steps_at, k=1500.0)
    assert two["L1"] == pytest.approx(one["L1"], rel=1e-6)


def three() -> list[dict[str, object]]:
    rng = np.random.default_rng(7)
    records = []
    for k, mu0 in [(900.0, 0.6), (1500.0, 0.63), (4000.0, 0.58)]:
        t, mu, load = ss.velocity_step([1e-6, 1e-5, 3e-6], 3e-4, k=k, **{**LAWS, "mu0": mu0})
        records.append({"t": t, "mu": mu + 1e-3 * rng.standard_normal(len(t)), "load": load})
    return records


def test_several_records_share_friction() -> None:
    records = three()
    joint = ss.joint_fit(records)
    truth = {"a": 0.008, "b1": 0.012, "L1": 1.5e-5, "k[0]": 900.0, "k[1]": 1500.0, "k[2]": 4000.0, "mu0[1]": 0.63}
    for name, exact in truth.items():
        assert abs(joint[name] - exact) < 4.0 * joint.errors[name], name
    assert joint.correlation.shape == (9, 9) and len(joint) == 3 and not joint.interrupted
    assert joint.records[2]["k"] == joint["k[2]"] and joint.records[0].errors["a"] == joint.errors["a"]
    alone = ss.fit(**records[1])  # type: ignore[arg-type]
    assert joint.errors["L1"] < alone.errors["L1"]
    assert "record 3" in str(joint) and repr(joint).startswith("JointFitResult(3 records, a=")
    known = ss.joint_fit([{**record, "k": k} for record, k in zip(records, [900.0, 1500.0, 4000.0])])
    assert known.records[0]["k"] == 900.0 and "k[0]" not in known.errors
    with pytest.raises(KeyError, match="mu0"):
        joint["k"]


@pytest.mark.parametrize(
    ("records", "error", "named"),
    [
        ([], ss.StickslipError, "record"),
        ([{"t": [0.0, 1.0]}], TypeError, "mu"),
        ([{"mu": [0.6], "stress": 1.0}], TypeError, "'stress'"),
        ([{"mu": [0.6], "t": "x"}], TypeError, "t of a record"),
        ([3.0], TypeError, "records"),
    ],
)
def test_wrong_records_are_named(records: list[object], error: type[Exception], named: str) -> None:
    with pytest.raises(error, match=named):
        ss.joint_fit(records)  # type: ignore[arg-type]
    with pytest.raises(ss.FitError, match="record 2"):
        ss.joint_fit([*three()[:1], {**three()[1], "window": (0.0, 1.0)}])


def test_ctrl_c_ends_a_fit_with_what_it_has() -> None:
    # Two states in many records take minutes.
    records = [record for _ in range(20) for record in three()]
    # A shell starts programs in the background with the signal ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt) as raised:
            ss.joint_fit(records, law="aging", states=2)
    finally:
        signal.signal(signal.SIGINT, before)
    partial = raised.value.partial  # type: ignore[attr-defined]
    assert partial is None or partial.interrupted


def test_a_daemon_thread_in_a_fit_ends_with_the_interpreter() -> None:
    program = """
import threading, time
import stickslip as ss
t, mu, load = ss.velocity_step([1e-6, 1e-5], 3e-4, k=1500.0, samples=20000, a=0.008, b=0.012, Dc=1.5e-5)
fit = lambda: ss.joint_fit([{"t": t, "mu": mu, "load": load}] * 20, states=2)
threading.Thread(target=fit, daemon=True).start()
time.sleep(0.3)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


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
        ({"k": -1.0}, "k must be"),
        ({"k": math.nan}, "k must be"),
        ({"k": None, "stiffness": 1e9}, "normal_stress"),
        ({"k": None, "normal_stress": 1e6}, "stiffness"),
        ({"k": None, "stiffness": -1e9, "normal_stress": 1e6}, "stiffness"),
        ({"stiffness": 1e9, "normal_stress": 1e6}, "one of them"),
        ({"steps_at": [(0.0, 1e-6)]}, "load or displacement"),
        ({"steps_at": [(0.0, 1e-6)], "load": None, "displacement": list(T)}, "t=None"),
        ({"free": ["c1"]}, "c1"),
        ({"law": "nagata", "free": ["Vc1"]}, "Vc1"),
        ({"law": "nagata", "fixed": {"c": -1.0}}, "c"),
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
    arguments: dict[str, object] = {"load": LOAD, "k": 1500.0, **changed}
    with pytest.raises((ValueError, ss.StickslipError), match=named):
        ss.fit(T, MU, **arguments)  # type: ignore[arg-type]


@pytest.mark.parametrize("mu", [[0.6] * len(T), [], MU[:5], [math.nan] * len(T), "x", None])
def test_records_are_checked(mu: object) -> None:
    with pytest.raises((ValueError, TypeError)):
        ss.fit(T, mu, load=LOAD)  # type: ignore[arg-type]
