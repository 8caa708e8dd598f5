"""Heat and fluids on faults: closed forms and readings."""

import math

import numpy as np
import pytest

import stickslip as ss

DAY = 86400.0
MEDIUM = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}
DAMPING = 0.5 * MEDIUM["shear_modulus"] / MEDIUM["shear_wave_speed"]
# At rest: strengthening far below its strength.
RESTING = {"a": 0.02, "b": 0.01, "Dc": 1e-2, "normal_stress": 50e6, "shear_stress": 15e6, "theta": 1e8}
ZONE = {"permeability": 1e-13, "viscosity": 1e-3, "storage": 1e-9, "thickness": 1.0}
HEAT = {"half_width": 0.01, "heat_capacity": 2.7e6, "thermal_diffusivity": 1e-6, "initial_temperature": 483.15}
FLUID = {"hydraulic_diffusivity": 4e-4, "pressurization_coefficient": 1e5}
PORES = ss.Dilatancy(coefficient=1e-5, reference_velocity=1e-9, slip_distance=1e-2)
PEAK = 1.0 / (HEAT["half_width"] * math.sqrt(2.0 * math.pi))
FLUX = 1.25e-6


class Constant:
    """A constant coefficient of friction."""

    def coefficient(self, slip_rate: float, theta: float) -> float:
        return 0.6

    def slope(self, slip_rate: float, theta: float) -> float:
        return 0.0

    def potential(self, slip_rate: float, theta: float) -> float:
        return 0.6 * slip_rate


def sliding(field: object, **further: object) -> ss.FaultSimulation:
    """A fault of uniform slip under a constant load of 4 MPa beyond its strength."""
    fault = ss.LineFault([0.0, 100.0], 2, space="periodic", **MEDIUM)
    start = {"shear_stress": 40e6, "slip_rate": 4e6 / DAMPING, "theta": 1.0}
    laws = {"friction": Constant(), "a": 0.01, "b": 0.0, "Dc": 1e-2}
    return fault.simulation(**{**laws, **start, "normal_stress": 60e6, "fields": [field], **further})


def line(cells: int = 401, **further: object) -> tuple[ss.LineFault, ss.FaultSimulation]:
    half = 10.0 * cells
    fault = ss.LineFault([-half, half], cells, space="whole", **MEDIUM)
    return fault, fault.simulation(**RESTING, fields=[ss.Diffusion(**{**ZONE, **further})])


def bp6(x: np.ndarray, time: float) -> np.ndarray:
    """The pressure of constant injection at the middle of a line for 100 days, that of BP6."""

    def spread(after: float) -> np.ndarray:
        if after <= 0.0:
            return np.zeros_like(x)
        s = np.abs(x) / math.sqrt(0.4 * after)
        return math.sqrt(after) * (np.exp(-s * s) / math.sqrt(math.pi) - s * np.array([math.erfc(v) for v in s]))

    return FLUX / (1e-9 * math.sqrt(0.1)) * (spread(time) - spread(time - 100.0 * DAY))


@pytest.mark.parametrize("sampled", [True, False])
def test_injection_has_the_pressure_of_bp6(sampled: bool) -> None:
    fault, simulation = line(801, wells=[ss.Well(0.0, [0.0, 100.0 * DAY], [FLUX, 0.0])])
    days = [10.0, 50.0, 100.0, 110.0, 200.0]
    if sampled:
        run = simulation.run(200.0 * DAY, t_eval=[day * DAY for day in days])
    else:
        run = simulation.run(200.0 * DAY, every=1, stops=[day * DAY for day in days])
    assert run.pore_pressure.shape == (len(run), 801)
    peak = bp6(np.zeros(1), 100.0 * DAY)[0]
    for day in days:
        row = int(np.searchsorted(run.t, day * DAY))
        assert run.t[row] == day * DAY
        assert np.abs(run.pore_pressure[row] - bp6(fault.centers, day * DAY)).max() < 1e-3 * peak
        injected = FLUX * min(day, 100.0) * DAY
        assert run.totals["injected_volume"][row] == pytest.approx(injected, rel=1e-12)
        assert run.totals["stored_volume"][row] == pytest.approx(injected, rel=1e-6 if sampled else 1e-11)
    # The shear stress is that of the total normal stress, which stays.
    assert run.normal_stress == pytest.approx(50e6, rel=1e-12)
    assert run.effective_normal_stress == pytest.approx(50e6 - run.pore_pressure, rel=1e-12)
    # -(k/eta) dp/dx before the shut-in.
    row = int(np.searchsorted(run.t, 50.0 * DAY))
    reach = math.sqrt(0.4 * 50.0 * DAY)
    velocity = [0.5 * FLUX * math.copysign(math.erfc(abs(x) / reach), x) for x in fault.centers]
    velocity[400] = 0.0
    assert np.abs(run.readings["darcy_velocity"][row] - velocity).max() < 1e-3 * FLUX
    assert (run.readings["permeability"] == 1e-13).all()


