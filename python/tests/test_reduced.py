"""Bodies reduced to their contacts: the bits of the command line, the whole body, misuse."""

import csv
import math
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from test_bodies import DT, slider

import stickslip as ss

START = {"scheme": "newmark", "equilibrium": True, "zero_acceleration": True}


def test_a_reduced_slider_has_the_bits_of_the_command_line(tmp_path: Path) -> None:
    program = os.environ.get("STICKSLIP")
    if program is None:
        pytest.skip("STICKSLIP is not set to the program `stickslip`")
    arguments = ["--refinements", "2", "--until", "0.05", "--scheme", "newmark", "--full-precision", "--out", str(tmp_path)]
    reduced = ["--body", "reduced", "--coupling", "fixed-point", "--state-update", "backward-euler"]
    subprocess.run([program, "slider", *arguments, *reduced], check=True, capture_output=True)
    with open(tmp_path / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    body, mesh = slider()
    x0 = int(np.argmin(np.hypot(mesh.vertices[:, 0] - 2.5, mesh.vertices[:, 1])))
    paper = {"coupling": "fixed-point", "state_update": "backward-euler", "absolute_tolerance": 1e-10}
    run = body.simulation(**START, **paper, reduced_for_step=DT)
    assert len(run.frequencies) > 10 and (np.diff(run.frequencies) >= 0.0).all()
    compared = 0
    for at, row in zip(run.run(steps=len(rows), dt=DT), rows):
        assert at.time == float(row["time"])
        assert at.displacement[x0, 0] == float(row["displacement"])
        assert at.velocity[x0, 0] == float(row["velocity"])
        compared += 1
    assert compared == len(rows) >= 100


def test_more_modes_come_closer_to_the_whole_body() -> None:
    body, mesh = slider()
    whole = body.simulation(**START)
    assert len(whole.frequencies) == 0
    reference = list(whole.run(steps=400, dt=DT, every=400))[-1]
    errors = []
    for frequency in [35.0, 150.0, math.inf]:
        run = body.simulation(**START, reduced_up_to=frequency)
        assert (run.frequencies <= frequency).all()
        # The weight of the body is in its displacement.
        assert np.abs(run.now().displacement - body.simulation(**START).now().displacement).max() < 1e-15
        at = list(run.run(steps=400, dt=DT, every=400))[-1]
        assert at.displacement.shape == at.velocity.shape == mesh.vertices.shape
        assert (at.contacts[0].vertices == reference.contacts[0].vertices).all()
        errors.append(np.abs(at.displacement - reference.displacement).max())
    assert errors[0] > errors[1] > errors[2]
    # With all modes it is another basis of the same body.
    assert errors[2] < 1e-15 and np.abs(at.velocity - reference.velocity).max() < 1e-13
    assert at.contacts[0].theta == pytest.approx(reference.contacts[0].theta, rel=1e-12)


def fault_inside(normal_stress: float | str, push: float = 0.0) -> ss.Body:
    mesh = ss.Mesh.grid([2.0, 2.0], [8, 8]).with_surface("fault", lambda x: x[1] == 1.0).split("fault")
    body = ss.Body(mesh, E=5e10, nu=0.25)
    body.fix(mesh.part(lambda x: x[1] == 0.0))
    body.drive(mesh.part(lambda x: x[1] == 2.0), [5e-3, -push])
    friction = {"a": 0.015, "b": 0.010, "Dc": 1e-4, "theta": 1.0}
    body.contact(mesh.part("fault+"), opposite=mesh.part("fault-"), normal_stress=normal_stress, **friction)
    return body


def test_a_fault_without_inertia_is_exact() -> None:
    ends = [
        list(fault_inside(5e7).simulation(scheme="backward-euler", **how).run(steps=20, dt=0.1))[-1]
        for how in [{}, {"reduced_up_to": 1.0}]
    ]
    assert ends[0].contacts[0].slip.min() > 1e-4
    assert np.abs(ends[0].displacement - ends[1].displacement).max() < 1e-9 * np.abs(ends[0].displacement).max()
    assert ends[1].contacts[0].slip == pytest.approx(ends[0].contacts[0].slip, rel=1e-9)


def test_a_normal_stress_of_the_body_is_reduced() -> None:
    ends = [
        list(fault_inside("body", push=1e-3).simulation(scheme="backward-euler", **how).run(steps=20, dt=0.1))[-1]
        for how in [{}, {"reduced_up_to": 1.0}]
    ]
    assert ends[0].contacts[0].normal_stress.min() > 1e7 and ends[0].contacts[0].slip.min() > 1e-4
    for name in ["slip", "normal_stress"]:
        assert getattr(ends[1].contacts[0], name) == pytest.approx(getattr(ends[0].contacts[0], name), rel=1e-9)


def test_a_reduced_body_goes_on_with_the_same_bits() -> None:
    run = slider(1)[0].simulation(**START, reduced_up_to=100.0)
    run.step(DT)
    kept = run.state()
    first = [at.velocity for at in run.run(steps=20, dt=DT)]
    run.restore(kept)
    assert all((one == at.velocity).all() for one, at in zip(first, run.run(steps=20, dt=DT)))
    with pytest.raises(ss.SceneError):
        slider(1)[0].simulation(**START).restore(kept)


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        ({"reduced_up_to": 0.0}, "reduced_up_to"),
        ({"reduced_up_to": -1.0}, "reduced_up_to"),
        ({"reduced_up_to": math.nan}, "reduced_up_to"),
        ({"reduced_up_to": "all"}, "reduced_up_to"),
        ({"reduced_for_step": 0.0}, "reduced_for_step"),
        ({"reduced_for_step": math.inf}, "reduced_for_step"),
        ({"reduced_for_step": DT, "reduced_up_to": 1.0}, "one of them"),
        ({"reduced_for_step": DT, "solver": "tnnmg"}, "solver"),
        ({"reduced_up_to": 1.0}, "first mode"),
    ],
)
def test_reductions_are_checked(wrong: dict[str, object], named: str) -> None:
    with pytest.raises((ValueError, TypeError)) as raised:
        slider(1)[0].simulation(**{**START, **wrong})  # type: ignore[arg-type]
    assert named in str(raised.value) + "".join(getattr(raised.value, "__notes__", []))


def test_modes_above_the_frequency_have_numbers() -> None:
    with pytest.raises(ss.SceneError) as raised:
        slider(1)[0].simulation(**START, reduced_up_to=1.0)
    error = raised.value
    assert error.kind == "BelowModes" and error.frequency == 1.0 and error.first > 1.0


def test_a_body_without_a_contact_is_not_reduced() -> None:
    mesh = ss.Mesh.grid([1.0, 1.0], [2, 2])
    body = ss.Body(mesh, E=5e7, nu=0.3, density=5e3)
    body.fix(mesh.part(lambda x: x[1] == 0.0))
    with pytest.raises(ss.SceneError):
        body.simulation(reduced_up_to=1e6)
