//! Parameters that the data do not determine.

use std::fmt;

use crate::fitted::{Fitted, rounded};
use crate::levels;
use crate::model::Model;
use crate::parameters::Parameter;
use crate::score::Tests;

/// The difference of criteria (AIC) that is evidence, by a factor of `exp(5)`. Source: K. P. Burnham, D. R. Anderson,
/// *Model Selection and Multimodel Inference* (2002), Sec. 2.6.
const EVIDENCE: f64 = 10.0;

/// The relative offset of a flat valley: a tenth of a standard error.
const VALLEY: f64 = 0.1;

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
    /// A parameter is at a bound, where the sum of squares is not stationary.
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
            Self::AtBound { parameter, bound } => {
                write!(f, "{parameter} is at its bound {bound:.3e}")
            }
        }
    }
}

/// The warnings of a fit.
pub(crate) fn warnings(
    fitted: &Fitted,
    model: &Model<'_>,
    values: &[f64],
    bounds: &[(f64, f64)],
    tests: &Tests,
) -> Vec<Warning> {
    let parameters = &fitted.parameters;
    let mut warnings = Vec::new();
    for (k, estimate) in fitted.estimates.iter().enumerate() {
        let scale = match estimate.parameter {
            Parameter::A | Parameter::SlipDistance(_) | Parameter::Stiffness => estimate.value,
            Parameter::B(_) => parameters.a,
            _ => continue,
        };
        let parameter = estimate.parameter;
        let effect = match parameter {
            Parameter::SlipDistance(i) => {
                let b = Parameter::B(i);
                fitted.value(b).abs() >= 2.0 * fitted.standard_error(b)
            }
            _ => true,
        };
        // Also of an error that is not a number.
        let determined = 2.0 * estimate.standard_error <= scale && effect;
        if !determined {
            warnings.push(Warning::NotDetermined {
                parameter,
                standard_error: estimate.standard_error,
            });
        }
        if values[k] <= bounds[k].0 || values[k] >= bounds[k].1 {
            warnings.push(Warning::AtBound {
                parameter,
                bound: estimate.value,
            });
        }
    }
    let relative = fitted.standard_error(Parameter::A) / parameters.a;
    let (difference, error) = fitted.a_minus_b;
    let vague = relative > 0.1 && error < 0.1 * relative * parameters.a;
    if vague || levels::aic(model).is_some_and(|aic| aic < fitted.aic + EVIDENCE) {
        warnings.push(Warning::OnlyDifference {
            a_minus_b: difference,
            standard_error: error,
        });
    }
    let slip_distances = || parameters.states.iter().map(|state| state.slip_distance);
    let (least, most) = slip_distances().fold((f64::INFINITY, 0.0_f64), |(least, most), length| {
        (least.min(length), most.max(length))
    });
    let relaxation = parameters.a / parameters.stiffness;
    if relative > 0.1 && relaxation > least {
        warnings.push(Warning::SoftMachine {
            relaxation,
            slip_distance: least,
        });
    }
    let times = model.record.times();
    let (first, last) = (times[0], times[times.len() - 1]);
    let mut ends: Vec<f64> = vec![first];
    ends.extend(model.load.changes(first, last).map(|(time, _)| time));
    ends.push(last);
    let longest = ends[1..]
        .windows(2)
        .map(|pair| model.load.displacement(pair[1]) - model.load.displacement(pair[0]));
    let longest = longest.fold(0.0, f64::max);
    if longest < 3.0 * most {
        warnings.push(Warning::ShortStep {
            displacement: longest,
            slip_distance: most,
        });
    }
    if fitted.offset > VALLEY {
        warnings.push(Warning::FlatValley {
            offset: fitted.offset,
        });
    }
    if let Some(score) = tests
        .step_offset
        .as_ref()
        .filter(|score| score.evidence > EVIDENCE)
    {
        let (offset, standard_error) = score.estimates[0];
        warnings.push(Warning::StepTime {
            offset,
            standard_error,
        });
    }
    let critical = parameters.critical_stiffness();
    if parameters.stiffness < critical {
        warnings.push(Warning::BelowCritical {
            stiffness: parameters.stiffness,
            critical,
        });
    }
    warnings
}
