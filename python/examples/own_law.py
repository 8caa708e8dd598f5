"""A state law of one's own: the law of Perrin, Rice and Zheng (1995), written in Python."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import stickslip as ss


class PerrinRiceZheng:
    """theta' = 1 - (V theta/(2 L))^2."""

    def __init__(self, slip_distance: float) -> None:
        self.slip_distance = slip_distance

    def rate(self, theta: float, slip_rate: float) -> float:
        return 1.0 - (slip_rate * theta / (2.0 * self.slip_distance)) ** 2

    def slope(self, theta: float, slip_rate: float) -> float:
        return -2.0 * theta * (slip_rate / (2.0 * self.slip_distance)) ** 2


# Its steady state is 2 L/V: friction compares with twice its L.
load = [(0.0, 1e-6), (10.0, 1e-5)]
laws: dict[str, str | PerrinRiceZheng] = {
    "aging": "aging",
    "slip": "slip",
    "Perrin, Rice and Zheng": PerrinRiceZheng(1e-5),
}
figure, axes = plt.subplots()
for name, law in laws.items():
    slider = ss.SpringSlider(1e10, 1e6, a=0.010, b=0.015, Dc=2e-5, damping=5e6, load=load, law=law)
    run = slider.run(40.0)
    axes.plot(1e6 * run.slip, run.mu, label=name)
    print(f"{name}: peak {run.mu.max():.5f}, end {run.mu[-1]:.5f}")
    assert abs(run.mu[-1] - (0.6 - 0.005 * 2.302585)) < 1e-4
axes.set(xlabel="slip [um]", ylabel="coefficient of friction")
axes.legend()
figure.savefig("own_law.png", dpi=150)
