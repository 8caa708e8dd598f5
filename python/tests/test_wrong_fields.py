"""Wrong inputs of fields: each is an error that names its argument, in words of Python."""

import math
from collections.abc import Callable

import numpy as np
import pytest

import stickslip as ss

MEDIUM = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}
CELLS = {"a": 0.02, "b": 0.01, "Dc": 1e-2, "normal_stress": 50e6, "shear_stress": 15e6, "theta": 1e8}
ZONE = {"permeability": 1e-13, "viscosity": 1e-3, "storage": 1e-9, "thickness": 1.0}
HEAT = {"half_width": 0.01, "heat_capacity": 2.7e6, "thermal_diffusivity": 1e-6, "initial_temperature": 483.15}
FLUID = {"hydraulic_diffusivity": 4e-4, "pressurization_coefficient": 1e5}


def heating(**wrong: object) -> object:
    return ss.ShearHeating(**{**HEAT, **wrong})  # type: ignore[arg-type]


def thermal(**wrong: object) -> object:
    return ss.ThermalPressurization(**{**HEAT, **FLUID, **wrong})  # type: ignore[arg-type]


def diffusion(**wrong: object) -> ss.Diffusion:
    return ss.Diffusion(**{**ZONE, **wrong})  # type: ignore[arg-type]


def well(**wrong: object) -> ss.Well:
    return ss.Well(**{"position": 0.0, "times": [0.0], "rates": [1e-6], **wrong})  # type: ignore[arg-type]


def source(**wrong: object) -> ss.GaussianSource:
    given = {"position": 500.0, "deviation": 10.0, "times": [0.0], "rates": [1e-6]}
    return ss.GaussianSource(**{**given, **wrong})  # type: ignore[arg-type]


def leak(**wrong: object) -> object:
    return ss.LeakOff(**{"drainage_time": 1e4, **wrong})  # type: ignore[arg-type]


def pores(**wrong: object) -> object:
    given = {"coefficient": 1e-4, "reference_velocity": 1e-9, "slip_distance": 1e-2}
    return ss.Dilatancy(**{**given, **wrong})  # type: ignore[arg-type]


def evolution(**wrong: object) -> ss.PermeabilityEvolution:
    given = {"minimum": 1e-16, "maximum": 1e-13, "slip_distance": 1e-2, "healing_time": 1e8}
    return ss.PermeabilityEvolution(**{**given, **wrong})  # type: ignore[arg-type]


def cells(**wrong: object) -> object:
    fault = ss.LineFault([0.0, 1e3], 8, **MEDIUM)
    return fault.simulation(**{**CELLS, **wrong})  # type: ignore[arg-type]


def on_line(**wrong: object) -> object:
    return cells(fields=[diffusion(**wrong)])


def on_plane(**wrong: object) -> object:
    fault = ss.PlaneFault([-1e3, 1e3], [0.0, 1e3], [4, 2], **MEDIUM)
    return fault.simulation(**CELLS, fields=[diffusion(**wrong)])  # type: ignore[arg-type]


def slider(**wrong: object) -> object:
    return ss.SpringSlider(1e9, 1e6, a=0.01, b=0.015, Dc=1e-5, **wrong)  # type: ignore[arg-type]


def on_planes(**wrong: object) -> object:
    half = [ss.PlaneFault([-1e3, 1e3], [1e3, 2e3], [4, 2], dip=90.0, **MEDIUM) for _ in range(2)]
    system = ss.FaultSystem(half, strikes=[0.0, 0.0], origins=[[0.0, 0.0], [5e3, 0.0]])
    return system.simulation(**CELLS, fields=[diffusion(**wrong)])  # type: ignore[arg-type]


BORE = {"storage": 1e-9, "radius": 0.1}

