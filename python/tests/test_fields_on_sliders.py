"""Thermal pressurization of spring sliders."""

import pickle

import numpy as np
import pytest
from test_fields import DAY, FLUID, HEAT, PEAK, ZONE

import stickslip as ss


def heated(start: float = 1e-9, **fluid: float) -> ss.SpringSlider:
    """A block that slips through an instability."""
    laws = {"a": 0.010, "b": 0.015, "Dc": 8e-3, "friction": "regularized", "V": start}
    fields = [ss.ThermalPressurization(**HEAT, **{**FLUID, **fluid})]
    return ss.SpringSlider(3e6, 50e6, **laws, damping=4.62e6, load=1e-9, fields=fields)


def test_a_slider_weakens_by_its_heat() -> None:
    until = 140.0 * 365.25 * DAY
    dry, wet = heated(pressurization_coefficient=0.0).run(until), heated(hydraulic_diffusivity=1e-4).run(until)
    # The table of the page on heat and fluids, of the same patch in Rust.
    for run, rate, temperature in ((dry, 1.53, 1339.0), (wet, 3.69, 1365.0)):
        assert run.V.max() == pytest.approx(rate, rel=5e-3)
        assert run.readings["temperature"].max() == pytest.approx(temperature, rel=2e-3)
    assert not dry.pore_pressure.any()
    assert wet.pore_pressure.max() == pytest.approx(41.3e6, rel=2e-3)
    assert wet.effective_normal_stress == pytest.approx(50e6 - wet.pore_pressure, rel=1e-12)
    assert wet.shear_stress == pytest.approx(wet.mu * wet.effective_normal_stress, rel=1e-9)


def test_undrained_sliders_with_and_without_mass_follow_their_heat() -> None:
    rock = {**HEAT, "thermal_diffusivity": 0.0}
    field = ss.ThermalPressurization(**rock, **{**FLUID, "hydraulic_diffusivity": 0.0})
    for mass in (0.0, 1e5):
        laws = {"a": 0.010, "b": 0.015, "Dc": 1e-3, "damping": 5e6, "mass": mass, "load": 1e-6, "V": 1e-5}
        slider = ss.SpringSlider(1e9, 20e6, **laws, fields=[field])
        run = slider.run(1e4, rtol=1e-5)
        rise = run.readings["temperature"] - HEAT["initial_temperature"]
        assert run.pore_pressure == pytest.approx(1e5 * rise, rel=1e-6, abs=1.0)
        # The heat is the work of friction: the trapezoidal rule over steps is close to it.
        work = np.concatenate([[0.0], np.cumsum(0.5 * (run.shear_stress[1:] + run.shear_stress[:-1]) * np.diff(run.slip))])
        heat = HEAT["heat_capacity"] * rise / PEAK
        assert rise[-1] > 1.0 and heat[-1] == pytest.approx(work[-1], rel=1e-3)


def test_a_slider_goes_on_with_its_heat() -> None:
    slider = heated(1.05e-9)
    first = slider.run(1e9)
    twin = pickle.loads(pickle.dumps(slider))
    runs = [block.run(1.2e9, start=pickle.loads(pickle.dumps(first)).state) for block in (slider, twin)]
    assert runs[0].pore_pressure[0] == first.pore_pressure[-1]
    for name in ("t", "V", "pore_pressure", "effective_normal_stress"):
        assert (getattr(runs[0], name) == getattr(runs[1], name)).all()
    assert (runs[0].readings["temperature"] == runs[1].readings["temperature"]).all()
    assert repr(twin) == repr(slider) and isinstance(slider.fields[0], ss.ThermalPressurization)
    with pytest.raises(ValueError, match="start"):
        ss.SpringSlider(3e6, 50e6, a=0.01, b=0.015, Dc=8e-3).run(2e9, start=first.state)
    with pytest.raises(ValueError, match=r"fields\[0\] must be ThermalPressurization or ShearHeating on a slider"):
        ss.SpringSlider(3e6, 50e6, a=0.01, b=0.015, Dc=8e-3, fields=[ss.Diffusion(**ZONE)])
