from collections.abc import Callable, Iterator, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypedDict, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Self

from ._events import Events
from ._names import Parameters

if TYPE_CHECKING:
    from pandas import DataFrame  # type: ignore[import-untyped, import-not-found, unused-ignore]

__version__: str

Array = NDArray[np.float64]
PerVertex = float | ArrayLike
Position = list[float]
Side = Literal["begin", "end", "top", "bottom"]
Condition = Literal["sealed"] | tuple[Literal["pressure", "flux"], float]

class FrictionLaw(Protocol):
    def coefficient(self, slip_rate: float, theta: float, /) -> float: ...
    def slope(self, slip_rate: float, theta: float, /) -> float: ...
    def potential(self, slip_rate: float, theta: float, /) -> float: ...

class StateLaw(Protocol):
    def rate(self, theta: float, slip_rate: float, /) -> float: ...
    def slope(self, theta: float, slip_rate: float, /) -> float: ...

@final
class CompiledFriction:
    def __new__(cls, *, coefficient: Any, slope: Any, potential: Any) -> Self: ...

@final
class CompiledState:
    def __new__(cls, *, rate: Any, slope: Any) -> Self: ...

AnyFriction = FrictionLaw | CompiledFriction
AnyState = StateLaw | CompiledState

@final
class SpringSlider:
    def __new__(
        cls,
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
        Vc: float | None = None,
        c: float | None = None,
        fields: Sequence[AnyField] = [],
    ) -> Self: ...
    @property
    def stiffness(self) -> float: ...
    @property
    def normal_stress(self) -> float: ...
    @property
    def a(self) -> float | None: ...
    @property
    def b(self) -> float | None: ...
    @property
    def Dc(self) -> float | None: ...
    @property
    def mu0(self) -> float: ...
    @property
    def V0(self) -> float: ...
    @property
    def friction(self) -> str | AnyFriction: ...
    @property
    def law(self) -> str | AnyState: ...
    @property
    def damping(self) -> float: ...
    @property
    def mass(self) -> float: ...
    @property
    def load(self) -> float | list[tuple[float, float]]: ...
    @property
    def V(self) -> float: ...
    @property
    def theta(self) -> float | None: ...
    @property
    def Vc(self) -> float | None: ...
    @property
    def c(self) -> float | None: ...
    @property
    def fields(self) -> list[AnyField]: ...
    @staticmethod
    def critical_stiffness(normal_stress: float, *, a: float, b: float, Dc: float) -> float: ...
    def run(
        self,
        until: float,
        rtol: float = 1e-6,
        max_steps: int = 2_000_000,
        *,
        t_eval: ArrayLike | None = None,
        start: bytes | None = None,
        progress: bool = False,
    ) -> SliderRun: ...
    def _repr_html_(self) -> str: ...

@final
class SliderRun:
    def __new__(
        cls,
        *,
        t: Array,
        V: Array,
        theta: Array,
        mu: Array,
        slip: Array,
        shear_stress: Array,
        pore_pressure: Array,
        effective_normal_stress: Array,
        readings: dict[str, Array],
        rejected: int,
        state: bytes,
    ) -> Self: ...
    @property
    def t(self) -> Array: ...
    @property
    def V(self) -> Array: ...
    @property
    def theta(self) -> Array: ...
    @property
    def mu(self) -> Array: ...
    @property
    def slip(self) -> Array: ...
    @property
    def shear_stress(self) -> Array: ...
    @property
    def pore_pressure(self) -> Array: ...
    @property
    def effective_normal_stress(self) -> Array: ...
    @property
    def readings(self) -> dict[str, Array]: ...
    @property
    def rejected(self) -> int: ...
    @property
    def state(self) -> bytes: ...
    def to_frame(self) -> DataFrame: ...
    def _repr_html_(self) -> str: ...
    def __len__(self) -> int: ...

