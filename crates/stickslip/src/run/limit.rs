//! The local error of a step in its parts, the largest of which limits the step.

use std::fmt;

use crate::StepError;
use crate::step::reduction::largest;

/// The estimated local error of a step, see [`ErrorControl`](crate::ErrorControl): what
/// [`Stepper::step_estimated`](crate::Stepper::step_estimated) returns, and what [`StepError`](crate::StepError) tells of a run
/// that gives up.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LocalError {
    /// Of the slip rates; where, and the slip rate there [m/s].
    pub slip_rate: VertexError,
    /// Of the states; where, and the state there.
    pub state: VertexError,
    /// Of the motion of the body, times its weight.
    pub motion: f64,
}

/// The largest error over the vertices of contacts.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct VertexError {
    /// The error.
    pub error: f64,
    /// The vertex that has it.
    pub vertex: usize,
    /// What has it there.
    pub value: f64,
}

/// What a local error is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorOf {
    /// A slip rate.
    SlipRate,
    /// A state.
    State,
    /// The motion of the body.
    Motion,
}

/// What limits the steps of a run.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Limit {
    /// The local error, the largest of the last steps.
    Error(LocalError),
    /// The largest step that the plan allows \[s\].
    LargestStep(f64),
    /// The largest step that an explicit scheme bears \[s\].
    Stability(f64),
    /// Most steps fail, the last one so.
    Failure(Box<StepError>),
}

impl VertexError {
    /// Takes the error of another vertex if it is larger; what is no number is larger than all.
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
    /// The largest of the errors; not a number if one of them is none.
    pub fn largest(&self) -> f64 {
        largest([self.slip_rate.error, self.state.error, self.motion].into_iter())
    }

    /// What has the largest error.
    pub fn largest_of(&self) -> ErrorOf {
        let largest = self.largest();
        let has = |error: f64| error.is_nan() || error == largest;
        if has(self.slip_rate.error) {
            ErrorOf::SlipRate
        } else if has(self.state.error) {
            ErrorOf::State
        } else {
            ErrorOf::Motion
        }
    }

    /// All errors times `share`.
    pub(crate) fn scaled(mut self, share: f64) -> Self {
        self.slip_rate.error *= share;
        self.state.error *= share;
        self.motion *= share;
        self
    }
}

/// What has the largest error, and the errors beside it, in one line.
impl fmt::Display for LocalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            slip_rate,
            state,
            motion,
        } = self;
        match self.largest_of() {
            ErrorOf::SlipRate => write!(
                f,
                "the slip rate {:.3e} m/s at vertex {}",
                slip_rate.value, slip_rate.vertex
            )?,
            ErrorOf::State => write!(
                f,
                "the state {:.6e} at vertex {}",
                state.value, state.vertex
            )?,
            ErrorOf::Motion => write!(f, "the motion of the body")?,
        }
        write!(
            f,
            " (local errors: slip rate {:.1e}, state {:.1e}, motion {motion:.1e})",
            slip_rate.error, state.error
        )
    }
}

/// What limits the steps, and what may be done about it, in one line.
impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Error(error) => {
                let remedy = match error.largest_of() {
                    ErrorOf::SlipRate => {
                        "a looser tolerance may do, or ErrorControl::rest for slip rates that are none"
                    }
                    ErrorOf::State => "a looser tolerance may do",
                    ErrorOf::Motion => {
                        "a looser tolerance may do, or ErrorControl::motion below 1 with a scheme that damps waves"
                    }
                };
                write!(f, "{error}: {remedy}")
            }
            Self::LargestStep(dt) => write!(f, "the largest step allowed, {dt:.3e} s"),
            Self::Stability(dt) => write!(
                f,
                "the stability of the scheme, {dt:.3e} s: an implicit one may do"
            ),
            Self::Failure(cause) => write!(f, "steps that fail: {cause}"),
        }
    }
}
