from collections.abc import Callable, Iterator, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
PerVertex = float | ArrayLike
Position = list[float]

class FrictionLaw(Protocol):
    def coefficient(self, slip_rate: float, theta: float, /) -> float: ...
    def slope(self, slip_rate: float, theta: float, /) -> float: ...
    def potential(self, slip_rate: float, theta: float, /) -> float: ...

class StateLaw(Protocol):
    def rate(self, theta: float, slip_rate: float, /) -> float: ...
    def slope(self, theta: float, slip_rate: float, /) -> float: ...

class CompiledFriction:
    def __init__(self, *, coefficient: Any, slope: Any, potential: Any) -> None: ...

class CompiledState:
    def __init__(self, *, rate: Any, slope: Any) -> None: ...

AnyFriction = FrictionLaw | CompiledFriction
AnyState = StateLaw | CompiledState

class SpringSlider:
    def __init__(
        self,
        stiffness: float,
        normal_stress: float,
        *,
        a: float | None = None,
        b: float | None = None,
        Dc: float | None = None,
        mu0: float = 0.6,
        V0: float = 1e-6,
        friction: str | AnyFriction = "cut-off",
        law: str | AnyState = "aging",
        damping: float = 0.0,
        mass: float = 0.0,
        load: float | Sequence[tuple[float, float]] = 1e-6,
        V: float | None = None,
        theta: float | None = None,
    ) -> None: ...
    @staticmethod
    def critical_stiffness(normal_stress: float, *, a: float, b: float, Dc: float) -> float: ...
    def run(self, until: float, rtol: float = 1e-6, max_steps: int = 2_000_000) -> SliderRun: ...

class SliderRun:
    t: Array
    V: Array
    theta: Array
    mu: Array
    slip: Array
    rejected: int
    def __len__(self) -> int: ...

class FitResult:
    @property
    def parameters(self) -> dict[str, float]: ...
    @property
    def errors(self) -> dict[str, float]: ...
    @property
    def correlation(self) -> Array: ...
    @property
    def a_minus_b(self) -> tuple[float, float]: ...
    @property
    def rms(self) -> float: ...
    @property
    def aic(self) -> float: ...
    @property
    def correlated_errors(self) -> bool: ...
    @property
    def lag_one(self) -> float: ...
    @property
    def effective_samples(self) -> float: ...
    @property
    def spikes(self) -> list[tuple[float, float]]: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def t(self) -> Array: ...
    @property
    def mu(self) -> Array: ...
    @property
    def residuals(self) -> Array: ...
    @property
    def laws(self) -> list[str]: ...
    def __getitem__(self, name: str) -> float: ...

class Healing:
    duration: Array
    healing: Array
    relaxation: Array
    rate: float
    standard_error: float

def fit(
    t: ArrayLike,
    mu: ArrayLike,
    *,
    load: Sequence[tuple[float, float]] | None = None,
    displacement: ArrayLike | None = None,
    resolution: float | None = None,
    law: str | Sequence[str] = "aging",
    states: int = 1,
    stiffness: float | None = None,
    window: tuple[float, float] | None = None,
    trend: str | None = None,
    weights: ArrayLike | None = None,
    free_initial_state: bool = False,
    loss: str = "squares",
    step_offset: bool = False,
    V0: float | None = None,
    fixed: Mapping[str, float] = {},
    bounds: Mapping[str, tuple[float, float]] = {},
    guess: Mapping[str, float] = {},
) -> FitResult: ...
def healing(
    t: ArrayLike,
    mu: ArrayLike,
    *,
    load: Sequence[tuple[float, float]] | None = None,
    displacement: ArrayLike | None = None,
    resolution: float | None = None,
) -> Healing: ...
def velocity_step(
    velocities: Sequence[float],
    displacement: float,
    *,
    stiffness: float,
    a: float,
    b: float,
    Dc: float,
    mu0: float = 0.6,
    V0: float = 1e-6,
    law: str = "aging",
    samples: int = 200,
) -> tuple[Array, Array, list[tuple[float, float]]]: ...
def slide_hold_slide(
    velocity: float,
    durations: Sequence[float],
    displacement: float,
    *,
    stiffness: float,
    a: float,
    b: float,
    Dc: float,
    mu0: float = 0.6,
    V0: float = 1e-6,
    law: str = "aging",
    samples: int = 200,
) -> tuple[Array, Array, list[tuple[float, float]]]: ...

