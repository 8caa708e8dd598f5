"""Daemon threads inside runs when the interpreter exits: the process ends quickly and without a word."""

import subprocess
import sys
import time

import pytest

START = """
import sys, threading, time
import stickslip as ss

MEDIUM = {"shear_modulus": 32e9, "shear_wave_speed": 3464.0}
CELLS = {"a": 0.01, "b": 0.015, "Dc": 8e-3, "normal_stress": 5e7, "shear_stress": 3e7, "theta": 1e7}
SLIDER = {"a": 0.010, "b": 0.015, "Dc": 1e-5, "damping": 5e6, "V": 2e-6}

class Aging:
    def rate(self, theta, slip_rate):
        time.sleep(1e-4)
        return 1.0 - slip_rate * theta / 1e-5

    def slope(self, theta, slip_rate):
        return -slip_rate / 1e-5

def busy(time, rate=0.0):
    for _ in range(10**6):
        pass

def slow(seconds):
    time.sleep(0.05)
    return 0.0

def fault(**arguments):
    return ss.LineFault([0.0, 40e3], 100, **MEDIUM).simulation(**CELLS, **arguments)

def body(velocity):
    mesh = ss.Mesh.grid([1.0, 1.0], [8, 8])
    body = ss.Body(mesh, E=5e10, nu=0.25, density=2700.0)
    body.drive(mesh.part(lambda x: x[1] == 1.0), velocity)
    body.contact(mesh.part(lambda x: x[1] == 0.0), normal_stress=1e7, a=0.01, b=0.015, Dc=1e-2, theta=1e6)
    return body.simulation()

def again(run):
    while True:
        try:
            run()
        except Exception:
            pass

def short():
    simulation = fault(plate_rate=1e-9)
    again(lambda: simulation.run(simulation.time + 1.0))

runs = {
    "slider": lambda: ss.SpringSlider(1e7, 1e6, **SLIDER).run(1e30, max_steps=10**9),
    "law": lambda: ss.SpringSlider(1e7, 1e6, law=Aging(), **SLIDER).run(1e30, max_steps=10**9),
    "fault": lambda: fault(plate_rate=1e-9).run(1e30, rtol=1e-9, every=10**6),
    "callback": lambda: fault(plate_rate=1e-9).run(1e30, rtol=1e-9, every=1, callback=busy),
    "sleep": lambda: fault(plate_rate=1e-9).run(1e30, rtol=1e-9, every=1, callback=lambda t, v: time.sleep(0.01)),
    "pressure": lambda: fault(pressure=slow).run(1e30, rtol=1e-9, every=10**6),
    "body": lambda: list(body([1e-6, 0.0]).run(until=1e30, dt=1e-3, every=10**9)),
    "velocity": lambda: list(body(lambda t: [slow(t), 0.0]).run(until=1e30, dt=1e-3, every=10**9)),
    "part": lambda: again(lambda: ss.Mesh.grid([1.0, 1.0], [8, 8]).part(lambda x: slow(x) == 0.0)),
    "short": short,
}
"""


def ended(program: str, first: str = "") -> float:
    """The time that a program takes [s]. It ends without an error and prints nothing."""
    begun = time.monotonic()
    done = subprocess.run([sys.executable, "-c", first + START + program], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    return time.monotonic() - begun


@pytest.mark.parametrize(
    "run", ["slider", "law", "fault", "callback", "sleep", "pressure", "body", "velocity", "part", "short"]
)
def test_daemon_threads_in_runs_end_with_the_interpreter(run: str) -> None:
    threads = f"""
for _ in range(3):
    threading.Thread(target=runs[{run!r}], daemon=True).start()
time.sleep(0.3)
"""
    assert ended(threads) < 4.0


def test_threads_of_all_runs_end_at_once() -> None:
    threads = "[threading.Thread(target=run, daemon=True).start() for run in runs.values()]\ntime.sleep(0.5)\n"
    assert ended(threads) < 4.5


def test_the_thread_that_exits_can_still_run() -> None:
    # Hooks are called in the reverse of their order: this one after that of the module.
    first = "import atexit; atexit.register(lambda: last())"
    program = """
def last():
    if ss.SpringSlider(1e10, 1e6, **SLIDER).run(1.0).t[-1] != 1.0:
        print("no run")
"""
    ended(program, first)


def test_a_child_process_does_not_wait_for_threads_of_its_parent() -> None:
    fork = """
import os, warnings
warnings.simplefilter("ignore")
if hasattr(os, "fork"):
    threading.Thread(target=runs["slider"], daemon=True).start()
    time.sleep(0.1)
    child = os.fork()
    if child:
        begun = time.monotonic()
        status = os.waitpid(child, 0)[1]
        if status or time.monotonic() - begun > 4.0:
            print("child", status, time.monotonic() - begun)
    else:
        ss.SpringSlider(1e10, 1e6, **SLIDER).run(1.0)
"""
    assert ended(fork) < 6.0
