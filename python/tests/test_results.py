"""Results as people use them: tables of pandas, HTML, texts, pictures, progress, laws by name."""

import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import stickslip as ss

YEAR = 365.25 * 86400.0
MEDIUM = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}
LAWS = {"a": 0.010, "b": 0.015, "Dc": 1e-5}
CELLS = {"a": 0.01, "b": 0.015, "Dc": 1e-2, "normal_stress": 5e7, "theta": 1e7}
STEP = [(0.0, 1e-6), (30.0, 1e-5)]


def slider(**changed: Any) -> ss.SpringSlider:
    return ss.SpringSlider(1e10, 1e6, **{"load": STEP, **LAWS, **changed})


def patch() -> tuple[ss.LineFault, ss.FaultSimulation]:
    fault = ss.LineFault([-1e3, 1e3], 40, space="whole", **MEDIUM)
    a = np.where(np.abs(fault.centers) < 600.0, 0.010, 0.025)
    friction = {"a": a, "b": 0.015, "Dc": 4e-4, "normal_stress": 50e6, "theta": 4e-4 / 1e-9}
    return fault, fault.simulation(**friction, shear_stress=25e6, plate_rate=1e-9)


def fitted() -> ss.FitResult:
    times = np.arange(0.0, 60.0, 0.1)
    return ss.fit(times, slider().run(60.0, t_eval=times).mu, load=STEP)


def test_tables() -> None:
    pytest.importorskip("pandas")
    run = slider().run(60.0)
    frame = run.to_frame()
    assert list(frame) == ["t", "V", "theta", "mu", "slip", "shear_stress"]
    assert (frame["V"] == run.V).all()
    cycle = patch()[1].run(10.0 * YEAR)
    table = cycle.to_frame(cells=[3, 20])
    assert len(table) == 2 * len(cycle.t)
    assert (table[table["cell"] == 20]["slip"].to_numpy() == cycle.slip[:, 20]).all()
    events = cycle.events.to_frame()
    assert len(events) == len(cycle.events) >= 1
    assert (events["moment"] == cycle.events["moment"]).all() and "hypocentre_x" in events
    # A subset of events is one of events, too.
    assert len(cycle.events[:1].to_frame()) == 1
    result = fitted()
    parameters = result.to_frame()
    assert parameters.loc["a", "value"] == result["a"]
    assert parameters.loc["b1", "standard_error"] == result.errors["b"]
    with pytest.raises(ValueError, match="cells"):
        cycle.to_frame(cells=40)


def test_tables_of_a_plane_with_a_free_rake() -> None:
    pytest.importorskip("pandas")
    plane = ss.PlaneFault([-1e3, 1e3], [0.0, 1e3], [4, 2], rake="free", **MEDIUM)
    run = plane.simulation(**CELLS, shear_stress=[3e7, 1e7]).run(1e4)
    table = run.to_frame()
    assert (table["V_dip"].to_numpy().reshape(-1, 8) == run.V[..., 1]).all()


def test_parameters_have_several_names() -> None:
    result = fitted()
    assert result["b"] == result["b1"] == result.parameters["b"]
    assert result["Dc"] == result["L"] == result["L1"] == result.parameters["Dc"]
    assert result.errors["b"] == result.errors["b1"] > 0.0
    for wrong in ("b2", "friction"):
        with pytest.raises(KeyError, match=wrong):
            result[wrong]
        with pytest.raises(KeyError, match=wrong):
            result.errors[wrong]


def test_texts_say_what_was_given() -> None:
    fault, simulation = patch()
    assert repr(fault) == (
        "LineFault(ends=[-1000.0, 1000.0], cells=40, shear_modulus=3.2e+10, shear_wave_speed=3464, space='whole', "
        "dip=90, sense='thrust')"
    )
    assert "40 cells" in repr(simulation)
    assert (fault.cells, fault.ends, fault.space) == (40, [-1000.0, 1000.0], "whole")
    block = slider()
    assert block.load == STEP and block.Dc == 1e-5 and block.friction == "cut-off"
    assert "load=[(0.0, 1e-06), (30.0, 1e-05)]" in repr(block)
    for value in (fault, block, block.run(1.0), simulation.run(1e3), simulation.events, fitted()):
        html = value._repr_html_()
        assert html.startswith("<table>") and html.endswith("</table>")


