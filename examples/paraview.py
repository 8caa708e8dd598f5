"""Opens what the example `paraview` has written in VTK itself, and checks the numbers.

The displacement of the body at the centre of the bottom is that of centre.csv, the stress of each cell that of the
displacement by Hooke's law, and slip rate, state and traction of the contact are those of the body and of the friction law.
"""

import csv
import pathlib
import sys
import xml.etree.ElementTree as xml

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonDataModel import VTK_LINE, VTK_TRIANGLE
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

# The paper's slider: SI units.
YOUNG, POISSON = 5e7, 0.3
NORMAL_STRESS, A, B, V0, MU0, LENGTH = 49_050.0, 0.010, 0.015, 1e-6, 0.6, 1e-5
CENTRE = (2.5, 0.0)
# The default tolerance of the solver, to which the coefficient of friction is right.
TOLERANCE = 1e-10


def read(path, shape, corners):
    """Points, cells, and fields at both by their names; any complaint of VTK ends the program."""
    complaints = []
    reader = vtkXMLUnstructuredGridReader()
    for event in (vtkCommand.ErrorEvent, vtkCommand.WarningEvent):
        reader.AddObserver(event, lambda *_: complaints.append(path.name))
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    if complaints or grid.GetNumberOfCells() == 0:
        sys.exit(f"{path}: VTK does not read it")
    if {grid.GetCellType(n) for n in range(grid.GetNumberOfCells())} != {shape}:
        sys.exit(f"{path}: cells of other shapes than {shape}")
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, corners)
    fields = []
    for data in (grid.GetPointData(), grid.GetCellData()):
        arrays = [data.GetArray(n) for n in range(data.GetNumberOfArrays())]
        fields.append({array.GetName(): vtk_to_numpy(array) for array in arrays})
    return vtk_to_numpy(grid.GetPoints().GetData()), cells, *fields


def stress(points, triangles, displacement):
    """Plane strain, cell by cell."""
    x, u = points[triangles][:, :, :2], displacement[triangles][:, :, :2]
    edges = np.stack([x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]], axis=1)
    change = np.stack([u[:, 1] - u[:, 0], u[:, 2] - u[:, 0]], axis=1)
    gradient = np.linalg.solve(edges, change)
    strain = 0.5 * (gradient + gradient.transpose(0, 2, 1))
    lame = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
    shear = YOUNG / (2 * (1 + POISSON))
    trace = np.trace(strain, axis1=1, axis2=2)
    return lame * trace[:, None, None] * np.eye(2) + 2 * shear * strain


def close(name, found, expected, relative):
    scale = max(np.abs(expected).max(), 1e-300)
    error = np.abs(found - expected).max() / scale
    if not error <= relative:
        sys.exit(f"{name}: {error:.1e} of the largest apart, {relative:.0e} allowed")
    return error


def main(folder):
    listed = xml.parse(folder / "slider.pvd").iter("DataSet")
    frames = {}
    for entry in listed:
        frames.setdefault(float(entry.get("timestep")), {})[entry.get("part")] = entry.get("file")
    rows = list(csv.DictReader(open(folder / "centre.csv")))
    assert [float(row["time"]) for row in rows] == list(frames), "the times of both files"
    worst = {}
    for row, files in zip(rows, frames.values()):
        points, triangles, at_points, at_cells = read(folder / files["0"], VTK_TRIANGLE, 3)
        fault_points, _, fault, _ = read(folder / files["1"], VTK_LINE, 2)
        displacement, velocity = at_points["displacement"], at_points["velocity"]
        found = stress(points, triangles, displacement)
        given = at_cells["stress"].reshape(-1, 3, 3)[:, :2, :2]
        centre = np.flatnonzero((points[:, 0] == CENTRE[0]) & (points[:, 1] == CENTRE[1]))[0]
        at = np.array([np.flatnonzero((points == x).all(axis=1))[0] for x in fault_points])
        rate, state, traction = fault["slip_rate"], fault["state"], fault["traction"][:, 0]
        # Where it creeps the traction is what holds the body in balance, which is that of friction up to what the
        # solver leaves: at a vertex a few times the tolerance, which is a mean over all.
        slides = rate > 1e-7
        coefficient = MU0 + A * np.log(rate[slides] / V0) + B * (state[slides] + np.log(V0 / LENGTH))
        compared = {
            "stress": close("stress", found, given, 1e-9),
            "displacement": close("displacement", displacement[centre, 0], float(row["displacement_x"]), 1e-15),
            "velocity": close("velocity", velocity[centre, 0], float(row["velocity_x"]), 1e-15),
            "slip rate": close("slip rate", rate, np.abs(velocity[at, 0]), 1e-15),
            "state": close("state", state[at == centre][0], float(row["state"]), 1e-15),
        }
        if slides.any():
            size = np.abs(traction[slides])
            compared["traction"] = close("traction", size, NORMAL_STRESS * coefficient, 10 * TOLERANCE)
        for name, error in compared.items():
            worst[name] = max(worst.get(name, 0.0), float(error))
    print(f"{len(frames)} times:", ", ".join(f"{name} {error:.1e}" for name, error in worst.items()))


main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out/paraview"))