@final
class FitResult:
    def __new__(
        cls,
        *,
        parameters: Parameters,
        errors: Parameters,
        values: Parameters,
        correlation: Array,
        a_minus_b: tuple[float, float],
        rms: float,
        aic: float,
        correlated_errors: bool,
        lag_one: float,
        effective_samples: float,
        spikes: Sequence[tuple[float, float]],
        interrupted: bool,
        warnings: Sequence[str],
        load: Sequence[tuple[float, float]],
        t: Array,
        mu: Array,
        residuals: Array,
        laws: Sequence[str],
        text: str,
    ) -> Self: ...
    @property
    def parameters(self) -> Parameters: ...
    @property
    def errors(self) -> Parameters: ...
    @property
    def values(self) -> Parameters: ...
    @property
    def text(self) -> str: ...
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
    def interrupted(self) -> bool: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def load(self) -> list[tuple[float, float]]: ...
    @property
    def t(self) -> Array: ...
    @property
    def mu(self) -> Array: ...
    @property
    def residuals(self) -> Array: ...
    @property
    def laws(self) -> list[str]: ...
    def to_frame(self) -> DataFrame: ...
    def _repr_html_(self) -> str: ...
    def __getitem__(self, name: str, /) -> float: ...

@final
class JointFitResult:
    def __new__(
        cls,
        *,
        parameters: Parameters,
        errors: Parameters,
        correlation: Array,
        a_minus_b: tuple[float, float],
        aic: float,
        interrupted: bool,
        warnings: Sequence[str],
        records: Sequence[FitResult],
        text: str,
    ) -> Self: ...
    @property
    def parameters(self) -> Parameters: ...
    @property
    def errors(self) -> Parameters: ...
    @property
    def correlation(self) -> Array: ...
    @property
    def a_minus_b(self) -> tuple[float, float]: ...
    @property
    def aic(self) -> float: ...
    @property
    def interrupted(self) -> bool: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def records(self) -> list[FitResult]: ...
    @property
    def text(self) -> str: ...
    def to_frame(self) -> DataFrame: ...
    def __len__(self) -> int: ...
    def __getitem__(self, name: str, /) -> float: ...
    def _repr_html_(self) -> str: ...

class _Friction(TypedDict):
    mu: ArrayLike

class _Record(_Friction, total=False):
    t: ArrayLike | None
    load: Sequence[tuple[float, float]] | None
    displacement: ArrayLike | None
    resolution: float | None
    steps_at: Sequence[tuple[float, float]] | None
    k: float | None
    stiffness: float | None
    normal_stress: float | None
    window: tuple[float, float] | None
    weights: ArrayLike | None

@final
class Healing:
    def __new__(
        cls, *, duration: Array, healing: Array, relaxation: Array, rate: float, standard_error: float
    ) -> Self: ...
    @property
    def duration(self) -> Array: ...
    @property
    def healing(self) -> Array: ...
    @property
    def relaxation(self) -> Array: ...
    @property
    def rate(self) -> float: ...
    @property
    def standard_error(self) -> float: ...
    def to_frame(self) -> DataFrame: ...
    def _repr_html_(self) -> str: ...

def fit(
    t: ArrayLike | None,
    mu: ArrayLike,
    *,
    load: Sequence[tuple[float, float]] | None = None,
    displacement: ArrayLike | None = None,
    resolution: float | None = None,
    steps_at: Sequence[tuple[float, float]] | None = None,
    law: str | Sequence[str] = "aging",
    states: int = 1,
    k: float | None = None,
    stiffness: float | None = None,
    normal_stress: float | None = None,
    window: tuple[float, float] | None = None,
    trend: str | None = None,
    weights: ArrayLike | None = None,
    free_initial_state: bool = False,
    loss: str = "squares",
    step_offset: bool = False,
    V0: float | None = None,
    free: Sequence[str] = [],
    fixed: Mapping[str, float] = {},
    bounds: Mapping[str, tuple[float, float]] = {},
    guess: Mapping[str, float] = {},
) -> FitResult: ...
def joint_fit(
    records: Sequence[_Record],
    *,
    law: str | Sequence[str] = "aging",
    states: int = 1,
    trend: str | None = None,
    free_initial_state: bool = False,
    loss: str = "squares",
    step_offset: bool = False,
    V0: float | None = None,
    free: Sequence[str] = [],
    fixed: Mapping[str, float] = {},
    bounds: Mapping[str, tuple[float, float]] = {},
    guess: Mapping[str, float] = {},
) -> JointFitResult: ...
def healing(
    t: ArrayLike | None,
    mu: ArrayLike,
    *,
    load: Sequence[tuple[float, float]] | None = None,
    displacement: ArrayLike | None = None,
    resolution: float | None = None,
    steps_at: Sequence[tuple[float, float]] | None = None,
) -> Healing: ...
def velocity_step(
    velocities: Sequence[float],
    displacement: float,
    *,
    k: float | None = None,
    a: float,
    b: float,
    Dc: float,
    mu0: float = 0.6,
    V0: float = 1e-6,
    law: str = "aging",
    samples: int = 200,
    stiffness: float | None = None,
    normal_stress: float | None = None,
) -> tuple[Array, Array, list[tuple[float, float]]]: ...
def slide_hold_slide(
    velocity: float,
    durations: Sequence[float],
    displacement: float,
    *,
    k: float | None = None,
    a: float,
    b: float,
    Dc: float,
    mu0: float = 0.6,
    V0: float = 1e-6,
    law: str = "aging",
    samples: int = 200,
    stiffness: float | None = None,
    normal_stress: float | None = None,
) -> tuple[Array, Array, list[tuple[float, float]]]: ...

