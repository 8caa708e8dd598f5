//! Steps of a case, each checked; after one that fails, smaller ones in its place.

use stickslip::{Operator, Simulation, StepFailure, StepState, Steps};

use crate::accuracy::Entries;
use crate::case::{IntoControlFlow, Outcome};
use crate::check::Check;

/// The number of repetitions of a failed step, each with a tenth of its size.
const RETRIES: i32 = 3;
/// Steps of varied sizes over the size of the first, again and again.
const VARIED: [f64; 6] = [1.0, 1e3, 1e-3, 1e2, 1e-1, 1e-2];

/// The relation of the size of a step to that of the last one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Pace {
    Constant,
    /// By [`VARIED`].
    Varied,
    /// To this tolerance.
    Adaptive(f64),
}

/// Puts a state, in metres and kilograms, in the place of one in other units.
type Convert<const C: usize> = Box<dyn Fn(&StepState<C>, &mut StepState<C>)>;

/// The same scene in metres and kilograms.
pub(crate) struct Twin<Op: Operator<C>, const C: usize> {
    pub(crate) simulation: Simulation<C>,
    pub(crate) check: Check<Op, C>,
    /// The metre in the units of the other.
    pub(crate) length: f64,
    pub(crate) convert: Convert<C>,
}

/// Takes steps, the first of `dt` \[s\], and checks each; one that fails must leave no trace, and
/// smaller ones are tried in its place. A twin takes the same steps to the same velocities.
pub(crate) fn march<Op: Operator<C> + Entries, const C: usize>(
    simulation: &mut Simulation<C>,
    check: &Check<Op, C>,
    mut twin: Option<&mut Twin<Op, C>>,
    (steps, dt, pace): (usize, f64, Pace),
) -> IntoControlFlow {
    let mut verdict = IntoControlFlow::new(Outcome::Solved, "");
    for k in 0..steps {
        let before = simulation.state().clone();
        let dt = match pace {
            Pace::Varied => dt * VARIED[k % VARIED.len()],
            _ => dt,
        };
        let taken = match pace {
            Pace::Adaptive(tolerance) => adapt(simulation, dt, tolerance),
            _ => simulation.step(dt).map(drop),
        };
        if let Err(failure) = taken {
            let text = failure.to_string();
            if *simulation.state() != before || text.contains('\n') {
                let text = format!("a failed step left its trace: {text}");
                return verdict.with(Outcome::Defect, text);
            }
            // A twin takes whole steps.
            let lost = match (pace, &twin) {
                (Pace::Adaptive(_), _) | (_, Some(_)) => Err((Outcome::Reported, text)),
                _ => split(simulation, check, dt, &mut verdict),
            };
            match lost {
                Ok(()) => continue,
                Err((Outcome::Reported, text)) => {
                    return resume(simulation, check, dt, verdict.with(Outcome::Reported, text));
                }
                Err((outcome, text)) => return verdict.with(outcome, text),
            }
        }
        let report = simulation.state().report;
        let checked = match pace {
            Pace::Adaptive(_) => halves(simulation, check, &before),
            _ => check.step(simulation, &before),
        };
        let compared = checked.and_then(|residual| match &mut twin {
            Some(twin) => Ok(residual.max(twin.compare(simulation, check, &before, dt)?)),
            None => Ok(residual),
        });
        match compared {
            Ok(residual) => verdict.residual = verdict.residual.max(residual),
            Err(text) => return verdict.with(Outcome::Defect, text),
        }
        let (most, work) = &mut verdict.iterations;
        *most = report.coupling_iterations.max(*most);
        *work = report.solver_iterations.max(*work);
    }
    verdict
}

/// The smallest substep over the step, and how many a step may try.
const SMALLEST: f64 = 1.0 / 1024.0;
const BUDGET: usize = 300;

/// Takes a step that failed in substeps as a run does, each of them checked.
fn split<Op: Operator<C> + Entries, const C: usize>(
    simulation: &mut Simulation<C>,
    check: &Check<Op, C>,
    dt: f64,
    verdict: &mut IntoControlFlow,
) -> Result<(), (Outcome, String)> {
    let until = simulation.state().clock.after(dt).time();
    let (mut part, mut in_a_row) = (0.5 * dt, 0);
    verdict.split += 1;
    for _ in 0..BUDGET {
        let left = simulation.state().clock.left(until);
        let last = part >= left * (1.0 - 1e-9);
        let from = simulation.state().clone();
        match simulation.step(if last { left } else { part }) {
            Ok(_) => {
                let residual = check.step(simulation, &from);
                let residual = residual.map_err(|text| (Outcome::Defect, text))?;
                verdict.residual = verdict.residual.max(residual);
                if last {
                    return Ok(());
                }
                in_a_row += 1;
                part *= if in_a_row % 2 == 0 { 2.0 } else { 1.0 };
            }
            Err(failure) => {
                if *simulation.state() != from {
                    let text = format!("a failed step left its trace: {failure}");
                    return Err((Outcome::Defect, text));
                }
                (part, in_a_row) = (0.5 * part.min(left), 0);
                if part < SMALLEST * dt {
                    return Err((Outcome::Reported, failure.to_string()));
                }
            }
        }
    }
    Err((
        Outcome::Reported,
        format!("{BUDGET} substeps tried in one step"),
    ))
}

