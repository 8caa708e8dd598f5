"""Bodies: the slider of the paper, faults inside, states, threads, misuse."""

import csv
import math
import os
import pickle
import struct
import subprocess
import threading
from pathlib import Path

import numpy as np
import pytest

import stickslip as ss

RATE_AND_STATE = {"a": 0.010, "b": 0.015, "Dc": 1e-5, "mu0": 0.6, "V0": 1e-6}
DT = 1.5e-3


def slider(refinements: int = 2) -> tuple[ss.Body, ss.Mesh]:
    """The block of Pipping, Sander and Kornhuber (2015)."""
    mesh = ss.Mesh.grid([5.0, 1.0], [5, 1]).refined(refinements)
    body = ss.Body(mesh, E=5e7, nu=0.3, density=5e3, gravity=[0.0, -9.81])
    body.drive(mesh.part(lambda x: x[1] == 1.0), lambda t: [2e-4 * min(4.0 * t / 15.0, 1.0), 0.0])
    bottom = mesh.part(lambda x: x[1] == 0.0)
    body.contact(bottom, normal_stress=49_050.0, theta=math.exp(-10.0), **RATE_AND_STATE)
    return body, mesh


def simulation(body: ss.Body, solver: str = "tnnmg") -> ss.BodySimulation:
    return body.simulation(scheme="newmark", solver=solver, equilibrium=True, zero_acceleration=True)


