"""Laws of the user: methods of Python, and compiled functions."""

import ctypes
import math
import subprocess
from pathlib import Path

import numpy as np
import pytest

import stickslip as ss

A, B, DC, MU0, V0 = 0.010, 0.015, 1e-5, 0.6, 1e-6
# A velocity step at once: in steady sliding the size of steps is that of rounding errors.
SCENE = {"load": 1e-5, "V": 1e-6, "theta": 10.0, "damping": 5e6}
PARAMETERS = {"a": A, "b": B, "Dc": DC, "mu0": MU0, "V0": V0}


class Aging:
    """theta' = 1 - V theta/Dc."""

    def rate(self, theta: float, slip_rate: float) -> float:
        return 1.0 - slip_rate * theta / DC

    def slope(self, theta: float, slip_rate: float) -> float:
        return -slip_rate / DC


class CutOff:
    """mu = max(0, mu0 + a ln(V/V0) + b ln(V0 theta/Dc))."""

    def least(self, theta: float) -> float:
        return V0 * math.exp(-(MU0 + B * math.log(V0 * theta / DC)) / A)

    def coefficient(self, slip_rate: float, theta: float) -> float:
        least = self.least(theta)
        return A * math.log(slip_rate / least) if slip_rate > least else 0.0

    def slope(self, slip_rate: float, theta: float) -> float:
        return A / slip_rate if slip_rate > self.least(theta) else 0.0

    def potential(self, slip_rate: float, theta: float) -> float:
        least = self.least(theta)
        if slip_rate <= least:
            return 0.0
        return A * (slip_rate * (math.log(slip_rate / least) - 1.0) + least)


def built_in() -> ss.SliderRun:
    return ss.SpringSlider(1e10, 1e6, **PARAMETERS, **SCENE).run(5.0, rtol=1e-9)


def same(one: ss.SliderRun, two: ss.SliderRun) -> float:
    """The largest difference of ln V and ln theta at common times."""
    at = np.linspace(0.0, 5.0, 2001)
    pairs = [(one.V, two.V), (one.theta, two.theta)]
    return max(np.abs(np.interp(at, one.t, np.log(x)) - np.interp(at, two.t, np.log(y))).max() for x, y in pairs)


def test_an_aging_law_of_python_is_ours() -> None:
    run = ss.SpringSlider(1e10, 1e6, **PARAMETERS, **SCENE, law=Aging()).run(5.0, rtol=1e-9)
    reference = built_in()
    assert len(run) == len(reference)
    assert np.abs(np.log(run.V / reference.V)).max() < 1e-10
    assert np.abs(np.log(run.theta / reference.theta)).max() < 1e-10


def test_a_friction_law_of_python_is_ours() -> None:
    run = ss.SpringSlider(1e10, 1e6, **SCENE, friction=CutOff(), law=Aging()).run(5.0, rtol=1e-9)
    assert same(run, built_in()) < 1e-6


def library(tmp_path: Path) -> ctypes.CDLL:
    source = tmp_path / "law.c"
    source.write_text(
        f"double rate(double theta, double v) {{ return 1.0 - v*theta/{DC}; }}\n"
        f"double slope(double theta, double v) {{ return -v/{DC}; }}\n"
    )
    compiled = tmp_path / "law.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-O2", "-o", str(compiled), str(source)], check=True)
    code = ctypes.CDLL(str(compiled))
    for function in [code.rate, code.slope]:
        function.restype = ctypes.c_double
        function.argtypes = (ctypes.c_double, ctypes.c_double)
    return code


def test_compiled_laws_are_ours(tmp_path: Path) -> None:
    code = library(tmp_path)
    law = ss.CompiledState(rate=code.rate, slope=code.slope)
    del code
    run = ss.SpringSlider(1e10, 1e6, **PARAMETERS, **SCENE, law=law).run(5.0, rtol=1e-9)
    reference = built_in()
    assert len(run) == len(reference)
    assert np.abs(np.log(run.V / reference.V)).max() < 1e-10


class Growing(Aging):
    """A state law without a steady state."""

    def slope(self, theta: float, slip_rate: float) -> float:
        return slip_rate / DC

    def rate(self, theta: float, slip_rate: float) -> float:
        return 1.0 + slip_rate * theta / DC


class Weak(CutOff):
    """A coefficient that decreases with the slip rate."""

    def coefficient(self, slip_rate: float, theta: float) -> float:
        return 0.6 - 0.1 * min(slip_rate, 1.0)


class Flat(CutOff):
    """A potential that is none."""

    def potential(self, slip_rate: float, theta: float) -> float:
        return 0.0


def test_contracts_are_checked_at_once() -> None:
    with pytest.raises(ss.StateLawError) as raised:
        ss.SpringSlider(1e10, 1e6, **PARAMETERS, law=Growing())
    assert raised.value.kind
    for law in [Weak(), Flat()]:
        with pytest.raises(ss.FrictionLawError):
            ss.SpringSlider(1e10, 1e6, friction=law, law=Aging())


class Late(Aging):
    """A law that fails at high rates."""

    armed = False

    def rate(self, theta: float, slip_rate: float) -> float:
        if self.armed and slip_rate > 2e-6:
            raise LookupError("no such rate")
        return super().rate(theta, slip_rate)


def test_exceptions_of_laws_are_raised() -> None:
    law = Late()
    slider = ss.SpringSlider(1e10, 1e6, **PARAMETERS, **SCENE, law=law)
    law.armed = True
    with pytest.raises(LookupError, match="no such rate"):
        slider.run(100.0)


class Wordy(Aging):
    """A law that returns no number."""

    def rate(self, theta: float, slip_rate: float) -> float:
        return "fast"  # type: ignore[return-value]


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        ({"law": object()}, AttributeError),
        ({"law": 3}, AttributeError),
        ({"law": Wordy()}, TypeError),
        ({"friction": object()}, AttributeError),
        ({"friction": Aging()}, AttributeError),
        ({"law": "ageing"}, ValueError),
        ({"friction": "none"}, ValueError),
        ({"a": None}, ValueError),
    ],
)
def test_objects_that_are_no_laws_are_refused(arguments: dict[str, object], error: type[Exception]) -> None:
    with pytest.raises(error):
        ss.SpringSlider(1e10, 1e6, **{**PARAMETERS, **arguments})  # type: ignore[arg-type]


@pytest.mark.parametrize("function", [0, 4096, None, "x", 1.5, object(), math.sin, lambda x, y: x])
def test_compiled_functions_are_those_of_ctypes(function: object) -> None:
    with pytest.raises(ValueError, match="rate"):
        ss.CompiledState(rate=function, slope=function)


def test_compiled_functions_are_declared(tmp_path: Path) -> None:
    code = library(tmp_path)
    code.rate.argtypes = (ctypes.c_double,)
    with pytest.raises(ValueError, match="rate must be a function of ctypes"):
        ss.CompiledState(rate=code.rate, slope=code.slope)
    code.slope.restype = ctypes.c_int
    with pytest.raises(ValueError, match="slope|rate"):
        ss.CompiledState(rate=code.slope, slope=code.slope)
