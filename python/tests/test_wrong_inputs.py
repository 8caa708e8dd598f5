"""A hundred wrong inputs: each is an error that names its argument, in words of Python."""

import math
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import stickslip as ss

MEDIUM = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}
SLIDER = {"stiffness": 1e9, "normal_stress": 1e6, "a": 0.01, "b": 0.015, "Dc": 1e-5}
CELLS = {"a": 0.01, "b": 0.015, "Dc": 1e-2, "normal_stress": 5e7, "shear_stress": 3e7, "theta": 1e7}
LINE = {"ends": [0.0, 1e3], "cells": 8, **MEDIUM}
PLANE = {"along_strike": [-1e3, 1e3], "down_dip": [0.0, 1e3], "cells": [4, 2], **MEDIUM}
BODY = {"E": 5e7, "nu": 0.3, "density": 5e3}
CONTACT = {"normal_stress": 1e3, "a": 0.01, "b": 0.015, "Dc": 1e-3, "theta": 1.0}
STEP = {"k": 1e3, "a": 0.01, "b": 0.015, "Dc": 1e-5}

Wrong = tuple[Callable[..., object], dict[str, object], str]


def slider(**wrong: object) -> object:
    return ss.SpringSlider(**{**SLIDER, **wrong})  # type: ignore[arg-type]


def slide(**wrong: object) -> object:
    return ss.SpringSlider(**SLIDER).run(**{"until": 1.0, **wrong})  # type: ignore[arg-type]


def line(**wrong: object) -> object:
    return ss.LineFault(**{**LINE, **wrong})  # type: ignore[arg-type]


def cells(**wrong: object) -> object:
    return ss.LineFault(**LINE).simulation(**{**CELLS, **wrong})  # type: ignore[arg-type]


def plane(**wrong: object) -> object:
    return ss.PlaneFault(**{**PLANE, **wrong})  # type: ignore[arg-type]


def plane_cells(**wrong: object) -> object:
    return ss.PlaneFault(**PLANE).simulation(**{**CELLS, **wrong})  # type: ignore[arg-type]


def free_cells(**wrong: object) -> object:
    stress = {"shear_stress": [3e7, 0.0]}
    return ss.PlaneFault(**PLANE, rake="free").simulation(**{**CELLS, **stress, **wrong})  # type: ignore[arg-type]


def slip(**wrong: object) -> object:
    return ss.LineFault(**LINE).simulation(**CELLS).run(**{"until": 1e3, **wrong})  # type: ignore[arg-type]


def grid(**wrong: object) -> object:
    return ss.Mesh.grid(**{"size": [1.0, 1.0], "cells": [2, 2], **wrong})  # type: ignore[arg-type]


def body(**wrong: object) -> object:
    return ss.Body(**{"mesh": ss.Mesh.grid([1.0, 1.0], [2, 2]), **BODY, **wrong})  # type: ignore[arg-type]


def begin(contact: dict[str, object], start: dict[str, object]) -> ss.BodySimulation:
    mesh = ss.Mesh.grid([1.0, 1.0], [2, 2])
    whole = ss.Body(mesh, **BODY)
    whole.contact(mesh.part(lambda x: x[1] == 0.0), **{**CONTACT, **contact})  # type: ignore[arg-type]
    return whole.simulation(**start)  # type: ignore[arg-type]


def contact(**wrong: object) -> object:
    return begin(wrong, {})


def start(**wrong: object) -> object:
    return begin({}, wrong)


def move(**wrong: object) -> object:
    return list(begin({}, {}).run(**{"until": 0.1, "dt": 0.01, **wrong}))  # type: ignore[arg-type]


def drive(**wrong: object) -> object:
    mesh = ss.Mesh.grid([1.0, 1.0], [2, 2])
    whole = ss.Body(mesh, **BODY)
    given = {"part": mesh.part(lambda x: x[1] == 1.0), "velocity": [1e-3, 0.0], **wrong}
    return whole.drive(**given)  # type: ignore[arg-type]


def seas(**wrong: object) -> object:
    return ss.SeasFiles(**{"folder": "files", "problem": "BP1", **wrong})  # type: ignore[arg-type]


T = np.linspace(0.0, 10.0, 100)


def fit(**wrong: object) -> object:
    return ss.fit(**{"t": T, "mu": np.full(100, 0.6), "load": [(0.0, 1e-6), (5.0, 1e-5)], **wrong})  # type: ignore[arg-type]


