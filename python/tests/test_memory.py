"""Memory of simulations that are created and dropped."""

import gc
import os
from collections.abc import Callable

import numpy as np
import pytest

import stickslip as ss

STATISTICS = "/proc/self/statm"
LAWS = {"a": 0.010, "b": 0.015, "Dc": 1e-5}


def resident() -> int:
    """The memory of the process [B]."""
    with open(STATISTICS, encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def slider() -> np.ndarray:
    return ss.SpringSlider(1e10, 1e6, load=[(0.0, 1e-6), (10.0, 1e-5)], **LAWS).run(100.0).V


FAULT = ss.LineFault([0.0, 40e3], 50, shear_modulus=32e9, shear_wave_speed=3464.0)
CELLS = {"a": 0.01, "b": 0.015, "Dc": 1e-2, "normal_stress": 5e7, "shear_stress": 3e7, "theta": 1e7}


def fault() -> np.ndarray:
    return FAULT.simulation(**CELLS).run(1e3, every=1).V


MESH = ss.Mesh.grid([5.0, 1.0], [5, 1]).refined(2)
BOTTOM = MESH.part(lambda x: x[1] == 0.0)


def body() -> np.ndarray:
    block = ss.Body(MESH, E=5e7, nu=0.3, density=5e3)
    block.contact(BOTTOM, normal_stress=1e5, theta=1.0, **LAWS)
    simulation = block.simulation(solver="tnnmg")
    simulation.restore(simulation.state())
    return simulation.step(1e-3).velocity


class Aging:
    def rate(self, theta: float, slip_rate: float) -> float:
        return 1.0 - slip_rate * theta / 1e-5

    def slope(self, theta: float, slip_rate: float) -> float:
        return -slip_rate / 1e-5


OWN = ss.SpringSlider(1e10, 1e6, law=Aging(), V=1.1e-6, **LAWS)


def own_law() -> np.ndarray:
    return OWN.run(1.0).V


@pytest.mark.skipif(not os.path.exists(STATISTICS), reason=f"needs {STATISTICS}")
@pytest.mark.parametrize("simulate", [slider, fault, body, own_law])
def test_memory_stays_over_a_thousand_simulations(simulate: Callable[[], np.ndarray]) -> None:
    for _ in range(100):
        bytes_each = simulate().nbytes
    gc.collect()
    before = resident()
    for _ in range(1000):
        simulate()
    gc.collect()
    # If one array of each were kept it would be all of them; 2 MiB are pages of the allocator.
    assert resident() - before < max(0.1 * 1000 * bytes_each, 2 << 20)
