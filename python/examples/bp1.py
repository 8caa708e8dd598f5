"""Earthquake cycles on a strike-slip fault: the benchmark BP1-QD (Erickson et al. 2020), coarse."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import stickslip as ss

YEAR = 365.25 * 86400.0
PLATE = 1e-9

fault = ss.LineFault([0.0, 40e3], 200, shear_modulus=32.038120320e9, shear_wave_speed=3464.0)
depth = fault.centers
a = 0.010 + 0.015 * np.clip((depth - 15e3) / 3e3, 0.0, 1.0)
b, Dc, normal = 0.015, 8e-3, 50e6
# Steady sliding at the plate rate at the lower end, and the same stress everywhere; states follow.
shear = normal * 0.025 * np.arcsinh(PLATE / 2e-6 * np.exp((0.6 + b * np.log(1e-6 / PLATE)) / 0.025))
friction = a * np.log(2e-6 / PLATE * np.sinh(shear / normal / a))
log_theta = (friction - 0.6) / b + np.log(Dc / 1e-6)
cycle = fault.simulation(a=a, b=b, Dc=Dc, normal_stress=normal, shear_stress=shear, log_theta=log_theta, plate_rate=PLATE)

run = cycle.run(500.0 * YEAR, rtol=1e-5, every=10)
onsets = run.events["onset"] / YEAR
print(run, "onsets [years]:", np.round(onsets, 1))
# Cells of 200 m resolve the nucleation barely: the first event of fine ones comes after 196 years.
assert 185.0 < onsets[0] < 205.0 and len(onsets) >= 3

figure, axes = plt.subplots()
picture = axes.pcolormesh(np.arange(len(run)), 1e-3 * depth, np.log10(run.V).T, vmin=-12.0, vmax=0.0, cmap="magma")
axes.invert_yaxis()
axes.set(xlabel="sample", ylabel="depth [km]")
figure.colorbar(picture, label="log10 slip rate [m/s]")
figure.savefig("bp1.png", dpi=150)
