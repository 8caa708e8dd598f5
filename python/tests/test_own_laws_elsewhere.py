"""Laws of the user on faults and bodies: ours again, and what they do wrong."""

import threading
from pathlib import Path

import numpy as np
import pytest
from test_own_laws import Aging, CutOff, Growing, Weak, library

import stickslip as ss

A, B, DC, MU0, V0 = 0.010, 0.015, 1e-5, 0.6, 1e-6
PARAMETERS = {"a": A, "b": B, "Dc": DC, "mu0": MU0, "V0": V0}
MEDIUM = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}


def body(**arguments: object) -> ss.BodySimulation:
    """A block that is pulled over a rigid surface."""
    mesh = ss.Mesh.grid([1.0, 0.5], [8, 4])
    block = ss.Body(mesh, E=5e7, nu=0.3, density=5000.0)
    block.drive(mesh.part(lambda x: x[1] == 0.5), lambda t: [1e-3 * min(t, 0.1) / 0.1, 0.0])
    seam = {"normal_stress": 1e4, "theta": 1.0, **PARAMETERS, **arguments}
    block.contact(mesh.part(lambda x: x[1] == 0.0), **seam)  # type: ignore[arg-type]
    # The step of order 2 at constant rate has a closed form for our law only.
    return block.simulation(state_update="backward-euler", tolerance=1e-13)


def ends(simulation: ss.BodySimulation) -> ss.BodyState:
    return list(simulation.run(steps=50, dt=1e-2, every=50))[-1]


def different(one: ss.BodyState, two: ss.BodyState) -> float:
    """The largest difference of states and displacements, relative to the largest one."""
    pairs = [(one.displacement, two.displacement), (one.contacts[0].theta, two.contacts[0].theta)]
    return max(float(np.abs(x - y).max() / np.abs(y).max()) for x, y in pairs)


def test_an_aging_law_of_python_on_a_body_is_ours() -> None:
    reference = ends(body())
    assert reference.contacts[0].slip_rate.max() > 1e-6
    assert different(ends(body(law=Aging())), reference) < 1e-10


def test_laws_of_python_and_compiled_ones_on_a_body_are_ours(tmp_path: Path) -> None:
    reference = ends(body())
    code = library(tmp_path)
    law = ss.CompiledState(rate=code.rate, slope=code.slope)
    assert different(ends(body(law=law)), reference) < 1e-10
    own = {"a": None, "b": None, "Dc": None, "friction": CutOff(), "law": law}
    assert different(ends(body(**own)), reference) < 1e-10


def line() -> ss.LineFault:
    return ss.LineFault([0.0, 40.0], 16, **MEDIUM)


def plane() -> ss.PlaneFault:
    return ss.PlaneFault([-20.0, 20.0], [0.0, 20.0], [4, 4], dip=60.0, rake=90.0, **MEDIUM)


START = {"normal_stress": 1e6, "shear_stress": 6e5, "theta": 10.0, "plate_rate": 1e-6}


def log_difference(one: ss.FaultRun, two: ss.FaultRun) -> float:
    return max(float(np.abs(np.log(x[-1] / y[-1])).max()) for x, y in [(one.V, two.V), (one.theta, two.theta)])


@pytest.mark.parametrize("fault", [line(), plane()])
def test_an_aging_law_of_python_on_a_fault_is_ours(fault: ss.LineFault | ss.PlaneFault, tmp_path: Path) -> None:
    reference = fault.simulation(**PARAMETERS, **START).run(20.0)
    assert reference.steps > 20
    code = library(tmp_path)
    compiled = ss.CompiledState(rate=code.rate, slope=code.slope)
    for law in [Aging(), compiled, [compiled] * 16]:
        run = fault.simulation(**PARAMETERS, **START, law=law).run(20.0)
        assert run.steps == reference.steps
        assert log_difference(run, reference) < 1e-8


