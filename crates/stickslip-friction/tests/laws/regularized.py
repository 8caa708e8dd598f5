"""Writes the reference values of tests/regularized.rs, computed with 60 digits.

    python3 regularized.py        (needs mpmath)

Every number read is an exact double, so that the table holds no rounding of the inputs. The law has
V0 = L = 1, mu0 = 0 and b = a, so that ln Vm = -alpha.
"""

import pathlib
import random

from mpmath import asinh, cosh, exp, ln, mp, mpf, nstr, sinh, sqrt, workdps

mp.dps = 60
here = pathlib.Path(__file__).parent
random.seed(2)


def balance(k, pull):
    """x + k sinh x = pull: Newton from the right, monotone."""
    x = min(pull / (1 + k), asinh(pull / k))
    for _ in range(400):
        step = (x + k * sinh(x) - pull) / (1 + k * cosh(x))
        x -= step
        if abs(step) < mpf(10) ** -58 * x:
            break
    return x


def problems():
    """a, alpha, viscosity, drive."""
    for _ in range(400):
        a = 2.0 ** random.randint(-20, 0)
        alpha = random.choice([random.uniform(-700, 700), random.uniform(-30, 60)])
        viscosity = 10 ** random.uniform(-12, 20)
        yield a, alpha, viscosity, a * 10 ** random.uniform(-6, 5)
        # Around the cut-off.
        yield a, alpha, viscosity, random.uniform(0, 30) * a
    for _ in range(200):
        # Creep under a Vm far below all numbers, slip under one above.
        a = 2.0 ** random.randint(-20, 0)
        alpha = 10 ** random.uniform(2.9, 5)
        yield a, alpha, 10 ** random.uniform(-12, 20), a * (alpha + random.uniform(-600, 30))
        yield a, -random.uniform(700, 1000), 10 ** random.uniform(-12, 20), 10 ** random.uniform(-12, 4)


if __name__ == "__main__":
    with open(here / "regularized.csv", "w") as file:
        print("a,alpha,viscosity,drive,x,slip_rate,coefficient,slope,potential", file=file)
        for inputs in problems():
            a, alpha, viscosity, drive = map(mpf, inputs)
            cutoff = exp(-alpha)
            x = balance(2 * cutoff * viscosity / a, drive / a)
            rate = 2 * cutoff * sinh(x)
            if not mpf(10) ** -307 < rate < mpf(10) ** 300:
                continue
            v = mpf(float(rate))
            root = sqrt(v**2 + 4 * cutoff**2)
            # Far below Vm the terms agree to hundreds of digits.
            with workdps(1500):
                vm = exp(-alpha)
                potential = a * (v * asinh(v / (2 * vm)) - sqrt(v**2 + 4 * vm**2) + 2 * vm)
            outputs = x, rate, a * asinh(v / (2 * cutoff)), a / root, potential
            print(*[repr(x) for x in inputs], *[nstr(y, 25) for y in outputs], sep=",", file=file)