def test_arrays_have_the_shape_of_a_plane() -> None:
    fault = ss.PlaneFault([-1e3, 1e3], [0.0, 1e3], [4, 2], **MEDIUM)
    assert fault.shape == (2, 4)
    a = np.linspace(0.01, 0.02, 8)

    def run(shape: tuple[int, ...], **further: Any) -> ss.FaultRun:
        given = {**CELLS, "a": a.reshape(shape), "shear_stress": np.full(shape, 3e7), **further}
        return fault.simulation(**given).run(1e5)

    flat, shaped = run((8,)), run((2, 4), pressure=lambda time: np.zeros((2, 4)))
    assert flat.slip == pytest.approx(shaped.slip, rel=1e-12)
    nested = fault.simulation(**{**CELLS, "a": a.reshape(2, 4).tolist()}, shear_stress=(3e7,) * 8).run(1e5)
    assert (nested.slip == flat.slip).all()


def test_stress_has_the_sign_of_slip() -> None:
    # The load point goes back: the block slides back once the spring has let go.
    block = ss.SpringSlider(1e8, 1e6, a=0.015, b=0.010, Dc=1e-5, friction="regularized", load=[(0.0, 1e-6), (10.0, -1e-3)])
    run = block.run(40.0)
    back = run.V < -1e-6
    assert back.any() and (run.shear_stress[back] < 0.0).all() and (run.mu > 0.0).all()
    assert (run.shear_stress[run.V > 1e-9] > 0.0).all()


@pytest.mark.parametrize(
    ("law", "further", "steady"),
    [("perrin-rice-zheng", {}, 2.0), ("kato-tullis", {"Vc": 1e-8}, 1.0), ("sato", {}, 1.0), ("nagata", {"c": 2.0}, 1.0)],
)
def test_laws_by_name_end_in_their_steady_state(law: str, further: dict[str, float], steady: float) -> None:
    run = slider(law=law, **further).run(300.0)
    assert run.theta[-1] == pytest.approx(steady * 1e-5 / 1e-5, rel=1e-3)
    # All states count contacts by ln(V0 theta/Dc).
    change = (0.010 - 0.015) * math.log(10.0)
    assert run.mu[-1] - run.mu[0] == pytest.approx(change, abs=1e-4)


def test_nagata_by_its_own_equation() -> None:
    run = slider(law="nagata", c=2.0).run(60.0, rtol=1e-9, t_eval=np.linspace(30.5, 60.0, 20_001))
    rate = np.gradient(run.mu, run.t)
    grown = np.gradient(np.log(run.theta), run.t)
    expected = 1.0 / run.theta - run.V / 1e-5 - 2.0 / 0.015 * rate
    assert grown[1:-1] == pytest.approx(expected[1:-1], abs=1e-4 * np.abs(expected).max())
    mu = 0.6 + 0.010 * np.log(run.V / 1e-6) + 0.015 * np.log(1e-6 * run.theta / 1e-5)
    assert run.mu == pytest.approx(mu, abs=1e-9)


def test_a_normal_stress_that_changes_changes_the_state() -> None:
    fault = ss.LineFault([-500.0, 500.0], 4, space="whole", **MEDIUM)
    start = {"a": 0.02, "b": 0.015, "Dc": 1.0, "normal_stress": 50e6, "shear_stress": 15e6, "theta": 1e9}

    def pressure(time: float) -> float:
        return 25e6 * min(time / 10.0, 1.0)

    # Slip hardly matters in 10 s, nor does aging: ln(theta) changes by -(alpha/b) ln(sigma/sigma_0).
    run = fault.simulation(**start, pressure=pressure, alpha=0.3).run(10.0)
    assert run.normal_stress[-1] == pytest.approx(25e6)
    assert np.log(run.theta[-1] / 1e9) == pytest.approx(0.3 / 0.015 * math.log(2.0), rel=1e-3)
    without = fault.simulation(**start, pressure=pressure).run(10.0)
    assert without.theta[-1] == pytest.approx(1e9, rel=1e-3)