class Stronger:
    """mu = mu0 + a asinh(V/V1), of a contact without a memory."""

    def __init__(self, a: float) -> None:
        self.a = a

    def coefficient(self, slip_rate: float, theta: float) -> float:
        return 0.5 + self.a * float(np.arcsinh(slip_rate / 1e-9))

    def slope(self, slip_rate: float, theta: float) -> float:
        return self.a / float(np.hypot(slip_rate, 1e-9))

    def potential(self, slip_rate: float, theta: float) -> float:
        x = slip_rate / 1e-9
        # The difference for small rates is that of two equal numbers.
        integral = x * np.arcsinh(x) - x * x / (1.0 + np.hypot(1.0, x))
        return 0.5 * slip_rate + self.a * 1e-9 * float(integral)


def test_each_cell_may_have_its_law() -> None:
    laws = [Stronger(a) for a in np.linspace(0.01, 0.02, 16)]
    run = line().simulation(**START, friction=laws, law=Aging()).run(10.0)
    damping = 0.5 * MEDIUM["shear_modulus"] / MEDIUM["shear_wave_speed"]
    for k, law in enumerate(laws):
        strength = 1e6 * law.coefficient(run.V[-1, k], 1.0)
        assert strength + damping * run.V[-1, k] == pytest.approx(run.shear_stress[-1, k], rel=1e-3)


class Armed(Aging):
    """A law that fails after it is armed."""

    armed = False

    def rate(self, theta: float, slip_rate: float) -> float:
        if self.armed:
            raise LookupError("no such rate")
        return super().rate(theta, slip_rate)


def test_exceptions_of_laws_end_runs() -> None:
    for fault in [line(), plane()]:
        law = Armed()
        simulation = fault.simulation(**PARAMETERS, **START, law=law)
        law.armed = True
        with pytest.raises(LookupError, match="no such rate"):
            simulation.run(20.0)
        law.armed = False
        assert simulation.run(20.0).t[-1] == 20.0
    law = Armed()
    block = body(law=law)
    block.step(1e-2)
    law.armed = True
    with pytest.raises(LookupError, match="no such rate"):
        block.step(1e-2)
    law.armed = False
    assert block.step(1e-2).time > 1e-2


def test_exceptions_go_to_the_simulation_that_called() -> None:
    law = Armed()
    mine = threading.get_ident()

    class Mine(Aging):
        def rate(self, theta: float, slip_rate: float) -> float:
            if law.armed and threading.get_ident() == mine:
                raise LookupError("mine")
            return super().rate(theta, slip_rate)

    slider = ss.SpringSlider(1e10, 1e6, **PARAMETERS, law=Mine(), load=1e-5, V=1e-6, theta=10.0, damping=5e6)
    law.armed = True
    lengths: list[int] = []
    other = threading.Thread(target=lambda: lengths.append(len(slider.run(5.0))))
    other.start()
    for _ in range(5):
        with pytest.raises(LookupError, match="mine"):
            slider.run(5.0)
    other.join()
    assert len(lengths) == 1


def made(kind: str, **arguments: object) -> object:
    if kind == "body":
        return body(**arguments)
    fault = line() if kind == "line" else plane()
    return fault.simulation(**{**PARAMETERS, **START, **arguments})  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", ["line", "plane", "body"])
@pytest.mark.parametrize(
    ("arguments", "error", "named"),
    [
        ({"law": Growing()}, ss.StateLawError, "law: "),
        ({"friction": Weak()}, ss.FrictionLawError, "friction: "),
        ({"law": object()}, AttributeError, "law: "),
        ({"friction": Aging()}, AttributeError, "friction: "),
        ({"law": "ageing"}, ValueError, "law must be"),
        ({"friction": "none"}, ValueError, "friction must be"),
        ({"law": Aging(), "a": None}, ValueError, "a must be given"),
        ({"friction": CutOff(), "Dc": None}, ValueError, "Dc must be given"),
    ],
)
def test_laws_are_checked_at_once(
    kind: str, arguments: dict[str, object], error: type[Exception], named: str
) -> None:
    with pytest.raises(error) as raised:
        made(kind, **arguments)
    assert str(raised.value).startswith(named)


@pytest.mark.parametrize("name", ["law", "friction"])
def test_lists_of_laws_have_one_per_cell(name: str) -> None:
    with pytest.raises(ValueError, match=f"{name} must be one law, or a list of one for each of 16 cells"):
        made("line", **{name: [Aging()] * 3})
