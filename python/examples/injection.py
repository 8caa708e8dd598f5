"""Fluid injection into a fault that strengthens with the slip rate: slip spreads with the pressure."""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import stickslip as ss

DAY = 86400.0
FLUX = 1.25e-6  # of the well, per length out of the plane [m^2/s]
STORAGE = 1e-9  # porosity times the compressibility of fluid and pores [1/Pa]
DIFFUSIVITY = 0.1  # permeability/(viscosity storage) [m^2/s]

fault = ss.LineFault([-4010.0, 4010.0], 401, space="whole", shear_modulus=32e9, shear_wave_speed=3464.0)
fluid = ss.Diffusion(
    permeability=1e-13,
    viscosity=1e-3,
    storage=STORAGE,
    thickness=1.0,
    wells=[ss.Well(0.0, [0.0, 100.0 * DAY], [FLUX, 0.0])],
)
cycle = fault.simulation(
    a=0.007,
    b=0.005,
    Dc=4e-3,
    normal_stress=50e6,
    shear_stress=29.2e6,
    theta=4e-3 / 1e-12,
    fields=[fluid],
)
days = [10.0, 25.0, 50.0, 100.0, 150.0]
run = cycle.run(150.0 * DAY, every=1, stops=[day * DAY for day in days])
slipped = np.array([np.ptp(fault.centers[slip > 1e-2]) if (slip > 1e-2).any() else 0.0 for slip in run.slip])
print(f"{run.steps} steps, slip {run.slip[-1].max():.3f} m, {slipped[-1]:.0f} m have slipped by a centimetre")

# Until the shut-in the pressure is that of a source of constant flux on a line, sqrt(t) ierfc(|x|/sqrt(4 D t)).
width = math.sqrt(4.0 * DIFFUSIVITY * 50.0 * DAY)
ierfc = [math.exp(-s * s) / math.sqrt(math.pi) - s * math.erfc(s) for s in np.abs(fault.centers) / width]
exact = FLUX / (STORAGE * math.sqrt(DIFFUSIVITY)) * math.sqrt(50.0 * DAY) * np.array(ierfc)
error = np.abs(run.pore_pressure[np.searchsorted(run.t, 50.0 * DAY)] - exact).max()
assert error < 1e-3 * exact.max()
# All of the fluid is in the fault, and slip is symmetric about the well.
assert abs(run.totals["stored_volume"][-1] / (FLUX * 100.0 * DAY) - 1.0) < 1e-9
assert np.abs(run.slip[-1] - run.slip[-1][::-1]).max() < 1e-9 and slipped[-1] > 200.0

figure, (above, below) = plt.subplots(2, sharex=True)
for day in days:
    sample = np.searchsorted(run.t, day * DAY)
    above.plot(fault.centers, run.pore_pressure[sample] * 1e-6, label=f"{day:.0f} days")
    below.semilogy(fault.centers, run.slip[sample])
above.set(ylabel="pore pressure [MPa]")
above.legend()
below.set(xlabel="position [m]", ylabel="slip [m]")
figure.savefig("injection.png", dpi=150)