class LineFault:
    def __init__(
        self,
        ends: Sequence[float],
        cells: int,
        *,
        shear_modulus: float,
        shear_wave_speed: float,
        space: str = "half",
        poisson_ratio: float | None = None,
        dip: float = 90.0,
        sense: str = "thrust",
    ) -> None: ...
    @property
    def centers(self) -> Array: ...
    def simulation(
        self,
        *,
        a: PerVertex | None = None,
        b: PerVertex | None = None,
        Dc: PerVertex | None = None,
        normal_stress: PerVertex,
        shear_stress: PerVertex,
        theta: PerVertex | None = None,
        log_theta: PerVertex | None = None,
        slip_rate: PerVertex | None = None,
        mu0: PerVertex = 0.6,
        V0: PerVertex = 1e-6,
        plate_rate: PerVertex = 0.0,
        stress_rate: PerVertex | None = None,
        friction: str | AnyFriction | Sequence[AnyFriction] = "regularized",
        law: str | AnyState | Sequence[AnyState] = "aging",
        allow_opening: bool = False,
        pressure: Callable[[float], PerVertex] | None = None,
        overstress: Callable[[float], PerVertex] | None = None,
    ) -> FaultSimulation: ...
    def __len__(self) -> int: ...

class PlaneFault:
    def __init__(
        self,
        along_strike: Sequence[float],
        down_dip: Sequence[float],
        cells: Sequence[int],
        *,
        shear_modulus: float,
        shear_wave_speed: float,
        poisson_ratio: float = 0.25,
        space: str = "half",
        dip: float = 90.0,
        rake: float | Literal["free"] = 0.0,
    ) -> None: ...
    @property
    def centers(self) -> Array: ...
    def simulation(
        self,
        *,
        a: PerVertex | None = None,
        b: PerVertex | None = None,
        Dc: PerVertex | None = None,
        normal_stress: PerVertex,
        shear_stress: PerVertex,
        theta: PerVertex | None = None,
        log_theta: PerVertex | None = None,
        slip_rate: PerVertex | None = None,
        mu0: PerVertex = 0.6,
        V0: PerVertex = 1e-6,
        plate_rate: PerVertex = 0.0,
        stress_rate: PerVertex | None = None,
        friction: str | AnyFriction | Sequence[AnyFriction] = "regularized",
        law: str | AnyState | Sequence[AnyState] = "aging",
        allow_opening: bool = False,
        pressure: Callable[[float], PerVertex] | None = None,
        overstress: Callable[[float], PerVertex] | None = None,
    ) -> FaultSimulation: ...
    def __len__(self) -> int: ...

class FaultSimulation:
    def run(
        self,
        until: float,
        *,
        every: int = 10,
        rtol: float = 1e-6,
        max_steps: int | None = None,
        callback: Callable[[float, float], Any] | None = None,
        threshold: tuple[float, float] = (1e-2, 1e-3),
        stops: Sequence[float] = [],
        seas: SeasFiles | None = None,
    ) -> FaultRun: ...
    @property
    def time(self) -> float: ...

class FaultRun:
    t: Array
    V: Array
    slip: Array
    theta: Array
    shear_stress: Array
    normal_stress: Array
    events: NDArray[np.void]
    steps: int
    def __len__(self) -> int: ...

class SeasFiles:
    def __init__(
        self,
        folder: str | PathLike[str],
        problem: str,
        *,
        stations: ArrayLike = [],
        line: ArrayLike = [],
        intervals: tuple[float, float] | None = None,
        threshold: float = 1e-2,
        normal_stress: bool = False,
        unit: float = 100.0,
        digits: int = 3,
        header: dict[str, str] = {},
    ) -> None: ...