@final
class ThermalPressurization:
    def __new__(
        cls,
        *,
        half_width: PerVertex,
        heat_capacity: PerVertex,
        thermal_diffusivity: PerVertex,
        hydraulic_diffusivity: PerVertex,
        pressurization_coefficient: PerVertex,
        initial_temperature: PerVertex,
        modes: int = 24,
    ) -> Self: ...
    @property
    def half_width(self) -> float | Array: ...
    @property
    def heat_capacity(self) -> float | Array: ...
    @property
    def thermal_diffusivity(self) -> float | Array: ...
    @property
    def hydraulic_diffusivity(self) -> float | Array: ...
    @property
    def pressurization_coefficient(self) -> float | Array: ...
    @property
    def initial_temperature(self) -> float | Array: ...
    @property
    def modes(self) -> int: ...
    def _repr_html_(self) -> str: ...

@final
class ShearHeating:
    def __new__(
        cls,
        *,
        half_width: PerVertex,
        heat_capacity: PerVertex,
        thermal_diffusivity: PerVertex,
        initial_temperature: PerVertex,
        modes: int = 24,
    ) -> Self: ...
    @property
    def half_width(self) -> float | Array: ...
    @property
    def heat_capacity(self) -> float | Array: ...
    @property
    def thermal_diffusivity(self) -> float | Array: ...
    @property
    def initial_temperature(self) -> float | Array: ...
    @property
    def modes(self) -> int: ...
    def _repr_html_(self) -> str: ...

@final
class Well:
    def __new__(
        cls,
        position: float | Sequence[float],
        times: ArrayLike,
        rates: ArrayLike,
        *,
        interpolation: Literal["constant", "linear"] = "constant",
        storage: float | None = None,
        radius: float | None = None,
        index: float | None = None,
    ) -> Self: ...
    @property
    def position(self) -> float | list[float]: ...
    @property
    def times(self) -> Array: ...
    @property
    def rates(self) -> Array: ...
    @property
    def interpolation(self) -> str: ...
    @property
    def storage(self) -> float | None: ...
    @property
    def radius(self) -> float | None: ...
    @property
    def index(self) -> float | None: ...
    def volume(self, begin: float, end: float) -> float: ...
    def _repr_html_(self) -> str: ...

@final
class GaussianSource:
    def __new__(
        cls,
        position: float | Sequence[float],
        deviation: float,
        times: ArrayLike,
        rates: ArrayLike,
        *,
        interpolation: Literal["constant", "linear"] = "constant",
    ) -> Self: ...
    @property
    def position(self) -> float | list[float]: ...
    @property
    def deviation(self) -> float: ...
    @property
    def times(self) -> Array: ...
    @property
    def rates(self) -> Array: ...
    @property
    def interpolation(self) -> str: ...
    def _repr_html_(self) -> str: ...

