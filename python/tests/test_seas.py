"""Files of the SEAS benchmarks: those of the command line, read back as arrays."""

import os
import stat
import subprocess
from pathlib import Path

import numpy as np
import pytest
from test_faults import MEDIUM, YEAR, bp1, plane

import stickslip as ss


def test_files_are_those_of_the_command_line(tmp_path: Path) -> None:
    program = os.environ.get("STICKSLIP")
    if program is None:
        pytest.skip("STICKSLIP is not set to the program `stickslip`")
    theirs, ours = tmp_path / "theirs", tmp_path / "ours"
    arguments = ["earthquakes", "--cell", "400", "--years", "10", "--out", str(tmp_path), "--seas", str(theirs)]
    subprocess.run([program, *arguments], check=True, capture_output=True)
    fault, simulation = bp1()
    files = ss.SeasFiles(
        ours,
        "SEAS Benchmark BP1-QD",
        stations=[0.0, 2.5e3, 5e3, 7.5e3, 10e3, 12.5e3, 15e3, 17.5e3, 20e3, 25e3, 30e3, 35e3],
        line=fault.centers,
        intervals=(5.0 * YEAR, 1.0),
        header={"element_size": "400 m"},
    )
    simulation.run(10.0 * YEAR, rtol=1e-4, stops=[255.0, 4095.0], seas=files)
    names = sorted(file.name for file in theirs.iterdir())
    assert len(names) == 15 and names == sorted(file.name for file in ours.iterdir())
    for name in names:
        assert (ours / name).read_text() == (theirs / name).read_text(), name


def test_files_are_read_as_arrays(tmp_path: Path) -> None:
    fault, simulation = bp1(800.0)
    files = ss.SeasFiles(tmp_path, "BP1", stations=[fault.centers[9]], line=fault.centers[::2], normal_stress=True)
    run = simulation.run(2.0 * YEAR, every=1, seas=files)
    station = ss.SeasTable(tmp_path / f"fltst_dp{fault.centers[9] / 100.0:03.0f}")
    assert station.names == ["t", "slip", "slip_rate", "shear_stress", "normal_stress", "state"]
    assert station.metadata("problem") == "BP1" and station.metadata("element_size") is None
    assert station.comments[0] == "problem=BP1" and station.positions is None
    assert (station["t"] == run.t).all() and len(station) == len(run.t)
    assert station["slip"] == pytest.approx(run.slip[:, 9], rel=1e-12)
    assert 10.0 ** station["slip_rate"] == pytest.approx(run.V[:, 9], rel=1e-9)
    assert 1e6 * station["shear_stress"] == pytest.approx(run.shear_stress[:, 9], rel=1e-12)
    assert (station["normal_stress"] == 50.0).all()
    assert 10.0 ** station["state"] == pytest.approx(run.theta[:, 9], rel=1e-9)
    assert station.values.shape == (len(run.t), 6) and (station.values[:, 1] == station["slip"]).all()
    everywhere = ss.SeasTable(tmp_path / "global.dat")
    assert 10.0 ** everywhere["max_slip_rate"] == pytest.approx(run.V.max(axis=1), rel=1e-9)
    assert everywhere["moment_rate"] == pytest.approx(MEDIUM["shear_modulus"] * 800.0 * run.V.sum(axis=1), rel=1e-9)
    slip = ss.SeasTable(tmp_path / "slip.dat")
    assert slip.positions is not None and (slip.positions == fault.centers[::2]).all()
    assert slip.values[:, 2:] == pytest.approx(run.slip[:, ::2], rel=1e-12)
    assert len(ss.SeasTable(tmp_path / "shear_stress.dat")) == len(ss.SeasTable(tmp_path / "normal_stress.dat"))
    assert not (tmp_path / "rupture.dat").exists()
    with pytest.raises(KeyError, match="opening"):
        station["opening"]


