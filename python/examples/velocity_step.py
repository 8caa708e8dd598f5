"""Fits a velocity-step experiment: a, b and L with their standard errors, by two state laws."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import stickslip as ss

# Velocity steps at 1, 10 and 3 um/s, each over 0.3 mm, with the noise of a good machine.
a, b, Dc = 0.008, 0.012, 1.5e-5
t, mu, load = ss.velocity_step([1e-6, 1e-5, 3e-6], 3e-4, k=1500.0, samples=250, a=a, b=b, Dc=Dc)
mu = mu + 3e-4 * np.random.default_rng(1).standard_normal(len(t))

# No guess is needed. The stiffness over the normal stress [1/m] is known here; else leave it out.
aging = ss.fit(t, mu, load=load, k=1500.0, law="aging")
slip = ss.fit(t, mu, load=load, k=1500.0, law="slip")
print(aging)
print(f"the aging law is preferred by an AIC of {slip.aic - aging.aic:.0f}")
assert slip.aic > aging.aic
assert abs(aging["a"] - a) < 3.0 * aging.errors["a"]
assert abs(aging["L"] - Dc) < 3.0 * aging.errors["L1"]

figure, (top, bottom) = plt.subplots(2, sharex=True, height_ratios=[3, 1])
top.plot(t, mu, ".", markersize=2, label="data")
top.plot(t, aging.mu, label="aging law")
top.plot(t, slip.mu, "--", label="slip law")
top.set_ylabel("coefficient of friction")
top.legend()
bottom.plot(t, 1e3 * aging.residuals, ".", markersize=2)
bottom.set(xlabel="time [s]", ylabel="residual [1e-3]")
figure.savefig("velocity_step.png", dpi=150)
