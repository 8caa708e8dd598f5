//! Estimation of friction parameters from a measured velocity step.

use nalgebra::SVector;
use stickslip_friction::DieterichRuina;
use stickslip_state::{LogTheta, StateError, StateLaw};
use thiserror::Error;

use super::VelocityStep;
use super::least_squares::{Stuck, minimize};
use crate::contact::check::{finite, require};
use crate::{SceneError, StepFailure};

/// The increment of `ln a`, `ln b` and `ln L` in differences for the derivatives.
const DIFFERENCE: f64 = 1e-3;
/// `ln a`, `ln b`, `ln L`, `mu0`.
const PARAMETERS: usize = 4;

/// The result of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct VelocityStepFit {
    /// Friction with the best-fit parameters.
    pub friction: DieterichRuina,
    /// The standard errors of `a`, `b` and `L` relative to each, and that of `mu0`: for independent errors of the data
    /// with equal variance.
    pub standard_errors: [f64; PARAMETERS],
    /// The standard deviation of the residuals: the root of the sum of squares over the number of points minus 4.
    pub deviation: f64,
    /// The number of attempted steps.
    pub steps: usize,
}

/// The error of a velocity step's curve or fit.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum FitError {
    /// A parameter or a point of the data is out of its range, or there are not more points than parameters.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Slip instability: the spring is softer than critical for the given friction.
    #[error("slip instability, the stiffness is below critical: {0}")]
    Run(#[from] StepFailure),
    /// The parameters are not identifiable: the data do not depend on some combination of them.
    #[error("the parameters are not identifiable from the data: add displacements behind the step")]
    Singular,
    /// The fit did not converge to a minimum.
    #[error(
        "the fit is {distance:e} away from a minimum after {steps} steps: start with a larger characteristic slip distance"
    )]
    NotConverged {
        /// The number of attempted steps.
        steps: usize,
        /// The estimated distance to a minimum, in `ln a`, `ln b`, `ln L` and `mu0`.
        distance: f64,
    },
}

impl From<StateError> for FitError {
    fn from(error: StateError) -> Self {
        Self::Scene(error.into())
    }
}

impl VelocityStep {
    /// The least-squares estimate of `a`, `b`, `L` and `mu0` from `data`, pairs of the displacement of the load point
    /// \[m\] and the coefficient of friction.
    ///
    /// The stiffness and the reference velocity of `start` are fixed. The method of Levenberg and Marquardt varies `ln
    /// a`, `ln b`, `ln L` and `mu0` from there. The data require points before the step or long after it, which
    /// determine `mu0`, and enough points after the step to resolve its peak and its decay. The spring must be stiffer
    /// than critical at `start`, [`SpringSlider::critical_stiffness`](super::SpringSlider::critical_stiffness): near
    /// the critical stiffness the curves oscillate, and the sum of squares has many minima. Prefer an initial
    /// characteristic slip distance that is too large.
    ///
    /// # Errors
    /// [`FitError::Scene`] for less than 5 points, for values that are not finite and for `a`, `b` or `L` that is not
    /// positive; [`FitError::Run`] for a slip instability at the start; [`FitError::Singular`] and
    /// [`FitError::NotConverged`].
    pub fn fit<S: StateLaw<State = LogTheta> + 'static>(
        &self,
        data: &[(f64, f64)],
        start: &DieterichRuina,
        state_law: impl Fn(&DieterichRuina) -> S,
    ) -> Result<VelocityStepFit, FitError> {
        let points = data.len();
        let enough = points > PARAMETERS;
        require("number of points", "at least 5", 0, points as f64, enough)?;
        for (position, &(_, mu)) in data.iter().enumerate() {
            finite("friction coefficient", position, mu)?;
        }
        let DieterichRuina {
            a,
            b,
            slip_distance,
            reference_friction,
            ..
        } = *start;
        for (what, value) in [("a", a), ("b", b), ("slip distance", slip_distance)] {
            require(what, "positive", 0, value, value > 0.0)?;
        }

        let friction = |p: &SVector<f64, PARAMETERS>| DieterichRuina {
            a: p[0].exp(),
            b: p[1].exp(),
            slip_distance: p[2].exp(),
            reference_friction: p[3],
            ..*start
        };
        let residuals = |p: &SVector<f64, PARAMETERS>| -> Result<Vec<f64>, FitError> {
            let displacements = data.iter().map(|&(x, _)| x);
            let curve = self.curve(&friction(p), &state_law, displacements)?;
            Ok((curve.iter().zip(data))
                .map(|(at, measured)| at.1 - measured.1)
                .collect())
        };
        let derivatives =
            |p: &SVector<f64, PARAMETERS>| -> Result<[Vec<f64>; PARAMETERS], FitError> {
                // Friction is mu0 and what does not depend on it.
                let mut columns = std::array::from_fn(|_| vec![1.0; data.len()]);
                for (k, column) in columns.iter_mut().enumerate().take(PARAMETERS - 1) {
                    let (mut more, mut less) = (*p, *p);
                    more[k] += DIFFERENCE;
                    less[k] -= DIFFERENCE;
                    let (more, less) = (residuals(&more)?, residuals(&less)?);
                    for (value, (more, less)) in column.iter_mut().zip(more.iter().zip(less)) {
                        *value = (more - less) / (2.0 * DIFFERENCE);
                    }
                }
                Ok(columns)
            };
        let start = SVector::from([a.ln(), b.ln(), slip_distance.ln(), reference_friction]);
        let minimum = minimize(start, residuals, derivatives).map_err(|stuck| match stuck {
            Stuck::Model(error) => error,
            Stuck::Singular => FitError::Singular,
            Stuck::NotConverged { steps, distance } => FitError::NotConverged { steps, distance },
        })?;
        let deviation = (minimum.squares / (data.len() - PARAMETERS) as f64).sqrt();
        Ok(VelocityStepFit {
            friction: friction(&minimum.parameters),
            standard_errors: std::array::from_fn(|k| deviation * minimum.inverse[(k, k)].sqrt()),
            deviation,
            steps: minimum.steps,
        })
    }
}
