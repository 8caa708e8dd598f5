"""Fluid injection into a fault that strengthens with the slip rate: slip spreads with the pressure."""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import stickslip as ss

DAY = 86400.0
DIFFUSIVITY = 0.1  # [m^2/s]
LARGEST = 6e6  # pressure at the well after 100 days [Pa]

fault = ss.LineFault([-2e3, 2e3], 200, space="whole", shear_modulus=32e9, shear_wave_speed=3464.0)
distance = np.abs(fault.centers)


def pressure(time: float) -> np.ndarray:
    """Of a source of constant flux on a line: sqrt(t) ierfc(|x|/sqrt(4 D t)), the solution of the diffusion equation."""
    if time <= 0.0:
        return np.zeros_like(distance)
    width = math.sqrt(4.0 * DIFFUSIVITY * time)
    ierfc = [math.exp(-((x / width) ** 2)) / math.sqrt(math.pi) - x / width * math.erfc(x / width) for x in distance]
    return LARGEST * math.sqrt(time / (100.0 * DAY)) * math.sqrt(math.pi) * np.array(ierfc)


cycle = fault.simulation(
    a=0.007,
    b=0.005,
    Dc=4e-3,
    normal_stress=50e6,
    shear_stress=29.2e6,
    theta=4e-3 / 1e-12,
    pressure=pressure,
)
days = [10.0, 25.0, 50.0, 100.0]
run = cycle.run(100.0 * DAY, every=1, stops=[day * DAY for day in days])
slipped = np.array([np.ptp(fault.centers[slip > 1e-4]) if (slip > 1e-4).any() else 0.0 for slip in run.slip])
print(f"{run.steps} steps, slip {run.slip[-1].max():.3f} m, {slipped[-1]:.0f} m have slipped")
# The pressure is that of the well, and slip is symmetric about it.
assert abs(run.normal_stress[-1].min() / (50e6 - pressure(100.0 * DAY).max()) - 1.0) < 1e-12
assert np.abs(run.slip[-1] - run.slip[-1][::-1]).max() < 1e-9 and slipped[-1] > 200.0

figure, axes = plt.subplots()
for day in days:
    axes.semilogy(fault.centers, run.slip[np.searchsorted(run.t, day * DAY)], label=f"{day:.0f} days")
axes.set(xlabel="position [m]", ylabel="slip [m]")
axes.legend()
figure.savefig("injection.png", dpi=150)
