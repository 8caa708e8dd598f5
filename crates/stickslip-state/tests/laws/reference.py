"""Writes the reference values of tests/reference.rs, computed with 60 digits.

    python3 reference.py        (needs mpmath)

Every number read is an exact double, so that the tables hold no rounding of the inputs.
"""

import pathlib
import random

from mpmath import exp, expm1, ln, mp, mpf, nstr

mp.dps = 60
here = pathlib.Path(__file__).parent
random.seed(1)


def omega(x):
    """w + ln w = x by Newton in z = ln w, which is monotone."""
    z = x if x <= 1 else ln(x)
    for _ in range(60):
        step = (z + exp(z) - x) / (1 + exp(z))
        z -= step
        if abs(step) < mpf(10) ** -55 * max(abs(z), mpf(10) ** -30):
            break
    return exp(z), z if abs(z) > mpf(10) ** -50 else mpf(0)


def write(name, header, rows):
    with open(here / name, "w") as file:
        print(header, file=file)
        for inputs, outputs in rows:
            print(*[repr(x) for x in inputs], *[nstr(y, 25) for y in outputs], sep=",", file=file)


def wright_arguments():
    yield from [-745.0, -730.0, -708.0, -300.0, -40.0, -37.0, -20.0, -5.0, -2.0, -1.0, -0.5, -1e-3, -1e-17, 0.0]
    yield from [5e-324, 1e-300, 1e-17, 1e-3, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 2.999, 3.0, 3.001, 3.5, 3.999]
    yield from [4.0, 5.0, 10.0, 40.0, 1e3, 1e8, 1e16, 1e100, 1e300, 1.7976931348623157e308]
    for k in range(1, 53, 4):
        yield from [1 + 2.0**-k, 1 - 2.0**-k]
    for _ in range(60):
        yield random.uniform(-1, 1) * 10 ** random.uniform(-2, 2.8)


def steps():
    """from, V, dt, L: as a simulation meets them, then anything."""
    for _ in range(60):
        yield random.uniform(-12, 12), 10 ** random.uniform(-12, -1), 10 ** random.uniform(-7, 6), 1e-5
    for _ in range(60):
        yield (random.uniform(-800, 800), 10 ** random.uniform(-300, 10), 10 ** random.uniform(-12, 6),
               10 ** random.uniform(-12, 0))
    for length in [1e-12, 1e-5, 1.0]:
        for dt in [1e-12, 1e-4, 1.0, 1e6]:
            for rate in [0.0, 5e-324, 1e-300, 1e-20, 1e-10, 1e-6, 1e-2, 1.0, 1e5, 1e10]:
                for start in [-800.0, -100.0, -10.0, 0.0, 1.0, 10.0, 100.0, 800.0]:
                    yield start, rate, dt, length
    yield 1e-3, 1e-9, 1e-12, 1e-5
    yield 0.0, 0.0, 1e6, 1e-5
    yield -10.0, 5e-324, 1.0, 1.0


def advanced(start, rate, dt, length):
    start, rate, dt, length = map(mpf, (start, rate, dt, length))
    x = dt * rate / length
    aging = ln(dt) - omega(ln(dt) + x - start)[1]
    if rate == 0:
        return aging, ln(exp(start) + dt), start, start
    decay = -expm1(-x)
    return (aging, ln(exp(start - x) + dt * decay / x),
            (start - x * ln(rate / length)) / (1 + x), start * (1 - decay) - decay * ln(rate / length))


if __name__ == "__main__":
    write("wright.csv", "x,omega,ln_omega", [((x,), omega(mpf(x))) for x in wright_arguments()])
    write("steps.csv", "from,slip_rate,dt,slip_distance,dieterich_euler,dieterich_exact,ruina_euler,ruina_exact",
          [(s, advanced(*s)) for s in steps()])