def test_stations_on_a_plane_have_two_components(tmp_path: Path) -> None:
    fault, arguments = plane()
    line = [[x, 1e3] for x in (-2e3, 0.0, 2e3)]
    files = ss.SeasFiles(tmp_path, "thrust", stations=[[-2e3, 1e3]], line=line, unit=1e3, digits=2)
    run = fault.simulation(**arguments).run(YEAR, every=1, seas=files)
    station = ss.SeasTable(tmp_path / "fltst_strk-02dp+01")
    # A thrust slips up dip, component 3 of the benchmarks is down dip.
    slip = np.array([run.slip[:, k] for k in range(len(fault)) if abs(fault.centers[k] - [-2e3, 1e3]).max() < 300.0])
    assert station["slip_3"] == pytest.approx(-slip.mean(axis=0), rel=1e-9)
    assert np.abs(station["slip_2"]).max() < 1e-15 * np.abs(station["slip_3"]).max() + 1e-30
    assert ss.SeasTable(tmp_path / "slip_strike.dat").values[-1, 2] == pytest.approx(-station["slip_3"][-1])


def test_ruptures_are_written(tmp_path: Path) -> None:
    fault = ss.LineFault([-1e3, 1e3], 40, space="whole", **MEDIUM)
    a = np.where(np.abs(fault.centers) < 600.0, 0.010, 0.025)
    friction = {"a": a, "b": 0.015, "Dc": 4e-4, "normal_stress": 50e6, "theta": 4e-4 / 1e-9}
    simulation = fault.simulation(**friction, shear_stress=25e6, plate_rate=1e-9)
    simulation.run(10.0 * YEAR, seas=ss.SeasFiles(tmp_path, "patch"))
    rupture = ss.SeasTable(tmp_path / "rupture.dat")
    assert len(rupture) == 40 and sorted(file.name for file in tmp_path.iterdir()) == ["global.dat", "rupture.dat"]


LINE = {"ends": [0.0, 1e3], "cells": 8, **MEDIUM}
CELLS = {"a": 0.01, "b": 0.015, "Dc": 1e-2, "normal_stress": 5e7, "shear_stress": 3e7, "theta": 1e7}


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        ({"intervals": (0.0, 1.0)}, "intervals"),
        ({"intervals": 1.0}, "intervals"),
        ({"threshold": 0.0}, "threshold"),
        ({"unit": -1.0}, "unit"),
        ({"digits": 0}, "digits"),
        ({"digits": 10**9}, "digits"),
        ({"stations": 1.0}, "stations"),
        ({"stations": [[1.0, 2.0, 3.0]]}, "stations"),
        ({"line": "x"}, "line"),
        ({"header": 3}, "header"),
        ({"header": {"element_size": 25}}, "header"),
        ({"problem": 1}, "problem"),
        ({"stations": [2e3]}, "[2000.0] m"),
        ({"stations": [[0.0, 0.0]]}, "dimension"),
        ({"line": [np.nan]}, ""),
    ],
)
def test_files_are_checked(tmp_path: Path, wrong: dict[str, object], named: str) -> None:
    with pytest.raises((ValueError, TypeError)) as raised:
        files = ss.SeasFiles(**{"folder": tmp_path, "problem": "BP1", **wrong})  # type: ignore[arg-type]
        ss.LineFault(**LINE).simulation(**CELLS).run(1.0, seas=files)
    assert named in str(raised.value) + "".join(getattr(raised.value, "__notes__", []))


def test_folders_and_files_that_cannot_be_used_are_errors(tmp_path: Path) -> None:
    simulation = ss.LineFault(**LINE).simulation(**CELLS)
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError, match="file"):
        simulation.run(1.0, seas=ss.SeasFiles(tmp_path / "file", "BP1"))
    with pytest.raises(TypeError, match="seas"):
        simulation.run(1.0, seas="folder")  # type: ignore[arg-type]
    assert simulation.time == 0.0
    with pytest.raises(FileNotFoundError, match="missing"):
        ss.SeasTable(tmp_path / "missing")
    (tmp_path / "words").write_text("t slip\n0 1\n2 three\n4 5\n")
    with pytest.raises(ss.FileError, match="three") as raised:
        ss.SeasTable(tmp_path / "words")
    assert raised.value.line == 3 and Path(raised.value.path) == tmp_path / "words"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_a_full_disk_ends_the_run(tmp_path: Path) -> None:
    assert stat.S_ISCHR(os.stat("/dev/full").st_mode)
    (tmp_path / "global.dat").symlink_to("/dev/full")
    simulation = ss.LineFault(**LINE).simulation(**CELLS)
    with pytest.raises(OSError, match="global.dat"):
        simulation.run(1e3, seas=ss.SeasFiles(tmp_path, "BP1"))