WRONG: list[tuple[Callable[..., object], dict[str, object], str]] = [
    (heating, {"half_width": 0.0}, "half_width"),
    (heating, {"half_width": "1 cm"}, "half_width"),
    (heating, {"heat_capacity": [2.7e6, -1.0]}, "heat_capacity[1]"),
    (heating, {"thermal_diffusivity": -1e-6}, "thermal_diffusivity"),
    (heating, {"initial_temperature": math.nan}, "initial_temperature"),
    (heating, {"modes": 1}, "modes"),
    (heating, {"modes": 65}, "modes"),
    (heating, {"modes": 24.0}, "modes"),
    (thermal, {"hydraulic_diffusivity": math.inf}, "hydraulic_diffusivity"),
    (thermal, {"pressurization_coefficient": None}, "pressurization_coefficient"),
    (thermal, {"pressurization_coefficient": [[1e5, 1e5], [1e5, -1.0]]}, "pressurization_coefficient[1, 1]"),
    (diffusion, {"permeability": -1e-13}, "permeability"),
    (diffusion, {"viscosity": 0.0}, "viscosity"),
    (diffusion, {"storage": [1e-9, math.nan]}, "storage[1]"),
    (diffusion, {"thickness": 1.0 + 1.0j}, "thickness"),
    (diffusion, {"initial_pressure": math.inf}, "initial_pressure"),
    (diffusion, {"wells": 3.0}, "wells"),
    (diffusion, {"wells": [source()]}, "wells"),
    (diffusion, {"wells": well()}, "wells"),
    (diffusion, {"sources": [1e-6]}, "sources"),
    (diffusion, {"sides": "sealed"}, "sides"),
    (diffusion, {"sides": {"left": "sealed"}}, "sides"),
    (diffusion, {"sides": {"begin": "open"}}, "sides"),
    (diffusion, {"sides": {"begin": ("pressure", "high")}}, "sides"),
    (diffusion, {"sides": {"begin": ("pressure",)}}, "sides"),
    (diffusion, {"sides": {"begin": ("flux", math.nan)}}, "sides"),
    (diffusion, {"sides": {"begin": 1e6}}, "sides"),
    (diffusion, {"leak_off": 1e4}, "leak_off"),
    (diffusion, {"dilatancy": {}}, "dilatancy"),
    (diffusion, {"fourth_order": 1}, "fourth_order"),
    (well, {"position": "middle"}, "position"),
    (well, {"position": [1.0, 2.0, 3.0]}, "position"),
    (well, {"position": math.nan}, "position"),
    (well, {"times": []}, "times"),
    (well, {"times": 0.0}, "times"),
    (well, {"times": [0.0, 1.0]}, "rates"),
    (well, {"times": [1.0, 0.0], "rates": [1.0, 0.0]}, "times[1]"),
    (well, {"rates": [math.inf]}, "rates[0]"),
    (well, {"interpolation": "cubic"}, "interpolation"),
    (well, {"storage": 1e-9}, "radius"),
    (well, {"radius": 0.1}, "storage"),
    (well, {**BORE, "index": 1e-9}, "index"),
    (well, {"storage": -1e-9, "radius": 0.1}, "storage"),
    (source, {"deviation": 0.0}, "deviation"),
    (source, {"rates": "fast"}, "rates"),
    (leak, {"drainage_time": 0.0}, "drainage_time"),
    (leak, {"far_pressure": math.nan}, "far_pressure"),
    (pores, {"coefficient": -1e-4}, "coefficient"),
    (pores, {"reference_velocity": 0.0}, "reference_velocity"),
    (pores, {"slip_distance": [1e-2]}, "slip_distance"),
    (evolution, {"minimum": -1.0}, "minimum"),
    (evolution, {"healing_time": 0.0}, "healing_time"),
    (cells, {"fields": diffusion()}, "fields"),
    (cells, {"fields": [1e6]}, "fields"),
    (cells, {"fields": [well()]}, "fields"),
    (cells, {"fields": [thermal(half_width=[0.01] * 7)]}, "fields[0].half_width"),
    (cells, {"fields": [heating(), heating(half_width=np.full((2, 4), 0.01))]}, "fields[1].half_width"),
    (cells, {"least_normal_stress": 0.0}, "least_normal_stress"),
    (cells, {"least_normal_stress": "little"}, "least_normal_stress"),
    (cells, {"least_normal_stress": 1e5, "allow_opening": True}, "least"),
    (on_line, {"permeability": [1e-13] * 9}, "fields[0].permeability"),
    (on_line, {"wells": [well(position=-1.0)]}, "fields[0].wells[0]"),
    (on_line, {"wells": [well(), well(position=[0.0, 0.0])]}, "fields[0].wells[1].position"),
    (on_line, {"wells": [well(**BORE)]}, "fields[0].wells[0].radius"),
    (on_line, {"wells": [well()], "permeability": 0.0}, "fields[0].wells[0]"),
    (on_line, {"sources": [source(position=2e3)]}, "fields[0].sources[0]"),
    (on_line, {"sides": {"top": "sealed"}}, "fields[0].sides"),
    (on_line, {"fourth_order": True}, "fields[0].fourth_order"),
    (on_line, {"leak_off": leak(drainage_time=[1e4] * 3)}, "fields[0].leak_off.drainage_time"),
    (on_line, {"permeability_evolution": evolution(maximum=1e-14)}, "fields[0].permeability_evolution"),
    (on_line, {"permeability_evolution": evolution(minimum=1e-12)}, "fields[0].permeability_evolution"),
    (on_plane, {"permeability": np.full((4, 2), 1e-13)}, "fields[0].permeability"),
    (on_plane, {"wells": [well()]}, "fields[0].wells[0].position"),
    (on_plane, {"wells": [well(position=[0.0, 500.0], storage=1e-9, radius=1e3)]}, "fields[0].wells[0]"),
    (on_plane, {"sources": [source()]}, "fields[0].sources[0].position"),
    (on_plane, {"plane": 0}, "fields[0].plane"),
    (on_planes, {}, "fields[0].plane"),
    (on_planes, {"plane": 2}, "fields[0].plane"),
    (on_planes, {"plane": 1, "permeability": [1e-13] * 16}, "fields[0].permeability"),
    (diffusion, {"plane": -1}, "plane"),
    (slider, {"fields": [diffusion()]}, "fields[0]"),
    (slider, {"fields": [thermal(half_width=[0.01, 0.02])]}, "fields[0].half_width"),
    (slider, {"fields": 3}, "fields"),
]

RUST = ["::", "Py", "PerVertex", "Vec<", "f64", "usize", "variant", "unwrap", "panicked", "Some(", "`with_"]


@pytest.mark.parametrize(("call", "wrong", "named"), WRONG)
def test_wrong_inputs_are_named(call: Callable[..., object], wrong: dict[str, object], named: str) -> None:
    with pytest.raises((ValueError, TypeError)) as refused:
        call(**wrong)
    message = str(refused.value)
    assert named in message and len(message) > len(named) + 10
    assert not any(word in message for word in RUST), message
    assert "\n" not in message