class SeasTable:
    def __init__(self, path: str | PathLike[str]) -> None: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def comments(self) -> list[str]: ...
    @property
    def positions(self) -> Array | None: ...
    @property
    def values(self) -> Array: ...
    def metadata(self, key: str) -> str | None: ...
    def __getitem__(self, name: str) -> Array: ...
    def __len__(self) -> int: ...

class Mesh:
    @staticmethod
    def grid(size: Sequence[float], cells: Sequence[int], origin: Sequence[float] | None = None) -> Mesh: ...
    @staticmethod
    def gmsh(path: str | PathLike[str]) -> Mesh: ...
    def with_surface(self, name: str, on: Callable[[Position], Any]) -> Mesh: ...
    def split(self, *names: str) -> Mesh: ...
    def refined(self, levels: int = 1) -> Mesh: ...
    def part(self, which: str | Callable[[Position], Any]) -> Part: ...
    @property
    def parts(self) -> list[str]: ...
    @property
    def vertices(self) -> Array: ...
    @property
    def cells(self) -> NDArray[np.uint32]: ...

class Part:
    @property
    def vertices(self) -> NDArray[np.uintp]: ...
    @property
    def points(self) -> Array: ...
    @property
    def weights(self) -> Array: ...
    def __len__(self) -> int: ...

class Body:
    def __init__(
        self,
        mesh: Mesh,
        *,
        E: float,
        nu: float,
        density: float = 0.0,
        gravity: Sequence[float] | None = None,
        antiplane: bool = False,
    ) -> None: ...
    def fix(self, part: Part, components: str | None = None) -> None: ...
    def drive(
        self,
        part: Part,
        velocity: Sequence[float] | Callable[[float], float | Sequence[float]],
        components: str | None = None,
    ) -> None: ...
    def contact(
        self,
        part: Part,
        *,
        normal_stress: PerVertex | str,
        a: float | None = None,
        b: float | None = None,
        Dc: float | None = None,
        mu0: float = 0.6,
        V0: float = 1e-6,
        theta: PerVertex,
        opposite: Part | None = None,
        friction: str | AnyFriction = "cut-off",
        law: str | AnyState = "aging",
        cohesion: float = 0.0,
        allow_opening: bool = False,
    ) -> None: ...
    def coulomb(
        self,
        part: Part,
        *,
        normal_stress: PerVertex | str,
        coefficient: float,
        opposite: Part | None = None,
        cohesion: float = 0.0,
        allow_opening: bool = False,
    ) -> None: ...
    def simulation(
        self,
        *,
        scheme: str = "generalized-alpha",
        solver: str = "condensed",
        equilibrium: bool = False,
        zero_acceleration: bool = False,
        coupling: str = "monolithic",
        state_update: str | None = None,
        tolerance: float | None = None,
        absolute_tolerance: float | None = None,
        reduced_up_to: float | None = None,
        reduced_for_step: float | None = None,
    ) -> BodySimulation: ...

class BodySimulation:
    def run(
        self,
        *,
        until: float | None = None,
        steps: int | None = None,
        dt: float | None = None,
        rtol: float | None = None,
        every: int = 1,
    ) -> BodyRun: ...
    def step(self, dt: float) -> BodyState: ...
    def now(self) -> BodyState: ...
    @property
    def time(self) -> float: ...
    @property
    def frequencies(self) -> Array: ...
    def state(self) -> bytes: ...
    def restore(self, state: bytes) -> None: ...

class BodyRun:
    def __iter__(self) -> Iterator[BodyState]: ...
    def __next__(self) -> BodyState: ...

class BodyState:
    time: float
    displacement: Array
    velocity: Array
    contacts: list[ContactState]
    iterations: int
    @property
    def max_slip_rate(self) -> float: ...

class ContactState:
    vertices: NDArray[np.uintp]
    slip: Array
    slip_rate: Array
    theta: Array | None
    normal_stress: Array
    opening: Array
    mu: Array
