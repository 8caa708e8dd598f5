//! Steps of a case, each checked; after one that fails, smaller ones in its place.

use stickslip::{Operator, Simulation};

use crate::accuracy::Entries;
use crate::case::{Outcome, Verdict};
use crate::check::Check;

/// How often a step that failed is tried with a tenth of its size.
const RETRIES: i32 = 3;

/// Takes `steps` steps of `dt` \[s\] and checks each; one that fails must leave no trace, and
/// smaller ones are tried in its place.
pub(crate) fn march<Op: Operator<C> + Entries, const C: usize>(
    simulation: &mut Simulation<Op, C>,
    check: &Check<Op, C>,
    steps: usize,
    dt: f64,
) -> Verdict {
    let mut verdict = Verdict::new(Outcome::Solved, "");
    for _ in 0..steps {
        let before = simulation.state().clone();
        let Err(failure) = simulation.step(dt) else {
            let report = simulation.state().report;
            match check.step(simulation, &before) {
                Ok(residual) => verdict.residual = verdict.residual.max(residual),
                Err(text) => return verdict.with(Outcome::Defect, text),
            }
            let (most, work) = &mut verdict.iterations;
            *most = report.coupling_iterations.max(*most);
            *work = report.solver_iterations.max(*work);
            continue;
        };
        let text = failure.to_string();
        if *simulation.state() != before || text.contains('\n') {
            let text = format!("a failed step left its trace: {text}");
            return verdict.with(Outcome::Defect, text);
        }
        return resume(simulation, check, dt, verdict.with(Outcome::Reported, text));
    }
    verdict
}

/// Tries smaller steps in the place of one that failed.
fn resume<Op: Operator<C> + Entries, const C: usize>(
    simulation: &mut Simulation<Op, C>,
    check: &Check<Op, C>,
    dt: f64,
    mut verdict: Verdict,
) -> Verdict {
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
