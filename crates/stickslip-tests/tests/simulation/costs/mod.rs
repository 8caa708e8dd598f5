//! What runs cost, counted and compared with `costs.csv`: a change of cost is a change of that file, and says why.
//!
//! Where a change is meant, `STICKSLIP_COSTS=accept cargo test --workspace --test simulation costs`
//! writes the file. Counts can differ by the elementary functions of a platform.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

mod bodies;
mod faults;
mod points;

use std::env;
use std::fmt::Write;
use std::fs;

use stickslip::integrate::Stepper;
use stickslip::{Run, Simulation, Snapshot, Steps};

use crate::Outcome;

const FILE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/tests/simulation/costs/costs.csv"
);

const COLUMNS: [&str; 11] = [
    "scene",
    "accepted",
    "rejected",
    "coupling iterations",
    "solver iterations",
    "reaction iterations",
    "preparations",
    "factorizations",
    "substitutions",
    "dense products",
    "allocations",
];

/// The counts of a run, in the order of the columns.
type Counts = [usize; COLUMNS.len() - 1];

/// A scene that is run, with its name.
pub(super) struct Cost {
    name: &'static str,
    counts: Counts,
}

/// Runs a plan, and again from its start: allocations are those of the second run.
fn count<S: Stepper<C>, const C: usize>(
    name: &'static str,
    stepper: &mut S,
    steps: &Steps,
) -> Outcome<Cost> {
    let start = stepper.state().clone();
    let mut iterations = [0; 3];
    let report = stepper.run(steps, |at: Snapshot<'_, C>| {
        let step = &at.report;
        iterations[0] += step.coupling_iterations;
        iterations[1] += step.solver_iterations;
        iterations[2] += step.reaction_iterations;
    })?;
    stepper.restore(&start)?;
    let mut again = None;
    let info = allocation_counter::measure(|| again = Some(stepper.run(steps, |_| ())));
    let again = again.ok_or("not run")??;
    assert_eq!(report.accepted, again.accepted, "{name}");
    let mut counts = [0; COLUMNS.len() - 1];
    counts[..2].copy_from_slice(&[report.accepted, report.rejected]);
    counts[2..5].copy_from_slice(&iterations);
    counts[9] = usize::try_from(info.count_total)?;
    Ok(Cost { name, counts })
}

/// The cost of a simulation, with the work of its solver, of two runs.
pub(super) fn simulated<const C: usize>(
    name: &'static str,
    mut simulation: Simulation<C>,
    steps: &Steps,
) -> Outcome<Cost> {
    let mut cost = count(name, &mut simulation, steps)?;
    let work = simulation.counters();
    let substitutions = work.forward_substitutions + work.backward_substitutions;
    cost.counts[5..9].copy_from_slice(&[
        work.preparations,
        work.factorizations,
        substitutions,
        work.products,
    ]);
    Ok(cost)
}

/// The cost of any stepper, without that of solvers.
pub(super) fn stepped<const C: usize>(
    name: &'static str,
    mut stepper: impl Stepper<C>,
    steps: &Steps,
) -> Outcome<Cost> {
    count(name, &mut stepper, steps)
}

#[test]
fn costs_are_those_accepted() -> Outcome {
    let mut table = COLUMNS.join(",");
    table.push('\n');
    let all = [points::all()?, bodies::all()?, faults::all()?];
    for cost in all.into_iter().flatten() {
        write!(table, "{}", cost.name)?;
        for count in cost.counts {
            write!(table, ",{count}")?;
        }
        table.push('\n');
    }
    if env::var_os("STICKSLIP_COSTS").is_some() {
        fs::write(FILE, &table)?;
    }
    let accepted = fs::read_to_string(FILE)?;
    for (line, (now, accepted)) in table.lines().zip(accepted.lines()).enumerate() {
        assert_eq!(now, accepted, "line {}, of {COLUMNS:?}", line + 1);
    }
    assert_eq!(table.lines().count(), accepted.lines().count());
    Ok(())
}
