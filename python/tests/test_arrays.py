"""Arrays without copies: views of objects that do not change, and arrays in the memory of results."""

import gc
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import stickslip as ss

MEDIUM = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}


def square() -> ss.Mesh:
    return ss.Mesh.grid([1.0, 1.0], [64, 64])


def block() -> ss.Mesh:
    return ss.Mesh.grid([1.0, 1.0, 1.0], [8, 8, 8])


def fitted() -> ss.FitResult:
    laws = {"a": 0.008, "b": 0.012, "Dc": 1.5e-5}
    t, mu, load = ss.velocity_step([1e-6, 1e-5], 3e-4, k=1500.0, **laws)
    return ss.fit(t, mu, load=load, k=1500.0)


def bottom(mesh: ss.Mesh) -> ss.Part:
    return mesh.part(lambda x: x[1] == 0.0)


VIEWS: dict[str, tuple[Callable[[], object], Callable[..., np.ndarray], tuple[int, ...]]] = {
    "vertices of a square": (square, lambda mesh: mesh.vertices, (65 * 65, 2)),
    "vertices of a block": (block, lambda mesh: mesh.vertices, (729, 3)),
    "vertices of a part": (lambda: bottom(square()), lambda part: part.vertices, (65,)),
    "points of a part": (lambda: bottom(block()), lambda part: part.points, (81, 3)),
    "weights of a part": (lambda: bottom(square()), lambda part: part.weights, (65,)),
    "times of a fit": (fitted, lambda fit: fit.t, (401,)),
    "curve of a fit": (fitted, lambda fit: fit.mu, (401,)),
    "residuals of a fit": (fitted, lambda fit: fit.residuals, (401,)),
}


@pytest.mark.parametrize("name", VIEWS)
def test_views_are_read_and_not_written(name: str) -> None:
    make, get, shape = VIEWS[name]
    owner = make()
    array = get(owner)
    assert array.base is owner and array.shape == shape and array.flags.c_contiguous
    assert np.shares_memory(array, get(owner))
    assert not array.flags.writeable and not array.flags.owndata
    for view in [array, array[1:], array.reshape(-1)]:
        with pytest.raises(ValueError, match="read-only"):
            view[0] = 0
        with pytest.raises(ValueError, match="WRITEABLE"):
            view.flags.writeable = True
    copy = array.copy()
    copy[0] += 1


@pytest.mark.parametrize("name", VIEWS)
def test_views_keep_their_owners_alive(name: str) -> None:
    make, get, _ = VIEWS[name]
    owner = make()
    before = sys.getrefcount(owner)
    array = get(owner)
    assert sys.getrefcount(owner) == before + 1
    expected, part = array.copy(), array[3:7]
    del owner
    gc.collect()
    # New arrays would reuse freed memory.
    others = [np.full_like(expected, 7) for _ in range(50)]
    assert (array == expected).all() and len(others) == 50
    del array
    gc.collect()
    assert (part == expected[3:7]).all()


def test_views_let_their_owners_go() -> None:
    mesh = square()
    before = sys.getrefcount(mesh)
    for _ in range(1000):
        mesh.vertices.sum()
    assert sys.getrefcount(mesh) == before


def test_columns_of_files_are_views(tmp_path: Path) -> None:
    (tmp_path / "table").write_text("# problem=x\nt slip\n0 1\n2 3\n")
    table = ss.SeasTable(tmp_path / "table")
    slip = table["slip"]
    assert slip.base is table and not slip.flags.writeable and list(slip) == [1.0, 3.0]
    fault = ss.LineFault([0.0, 1e3], 8, **MEDIUM)
    friction = {"a": 0.02, "b": 0.015, "Dc": 1e-2, "normal_stress": 5e7, "shear_stress": 3e7, "theta": 1e7}
    fault.simulation(**friction).run(1e3, seas=ss.SeasFiles(tmp_path, "x", line=fault.centers))
    line = ss.SeasTable(tmp_path / "slip.dat")
    positions = line.positions
    assert positions is not None and positions.base is line and not positions.flags.writeable
    del line, table
    assert (positions == fault.centers).all() and list(slip) == [1.0, 3.0]


def test_records_are_handed_over() -> None:
    fault = ss.LineFault([0.0, 1e3], 8, **MEDIUM)
    friction = {"a": 0.02, "b": 0.015, "Dc": 1e-2, "normal_stress": 5e7, "shear_stress": 3e7, "theta": 1e7}
    run = fault.simulation(**friction).run(1e3, every=1)
    slider = ss.SpringSlider(1e10, 1e6, a=0.010, b=0.015, Dc=1e-5).run(10.0)
    for record, names in [(run, ["t", "V", "slip", "theta"]), (slider, ["t", "V", "theta", "mu", "slip"])]:
        for name in names:
            array = getattr(record, name)
            # In memory of the record, the same in each look.
            assert array.base is not None and getattr(record, name) is array
    array, expected = run.V, run.V.copy()
    del run
    gc.collect()
    assert (array == expected).all()


def reduced() -> ss.BodySimulation:
    return body(reduced_up_to=100.0)


def body(**options: float) -> ss.BodySimulation:
    mesh = ss.Mesh.grid([5.0, 1.0], [10, 2])
    block = ss.Body(mesh, E=5e7, nu=0.3, density=5e3)
    block.drive(mesh.part(lambda x: x[1] == 1.0), [1e-4, 0.0])
    block.contact(bottom(mesh), normal_stress=1e5, a=0.010, b=0.015, Dc=1e-5, theta=1.0)
    return block.simulation(**options)


@pytest.mark.parametrize("simulate", [body, reduced])
def test_states_are_not_those_of_later_steps(simulate: Callable[[], ss.BodySimulation]) -> None:
    simulation = simulate()
    first = simulation.step(1e-3)
    kept = first.displacement.copy(), first.velocity.copy()
    assert first.displacement.shape == (33, 2) and first.displacement.flags.c_contiguous
    second = simulation.step(1e-3)
    assert (first.displacement == kept[0]).all() and (first.velocity == kept[1]).all()
    assert (second.displacement != kept[0]).any()
    # The driven side moves along the first axis by 1e-7 m a step.
    assert second.displacement.max(axis=0)[0] == pytest.approx(2e-7)