@final
class LeakOff:
    def __new__(
        cls,
        drainage_time: PerVertex,
        *,
        far_pressure: PerVertex = 0.0,
    ) -> Self: ...
    @property
    def drainage_time(self) -> float | Array: ...
    @property
    def far_pressure(self) -> float | Array: ...
    def _repr_html_(self) -> str: ...

@final
class Dilatancy:
    def __new__(
        cls,
        *,
        coefficient: float,
        reference_velocity: float,
        slip_distance: float,
        initial_change: float = 0.0,
    ) -> Self: ...
    @property
    def coefficient(self) -> float: ...
    @property
    def reference_velocity(self) -> float: ...
    @property
    def slip_distance(self) -> float: ...
    @property
    def initial_change(self) -> float: ...
    def _repr_html_(self) -> str: ...

@final
class PermeabilityEvolution:
    def __new__(
        cls,
        *,
        minimum: PerVertex,
        maximum: PerVertex,
        slip_distance: PerVertex,
        healing_time: PerVertex,
    ) -> Self: ...
    @property
    def minimum(self) -> float | Array: ...
    @property
    def maximum(self) -> float | Array: ...
    @property
    def slip_distance(self) -> float | Array: ...
    @property
    def healing_time(self) -> float | Array: ...
    def _repr_html_(self) -> str: ...

@final
class Diffusion:
    def __new__(
        cls,
        *,
        permeability: PerVertex,
        viscosity: PerVertex,
        storage: PerVertex,
        thickness: PerVertex,
        initial_pressure: PerVertex = 0.0,
        wells: Sequence[Well] = [],
        sources: Sequence[GaussianSource] = [],
        sides: Mapping[Side, Condition] = {},
        leak_off: LeakOff | None = None,
        dilatancy: Dilatancy | None = None,
        permeability_evolution: PermeabilityEvolution | None = None,
        fourth_order: bool = False,
        plane: int | None = None,
    ) -> Self: ...
    @property
    def permeability(self) -> float | Array: ...
    @property
    def viscosity(self) -> float | Array: ...
    @property
    def storage(self) -> float | Array: ...
    @property
    def thickness(self) -> float | Array: ...
    @property
    def initial_pressure(self) -> float | Array: ...
    @property
    def wells(self) -> list[Well]: ...
    @property
    def sources(self) -> list[GaussianSource]: ...
    @property
    def sides(self) -> dict[Side, Condition]: ...
    @property
    def leak_off(self) -> LeakOff | None: ...
    @property
    def dilatancy(self) -> Dilatancy | None: ...
    @property
    def permeability_evolution(self) -> PermeabilityEvolution | None: ...
    @property
    def fourth_order(self) -> bool: ...
    @property
    def plane(self) -> int | None: ...
    def _repr_html_(self) -> str: ...

AnyField = ThermalPressurization | ShearHeating | Diffusion

@final
class LineFault:
    def __new__(
        cls,
        ends: Sequence[float],
        cells: int,
        *,
        shear_modulus: float,
        shear_wave_speed: float,
        space: str = "half",
        poisson_ratio: float | None = None,
        dip: float = 90.0,
        sense: str = "thrust",
    ) -> Self: ...
    @property
    def ends(self) -> list[float]: ...
    @property
    def cells(self) -> int: ...
    @property
    def shear_modulus(self) -> float: ...
    @property
    def shear_wave_speed(self) -> float: ...
    @property
    def space(self) -> str: ...
    @property
    def poisson_ratio(self) -> float | None: ...
    @property
    def dip(self) -> float: ...
    @property
    def sense(self) -> str: ...
    @property
    def centers(self) -> Array: ...
    def receivers(self, points: ArrayLike, *, plate_rate: PerVertex | None = None) -> Receivers: ...
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
        alpha: PerVertex | None = None,
        fields: Sequence[AnyField] = [],
        least_normal_stress: float | None = None,
    ) -> FaultSimulation: ...
    def _repr_html_(self) -> str: ...
    def __len__(self) -> int: ...