def test_the_slider_has_the_bits_of_the_command_line(tmp_path: Path) -> None:
    program = os.environ.get("STICKSLIP")
    if program is None:
        pytest.skip("STICKSLIP is not set to the program `stickslip`")
    arguments = ["--refinements", "2", "--until", "0.05", "--scheme", "newmark", "--full-precision", "--out", str(tmp_path)]
    subprocess.run([program, "slider", *arguments], check=True, capture_output=True)
    with open(tmp_path / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    body, mesh = slider()
    x0 = int(np.argmin(np.hypot(mesh.vertices[:, 0] - 2.5, mesh.vertices[:, 1])))
    paper = {"coupling": "fixed-point", "state_update": "backward-euler", "absolute_tolerance": 1e-10}
    run = body.simulation(scheme="newmark", solver="tnnmg", equilibrium=True, zero_acceleration=True, **paper)
    compared = 0
    for at, row in zip(run.run(steps=len(rows), dt=DT), rows):
        assert at.time == float(row["time"])
        assert at.displacement[x0, 0] == float(row["displacement"])
        assert at.velocity[x0, 0] == float(row["velocity"])
        compared += 1
    assert compared == len(rows) >= 100


def test_both_solvers_take_the_same_steps() -> None:
    body, _ = slider(1)
    ends = []
    for solver in ["tnnmg", "condensed"]:
        for at in simulation(body, solver).run(steps=400, dt=DT, every=400):
            ends.append(at)
    assert len(ends) == 2
    assert ends[0].time == pytest.approx(400 * DT)
    assert np.abs(ends[0].displacement - ends[1].displacement).max() < 1e-13


def test_a_state_pickles_and_goes_on_with_the_same_bits() -> None:
    run = simulation(slider(1)[0])
    for _ in run.run(steps=50, dt=DT, every=50):
        pass
    kept = pickle.dumps(run.state())
    first = [at.velocity for at in run.run(steps=20, dt=DT)]
    run.restore(pickle.loads(kept))
    # A velocity that is no number.
    largest = struct.pack("<d", float(run.now().velocity.max()))
    assert largest in run.state()
    broken = run.state().replace(largest, struct.pack("<d", math.nan))
    with pytest.raises(ss.SceneError, match="velocity"):
        run.restore(broken)
    again = [at.velocity for at in run.run(steps=20, dt=DT)]
    assert all((one == two).all() for one, two in zip(first, again))


def test_a_run_in_pieces_takes_the_steps_of_the_whole() -> None:
    whole = [at for at in simulation(slider(1)[0]).run(until=0.1, dt=DT, every=1000)]
    pieces = [at for at in simulation(slider(1)[0]).run(until=0.1, dt=DT, every=7)]
    assert whole[-1].time == pieces[-1].time == 0.1
    assert (whole[-1].velocity == pieces[-1].velocity).all()


def crack(opposite: str = "-") -> tuple[ss.Body, ss.Mesh]:
    """A square of 4 m with a fault inside, compressed and sheared."""
    mesh = ss.Mesh.grid([4.0, 4.0], [16, 16], origin=[-2.0, -2.0])
    mesh = mesh.with_surface("fault", lambda x: x[1] == 0.0 and abs(x[0]) <= 1.0).split("fault")
    body = ss.Body(mesh, E=1.0, nu=0.25)
    body.fix(mesh.part(lambda x: x[1] == -2.0))
    body.drive(mesh.part(lambda x: x[1] == 2.0), [1e-3, -1e-3])
    plus, minus = mesh.part("fault+"), mesh.part("fault" + opposite)
    body.coulomb(plus, opposite=minus, normal_stress="body", coefficient=0.3)
    return body, mesh


def test_a_fault_inside_slides_under_the_pressure_of_the_deformation() -> None:
    body, mesh = crack()
    assert sorted(mesh.parts) == ["fault+", "fault-"]
    at = list(body.simulation().run(until=1.0, dt=0.1, every=10))[-1]
    fault = at.contacts[0]
    # Uniaxial strain presses with E (1 - nu)/((1 + nu)(1 - 2 nu)) = 1.2 times the strain of 1e-3/4.
    assert fault.normal_stress.mean() == pytest.approx(3e-4, rel=0.1)
    # Slip is largest in the middle, and falls to the tips.
    x = mesh.vertices[fault.vertices, 0]
    assert abs(x[fault.slip.argmax()]) < 0.3
    assert fault.slip[np.abs(x).argmax()] < 0.5 * fault.slip.max()
    assert fault.theta is None and (fault.mu == 0.3).all()


def test_one_thread_runs_at_a_time() -> None:
    run = simulation(slider(2)[0])
    refused = []

    def step() -> None:
        try:
            for _ in run.run(steps=300, dt=DT, every=300):
                pass
        except RuntimeError as error:
            refused.append(str(error))

    threads = [threading.Thread(target=step) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all("another thread" in message for message in refused)
    assert run.time == pytest.approx(DT * 300 * (4 - len(refused)))


def test_functions_of_the_user_raise_their_exceptions() -> None:
    mesh = ss.Mesh.grid([1.0, 1.0], [2, 2])
    with pytest.raises(ZeroDivisionError):
        mesh.part(lambda x: 1 / 0 > x[0])
    body = ss.Body(mesh, E=1e9, nu=0.3, density=1e3)
    body.drive(mesh.part(lambda x: x[1] == 1.0), lambda t: [1e-6 / (0.0015 - t) if t < 0.001 else 1 / 0, 0.0])
    run = body.simulation()
    with pytest.raises(ZeroDivisionError):
        list(run.run(steps=100, dt=2e-4))
    # The last accepted step stays in place, a part of the fifth one.
    assert 8e-4 < run.time < 1e-3
    assert np.isfinite(run.now().displacement).all()


MESH = ss.Mesh.grid([1.0, 1.0], [2, 2])
SPACE = ss.Mesh.grid([1.0, 1.0, 1.0], [1, 1, 1])
PART = MESH.part(lambda x: x[1] == 0.0)
OTHER = SPACE.part(lambda x: x[2] == 0.0)


def body() -> ss.Body:
    return ss.Body(MESH, E=1e9, nu=0.3, density=1e3)


def contact(**changed: object) -> None:
    arguments = {"normal_stress": 1e6, "theta": 1.0, **RATE_AND_STATE, **changed}
    other = body()
    other.contact(PART, **arguments)
    other.simulation()


@pytest.mark.parametrize(
    ("call", "named"),
    [
        (lambda: ss.Mesh.grid([1.0], [1]), "size"),
        (lambda: ss.Mesh.grid([1.0, -1.0], [1, 1]), r"size\[1\]"),
        (lambda: ss.Mesh.grid([1.0, math.nan], [1, 1]), r"size\[1\]"),
        (lambda: ss.Mesh.grid([1.0, 1.0], [1]), "cells"),
        (lambda: ss.Mesh.grid([1.0, 1.0], [0, 1]), "cell"),
        (lambda: ss.Mesh.grid([1.0, 1.0], [1, 1], origin=[0.0]), "origin"),
        (lambda: ss.Mesh.gmsh("no-such-file.msh"), "no-such-file"),
        (lambda: ss.Mesh.gmsh(__file__), "test_bodies"),
        (lambda: MESH.part("nowhere"), "nowhere"),
        (lambda: MESH.part(3), "which"),
        (lambda: MESH.part(lambda x: False), "face"),
        (lambda: MESH.split(), "names"),
        (lambda: MESH.split("nowhere"), "nowhere"),
        (lambda: MESH.refined(1).split("nowhere"), "refine"),
        (lambda: ss.Body(MESH, E=-1.0, nu=0.3), "E"),
        (lambda: ss.Body(MESH, E=math.inf, nu=0.3), "E"),
        (lambda: ss.Body(MESH, E=1.0, nu=math.nan), "nu"),
        (lambda: ss.Body(MESH, E=1.0, nu=0.7).simulation(), "Poisson"),
        (lambda: ss.Body(MESH, E=1.0, nu=0.3, density=-1.0), "density"),
        (lambda: ss.Body(MESH, E=1.0, nu=0.3, gravity=[1.0]), "gravity"),
        (lambda: ss.Body(SPACE, E=1.0, nu=0.3, antiplane=True), "antiplane"),
        (lambda: body().fix(OTHER), "part"),
        (lambda: body().fix(PART, "q"), "components"),
        (lambda: body().fix(PART, ""), "components"),
        (lambda: body().drive(PART, [1.0]), "velocity"),
        (lambda: body().drive(PART, [1.0, math.nan]), "velocity"),
        (lambda: body().drive(PART, "fast"), "velocity"),
        (lambda: contact(normal_stress="gravity"), "normal_stress"),
        (lambda: contact(normal_stress=[1.0, 2.0]), "normal_stress"),
        (lambda: contact(normal_stress=math.nan), "normal_stress"),
        (lambda: contact(normal_stress=-1.0), "tension|compression|normal stress"),
        (lambda: contact(a=0.0), "a must"),
        (lambda: contact(b=-1.0), "b must"),
        (lambda: contact(Dc=math.nan), "Dc"),
        (lambda: contact(V0=0.0), "V0"),
        (lambda: contact(theta=0.0), "theta"),
        (lambda: contact(theta=[1.0, -1.0, 1.0]), r"theta\[1\]"),
        (lambda: contact(theta=[1.0]), "theta"),
        (lambda: contact(law="ageing"), "law"),
        (lambda: contact(friction="sticky"), "friction"),
        (lambda: contact(cohesion=-1.0), "cohesion"),
        (lambda: contact(opposite=OTHER), "opposite"),
        (lambda: body().coulomb(PART, normal_stress=1.0, coefficient=-1.0), "coefficient"),
        (lambda: body().simulation(scheme="euler"), "scheme"),
        (lambda: body().simulation(solver="magic"), "solver"),
        (lambda: body().simulation(coupling="loose"), "coupling"),
        (lambda: body().simulation(state_update="euler"), "state_update"),
        (lambda: body().simulation(tolerance=0.0), "tolerance"),
        (lambda: body().simulation(absolute_tolerance=math.nan), "absolute_tolerance"),
        (lambda: list(body().simulation().run(steps=1)), "dt or rtol"),
        (lambda: list(body().simulation().run(dt=1.0)), "until or steps"),
        (lambda: list(body().simulation().run(steps=1, dt=-1.0)), "dt"),
        (lambda: list(body().simulation().run(steps=0, dt=1.0)), "steps"),
        (lambda: list(body().simulation().run(steps=1, dt=1.0, every=0)), "every"),
        (lambda: list(body().simulation().run(until=-1.0, dt=1.0)), "until"),
        (lambda: list(body().simulation().run(until=math.nan, dt=1.0)), "until"),
        (lambda: list(body().simulation().run(until=1.0, rtol=0.0)), "rtol"),
        (lambda: body().simulation().step(math.nan), "dt"),
        (lambda: body().simulation().restore(b"nothing"), "state"),
    ],
)
def test_misuse_is_named(call: object, named: str) -> None:
    with pytest.raises((ValueError, TypeError), match=named):
        call()  # type: ignore[operator]


@pytest.mark.parametrize("wrong", [None, "x", [1.0], {}, object()])
@pytest.mark.parametrize("name", ["E", "nu", "density"])
def test_wrong_types_are_named(name: str, wrong: object) -> None:
    arguments: dict[str, object] = {"E": 1e9, "nu": 0.3, name: wrong}
    with pytest.raises(TypeError, match=name):
        ss.Body(MESH, **arguments)  # type: ignore[arg-type]


def test_parts_of_another_mesh_are_refused() -> None:
    other = ss.Mesh.grid([1.0, 1.0], [3, 3]).part(lambda x: x[1] == 0.0)
    wrong = body()
    wrong.fix(other)
    with pytest.raises(ss.SceneError, match="mesh"):
        wrong.simulation()


def test_a_bar_opens_under_tension_and_closes() -> None:
    mesh = ss.Mesh.grid([1.0, 2.0], [2, 4]).with_surface("fault", lambda x: x[1] == 1.0).split("fault")
    body = ss.Body(mesh, E=1.0, nu=0.0)
    body.fix(mesh.part(lambda x: x[1] == 0.0))
    body.drive(mesh.part(lambda x: x[1] == 2.0), lambda t: [0.0, 2e-3 * (1.0 - t)])
    plus, minus = mesh.part("fault+"), mesh.part("fault-")
    body.coulomb(plus, opposite=minus, normal_stress="body", coefficient=0.5, allow_opening=True)
    bar = body.simulation(solver="condensed")
    for at in bar.run(dt=0.1, steps=25):
        top = 1e-3 * at.time * (2.0 - at.time)
        assert at.contacts[0].opening == pytest.approx(max(top, 0.0), abs=1e-5)
        assert at.contacts[0].normal_stress == pytest.approx(max(-0.5 * top, 0.0), abs=1e-5)


def test_shear_stress_of_a_contact_has_a_sign() -> None:
    for sign in (1.0, -1.0):
        mesh = ss.Mesh.grid([1.0, 1.0], [4, 4])
        body = ss.Body(mesh, E=5e7, nu=0.3, density=5e3)
        body.drive(mesh.part(lambda x: x[1] == 1.0), [sign * 1e-2, 0.0])
        friction = {"normal_stress": 1e3, "a": 0.02, "b": 0.01, "Dc": 1e-3, "theta": 1.0}
        body.contact(mesh.part(lambda x: x[1] == 0.0), **friction)
        contact = list(body.simulation().run(until=1.0, rtol=1e-4))[-1].contacts[0]
        assert contact.shear_stress.shape == (5, 2)
        assert (np.sign(contact.shear_stress[:, 0]) == sign).all()
        assert np.abs(contact.shear_stress[:, 0]) == pytest.approx(contact.mu * 1e3, rel=1e-6)
        assert contact.shear_stress[:, 1] == pytest.approx(0.0, abs=1e-9)