def test_own_laws_are_checked_once() -> None:
    calls = []

    class Law:
        def rate(self, theta: float, rate: float) -> float:
            calls.append(theta)
            return 1.0 - rate * theta / 1e-2

        def slope(self, theta: float, rate: float) -> float:
            return -rate / 1e-2

    law = Law()
    fault = ss.LineFault([0.0, 1e3], 50, **MEDIUM)
    given = {**CELLS, "shear_stress": 3e7, "law": law}
    fault.simulation(**given)
    first = len(calls)
    fault.simulation(**given)
    # Its contract takes thousands of calls; a simulation begins with some per cell.
    assert len(calls) - first < first / 10


def test_progress_is_a_line(capfd: pytest.CaptureFixture[str]) -> None:
    script = """
import sys
sys.modules["tqdm"] = sys.modules["tqdm.auto"] = None
import stickslip._progress as progress
sys.stderr.isatty = lambda: True
bar = progress.Progress(0.0, 10.0)
bar.update(5.0)
bar.close(10.0)
"""
    found = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert "50.0 %" in found.stderr and found.stderr.endswith("\n") and "100.0 %" in found.stderr


def test_progress_changes_no_step(capfd: pytest.CaptureFixture[str]) -> None:
    assert slider().run(60.0, progress=True).state == slider().run(60.0).state
    one, other = patch()[1], patch()[1]
    one.run(YEAR, progress=True)
    other.run(YEAR)
    assert one.state() == other.state()


def test_pictures(tmp_path: Path) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    from stickslip import plots

    fault, simulation = patch()
    cycle = simulation.run(5.0 * YEAR)
    plane = ss.PlaneFault([-1e3, 1e3], [0.0, 1e3], [4, 2], rake="free", **MEDIUM)
    on_plane = plane.simulation(**CELLS, shear_stress=[3e7, 1e7]).run(1e4)
    run = slider().run(60.0)
    drawn = [
        plots.history(run),
        plots.history(run, "mu"),
        plots.history(cycle),
        plots.history(cycle, "slip", cell=20),
        plots.phase_plane(run),
        plots.slip_profiles(cycle, fault, interval=0.1 * YEAR),
        plots.fault_map(on_plane, plane),
        plots.fault_map(on_plane, plane, "V"),
        plots.fit(fitted())[0],
    ]
    for n, ax in enumerate(drawn):
        assert ax.get_ylabel()
        ax.figure.savefig(tmp_path / f"{n}.png")
    pyplot.close("all")
    with pytest.raises(ValueError, match="field"):
        plots.history(run, "stress")


def test_the_version_is_that_of_the_package() -> None:
    from importlib.metadata import PackageNotFoundError, version

    assert ss.__version__.count(".") == 2
    try:
        assert version("stickslip") == ss.__version__
    except PackageNotFoundError:
        pass


def test_lists_are_as_good_as_tuples() -> None:
    times = np.arange(0.0, 60.0, 0.1)
    mu = slider(load=[[0.0, 1e-6], [30.0, 1e-5]]).run(60.0, t_eval=list(times)).mu
    bounds = {"a": (0.001, 0.1)}
    tuples = ss.fit(times, mu, load=STEP, window=(0.0, 60.0), bounds=bounds)
    lists = [list(pair) for pair in STEP]
    for load in (lists, np.array(lists)):
        found = ss.fit(list(times), list(mu), load=load, window=[0.0, 60.0], bounds={"a": [0.001, 0.1]})
        assert found.parameters == tuples.parameters
    fault, simulation = patch()
    assert simulation.run(1e3, threshold=[1e-2, 1e-3], stops=(10.0,)).steps > 0
    plane = ss.PlaneFault((-1e3, 1e3), (0.0, 1e3), (4, 2), **MEDIUM)
    system = ss.FaultSystem((plane,), strikes=(0.0,), origins=[[0.0, 0.0]])
    assert len(system) == 8