@final
class PlaneFault:
    def __new__(
        cls,
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
    ) -> Self: ...
    @property
    def along_strike(self) -> list[float]: ...
    @property
    def down_dip(self) -> list[float]: ...
    @property
    def cells(self) -> list[int]: ...
    @property
    def shape(self) -> tuple[int, int]: ...
    @property
    def shear_modulus(self) -> float: ...
    @property
    def shear_wave_speed(self) -> float: ...
    @property
    def poisson_ratio(self) -> float: ...
    @property
    def space(self) -> str: ...
    @property
    def dip(self) -> float: ...
    @property
    def rake(self) -> float | str: ...
    @property
    def centers(self) -> Array: ...
    def receivers(self, points: ArrayLike, *, plate_rate: PerVertex | None = None) -> Receivers: ...
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
        alpha: PerVertex | None = None,
        fields: Sequence[AnyField] = [],
        least_normal_stress: float | None = None,
    ) -> FaultSimulation: ...
    def _repr_html_(self) -> str: ...
    def __len__(self) -> int: ...

@final
class FaultSystem:
    def __new__(
        cls,
        planes: Sequence[PlaneFault],
        *,
        strikes: Sequence[float],
        origins: Sequence[Sequence[float]],
    ) -> Self: ...
    @property
    def planes(self) -> list[PlaneFault]: ...
    @property
    def strikes(self) -> list[float]: ...
    @property
    def origins(self) -> list[list[float]]: ...
    @property
    def ranges(self) -> list[tuple[int, int]]: ...
    @property
    def centers(self) -> Array: ...
    def receivers(self, points: ArrayLike) -> Receivers: ...
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
        alpha: PerVertex | None = None,
        fields: Sequence[AnyField] = [],
        least_normal_stress: float | None = None,
    ) -> FaultSimulation: ...
    def _repr_html_(self) -> str: ...
    def __len__(self) -> int: ...

@final
class Segments:
    def __new__(cls, lines: ArrayLike | Sequence[ArrayLike]) -> Self: ...
    @staticmethod
    def from_csv(path: str | PathLike[str]) -> Segments: ...
    @staticmethod
    def down(
        pieces: ArrayLike,
        length: float,
        *,
        spread: float = 0.0,
        start: Sequence[float] = (0.0, 0.0),
    ) -> Segments: ...
    def divided(self, length: float) -> Segments: ...
    def joined(self, others: Segments) -> Segments: ...
    @property
    def lines(self) -> list[Array]: ...
    @property
    def centers(self) -> Array: ...
    @property
    def lengths(self) -> Array: ...
    @property
    def distances(self) -> Array: ...
    @property
    def faults(self) -> NDArray[np.uint64]: ...
    @property
    def quality(self) -> dict[str, Any]: ...
    def __len__(self) -> int: ...

@final
class SegmentFault:
    def __new__(
        cls,
        segments: Segments,
        *,
        shear_modulus: float,
        shear_wave_speed: float,
        poisson_ratio: float | None = None,
        space: str = "half",
        sense: str = "thrust",
    ) -> Self: ...
    @property
    def segments(self) -> Segments: ...
    @property
    def shear_modulus(self) -> float: ...
    @property
    def shear_wave_speed(self) -> float: ...
    @property
    def poisson_ratio(self) -> float | None: ...
    @property
    def space(self) -> str: ...
    @property
    def sense(self) -> str: ...
    @property
    def centers(self) -> Array: ...
    def along(self, velocity: Sequence[float]) -> Array: ...
    def displacement_at(self, points: ArrayLike, slip: ArrayLike) -> Array: ...
    def stress_at(self, points: ArrayLike, slip: ArrayLike) -> Array: ...
    def receivers(self, points: ArrayLike) -> Receivers: ...
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
        alpha: PerVertex | None = None,
        fields: Sequence[AnyField] = [],
        least_normal_stress: float | None = None,
    ) -> FaultSimulation: ...
    def _repr_html_(self) -> str: ...
    def __len__(self) -> int: ...

