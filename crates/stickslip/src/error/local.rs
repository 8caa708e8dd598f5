//! The parts of the local error of a step; the largest limits the step.

use std::fmt;

use crate::sums::largest;

/// The estimated local error of a step, see [`ErrorControl`](crate::ErrorControl).
/// [`Stepper::step_estimated`](crate::integrate::Stepper::step_estimated) returns it, and
/// [`StepError`](crate::StepError) contains it when a run stalls.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct LocalError {
    /// The error of the slip rates, with its vertex and the slip rate there [m/s].
    pub slip_rate: VertexError,
    /// The error of the states, with its vertex and the state there.
    pub state: VertexError,
    /// The error of the slip of contacts without control of the slip rate, with its vertex and the slip there \[m\].
    pub slip: VertexError,
    /// The error of the displacement of an unconstrained body, with its vertex and its modulus there \[m\].
    pub displacement: VertexError,
    /// The error of the motion of the body, times its weight.
    pub motion: f64,
}

/// The largest error over the vertices of contacts.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct VertexError {
    /// The error.
    pub error: f64,
    /// The vertex with this error.
    pub vertex: usize,
    /// The value of the quantity there.
    pub value: f64,
}

/// The quantity of a local error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorOf {
    /// A slip rate.
    SlipRate,
    /// A state.
    State,
    /// A slip.
    Slip,
    /// The displacement of an unconstrained body.
    Displacement,
    /// The motion of the body.
    Motion,
}

/// The quantity that limits the steps of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Limit {
    /// The local error of the last step.
    Error(LocalError),
    /// The largest step that the plan allows \[s\].
    LargestStep(f64),
    /// The largest stable step of an explicit scheme \[s\].
    Stability(f64),
}

impl VertexError {
    /// Takes the error of another vertex if it is larger; NaN exceeds all numbers.
    #[inline]
    pub(crate) fn raise(&mut self, error: f64, vertex: usize, value: impl FnOnce() -> f64) {
        if error <= self.error || self.error.is_nan() {
            return;
        }
        let value = value();
        *self = Self {
            error,
            vertex,
            value,
        };
    }
}

impl LocalError {
    fn parts(&self) -> [(ErrorOf, f64); 5] {
        [
            (ErrorOf::SlipRate, self.slip_rate.error),
            (ErrorOf::State, self.state.error),
            (ErrorOf::Slip, self.slip.error),
            (ErrorOf::Displacement, self.displacement.error),
            (ErrorOf::Motion, self.motion),
        ]
    }

    /// The largest of the errors; NaN if one of them is.
    pub fn largest(&self) -> f64 {
        let of = self.largest_of();
        let mut parts = self.parts().into_iter();
        parts.find(|part| part.0 == of).map_or(0.0, |part| part.1)
    }

    /// The quantity with the largest error.
    pub fn largest_of(&self) -> ErrorOf {
        let first = (ErrorOf::SlipRate, self.slip_rate.error);
        let larger = |a: (ErrorOf, f64), b: (ErrorOf, f64)| {
            if a.1.is_nan() || a.1 >= b.1 { a } else { b }
        };
        self.parts().into_iter().fold(first, larger).0
    }

    /// The vertex of the largest error; none for the motion of the body.
    pub fn vertex(&self) -> Option<usize> {
        let at = match self.largest_of() {
            ErrorOf::SlipRate => self.slip_rate,
            ErrorOf::State => self.state,
            ErrorOf::Slip => self.slip,
            ErrorOf::Displacement => self.displacement,
            ErrorOf::Motion => return None,
        };
        Some(at.vertex)
    }

    /// The larger of both errors of each quantity; of equal ones that of `self`.
    pub(crate) fn larger(mut self, other: Self) -> Self {
        for (error, other) in [
            (&mut self.slip_rate, other.slip_rate),
            (&mut self.state, other.state),
            (&mut self.slip, other.slip),
            (&mut self.displacement, other.displacement),
        ] {
            error.raise(other.error, other.vertex, || other.value);
        }
        self.motion = largest([self.motion, other.motion].into_iter());
        self
    }

    /// All errors times `share`.
    pub(crate) fn scaled(mut self, share: f64) -> Self {
        for vertex in [
            &mut self.slip_rate,
            &mut self.state,
            &mut self.slip,
            &mut self.displacement,
        ] {
            vertex.error *= share;
        }
        self.motion *= share;
        self
    }
}

/// The quantity with the largest error, its place and its size, in one line.
impl fmt::Display for LocalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = self.largest_of();
        let (name, unit, at) = match of {
            ErrorOf::SlipRate => ("slip rate", " m/s", self.slip_rate),
            ErrorOf::State => ("state", "", self.state),
            ErrorOf::Slip => ("slip", " m", self.slip),
            ErrorOf::Displacement => ("displacement", " m", self.displacement),
            ErrorOf::Motion => {
                return write!(
                    f,
                    "the motion of the body (local error {:.1e})",
                    self.motion
                );
            }
        };
        let VertexError {
            error,
            vertex,
            value,
        } = at;
        write!(
            f,
            "the {name} {value:.3e}{unit} at vertex {vertex} (local error {error:.1e})"
        )
    }
}

/// The limit of the steps and a remedy, in one line.
impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Error(error) => write!(f, "{error}: {}", error.hint()),
            Self::LargestStep(dt) => write!(f, "the largest step allowed, {dt:.3e} s"),
            Self::Stability(dt) => {
                let hint = super::hint::IMPLICIT;
                write!(f, "the stability of the scheme, {dt:.3e} s: {hint}")
            }
        }
    }
}
