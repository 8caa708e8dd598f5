//! Errors as exceptions: a class per enum, the variant as `kind`, its numbers as attributes.

mod arguments;
mod hints;

use arguments::argument_of;
pub(crate) use arguments::{Bare, argument, misfit, of_argument};
use hints::{RTOL, hint_of_scene, hint_of_step, worded};

use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use stickslip::bie::{KernelError, ReceiverError, SegmentsError, SurfaceError};
use stickslip::fem::ReadError;
use stickslip::friction::FrictionViolation;
use stickslip::lab::LabError;
use stickslip::record::FileError;
use stickslip::state::{StateError, StateLawViolation};
use stickslip::{SceneError, StepError, StepFailure};

/// The attributes of an exception.
type Attributes = Vec<(&'static str, Py<PyAny>)>;

/// The name of the variant and its fields, of the variants listed; of others the name alone.
macro_rules! variant {
    ($py:expr, $error:expr, $kind:ident { $($variant:ident { $($field:ident),* }),* $(,)? }) => {
        match $error {
            $($kind::$variant { $($field,)* .. } => {
                let fields: PyResult<Attributes> = [$(
                    $field.into_py_any($py).map(|value| (stringify!($field), value))
                ),*].into_iter().collect();
                (stringify!($variant).to_owned(), fields?)
            })*
            other => (name(other), Attributes::new()),
        }
    };
}

/// The name of a variant without numbers of interest.
fn name(error: &impl std::fmt::Debug) -> String {
    let debug = format!("{error:?}");
    let end = debug.find(|c: char| !c.is_alphanumeric());
    debug[..end.unwrap_or(debug.len())].to_owned()
}

/// An exception of a class of `stickslip`.
fn exception(
    py: Python<'_>,
    class: &str,
    message: String,
    (kind, fields): (String, Attributes),
) -> PyResult<PyErr> {
    let class = py.import("stickslip._errors")?.getattr(class)?;
    let exception = class.call1((message, kind))?;
    for (name, value) in fields {
        exception.setattr(name, value)?;
    }
    Ok(PyErr::from_value(exception))
}

fn made(result: PyResult<PyErr>) -> PyErr {
    result.unwrap_or_else(|error| error)
}

/// The exception of an error of a scene.
pub(crate) fn scene(py: Python<'_>, error: &SceneError) -> PyErr {
    match error {
        SceneError::Friction(violation) => return friction(py, violation),
        SceneError::State(violation) => return state_law(py, violation),
        SceneError::Kernel(cause) => return kernel(py, cause),
        SceneError::Start(cause) => return step(py, cause, error.to_string(), None),
        _ => {}
    }
    made((|| {
        let fields = variant!(py, error, SceneError {
            Length { what, expected, found },
            Value { what, requirement, position, value },
            Index { what, index, count },
            Unbalanced { vertex, slip_rate, missing },
            Unsupported { by, requirement },
            Vertex { what, vertex, requirement },
            BelowModes { frequency, first },
            ReducedStart { what, share },
            HeldApart { vertex, component, value },
        });
        let message = worded(error.to_string(), error.hint(), hint_of_scene(error));
        let argument = match error {
            SceneError::Value { what, .. } => argument_of(what),
            SceneError::Unbalanced { .. } => Some("slip_rate"),
            _ => None,
        };
        let message = match argument {
            Some(argument) => format!("{argument}: {message}"),
            None => message,
        };
        exception(py, "SceneError", message, fields)
    })())
}

/// The exception of a failed step.
pub(crate) fn failure(py: Python<'_>, failure: &StepFailure) -> PyErr {
    step(py, &failure.cause, failure.to_string(), Some(failure))
}

fn step(py: Python<'_>, cause: &StepError, message: String, at: Option<&StepFailure>) -> PyErr {
    made((|| {
        let (kind, mut fields) = variant!(py, cause, StepError {
            StepSize { dt },
            Unstable { dt, limit },
            State { vertex, slip_rate },
            Data { what, vertex, value },
            Law { what, vertex, slip_rate, state, value },
            Tension { vertex, normal_stress },
            PorePressure { vertex, pore_pressure, normal_stress },
            Field { field },
            Penetration { vertex, opening },
            NotContracting { vertex, contraction, iterations, dt },
            NormalStressEffect { vertex, from, to },
            Stage { vertex, slip_rate, state, evolution },
            StepTooSmall { dt, tolerance, resisted },
            TooManySteps { steps, dt },
            Control { what, requirement, value },
            Option { option },
            NotUnique { vertex, slip_rate, dt, shorter },
            NotCoupled { iterations, change, tolerance },
        });
        if let Some(failure) = at {
            fields.push(("step", failure.step.into_py_any(py)?));
            fields.push(("time", failure.time.into_py_any(py)?));
        }
        if let Some(place) = at.and_then(|failure| failure.place) {
            fields.push(("contact", place.contact.into_py_any(py)?));
            let point = place
                .point
                .map(|point| point[..place.dimension.min(3)].to_vec());
            fields.push(("point", point.into_py_any(py)?));
            let cell = place.cell.map(|cell| cell.to_vec());
            fields.push(("cell", cell.into_py_any(py)?));
        }
        let message = match cause {
            // Without inertia it has another hint, too.
            StepError::StepTooSmall { error, .. } => {
                worded(message, Some(error.hint()), Some(RTOL))
            }
            _ => worded(message, cause.hint(), hint_of_step(cause)),
        };
        exception(py, "StepError", message, (kind, fields))
    })())
}

/// The exception of a friction law that violates its contract.
pub(crate) fn friction(py: Python<'_>, error: &FrictionViolation) -> PyErr {
    made((|| {
        let fields = variant!(py, error, FrictionViolation {
            Value { what, requirement, state, slip_rate, value },
            CoefficientDecreases { state, slower, faster, at_slower, at_faster },
            Differs { what, requirement, state, slip_rate, found, expected },
            SlipRate { state, viscosity, drive, strength, slip_rate, expected },
        });
        exception(py, "FrictionLawError", error.to_string(), fields)
    })())
}

/// The exception of a state law that violates its contract.
pub(crate) fn state_law(py: Python<'_>, error: &StateLawViolation) -> PyErr {
    if let StateLawViolation::Refused(cause) = error {
        return state(py, cause);
    }
    made((|| {
        let fields = variant!(py, error, StateLawViolation {
            EvolutionNotANumber { state, slip_rate },
            EvolutionIncreases { lower, upper, slip_rate, at_lower, at_upper },
            Slope { requirement, state, slip_rate, slope, bound },
        });
        exception(py, "StateLawError", error.to_string(), fields)
    })())
}

/// The exception of a state law without a solution, or with a parameter out of its range.
pub(crate) fn state(py: Python<'_>, error: &StateError) -> PyErr {
    made((|| {
        let fields = variant!(py, error, StateError {
            Value { what, requirement, value },
            NoRoot { start, argument, value },
            Advance { from, slip_rate, dt, argument, value },
        });
        exception(py, "StateLawError", error.to_string(), fields)
    })())
}

/// The exception of a fault that cannot be built.
pub(crate) fn kernel(py: Python<'_>, error: &KernelError) -> PyErr {
    made((|| {
        let KernelError {
            what,
            cell,
            plane,
            requirement,
            bound,
            value,
            ..
        } = error;
        let fields = vec![
            ("what", what.into_py_any(py)?),
            ("cell", cell.into_py_any(py)?),
            ("plane", plane.into_py_any(py)?),
            ("requirement", requirement.into_py_any(py)?),
            ("bound", bound.into_py_any(py)?),
            ("value", value.into_py_any(py)?),
        ];
        let message = match argument_of(what) {
            Some(argument) => format!("{argument}: {error}"),
            None => error.to_string(),
        };
        exception(
            py,
            "FaultError",
            message,
            ("KernelError".to_owned(), fields),
        )
    })())
}

/// The exception of segments that make no fault.
pub(crate) fn segments(py: Python<'_>, error: &SegmentsError) -> PyErr {
    match error {
        SegmentsError::Value(cause) => kernel(py, cause),
        _ => fault(py, error, name(error)),
    }
}

/// The exception of triangles that make no fault, or of a file of them that cannot be read.
pub(crate) fn surface(py: Python<'_>, error: &SurfaceError) -> PyErr {
    match error {
        SurfaceError::Value(cause) => kernel(py, cause),
        SurfaceError::File { .. } => {
            let fields = (name(error), Attributes::new());
            made(exception(py, "MeshError", error.to_string(), fields))
        }
        _ => fault(py, error, name(error)),
    }
}

/// The exception of points off a fault at which displacement and stress cannot be had.
pub(crate) fn receivers(py: Python<'_>, error: &ReceiverError) -> PyErr {
    if let ReceiverError::Value(cause) = error {
        return kernel(py, cause);
    }
    made((|| {
        let fields = variant!(py, error, ReceiverError {
            NotFinite { receiver, value },
            AboveSurface { receiver, height },
            AtEdge { receiver, cell, distance, least },
            Memory { receivers, cells, bytes, limit },
        });
        exception(py, "FaultError", error.to_string(), fields)
    })())
}

fn fault(py: Python<'_>, error: &impl std::fmt::Display, kind: String) -> PyErr {
    let fields = (kind, Attributes::new());
    made(exception(py, "FaultError", error.to_string(), fields))
}

/// The exception of a file that is no mesh.
pub(crate) fn mesh_file(py: Python<'_>, path: &std::path::Path, error: &ReadError) -> PyErr {
    let fields = (name(error), Attributes::new());
    let message = format!("{}: {error}", path.display());
    made(exception(py, "MeshError", message, fields))
}

/// The exception of a file that cannot be read or written, or that is not in its format.
pub(crate) fn file(py: Python<'_>, error: &FileError) -> PyErr {
    match error {
        FileError::Scene(cause) => scene(py, cause),
        FileError::Read { source, .. } | FileError::Write { source, .. } => {
            std::io::Error::new(source.kind(), error.to_string()).into()
        }
        _ => made((|| {
            let fields = variant!(py, error, FileError {
                Line { path, line },
            });
            exception(py, "FileError", error.to_string(), fields)
        })()),
    }
}

/// The exception of a record that cannot be fitted.
pub(crate) fn lab(py: Python<'_>, error: &LabError) -> PyErr {
    let cause = match error {
        LabError::Record { cause, .. } => cause,
        _ => error,
    };
    made((|| {
        let fields = variant!(py, cause, LabError {
            Value { what, requirement, position, value },
            Length { what, expected, found },
            States { expected, found },
            TooFewSamples { samples, parameters },
            NoVelocityStep { velocity },
            Name { name },
            LawName { name },
            Unstable { time, stiffness },
            NoStart { starts },
            NotConverged { steps, offset },
        });
        exception(py, "FitError", error.to_string(), fields)
    })())
}
