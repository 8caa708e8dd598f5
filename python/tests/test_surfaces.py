"""Faults of triangles."""

import pickle
from pathlib import Path

import numpy as np
import pytest

import stickslip as ss

MEDIUM = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}
CELLS = {"a": 0.015, "b": 0.010, "Dc": 1e-2, "normal_stress": 5e7, "shear_stress": 3e7, "theta": 1e7}


def grid(count: int, side: float, dip: float = 60.0, top: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Two triangles per square of a plane that dips to the south."""
    i, j = np.meshgrid(np.arange(count + 1), np.arange(count + 1))
    down = side * j.ravel() + top
    angle = np.radians(dip)
    points = np.column_stack([side * i.ravel(), -down * np.cos(angle), -down * np.sin(angle)])
    corners = [n * (count + 1) + m for n in range(count) for m in range(count)]
    row = count + 1
    triangles = [t for k in corners for t in ((k, k + 1, k + row + 1), (k, k + row + 1, k + row))]
    return points, np.array(triangles)


def test_triangles_know_their_geometry() -> None:
    cells = ss.Triangles(*grid(4, 1e3))
    assert len(cells) == 32 and cells.areas.sum() == pytest.approx(16e6)
    assert cells.points.shape == (25, 3) and cells.triangles.shape == (32, 3)
    assert cells.centers == pytest.approx(cells.points[cells.triangles.astype(int)].mean(axis=1))
    assert np.cross(cells.strikes, cells.dips) == pytest.approx(cells.normals)
    # Up dip of a plane that dips 60 degrees to the south is north and up.
    assert cells.dips == pytest.approx(np.tile([0.0, 0.5, np.sqrt(0.75)], (32, 1)))
    assert set(cells.sheets.tolist()) == {0} and "32 triangles" in cells.quality["text"]


def test_a_plane_of_triangles_slips_as_one_of_rectangles() -> None:
    """Mean slips agree but for cells at rims, whose share is that of their size."""
    triangles = ss.SurfaceFault(ss.Triangles(*grid(16, 250.0, top=1e3)), rake=90.0, **MEDIUM)
    plane = ss.PlaneFault([0.0, 4e3], [1e3, 5e3], [16, 16], dip=60.0, rake=90.0, **MEDIUM)
    runs = [fault.simulation(**CELLS, plate_rate=1e-9, stress_rate=1.0).run(1e7) for fault in (triangles, plane)]
    means = [run.slip[-1].mean() for run in runs]
    assert means[0] == pytest.approx(means[1], rel=0.06)


def test_slip_has_one_component_or_two() -> None:
    cells = ss.Triangles(*grid(3, 1e3, top=1e3))
    free = ss.SurfaceFault(cells, rake="free", **MEDIUM)
    run = free.simulation(**{**CELLS, "shear_stress": [3e7, 1e7]}, plate_rate=free.along([1e-9, 0.0, 0.0])).run(1e5)
    assert run.slip.shape[1:] == (18, 2) and (run.slip[-1] > 0.0).all()
    # One velocity as rakes: slip along it has the rate of its projection.
    rakes = free.rakes_along([1e-9, 1e-9, 0.0])
    fault = ss.SurfaceFault(cells, rake=rakes, **MEDIUM)
    expected = np.hypot(*free.along([1e-9, 1e-9, 0.0]).T)
    assert fault.along([1e-9, 1e-9, 0.0]) == pytest.approx(expected)
    assert fault.simulation(**CELLS).run(1e5).V.shape[1] == 18


def test_slip_of_a_curved_fault_changes_the_normal_stress() -> None:
    points, triangles = grid(4, 1e3, top=1e3)
    points[:, 2] -= 1e-5 * points[:, 1] ** 2
    run = ss.SurfaceFault(ss.Triangles(points, triangles), **MEDIUM).simulation(**CELLS).run(1e6)
    assert abs(run.normal_stress[-1] - 5e7).max() > 1.0


def test_files_are_read(tmp_path: Path) -> None:
    path = tmp_path / "two.stl"
    facet = "facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n"
    points = [(0, 0, -1e3), (1e3, 0, -1e3), (1e3, -1e3, -2e3), (0, -1e3, -2e3)]
    text = "".join(
        facet.format("".join("vertex {} {} {}\n".format(*points[k]) for k in corners)) for corners in ((0, 1, 2), (0, 2, 3))
    )
    path.write_text(f"solid two\n{text}endsolid two\n")
    cells = ss.Triangles.stl(path)
    assert len(cells) == 2 and len(cells.points) == 4
    mesh = tmp_path / "two.msh"
    nodes = "".join(f"{n + 1} {x} {y} {z}\n" for n, (x, y, z) in enumerate(points))
    mesh.write_text(
        '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 "a"\n2 2 "b"\n$EndPhysicalNames\n'
        f"$Nodes\n4\n{nodes}$EndNodes\n$Elements\n2\n1 2 2 1 1 1 2 3\n2 2 2 2 2 1 3 4\n$EndElements\n"
    )
    assert len(ss.Triangles.gmsh(mesh)) == 2 and len(ss.Triangles.gmsh(mesh, groups=["b"])) == 1
    with pytest.raises(ss.SceneError, match="c"):
        ss.Triangles.gmsh(mesh, groups=["c"])
    with pytest.raises(ss.MeshError):
        ss.Triangles.stl(tmp_path / "none.stl")


def test_surfaces_are_pickled_and_say_what_they_are() -> None:
    cells = ss.Triangles(*grid(2, 1e3))
    for rake in (90.0, "free", np.linspace(0.0, 90.0, 8)):
        fault = ss.SurfaceFault(cells, rake=rake, **MEDIUM)  # type: ignore[arg-type]
        other = pickle.loads(pickle.dumps(fault))
        assert (other.centers == fault.centers).all() and np.all(other.rake == fault.rake)
    assert repr(cells) == "Triangles(8 triangles, 9 points)"
    assert repr(fault).startswith("SurfaceFault(cells=Triangles(8 triangles")


@pytest.mark.parametrize(
    ("points", "triangles", "named"),
    [
        ([[0.0, 0.0, 0.0]], [], "triangles"),
        ([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], [[0, 1, 2]], "degenerate"),
        ([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[0, 1, 3]], "point 3"),
        ([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[0, 1, 1.5]], "integers"),
        ([[0.0, 0.0]], [[0, 1, 2]], "points"),
    ],
)
def test_triangles_are_checked(points: object, triangles: object, named: str) -> None:
    with pytest.raises((ValueError, TypeError), match=named):
        ss.Triangles(points, triangles)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"shear_wave_speed": -1.0}, "shear_wave_speed"),
        ({"poisson_ratio": 0.5}, "poisson_ratio"),
        ({"space": "periodic"}, "space"),
        ({"rake": "fixed"}, "rake"),
        ({"rake": [90.0]}, "rake"),
    ],
)
def test_surface_faults_are_checked(changed: dict[str, object], named: str) -> None:
    cells = ss.Triangles(*grid(2, 1e3))
    with pytest.raises((ValueError, TypeError), match=named):
        ss.SurfaceFault(cells, **{**MEDIUM, **changed})  # type: ignore[arg-type]
    above = ss.Triangles(*grid(2, 1e3, top=-1e3))
    with pytest.raises(ss.FaultError, match="above the free surface"):
        ss.SurfaceFault(above, **MEDIUM)
