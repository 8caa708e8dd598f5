//! The method of Levenberg and Marquardt within bounds.

use nalgebra::DVector;

use crate::error::LabError;
use crate::normal::{Linearised, Normal};

/// The least factor on the damping after a successful step, and its factors after the first, second, .. unsuccessful
/// one: `RAISE`, its square, ..
const RELIEF: f64 = 0.1;
const RAISE: f64 = 2.0;
/// The longest step in a parameter: the linear model of a logarithm holds over a factor of e at most.
const LONGEST: f64 = 1.0;
/// The decrease of the sum of squares over the variance, a thirtieth of a standard error squared, which ends the
/// iteration if so many steps in turn do not exceed it: in a flat valley.
const STALLED: f64 = 1e-3;
const STALLED_STEPS: usize = 3;
/// The damping beyond which a step does not change a parameter.
const ENDLESS: f64 = 1.0 / f64::EPSILON;

/// The end of an iteration.
#[derive(Clone, Copy)]
pub(crate) struct Stop {
    /// The relative offset that ends it: the distance to the minimum of the linear model over the radius of its
    /// confidence region.
    pub(crate) offset: f64,
    /// The root mean square change of the residuals by a further step that ends it.
    pub(crate) change: f64,
    /// The maximum number of steps, successful or not.
    pub(crate) steps: usize,
    /// The damping at the start, relative to the diagonal of the normal equations.
    pub(crate) damping: f64,
}

/// The last point of an iteration.
#[derive(Clone)]
pub(crate) struct Minimum {
    pub(crate) parameters: Vec<f64>,
    pub(crate) residual: DVector<f64>,
    /// The number of attempted steps.
    pub(crate) steps: usize,
    /// The relative offset there; 0 where a further step would change the residuals by less than [`Stop::change`].
    pub(crate) offset: f64,
    /// Whether a further step would change the residuals by less than [`Stop::change`], no step lowers their sum of
    /// squares, several steps have lowered it by less than [`STALLED`], or the second half of all steps by less than the
    /// variance, a standard error.
    pub(crate) flat: bool,
    /// The damping of the next step.
    pub(crate) damping: f64,
    /// The residuals and derivatives there, of an iteration that was interrupted.
    pub(crate) linearised: Option<Linearised>,
}

impl Minimum {
    /// A start, of which no residuals are known.
    pub(crate) fn at_start(parameters: Vec<f64>) -> Self {
        Self {
            parameters,
            residual: DVector::zeros(0),
            steps: 0,
            offset: f64::INFINITY,
            flat: false,
            damping: 0.0,
            linearised: None,
        }
    }
}

/// Minimises the sum of the squares of the residuals from `start`, with each parameter in its bounds.
///
/// A step solves `(J^T J + lambda D) d = -J^T r`, where `D` is the largest diagonal of `J^T J` so far, and `lambda`
/// falls after successful steps. A step to parameters without residuals is unsuccessful. A parameter at a bound, with a
/// slope of the sum of squares that points out of it, stays there. With `N` residuals `r` and `P` parameters the
/// relative offset is `(|J d|^2/P / (|r|^2/(N - P)))^(1/2)` of the step `d` with `lambda = 0`. Sources: D. Marquardt,
/// "An algorithm for least-squares estimation of nonlinear parameters", J. SIAM 11 (1963); J. Moré, "The
/// Levenberg-Marquardt algorithm", Numerical Analysis (1978); D. Bates, D. Watts, "A relative offset orthogonality
/// convergence criterion for nonlinear least squares", Technometrics 23 (1981).
///
/// An iteration that is interrupted ends where it is.
///
/// # Errors
/// That of the residuals at the start.
pub(crate) fn minimize(
    start: Vec<f64>,
    bounds: &[(f64, f64)],
    stop: Stop,
    mut evaluate: impl FnMut(&[f64]) -> Result<Linearised, LabError>,
) -> Result<Minimum, LabError> {
    let mut parameters = start;
    for (value, &(low, high)) in parameters.iter_mut().zip(bounds) {
        *value = value.clamp(low, high);
    }
    let mut at = evaluate(&parameters)?;
    let mut damping = stop.damping;
    let mut largest = DVector::zeros(parameters.len());
    let (mut steps, mut stalled) = (0, 0);
    let mut halfway = f64::INFINITY;
    loop {
        let normal = Normal::new(&at);
        largest = normal.matrix.diagonal().sup(&largest);
        let free: Vec<bool> = (bounds.iter().enumerate())
            .map(|(i, &(low, high))| {
                let (value, slope) = (parameters[i], normal.gradient[i]);
                !(value <= low && slope >= 0.0 || value >= high && slope <= 0.0)
            })
            .collect();
        let squares = at.0.norm_squared();
        let (samples, count) = (at.0.len() as f64, parameters.len() as f64);
        let moved = if free.iter().all(|free| *free) {
            normal.removable()
        } else {
            normal.with(&free).removable()
        };
        let offset = (moved / count / (squares / (samples - count))).sqrt();
        let exact = moved <= stop.change * stop.change * samples;
        let minimum = |at: Linearised, parameters, steps, damping, flat| Minimum {
            parameters,
            residual: at.0,
            steps,
            offset: if exact { 0.0 } else { offset },
            flat,
            damping,
            linearised: None,
        };
        let flat = exact || stalled >= STALLED_STEPS;
        if offset <= stop.offset || flat {
            return Ok(minimum(at, parameters, steps, damping, flat));
        }
        let mut raise = RAISE;
        loop {
            if steps >= stop.steps {
                let flat = halfway - squares < squares / (samples - count);
                return Ok(minimum(at, parameters, steps, damping, flat));
            }
            if 2 * steps <= stop.steps {
                halfway = squares;
            }
            steps += 1;
            let mut interrupted = false;
            let trial = normal.step(damping, &largest, &free).and_then(|mut step| {
                if step.amax() > LONGEST {
                    step *= LONGEST / step.amax();
                }
                let to = (parameters.iter().zip(bounds).zip(&step))
                    .map(|((value, &(low, high)), step)| (value + step).clamp(low, high));
                let to: Vec<f64> = to.collect();
                let there = evaluate(&to);
                interrupted = matches!(there, Err(LabError::Interrupted));
                let there = there.ok()?;
                let less = squares - there.0.norm_squared();
                let expected =
                    -2.0 * normal.gradient.dot(&step) - step.dot(&(&normal.matrix * &step));
                (less > 0.0).then_some((to, there, less, less / expected))
            });
            if let Some((to, there, less, gain)) = trial {
                let little = less < STALLED * squares / (samples - count);
                stalled = if little { stalled + 1 } else { 0 };
                (parameters, at) = (to, there);
                damping *= (1.0 - (2.0 * gain - 1.0).powi(3)).max(RELIEF);
                break;
            }
            if interrupted {
                let here = Some(at.clone());
                return Ok(Minimum {
                    linearised: here,
                    ..minimum(at, parameters, steps, damping, false)
                });
            }
            damping *= raise;
            raise *= RAISE;
            if damping > ENDLESS {
                return Ok(minimum(at, parameters, steps, stop.damping, true));
            }
        }
    }
}
