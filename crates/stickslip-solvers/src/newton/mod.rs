//! The nonsmooth Newton method, for sparse and for dense quadratic parts.

mod line_search;
mod models;
mod system;

use models::Trust;
pub(crate) use models::{Friction, Models};
pub(crate) use system::{Aim, Step, System};

use nalgebra::SVector;

use crate::SolveError;
use crate::progress::Progress;
use line_search::{Line, search};

/// The number of successive steps, each as long as the body's stiffness and the added share allow, after which friction
/// is taken not to arrest a motion.
const ADRIFT: usize = 5;

/// The ratio of the squares of successive whole steps up to which Newton's method continues without a sweep. With a
/// sweep in each iteration a minimisation over a contact that slips takes 1.35 to 1.5 times as long (bench `condensed`).
const SHRINKING: f64 = 0.25;

/// The number of iterations over which stall detection judges progress, and the largest number of such windows.
const WINDOW: usize = 50;
const WINDOWS: f64 = 40.0;

/// The end of an iteration.
pub(crate) struct Ending {
    pub(crate) iterations: usize,
    /// The estimated remaining error in the stopping norm.
    pub(crate) error: f64,
}

/// Moves `v` to the minimiser. One iteration:
///
/// 1. a nonlinear block Gauss-Seidel sweep, each local problem solved exactly;
/// 2. truncation: the components in which the potentials are twice differentiable, with a curvature below
///    `ratio` times the diagonal of the quadratic part, here and as far away as the last iteration moved or the
///    tolerance
///    resolves, stay unknowns;
/// 3. a linear step for the Newton system on these;
/// 4. projection of the direction to where the second-order models hold;
/// 5. a line search, by which the energy never grows.
///
/// The first part alone converges, so the whole does from every start. Where vertices that are stiff among themselves
/// slide back together, the projection of one of them spoils the direction of all, and the sweeps are slow: an iteration
/// that has stalled goes on with directions that are not projected, past the kinks of friction and up to the bounds of
/// gaps. If all potentials are smooth and each step is
/// whole and far shorter than the one before, a system may skip the first two.
pub(crate) fn minimize<S: System<C>, const C: usize>(
    system: &mut S,
    models: &mut Models<C>,
    friction: &Friction<'_, C>,
    ratio: f64,
    max_iterations: usize,
    v: &mut [SVector<f64, C>],
) -> Result<Ending, SolveError> {
    let (mut iterations, mut change, mut adrift) = (0, f64::INFINITY, 0);
    let mut progress = Progress::new(WINDOW, WINDOWS);
    let (mut taken, mut passes_kinks) = (f64::INFINITY, false);
    let mut smooth = system.begin(v) && models.keep_all(friction, v);
    while iterations < max_iterations {
        iterations += 1;
        // Where the energy is not convex, a sweep leads on.
        let linear = smooth && system.linearize(models, iterations).is_ok();
        let swept = !linear || models.loose.is_some();
        if swept {
            system.sweep(v);
            let change = if change.is_finite() {
                change
            } else {
                system.tolerance()
            };
            // The least that the energy norm may have moved: nothing where it says nothing about the stopping norm.
            let moved = change / system.equivalence().sqrt();
            let scales = system.scales();
            models.truncate(friction, v, move |k| {
                let scale = scales(k);
                Trust {
                    curvature: ratio * scale,
                    distance: moved / scale.sqrt(),
                }
            });
            system.linearize(models, iterations)?;
        }
        let mut aim = system.aim(models, v);
        loop {
            let step = follow(system, models, friction, v, (aim, passes_kinks));
            // A step of zero, as in a body at rest, says nothing: a sweep does.
            smooth = step.whole && step.taken > 0.0 && step.taken <= SHRINKING * taken;
            taken = step.taken;
            if let Some(error) = system.settled(models, v, &step)? {
                return Ok(Ending { iterations, error });
            }
            adrift = match models.loose {
                Some(_) if step.full => adrift + 1,
                _ => 0,
            };
            match system.again(&step) {
                Some(next) if iterations < max_iterations => aim = next,
                _ => break,
            }
            iterations += 1;
        }
        if swept {
            // Where kinks are never left behind, as in a body at rest, only the change tells.
            change = system.moved(v);
            if !change.is_finite() {
                return Err(SolveError::NotFinite {
                    iteration: iterations,
                    change,
                });
            }
            let headway = progress.goes_on(change, system.tolerance());
            if change <= system.tolerance() || !headway && system.is_exhausted(models, v) {
                let error = change;
                return Ok(Ending { iterations, error });
            }
            if let Some(vertex) = models.loose.filter(|_| adrift >= ADRIFT) {
                return Err(SolveError::NoEquilibrium {
                    vertex,
                    iterations,
                    change,
                });
            }
            if !headway {
                if passes_kinks {
                    break;
                }
                passes_kinks = true;
                progress = Progress::new(WINDOW, WINDOWS);
            }
        }
        smooth = smooth && system.begin(v) && models.move_on();
    }
    Err(SolveError::NotConverged {
        iterations,
        change,
        tolerance: system.tolerance(),
    })
}

/// Projection, or shortening to where the energy is finite, line search and the move itself.
fn follow<S: System<C>, const C: usize>(
    system: &mut S,
    models: &mut Models<C>,
    friction: &Friction<'_, C>,
    v: &mut [SVector<f64, C>],
    (mut aim, passes_kinks): (Aim, bool),
) -> Step {
    let still = aim.decrease == 0.0;
    let projected = match passes_kinks {
        false => models.project(friction, v, system.direction()),
        true => shorten(friction, v, system.direction()),
    };
    if projected {
        aim = system.slopes(models, v);
    }
    // Nearly always the whole step is taken: its slope comes from the gradients needed next.
    let direction = &*system.direction();
    let ahead = models.differentiate(friction, v, direction, 1.0);
    let line = Line {
        friction,
        from: v,
        along: direction,
        aim,
        models,
    };
    let slope = aim.curvature - aim.decrease + ahead.bend;
    let length = search(&line, ahead.smooth.then_some((slope, ahead.noise)));
    let smooth = if length == 1.0 {
        ahead.smooth
    } else {
        models.differentiate(friction, v, direction, length).smooth
    };
    system.advance(v, length);
    Step {
        taken: aim.curvature * length * length,
        full: length == 1.0 && !still,
        whole: !projected && smooth && (length == 1.0 || still),
    }
}

/// Shortens a direction to where all potentials are finite; true if it had left.
fn shorten<const C: usize>(
    friction: &Friction<'_, C>,
    v: &[SVector<f64, C>],
    direction: &mut [SVector<f64, C>],
) -> bool {
    let mut length = 1.0;
    for (k, &vertex) in friction.vertices.iter().enumerate() {
        let is_finite = |length: f64| {
            let ahead = v[vertex] + direction[vertex] * length;
            friction.potentials.value(k, &ahead).is_finite()
        };
        if is_finite(length) {
            continue;
        }
        let mut low = 0.0;
        // To rounding: the sweep that follows closes a gap exactly.
        for _ in 0..f64::MANTISSA_DIGITS {
            let middle = 0.5 * (low + length);
            if is_finite(middle) {
                low = middle;
            } else {
                length = middle;
            }
        }
        length = low;
    }
    if length < 1.0 {
        direction.iter_mut().for_each(|d| *d *= length);
    }
    length < 1.0
}