WRONG: list[Wrong] = [
    (fit, {"t": "times"}, "t"),
    (fit, {"mu": [None] * 100}, "mu"),
    (fit, {"mu": T[:50]}, "100 samples"),
    (fit, {"load": 1e-6}, "load"),
    (fit, {"window": 3.0}, "window"),
    (fit, {"fixed": [0.01]}, "fixed"),
    (fit, {"states": -1}, "states"),
    (fit, {"trend": "parabola"}, "trend"),
    (fit, {"loss": "cubes"}, "loss"),
    (slider, {"stiffness": "stiff"}, "stiffness"),
    (slider, {"stiffness": 0.0}, "stiffness"),
    (slider, {"stiffness": None}, "stiffness"),
    (slider, {"normal_stress": -1e6}, "normal_stress"),
    (slider, {"normal_stress": [1e6, 1e6]}, "normal_stress"),
    (slider, {"a": 0.0}, "a"),
    (slider, {"a": None}, "a"),
    (slider, {"b": math.nan}, "b"),
    (slider, {"Dc": -1e-5}, "Dc"),
    (slider, {"Dc": "10 um"}, "Dc"),
    (slider, {"mu0": math.inf}, "mu0"),
    (slider, {"V0": 0.0}, "V0"),
    (slider, {"friction": "coulomb"}, "friction"),
    (slider, {"friction": 0.6}, "friction"),
    (slider, {"law": "ageing"}, "law"),
    (slider, {"law": "kato-tullis"}, "Vc"),
    (slider, {"law": "nagata"}, "c"),
    (slider, {"law": "nagata", "c": 0.0}, "c"),
    (slider, {"Vc": 1e-8}, "Vc"),
    (slider, {"law": "nagata", "c": 2.0, "friction": "regularized"}, "friction"),
    (slider, {"load": []}, "load"),
    (slider, {"load": [(1.0, 1e-6)]}, "load"),
    (slider, {"load": [(0.0, 1e-6), (0.0, 1e-5)]}, "load"),
    (slider, {"load": "fast"}, "load"),
    (slider, {"load": [(0.0, math.nan)]}, "load"),
    (slider, {"theta": 0.0}, "theta"),
    (slider, {"V": -1.0}, "V"),
    (slide, {"until": 0.0}, "until"),
    (slide, {"until": "noon"}, "until"),
    (slide, {"rtol": 0.0}, "rtol"),
    (slide, {"max_steps": -1}, "max_steps"),
    (slide, {"max_steps": 1.5}, "max_steps"),
    (slide, {"t_eval": [0.5, 0.1]}, "t_eval"),
    (slide, {"t_eval": [2.0]}, "t_eval"),
    (slide, {"t_eval": [[0.1]]}, "t_eval"),
    (slide, {"start": b"start"}, "start"),
    (slide, {"start": 3}, "start"),
    (slide, {"progress": "yes"}, "progress"),
    (line, {"ends": [0.0]}, "ends"),
    (line, {"ends": 1e3}, "ends"),
    (line, {"ends": [1e3, 0.0]}, "ends"),
    (line, {"cells": -8}, "cells"),
    (line, {"cells": 0}, "cells"),
    (line, {"cells": 8.0}, "cells"),
    (line, {"shear_modulus": 0.0}, "shear_modulus"),
    (line, {"shear_wave_speed": math.nan}, "shear_wave_speed"),
    (line, {"space": "full"}, "space"),
    (line, {"space": 2}, "space"),
    (line, {"poisson_ratio": 0.5}, "poisson_ratio"),
    (line, {"dip": 30.0}, "dip"),
    (line, {"sense": "left", "poisson_ratio": 0.25}, "sense"),
    (cells, {"a": [0.01] * 7}, "a"),
    (cells, {"a": np.full((2, 4), 0.01)}, "a"),
    (cells, {"b": [[0.01], [0.01, 0.02]]}, "b"),
    (cells, {"Dc": 1e-2 + 1j}, "Dc"),
    (cells, {"normal_stress": "50 MPa"}, "normal_stress"),
    (cells, {"normal_stress": -5e7}, "normal_stress"),
    (cells, {"shear_stress": None}, "shear_stress"),
    (cells, {"shear_stress": [math.nan] * 8}, "shear_stress"),
    (cells, {"theta": 0.0}, "theta"),
    (cells, {"log_theta": 1.0}, "theta"),
    (cells, {"slip_rate": 1.0}, "slip_rate"),
    (cells, {"plate_rate": [1e-9] * 9}, "plate_rate"),
    (cells, {"friction": "cut-off"}, "friction"),
    (cells, {"law": ["aging"] * 3}, "law"),
    (cells, {"alpha": -0.1}, "alpha"),
    (cells, {"alpha": 0.2, "b": 0.0}, "b"),
    (cells, {"allow_opening": "never"}, "allow_opening"),
    (cells, {"pressure": 1e6}, "pressure"),
    (cells, {"pressure": lambda time: [0.0] * 3}, "pressure"),
    (cells, {"overstress": lambda time: "none"}, "overstress"),
    (plane, {"cells": [4]}, "cells"),
    (plane, {"cells": 8}, "cells"),
    (plane, {"rake": "loose"}, "rake"),
    (plane, {"rake": None}, "rake"),
    (plane, {"along_strike": [1e3, -1e3]}, "along_strike"),
    (plane, {"dip": 120.0}, "dip"),
    (plane, {"space": "periodic"}, "space"),
    (plane_cells, {"a": np.full((4, 2), 0.01)}, "a"),
    (plane_cells, {"shear_stress": np.full((2, 4, 2), 3e7)}, "shear_stress"),
    (free_cells, {"shear_stress": 3e7}, "shear_stress"),
    (free_cells, {"shear_stress": np.full((2, 4), 3e7)}, "shear_stress"),
    (free_cells, {"plate_rate": [math.nan, 0.0]}, "plate_rate"),
    (slip, {"every": 0}, "every"),
    (slip, {"callback": 3}, "callback"),
    (slip, {"callback": lambda time, rate: 0, "every": 1}, "callback"),
    (slip, {"callback": lambda time, rate: [], "every": 1}, "callback"),
    (slip, {"callback": lambda time, rate: rate, "every": 1}, "callback"),
    (slip, {"threshold": (1e-3, 1e-2)}, "threshold"),
    (slip, {"threshold": 1e-3}, "threshold"),
    (slip, {"stops": [math.nan]}, "stops"),
    (slip, {"seas": "folder"}, "seas"),
    (slip, {"t_eval": [math.nan]}, "t_eval"),
    (slip, {"until": -1.0}, "until"),
    (grid, {"size": [1.0]}, "size"),
    (grid, {"size": [1.0, -1.0]}, "size"),
    (grid, {"cells": [2]}, "cells"),
    (grid, {"cells": [2, 0]}, "cells"),
    (grid, {"origin": [0.0]}, "origin"),
    (body, {"mesh": "mesh.msh"}, "mesh"),
    (body, {"E": -1.0}, "E"),
    (body, {"nu": 0.5}, "nu"),
    (body, {"gravity": [0.0, 0.0, -9.8]}, "gravity"),
    (body, {"antiplane": 1}, "antiplane"),
    (contact, {"normal_stress": "pressure"}, "normal_stress"),
    (contact, {"normal_stress": None}, "normal_stress"),
    (contact, {"theta": [1.0]}, "theta"),
    (contact, {"cohesion": -1.0}, "cohesion"),
    (contact, {"opposite": 3}, "opposite"),
    (start, {"scheme": "euler"}, "scheme"),
    (start, {"solver": "mumps"}, "solver"),
    (start, {"coupling": 1}, "coupling"),
    (start, {"tolerance": 0.0}, "tolerance"),
    (start, {"reduced_up_to": -1.0}, "reduced_up_to"),
    (move, {"dt": 0.0}, "dt"),
    (move, {"rtol": 1e-3}, "rtol"),
    (move, {"steps": -3}, "steps"),
    (drive, {"velocity": [1e-3]}, "velocity"),
    (drive, {"velocity": "fast"}, "velocity"),
    (drive, {"components": "z"}, "components"),
    (seas, {"stations": "surface"}, "stations"),
    (seas, {"stations": [[0.0, 1.0, 2.0]]}, "stations"),
    (seas, {"digits": 0}, "digits"),
    (seas, {"intervals": (1.0, 0.0)}, "intervals"),
    (seas, {"folder": 3}, "folder"),
]

