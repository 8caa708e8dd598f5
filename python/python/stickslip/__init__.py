"""Rate- and state-dependent friction: spring sliders, faults and laws of your own. Units are SI."""

from ._arguments import named as _named
from ._errors import ArgumentError, ArgumentTypeError, ArgumentValueError, FaultError, FileError, FitError, FrictionLawError, MeshError, SceneError, StateLawError, StepError, StickslipError
from ._stickslip import (
    Body,
    BodyRun,
    BodySimulation,
    BodyState,
    CompiledFriction,
    CompiledState,
    ContactState,
    Diffusion,
    Dilatancy,
    FaultRun,
    FaultSimulation,
    FaultSystem,
    FitResult,
    GaussianSource,
    Healing,
    JointFitResult,
    LeakOff,
    LineFault,
    Mesh,
    Part,
    PermeabilityEvolution,
    PlaneFault,
    Receivers,
    SeasFiles,
    SeasTable,
    SegmentFault,
    Segments,
    ShearHeating,
    SliderRun,
    SpringSlider,
    SurfaceFault,
    ThermalPressurization,
    Triangles,
    Well,
)
from ._stickslip import __version__ as __version__
from ._stickslip import fit as _fit
from ._stickslip import healing as _healing
from ._stickslip import joint_fit as _joint_fit
from ._stickslip import slide_hold_slide as _slide_hold_slide
from ._stickslip import velocity_step as _velocity_step

fit = _named(_fit)
healing = _named(_healing)
joint_fit = _named(_joint_fit)
slide_hold_slide = _named(_slide_hold_slide)
velocity_step = _named(_velocity_step)

__all__ = [
    "ArgumentError",
    "ArgumentTypeError",
    "ArgumentValueError",
    "Body",
    "BodyRun",
    "BodySimulation",
    "BodyState",
    "CompiledFriction",
    "CompiledState",
    "ContactState",
    "Diffusion",
    "Dilatancy",
    "FaultError",
    "FaultRun",
    "FaultSimulation",
    "FaultSystem",
    "FileError",
    "FitError",
    "FitResult",
    "FrictionLawError",
    "GaussianSource",
    "Healing",
    "JointFitResult",
    "LeakOff",
    "LineFault",
    "Mesh",
    "MeshError",
    "Part",
    "PermeabilityEvolution",
    "PlaneFault",
    "Receivers",
    "SceneError",
    "SeasFiles",
    "SeasTable",
    "SegmentFault",
    "Segments",
    "ShearHeating",
    "SliderRun",
    "SpringSlider",
    "StateLawError",
    "StepError",
    "StickslipError",
    "SurfaceFault",
    "ThermalPressurization",
    "Triangles",
    "Well",
    "fit",
    "healing",
    "joint_fit",
    "slide_hold_slide",
    "velocity_step",
]