/// One step of an adaptive run.
fn adapt<const C: usize>(
    simulation: &mut Simulation<C>,
    dt: f64,
    tolerance: f64,
) -> Result<(), StepFailure> {
    let steps = Steps::adaptive(tolerance).with_first_step(dt);
    let steps = steps
        .with_min_step(1e-6 * dt)
        .with_max_step(1e3 * dt)
        .count(1);
    simulation.run(&steps, |_| ()).map(drop)
}

/// An adaptive step is the two halves that gave it, and each of these is a step.
fn halves<Op: Operator<C> + Entries, const C: usize>(
    simulation: &mut Simulation<C>,
    check: &Check<Op, C>,
    before: &StepState<C>,
) -> Result<f64, String> {
    let end = simulation.state().clone();
    let go_to = |simulation: &mut Simulation<C>, state: &StepState<C>| {
        simulation.restore(state).map_err(|error| error.to_string())
    };
    go_to(simulation, before)?;
    let mut worst: f64 = 0.0;
    for _ in 0..2 {
        let from = simulation.state().clone();
        let taken = simulation.step(end.last_step);
        taken.map_err(|failure| format!("a half of an adaptive step fails: {failure}"))?;
        worst = worst.max(check.step(simulation, &from)?);
    }
    let again = simulation.state();
    let same = again.velocity == end.velocity
        && again.displacement == end.displacement
        && again.acceleration == end.acceleration
        && again.contacts == end.contacts;
    if !same {
        let step = end.clock.step();
        return Err(format!("step {step}: an adaptive step is not its halves"));
    }
    go_to(simulation, &end)?;
    Ok(worst)
}

impl<Op: Operator<C>, const C: usize> Twin<Op, C> {
    /// Takes the same step from the same state; the share of what is allowed by which the
    /// velocities differ, or what is wrong.
    fn compare(
        &mut self,
        other: &mut Simulation<C>,
        check: &Check<Op, C>,
        before: &StepState<C>,
        dt: f64,
    ) -> Result<f64, String>
    where
        Op: Entries,
    {
        let from = self.simulation.state().clone();
        let taken = self.simulation.step(dt);
        taken.map_err(|failure| format!("in metres and kilograms: {failure}"))?;
        let allowed = check.deviation(other, before)
            + self.length * self.check.deviation(&self.simulation, &from);
        let now = self.simulation.state();
        let velocities = now.velocity.iter().zip(&other.state().velocity);
        let differences = velocities.map(|(v, w)| (v * self.length - w).amax());
        let difference = differences.fold(0.0, f64::max);
        if difference.is_nan() || difference > allowed {
            return Err(format!(
                "step {}: velocities differ by {difference:e} from those in metres and kilograms, \
                 {allowed:e} allowed",
                now.clock.step()
            ));
        }
        // Errors of the last step are not those of the next.
        let mut state = other.state().clone();
        (self.convert)(now, &mut state);
        other.restore(&state).map_err(|error| error.to_string())?;
        Ok(difference / allowed)
    }
}

/// Tries smaller steps in the place of one that failed.
fn resume<Op: Operator<C> + Entries, const C: usize>(
    simulation: &mut Simulation<C>,
    check: &Check<Op, C>,
    dt: f64,
    mut verdict: IntoControlFlow,
) -> IntoControlFlow {
    let before = simulation.state().clone();
    for power in 1..=RETRIES {
        let smaller = 0.1f64.powi(power);
        match simulation.step(smaller * dt) {
            Ok(_) => match check.step(simulation, &before) {
                Ok(_) => {
                    verdict.resumed = Some(smaller);
                    return verdict;
                }
                Err(text) => return verdict.with(Outcome::Defect, text),
            },
            Err(failure) if *simulation.state() != before => {
                let text = format!("a failed step left its trace: {failure}");
                return verdict.with(Outcome::Defect, text);
            }
            Err(_) => {}
        }
    }
    verdict
}