RUST = ["::", "Py", "PerVertex", "Vec<", "f64", "usize", "variant", "unwrap", "panicked", "Some("]


@pytest.mark.parametrize(("call", "wrong", "named"), WRONG)
def test_wrong_inputs_are_named(call: Callable[..., object], wrong: dict[str, object], named: str) -> None:
    if call is fit and sys.version_info < (3, 11):
        pytest.skip("the binding names arguments of functions by notes, which are newer")
    with pytest.raises((ValueError, TypeError, AttributeError)) as refused:
        call(**wrong)
    message = str(refused.value)
    assert named in message and len(message) > len(named) + 10
    assert not any(word in message for word in RUST), message
    assert "\n" not in message


def test_there_are_a_hundred() -> None:
    assert len(WRONG) >= 100


def test_files_are_named(tmp_path: Path) -> None:
    with pytest.raises(ss.MeshError, match="none.msh"):
        ss.Mesh.gmsh(tmp_path / "none.msh")
    with pytest.raises(OSError, match="none"):
        ss.SeasTable(tmp_path / "none")
    with pytest.raises(TypeError, match="path"):
        ss.SeasTable(3)  # type: ignore[arg-type]


def test_a_fault_that_starts_at_seismic_rates_warns() -> None:
    with pytest.warns(UserWarning, match="seismic slip rate.*normal_stress"):
        cells(normal_stress=50.0)
    # It is meant where the rate is given, as of a benchmark that begins with an event.
    one = ss.LineFault([-4.0, 4.0], 8, space="whole", **MEDIUM)
    friction = {"a": 0.01, "b": 0.015, "Dc": 1e-2, "normal_stress": 5e7, "theta": 1.0, "V0": 1e-6}
    rate = 0.03
    x = rate / 2e-6 * math.exp((0.6 + 0.015 * math.log(1e-6 / 1e-2)) / 0.01)
    stress = 5e7 * 0.01 * math.asinh(x) + 0.5 * MEDIUM["shear_modulus"] / MEDIUM["shear_wave_speed"] * rate
    one.simulation(**friction, shear_stress=stress, slip_rate=rate)


def test_a_run_has_a_largest_number_of_steps() -> None:
    with pytest.raises(ss.StepError, match="max_steps") as refused:
        slip(max_steps=3, until=1e12)
    assert refused.value.kind == "TooManySteps"
