"""Heat and fluids on planes, one and several."""

import numpy as np
import pytest
from test_fields import FLUID, HEAT, MEDIUM, PORES, RESTING, ZONE

import stickslip as ss


def plane(rake: object = 0.0) -> ss.PlaneFault:
    return ss.PlaneFault([-200.0, 200.0], [0.0, 300.0], [8, 6], space="whole", rake=rake, **MEDIUM)


def test_a_plane_takes_all_of_a_source() -> None:
    fault = plane()
    source = ss.GaussianSource([0.0, 150.0], 50.0, [0.0, 4e4], [0.0, 1e-4], interpolation="linear")
    well = ss.Well((-25.0, 125.0), [0.0], [1e-4], storage=1e-9, radius=0.1)
    k = np.full(fault.shape, 1e-14)
    k[0, :] = 1e-15
    runs = []
    for permeability in (k, k.ravel()):
        field = ss.Diffusion(**{**ZONE, "permeability": permeability}, sources=[source], wells=[well])
        runs.append(fault.simulation(**RESTING, fields=[field], least_normal_stress=1e5).run(4e4, every=1))
    run, flat = runs
    assert (run.pore_pressure == flat.pore_pressure).all()
    assert run.totals["injected_volume"][-1] == pytest.approx(2.0 + 4.0, rel=1e-12)
    assert run.totals["stored_volume"] == pytest.approx(run.totals["injected_volume"], rel=1e-10, abs=1e-12)
    assert run.readings["permeability"][0].reshape(fault.shape)[0, 0] == 1e-15
    assert {"darcy_velocity_along_strike", "darcy_velocity_down_dip"} <= set(run.readings)
    assert well.volume(0.0, 4e4) == pytest.approx(4.0, rel=1e-14)


def test_flow_of_fourth_order_is_closer_to_a_spreading_gaussian() -> None:
    fault = ss.PlaneFault([-800.0, 800.0], [0.0, 1600.0], [32, 32], space="whole", **MEDIUM)
    x, y = fault.centers.T
    square = x * x + (y - 800.0) ** 2
    start, spread = 100.0**2, 2.0 * 0.1 * 4e4
    errors = []
    for fourth in (False, True):
        pressure = 1e6 * np.exp(-square / (2.0 * start))
        field = ss.Diffusion(**ZONE, initial_pressure=pressure, fourth_order=fourth)
        run = fault.simulation(**RESTING, fields=[field]).run(4e4, rtol=1e-8)
        exact = 1e6 * start / (start + spread) * np.exp(-square / (2.0 * (start + spread)))
        errors.append(np.abs(run.pore_pressure[-1] - exact).max())
    assert errors[1] < 0.25 * errors[0] < 1e5


def test_a_free_rake_and_several_planes_take_heat() -> None:
    heat = ss.ThermalPressurization(**HEAT, **FLUID)
    stress = {**RESTING, "shear_stress": [15e6, 1e6]}
    run = plane("free").simulation(**stress, fields=[heat]).run(1e5)
    assert run.readings["temperature"].shape == (len(run), 48) and run.V.shape == (len(run), 48, 2)
    half = [ss.PlaneFault([-1e3, 1e3], [1e3, 2e3], [4, 2], dip=90.0, **MEDIUM) for _ in range(2)]
    system = ss.FaultSystem(half, strikes=[0.0, 0.0], origins=[[0.0, 0.0], [5e3, 0.0]])
    run = system.simulation(**RESTING, fields=[heat]).run(1e5)
    assert run.pore_pressure.shape == (len(run), 16)


def test_fluid_follows_planes_of_a_system() -> None:
    # Far apart: nothing of one plane reaches the other.
    one = ss.PlaneFault([-200.0, 200.0], [1e3, 1.3e3], [8, 6], dip=90.0, **MEDIUM)
    two = ss.PlaneFault([0.0, 500.0], [500.0, 1e3], [5, 4], dip=60.0, **MEDIUM)
    system = ss.FaultSystem([one, two], strikes=[0.0, 90.0], origins=[[0.0, 0.0], [9e6, 0.0]])
    k = np.linspace(1e-14, 2e-14, 20).reshape(two.shape)
    first = {**ZONE, "wells": [ss.Well([10.0, 1.1e3], [0.0, 3e4], [1e-5, 0.0])], "dilatancy": PORES}
    second = {**ZONE, "permeability": k, "sides": {"top": ("pressure", 1e6)}, "initial_pressure": 1e5}
    fields = [ss.Diffusion(**second, plane=1), ss.Diffusion(**first, plane=0)]
    times = {"until": 5e4, "rtol": 1e-9, "stops": [1e4, 2e4, 4e4], "every": 10**6}
    run = system.simulation(**RESTING, fields=fields).run(**times)
    for fault, field, (begin, end) in ((one, first, system.ranges[0]), (two, second, system.ranges[1])):
        alone = fault.simulation(**RESTING, fields=[ss.Diffusion(**field)]).run(**times)
        assert run.pore_pressure[-1, begin:end] == pytest.approx(alone.pore_pressure[-1], rel=1e-5)
        for name in ("darcy_velocity_down_dip", "permeability"):
            apart = np.abs(run.readings[name][-1, begin:end] - alone.readings[name][-1])
            assert apart.max() < 1e-4 * np.abs(alone.readings[name][-1]).max()
    assert np.isnan(run.readings["porosity_change"][:, 48:]).all()
    assert run.totals["injected_volume"][-1] == pytest.approx(0.3, rel=1e-12)
    stored, drained, pores = (run.totals[name] for name in ("stored_volume", "drained_volume", "pore_volume"))
    assert (stored + drained + pores)[-1] == pytest.approx(0.3, rel=1e-9)
