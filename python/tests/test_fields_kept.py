"""Restarts, pickles, tables and pictures of runs with fields."""

import copy
import math
import pickle
from pathlib import Path

import numpy as np
import pytest
from test_fields import FLUID, HEAT, MEDIUM, PORES, RESTING, ZONE
from test_fields_on_sliders import heated

import stickslip as ss


def field_of_everything() -> ss.Diffusion:
    return ss.Diffusion(
        **{**ZONE, "permeability": np.linspace(1e-15, 1e-14, 21)},
        wells=[ss.Well(0.0, [0.0, 2e4], [1e-6, 0.0]), ss.Well(30.0, [0.0], [1e-7], storage=1e-8, index=1e-10)],
        sources=[ss.GaussianSource(-50.0, 20.0, [0.0, 1e4], [0.0, 1e-6], interpolation="linear")],
        sides={"begin": ("pressure", 1e5), "end": "sealed"},
        leak_off=ss.LeakOff(1e6),
        dilatancy=PORES,
        permeability_evolution=ss.PermeabilityEvolution(
            minimum=1e-15, maximum=1e-13, slip_distance=1e-2, healing_time=math.inf
        ),
    )


def creeping(fields: list[object]) -> ss.FaultSimulation:
    fault = ss.LineFault([-100.0, 100.0], 21, space="whole", **MEDIUM)
    stress = {**RESTING, "shear_stress": 29e6, "theta": 1e6}
    return fault.simulation(**stress, fields=fields)  # type: ignore[arg-type]


def test_a_restart_has_the_same_bits(tmp_path: Path) -> None:
    fields = [field_of_everything(), ss.ThermalPressurization(**HEAT, **FLUID)]
    simulation = creeping(fields)
    simulation.run(1e4)
    state = simulation.state()
    simulation.save(tmp_path / "checkpoint")
    run = simulation.run(5e4, every=1)
    assert len(run) > 10 and run.pore_pressure[-1].any() and run.slip[-1].max() > 0.0
    restored, loaded = creeping(pickle.loads(pickle.dumps(fields))), creeping(copy.deepcopy(fields))
    restored.restore(pickle.loads(pickle.dumps(state)))
    loaded.load(tmp_path / "checkpoint")
    for other in (restored.run(5e4, every=1), loaded.run(5e4, every=1), pickle.loads(pickle.dumps(run))):
        for name in ("t", "slip", "V", "pore_pressure", "effective_normal_stress", "shear_stress"):
            assert (getattr(run, name) == getattr(other, name)).all()
        for mine, its in ((run.readings, other.readings), (run.totals, other.totals)):
            assert list(mine) == list(its) and all((mine[name] == its[name]).all() for name in mine)
    with pytest.raises(ss.SceneError):
        creeping([]).restore(state)
    with pytest.raises(ss.FileError):
        creeping(fields[::-1]).load(tmp_path / "checkpoint")


def test_fields_are_plain_data() -> None:
    field = field_of_everything()
    parts = [*field.wells, *field.sources, field.leak_off, field.dilatancy, field.permeability_evolution]
    for value in (field, ss.ShearHeating(**HEAT), ss.ThermalPressurization(**HEAT, **FLUID, modes=30), *parts):
        twin = pickle.loads(pickle.dumps(value))
        assert type(twin) is type(value) and repr(twin) == repr(value)
        assert value._repr_html_().startswith("<table>")
    assert repr(field.wells[0]) == "Well(position=0, times=<array of 2>, rates=<array of 2>, interpolation='constant')"
    assert field.sides == {"begin": ("pressure", 1e5), "end": "sealed"}
    assert field.permeability.shape == (21,) and field.viscosity == 1e-3
    # A copy: later changes of the argument leave it as it is.
    rates = np.array([1e-6])
    well = ss.Well([0.0, 1.0], [0.0], rates)
    rates[0] = 0.0
    assert well.rates[0] == 1e-6 and well.position == [0.0, 1.0]


def test_runs_without_fields_have_no_pressure() -> None:
    fault = ss.LineFault([0.0, 1e3], 8, **MEDIUM)
    run = fault.simulation(**RESTING).run(1e4)
    assert not run.pore_pressure.any() and run.pore_pressure.shape == run.normal_stress.shape
    assert run.effective_normal_stress is run.normal_stress
    assert run.readings == {} and run.totals == {}


def test_tables_and_pictures_show_fields() -> None:
    pandas = pytest.importorskip("pandas")
    block = heated().run(1e6)
    assert list(block.to_frame())[-3:] == ["pore_pressure", "effective_normal_stress", "temperature"]
    pytest.importorskip("matplotlib").use("Agg")
    from stickslip import plots

    run = creeping([field_of_everything()]).run(1e4)
    table = run.to_frame(cells=[3])
    assert isinstance(table, pandas.DataFrame)
    assert (table["pore_pressure"] == run.pore_pressure[:, 3]).all()
    assert (table["darcy_velocity"] == run.readings["darcy_velocity"][:, 3]).all()
    assert "darcy_velocity" in run._repr_html_() and "injected_volume" in run._repr_html_()
    assert plots.history(run, "pore_pressure", cell=3).get_ylabel() == "pore pressure [MPa]"
    assert plots.history(run, "permeability", cell=3).get_ylabel().startswith("permeability")
    with pytest.raises(ValueError, match="darcy_velocity"):
        plots.history(run, "temperature")