def test_a_shut_in_is_the_end_of_a_step() -> None:
    _, simulation = line(41, wells=[ss.Well(0.0, [1e3, 5e4], [FLUX, 0.0])])
    run = simulation.run(1e5, every=1)
    assert {1e3, 5e4} <= set(run.t)


def test_undrained_strength_falls_exponentially_with_slip() -> None:
    rock = {**HEAT, "thermal_diffusivity": 0.0}
    fluid = {**FLUID, "hydraulic_diffusivity": 0.0}
    run = sliding(ss.ThermalPressurization(**rock, **fluid)).run(0.5, rtol=1e-10, every=1)
    slip = run.slip[:, 0]
    assert slip[-1] > 0.5 and len(run) > 5
    rate = 0.6 * FLUID["pressurization_coefficient"] / HEAT["heat_capacity"] * PEAK
    assert run.effective_normal_stress[:, 0] == pytest.approx(60e6 * np.exp(-rate * slip), rel=1e-8)
    assert run.normal_stress == pytest.approx(60e6, rel=1e-12)
    # Without flow of heat and fluid the pressure follows the temperature.
    rise = run.readings["temperature"] - HEAT["initial_temperature"]
    assert run.pore_pressure == pytest.approx(FLUID["pressurization_coefficient"] * rise, rel=1e-9, abs=1e-3)
    # The event that begins and goes on has the pressure of all of it.
    assert run.events["pressure_change"][0] == pytest.approx(run.pore_pressure[-1, 0], rel=1e-12)


@pytest.mark.parametrize("modes", [24, 40])
def test_constant_heat_has_roots_of_time(modes: int) -> None:
    # Too little pressure to change friction.
    fluid = {**FLUID, "pressurization_coefficient": 1e-4}
    for field in (ss.ShearHeating(**HEAT, modes=modes), ss.ThermalPressurization(**HEAT, **fluid, modes=modes)):
        run = sliding(field).run(20.0, rtol=1e-10, every=1)
        heat = 0.6 * 60e6 * 4e6 / DAMPING / HEAT["heat_capacity"]
        thermal, hydraulic = (
            np.sqrt(2.0 * alpha * run.t / HEAT["half_width"] ** 2 + 1.0)
            for alpha in (HEAT["thermal_diffusivity"], FLUID["hydraulic_diffusivity"])
        )
        rise = run.readings["temperature"][:, 0] - HEAT["initial_temperature"]
        assert rise == pytest.approx(heat * PEAK * 2.0 * run.t / (thermal + 1.0), rel=1e-5)
        if isinstance(field, ss.ThermalPressurization):
            pressure = 1e-4 * heat * PEAK * 2.0 * run.t / (thermal + hydraulic)
            assert run.pore_pressure[:, 0] == pytest.approx(pressure, rel=1e-5)
        else:
            assert not run.pore_pressure.any() and run.totals == {}


def test_pressures_of_several_fields_add() -> None:
    fields = [ss.Diffusion(**ZONE, initial_pressure=1e6), ss.Diffusion(**ZONE, initial_pressure=np.full(11, 2e6))]
    fault = ss.LineFault([0.0, 1e3], 11, **MEDIUM)
    run = fault.simulation(**RESTING, fields=[*fields, ss.ShearHeating(**HEAT)]).run(1e3)
    assert run.pore_pressure == pytest.approx(3e6, rel=1e-12)
    assert set(run.readings) == {"darcy_velocity", "permeability", "temperature"}