@final
class Triangles:
    def __new__(cls, points: ArrayLike, triangles: ArrayLike) -> Self: ...
    @staticmethod
    def gmsh(path: str | PathLike[str], groups: Sequence[str] | None = None) -> Triangles: ...
    @staticmethod
    def stl(path: str | PathLike[str]) -> Triangles: ...
    @property
    def points(self) -> Array: ...
    @property
    def triangles(self) -> NDArray[np.uint64]: ...
    @property
    def centers(self) -> Array: ...
    @property
    def areas(self) -> Array: ...
    @property
    def strikes(self) -> Array: ...
    @property
    def dips(self) -> Array: ...
    @property
    def normals(self) -> Array: ...
    @property
    def sheets(self) -> NDArray[np.uint64]: ...
    @property
    def quality(self) -> dict[str, Any]: ...
    def __len__(self) -> int: ...

@final
class SurfaceFault:
    def __new__(
        cls,
        cells: Triangles,
        *,
        shear_modulus: float,
        shear_wave_speed: float,
        poisson_ratio: float = 0.25,
        space: str = "half",
        rake: float | str | ArrayLike = 90.0,
    ) -> Self: ...
    @property
    def cells(self) -> Triangles: ...
    @property
    def shear_modulus(self) -> float: ...
    @property
    def shear_wave_speed(self) -> float: ...
    @property
    def poisson_ratio(self) -> float: ...
    @property
    def space(self) -> str: ...
    @property
    def rake(self) -> float | str | Array: ...
    @property
    def centers(self) -> Array: ...
    def along(self, velocity: Sequence[float]) -> Array: ...
    def rakes_along(self, velocity: Sequence[float]) -> Array: ...
    def receivers(self, points: ArrayLike) -> Receivers: ...
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
        alpha: PerVertex | None = None,
        fields: Sequence[AnyField] = [],
        least_normal_stress: float | None = None,
    ) -> FaultSimulation: ...
    def _repr_html_(self) -> str: ...
    def __len__(self) -> int: ...

@final
class Receivers:
    @property
    def points(self) -> Array: ...
    def displacement(self, slip: PerVertex) -> Array: ...
    def stress(self, slip: PerVertex) -> Array: ...
    def creep(self, slip: PerVertex) -> Array: ...
    def __len__(self) -> int: ...

@final
class FaultSimulation:
    def run(
        self,
        until: float,
        *,
        every: int = 10,
        rtol: float = 1e-6,
        max_steps: int | None = 2_000_000,
        callback: Callable[[float, float], bool | None] | None = None,
        threshold: Sequence[float] = (1e-2, 1e-3),
        stops: ArrayLike = [],
        seas: SeasFiles | None = None,
        t_eval: ArrayLike | None = None,
        receivers: Receivers | None = None,
        progress: bool = False,
    ) -> FaultRun: ...
    @property
    def time(self) -> float: ...
    @property
    def events(self) -> Events: ...
    def state(self) -> bytes: ...
    def restore(self, state: bytes) -> None: ...
    def save(self, path: str | PathLike[str]) -> None: ...
    def load(self, path: str | PathLike[str]) -> None: ...

@final
class FaultRun:
    def __new__(
        cls,
        *,
        t: Array,
        V: Array,
        slip: Array,
        theta: Array,
        shear_stress: Array,
        normal_stress: Array,
        pore_pressure: Array,
        effective_normal_stress: Array,
        readings: dict[str, Array],
        totals: dict[str, Array],
        receiver_displacement: Array,
        receiver_velocity: Array,
        events: Events,
        steps: int,
    ) -> Self: ...
    @property
    def t(self) -> Array: ...
    @property
    def V(self) -> Array: ...
    @property
    def slip(self) -> Array: ...
    @property
    def theta(self) -> Array: ...
    @property
    def shear_stress(self) -> Array: ...
    @property
    def normal_stress(self) -> Array: ...
    @property
    def pore_pressure(self) -> Array: ...
    @property
    def effective_normal_stress(self) -> Array: ...
    @property
    def readings(self) -> dict[str, Array]: ...
    @property
    def totals(self) -> dict[str, Array]: ...
    @property
    def receiver_displacement(self) -> Array: ...
    @property
    def receiver_velocity(self) -> Array: ...
    @property
    def events(self) -> Events: ...
    @property
    def steps(self) -> int: ...
    def to_frame(self, cells: ArrayLike | None = None) -> DataFrame: ...
    def _repr_html_(self) -> str: ...
    def __len__(self) -> int: ...

