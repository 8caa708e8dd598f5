"""Thermal pressurization of contacts of bodies."""

import pickle

import numpy as np
import pytest
from test_fields import FLUID, HEAT, PEAK, ZONE

import stickslip as ss

UNDRAINED = ss.ThermalPressurization(
    **{**HEAT, "thermal_diffusivity": 0.0}, **{**FLUID, "hydraulic_diffusivity": 0.0}
)


def block(*fields: object, **further: object) -> ss.BodySimulation:
    """A block on a surface with a constant coefficient, whose top is driven at 1 m/s."""
    mesh = ss.Mesh.grid([1.0, 1.0], [3, 3])
    body = ss.Body(mesh, E=5e7, nu=0.3, density=5e3)
    body.drive(mesh.part(lambda x: x[1] == 1.0), [1.0, 0.0])
    bottom = mesh.part(lambda x: x[1] == 0.0)
    given = {"normal_stress": 1e6, "coefficient": 0.6, "fields": fields, **further}
    body.coulomb(bottom, **given)  # type: ignore[arg-type]
    return body.simulation()


def test_undrained_strength_falls_exponentially_with_slip() -> None:
    errors = []
    for dt in (2e-3, 1e-3):
        *_, state = block(UNDRAINED).run(until=0.3, dt=dt)
        contact = state.contacts[0]
        assert contact.slip.min() > 0.05 and contact.pore_pressure.max() < 1e6
        rise = contact.readings["temperature"] - HEAT["initial_temperature"]
        assert contact.pore_pressure == pytest.approx(FLUID["pressurization_coefficient"] * rise, rel=1e-9)
        assert contact.normal_stress == pytest.approx(1e6, rel=1e-12)
        assert contact.effective_normal_stress == pytest.approx(1e6 - contact.pore_pressure, rel=1e-12)
        rate = 0.6 * FLUID["pressurization_coefficient"] / HEAT["heat_capacity"] * PEAK
        exact = 1e6 * np.exp(-rate * contact.slip)
        errors.append(np.abs(contact.effective_normal_stress / exact - 1.0).max())
    # Of second order in the step.
    assert errors[0] < 1e-4 and errors[1] < 0.4 * errors[0]


def test_a_restart_has_the_same_bits() -> None:
    simulation, other = block(UNDRAINED), block(pickle.loads(pickle.dumps(UNDRAINED)))
    for _ in simulation.run(steps=50, dt=2e-3):
        pass
    other.restore(pickle.loads(pickle.dumps(simulation.state())))
    for _ in range(20):
        one, two = (run.step(2e-3).contacts[0] for run in (simulation, other))
        assert one.pore_pressure.any()
        assert (one.slip == two.slip).all() and (one.pore_pressure == two.pore_pressure).all()
        assert (one.readings["temperature"] == two.readings["temperature"]).all()
    twin = pickle.loads(pickle.dumps(one))
    assert (twin.readings["temperature"] == one.readings["temperature"]).all()


def test_heat_per_vertex_and_tables() -> None:
    pytest.importorskip("pandas")
    width = np.array([0.01, 0.02, 0.01, 0.02])
    contact = block(ss.ShearHeating(**{**HEAT, "half_width": width})).step(1e-3).contacts[0]
    assert list(contact.to_frame())[-1] == "temperature" and not contact.pore_pressure.any()
    assert "readings" not in block().step(1e-3).contacts[0].to_frame()


def test_wrong_fields_are_named() -> None:
    with pytest.raises(ValueError, match=r"fields\[0\] must be .* on a contact of a body, is Diffusion"):
        block(ss.Diffusion(**ZONE))
    with pytest.raises(ValueError, match=r"fields\[1\].half_width must be one number, or an array of 4 numbers"):
        block(UNDRAINED, ss.ShearHeating(**{**HEAT, "half_width": [0.01] * 3}))
    with pytest.raises(TypeError, match="fields"):
        block(1e6)