def test_leak_off_is_exponential() -> None:
    leak = ss.LeakOff(np.linspace(1e4, 3e4, 5), far_pressure=1e6)
    fault = ss.LineFault([0.0, 1e3], 5, **MEDIUM)
    sealed = {**ZONE, "permeability": 0.0}
    field = ss.Diffusion(**sealed, initial_pressure=2e6, leak_off=leak)
    run = fault.simulation(**RESTING, fields=[field]).run(3e4, rtol=1e-9, stops=[1e4, 2e4])
    exact = 1e6 + 1e6 * np.exp(-run.t[:, None] / leak.drainage_time)
    assert run.pore_pressure == pytest.approx(exact, rel=1e-5)
    assert run.totals["leaked_volume"] == pytest.approx(-run.totals["stored_volume"], rel=1e-9, abs=1e-12)


def test_fluid_flows_from_side_to_side() -> None:
    fault = ss.LineFault([0.0, 1e3], 50, **MEDIUM)
    field = ss.Diffusion(**ZONE, sides={"begin": ("pressure", 2e6), "end": ("flux", -5e-8)})
    run = fault.simulation(**RESTING, fields=[field]).run(1e9, every=1)
    # In the end u = 5e-8 m/s, and p falls by u eta/k a metre.
    assert run.readings["darcy_velocity"][-1] == pytest.approx(5e-8, rel=1e-6)
    assert run.pore_pressure[-1] == pytest.approx(2e6 - 5e-8 / 1e-10 * fault.centers, rel=1e-6)
    volume = run.totals["stored_volume"] + run.totals["drained_volume"]
    assert np.abs(volume).max() < 1e-9 * np.abs(run.totals["drained_volume"]).max()


def test_permeability_rises_with_slip_and_heals() -> None:
    rate, distance, healing = 4e6 / DAMPING, 0.5, 2.0
    evolution = ss.PermeabilityEvolution(minimum=1e-18, maximum=1e-14, slip_distance=distance, healing_time=healing)
    field = ss.Diffusion(**{**ZONE, "permeability": 1e-18}, permeability_evolution=evolution)
    run = sliding(field).run(3.0, every=1)
    rise, heal = rate / distance, 1.0 / healing
    excess = rise / (rise + heal) * -np.expm1(-(rise + heal) * run.t)
    assert run.readings["permeability"][:, 0] == pytest.approx(1e-18 + (1e-14 - 1e-18) * excess, rel=1e-9)


def test_dilatancy_takes_pressure() -> None:
    rate = 4e6 / DAMPING
    pores = {"coefficient": 1e-4, "reference_velocity": 1e-6, "slip_distance": 0.1}
    steady = 1e-4 * math.log(rate / 1e-6)
    # So much storage that the pressure does not change friction.
    zone = {**ZONE, "storage": 1e3}
    run = sliding(ss.Diffusion(**zone, dilatancy=ss.Dilatancy(**pores))).run(1.0, rtol=1e-8, every=1)
    porosity = run.readings["porosity_change"][:, 0]
    assert porosity == pytest.approx(steady * -np.expm1(-rate / 0.1 * run.t), rel=1e-5)
    assert run.pore_pressure[:, 0] == pytest.approx(-porosity / 1e3, rel=1e-9)
    assert run.totals["pore_volume"] == pytest.approx(porosity * 100.0, rel=1e-9)
    kept = ss.Dilatancy(**pores, initial_change=steady)
    run = sliding(ss.Diffusion(**zone, dilatancy=kept)).run(1.0)
    assert run.readings["porosity_change"] == pytest.approx(steady, rel=1e-9)


def injected(**further: object) -> ss.FaultSimulation:
    fault = ss.LineFault([-100.0, 100.0], 11, space="whole", **MEDIUM)
    well = ss.Well(0.0, [0.0], [1e-4])
    return fault.simulation(**RESTING, fields=[ss.Diffusion(**ZONE, wells=[well])], **further)


def test_pressure_beyond_the_normal_stress_is_refused_or_taken() -> None:
    with pytest.raises(ss.StepError, match="least_normal_stress") as refused:
        injected().run(1e6)
    error = refused.value
    assert error.kind == "PorePressure" and error.vertex == 5
    assert error.pore_pressure > error.normal_stress == pytest.approx(50e6, rel=1e-12)
    assert error.partial.pore_pressure.max() <= 50e6
    until = 1.5 * error.time
    run = injected(least_normal_stress=1e5).run(until)
    assert run.pore_pressure.max() > 50e6 and run.effective_normal_stress.min() == 1e5
    run = injected(allow_opening=True).run(until)
    assert run.pore_pressure.max() > 50e6 and run.effective_normal_stress.min() == 0.0