@final
class SeasFiles:
    def __new__(
        cls,
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
    ) -> Self: ...
    @property
    def folder(self) -> Path: ...
    @property
    def problem(self) -> str: ...
    @property
    def stations(self) -> list[float] | list[list[float]]: ...
    @property
    def line(self) -> list[float] | list[list[float]]: ...
    @property
    def intervals(self) -> list[float] | None: ...
    @property
    def threshold(self) -> float: ...
    @property
    def normal_stress(self) -> bool: ...
    @property
    def unit(self) -> float: ...
    @property
    def digits(self) -> int: ...
    @property
    def header(self) -> dict[str, str]: ...

@final
class SeasTable:
    def __new__(cls, path: str | PathLike[str]) -> Self: ...
    @property
    def path(self) -> Path: ...
    def to_frame(self) -> DataFrame: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def comments(self) -> list[str]: ...
    @property
    def positions(self) -> Array | None: ...
    @property
    def values(self) -> Array: ...
    def metadata(self, key: str) -> str | None: ...
    def __getitem__(self, name: str, /) -> Array: ...
    def __len__(self) -> int: ...

@final
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

@final
class Part:
    @property
    def vertices(self) -> NDArray[np.uintp]: ...
    @property
    def points(self) -> Array: ...
    @property
    def weights(self) -> Array: ...
    def __len__(self) -> int: ...

@final
class Body:
    def __new__(
        cls,
        mesh: Mesh,
        *,
        E: float,
        nu: float,
        density: float = 0.0,
        gravity: Sequence[float] | None = None,
        antiplane: bool = False,
    ) -> Self: ...
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
        fields: Sequence[AnyField] = [],
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
        fields: Sequence[AnyField] = [],
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

@final
class BodySimulation:
    def run(
        self,
        *,
        until: float | None = None,
        steps: int | None = None,
        dt: float | None = None,
        rtol: float | None = None,
        every: int = 1,
        progress: bool = False,
    ) -> BodyRun: ...
    def step(self, dt: float) -> BodyState: ...
    def now(self) -> BodyState: ...
    @property
    def time(self) -> float: ...
    @property
    def frequencies(self) -> Array: ...
    def state(self) -> bytes: ...
    def restore(self, state: bytes) -> None: ...
    def save(self, path: str | PathLike[str]) -> None: ...
    def load(self, path: str | PathLike[str]) -> None: ...

@final
class BodyRun:
    def __iter__(self) -> Iterator[BodyState]: ...
    def __next__(self) -> BodyState: ...

@final
class BodyState:
    def __new__(
        cls,
        *,
        time: float,
        displacement: Array,
        velocity: Array,
        contacts: Sequence[ContactState],
        iterations: int,
    ) -> Self: ...
    @property
    def time(self) -> float: ...
    @property
    def displacement(self) -> Array: ...
    @property
    def velocity(self) -> Array: ...
    @property
    def contacts(self) -> list[ContactState]: ...
    @property
    def iterations(self) -> int: ...
    @property
    def max_slip_rate(self) -> float: ...
    def _repr_html_(self) -> str: ...

@final
class ContactState:
    def __new__(
        cls,
        *,
        vertices: NDArray[np.uintp],
        slip: Array,
        slip_rate: Array,
        theta: Array | None,
        normal_stress: Array,
        pore_pressure: Array,
        effective_normal_stress: Array,
        readings: dict[str, Array],
        opening: Array,
        mu: Array,
        shear_stress: Array,
    ) -> Self: ...
    @property
    def vertices(self) -> NDArray[np.uintp]: ...
    @property
    def slip(self) -> Array: ...
    @property
    def slip_rate(self) -> Array: ...
    @property
    def theta(self) -> Array | None: ...
    @property
    def normal_stress(self) -> Array: ...
    @property
    def pore_pressure(self) -> Array: ...
    @property
    def effective_normal_stress(self) -> Array: ...
    @property
    def readings(self) -> dict[str, Array]: ...
    @property
    def opening(self) -> Array: ...
    @property
    def mu(self) -> Array: ...
    @property
    def shear_stress(self) -> Array: ...
    def to_frame(self) -> DataFrame: ...
    def _repr_html_(self) -> str: ...
