"""The slider of Pipping, Sander and Kornhuber (2015): an elastic block sticks and slips on a rigid surface."""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import stickslip as ss

mesh = ss.Mesh.grid([5.0, 1.0], [5, 1]).refined(3)
body = ss.Body(mesh, E=5e7, nu=0.3, density=5e3, gravity=[0.0, -9.81])
body.drive(mesh.part(lambda x: x[1] == 1.0), lambda t: [2e-4 * min(4.0 * t / 15.0, 1.0), 0.0])
bottom = mesh.part(lambda x: x[1] == 0.0)
body.contact(bottom, normal_stress=49_050.0, theta=math.exp(-10.0), a=0.010, b=0.015, Dc=1e-5, mu0=0.6, V0=1e-6)

# The vertex x0 in the middle.
x0 = int(np.argmin(np.abs(bottom.points[:, 0] - 2.5)))
times, rates = [], []
for at in body.simulation(equilibrium=True).run(until=15.0, dt=1.5e-3):
    times.append(at.time)
    rates.append(at.contacts[0].slip_rate[x0])
# An event begins above 1 mm/s and ends below a tenth of that.
events, slips = 0, False
for rate in rates:
    if rate > (1e-4 if slips else 1e-3):
        events += not slips
        slips = True
    else:
        slips = False
print(f"{events} events, largest slip rate {max(rates):.3e} m/s")
assert events == 7

figure, axes = plt.subplots()
axes.semilogy(times, rates)
axes.set(xlabel="time [s]", ylabel="slip rate at x0 [m/s]", ylim=(1e-8, 1e-1))
figure.savefig("slider.png", dpi=150)
