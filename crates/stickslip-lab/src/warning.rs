//! Reasons to distrust a fit.

use std::fmt;

use crate::parameter::Parameter;
use crate::rounded::rounded;

/// A reason to distrust a fitted parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// Two standard errors exceed the value, or `a` for a `b`; or the parameter is the `L` of a `b` that does not differ
    /// from 0 by two standard errors.
    NotDetermined {
        /// The parameter.
        parameter: Parameter,
        /// Its standard error, in its unit.
        standard_error: f64,
    },
    /// The data determine `a - b` ten times as well as `a`, which has a relative standard error above 0.1; or steady
    /// levels alone have a criterion (AIC) that exceeds that of the fit by less than 10, so that chance explains the rest.
    OnlyDifference {
        /// `a - sum b_i`.
        a_minus_b: f64,
        /// Its standard error.
        standard_error: f64,
    },
    /// The machine is so soft that the direct effect relaxes over more slip than the state: `a/k > L`, and `a` has a
    /// relative standard error above 0.1.
    SoftMachine {
        /// `a/k` \[m\].
        relaxation: f64,
        /// The smallest `L` \[m\].
        slip_distance: f64,
    },
    /// All pieces of constant velocity are shorter than three times `L`, after which a twentieth of the evolution
    /// effect remains.
    ShortStep {
        /// The displacement of the load point over the longest piece \[m\].
        displacement: f64,
        /// `L` \[m\].
        slip_distance: f64,
    },
    /// Steady sliding is unstable on this machine: records of it oscillate.
    BelowCritical {
        /// `K/sigma_n` [1/m].
        stiffness: f64,
        /// The critical one [1/m].
        critical: f64,
    },
    /// The iteration ended in a flat valley, where further steps lower the sum of squares by less than a standard error
    /// does: other parameters fit as well.
    FlatValley {
        /// The relative offset: the distance to the minimum of the linear model over the radius of its confidence region.
        offset: f64,
    },
    /// Residuals peak behind the velocity steps: with the steps at another time the criterion (AIC) would be lower by more
    /// than 10. The times of the load history are wrong, or the state law is another one.
    StepTime {
        /// The time by which the steps seem to be later than the load history says \[s\], in the linear approximation.
        offset: f64,
        /// Its standard error \[s\].
        standard_error: f64,
    },
    /// The residuals of neighbouring samples have a correlation above 0.3 and its two standard errors: of noise with a memory, of a filter, or of a model
    /// that does not fit. The standard errors are those of such residuals.
    CorrelatedResiduals {
        /// The correlation.
        correlation: f64,
        /// The number of independent samples that determine a mean as well.
        samples: f64,
    },
    /// Samples are far beside their neighbours ([`Fitted::spikes`](crate::Fitted::spikes)): errors of the data, or peaks at
    /// steps that the law does not have.
    Spikes {
        /// Their number.
        count: usize,
        /// The time of the first one \[s\].
        first: f64,
        /// Data minus model of the one that is farthest off.
        largest: f64,
    },
    /// The record begins in a transient: with a free beginning the criterion (AIC) would be lower by more than 10.
    Transient {
        /// The fall of the criterion, in the linear approximation.
        aic: f64,
    },
    /// `L` is determined, and ten times beyond the laboratory's experience, 1 to 100 um: are displacements and velocities in metres? The data
    /// cannot tell: with lengths in another unit the same curve has `L`, `1/k` and velocities in that unit. Source: C. Marone,
    /// "Laboratory-derived friction laws and their application to seismic faulting", Annu. Rev. Earth Planet. Sci. 26 (1998).
    Unit {
        /// The parameter.
        parameter: Parameter,
        /// `L` \[m\].
        slip_distance: f64,
        /// The fastest velocity of the load point [m/s].
        velocity: f64,
    },
    /// The fit was interrupted: its parameters are the best so far.
    Interrupted {
        /// The number of attempted steps.
        steps: usize,
        /// The relative offset: the distance to the minimum of the linear model over the radius of its confidence region;
        /// infinite if it is not known.
        offset: f64,
    },
    /// A parameter, of any kind, is at a bound, where the sum of squares is not stationary.
    AtBound {
        /// The parameter.
        parameter: Parameter,
        /// Its value.
        bound: f64,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotDetermined {
                parameter,
                standard_error,
            } => write!(
                f,
                "{parameter} is not determined by the data (standard error {standard_error:.1e}): fix it, or add data"
            ),
            Self::OnlyDifference {
                a_minus_b,
                standard_error,
            } => write!(
                f,
                "only a - b = {} is in the data: sample the transient more densely",
                rounded(a_minus_b, standard_error)
            ),
            Self::SoftMachine {
                relaxation,
                slip_distance,
            } => write!(
                f,
                "the machine is soft: the direct effect relaxes over a/k = {relaxation:.1e} m, L is {slip_distance:.1e} m"
            ),
            Self::ShortStep {
                displacement,
                slip_distance,
            } => write!(
                f,
                "the steps are short: {displacement:.1e} m of load-point displacement, L is {slip_distance:.1e} m"
            ),
            Self::BelowCritical {
                stiffness,
                critical,
            } => write!(
                f,
                "the stiffness {stiffness:.3e} 1/m is below critical, {critical:.3e} 1/m: steady sliding is unstable"
            ),
            Self::FlatValley { offset } => write!(
                f,
                "the minimum is flat (relative offset {offset:.1e}): fix a parameter, or add data"
            ),
            Self::StepTime {
                offset,
                standard_error,
            } => write!(
                f,
                "the residuals peak behind the steps, as if these were {} s later: check their times, fit the step offset, or try another law",
                rounded(offset, standard_error)
            ),
            Self::CorrelatedResiduals {
                correlation,
                samples,
            } => write!(
                f,
                "the residuals of neighbours have a correlation of {correlation:.2}: the standard errors are for correlated residuals, worth {samples:.0} samples"
            ),
            Self::Spikes {
                count: 1,
                first,
                largest,
            } => write!(
                f,
                "a spike of {largest:.1e} at {first} s: drop it, use Huber's loss, or try another law if it is at a step"
            ),
            Self::Spikes {
                count,
                first,
                largest,
            } => write!(
                f,
                "{count} spikes, the first at {first} s, the largest {largest:.1e}: drop them, use Huber's loss, or try another law if they are at steps"
            ),
            Self::Transient { aic } => write!(
                f,
                "the record begins in a transient (AIC lower by {aic:.0} with a free beginning): free the initial state, or begin in steady sliding"
            ),
            Self::Unit {
                parameter,
                slip_distance,
                velocity,
            } => write!(
                f,
                "{parameter} = {slip_distance:.2e} m is far from laboratory experience, 1e-6 to 1e-4 m (Marone 1998), and the load point slides at up to {velocity:.2e} m/s: check that displacements and velocities are in metres"
            ),
            Self::Interrupted { steps, offset } if offset.is_finite() => write!(
                f,
                "the fit was interrupted after {steps} steps, {offset:.1e} standard errors from a minimum: run it again for the parameters of the minimum"
            ),
            Self::Interrupted { steps, .. } => write!(
                f,
                "the fit was interrupted after {steps} steps, in the choice of a start: run it again for the parameters of the minimum"
            ),
            Self::AtBound { parameter, bound } => {
                write!(f, "{parameter} is at its bound {bound:.3e}")
            }
        }
    }
}
