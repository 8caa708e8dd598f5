//! The accuracy of a step: its velocity by the tolerance of the coupling, and the effect on friction.

use std::any::Any;

use nalgebra::{SMatrix, SVector};
use stickslip::friction::modulus;
use stickslip::{BlockMatrix, LinearSolver, Matrix, Operator, Simulation, Snapshot, StepState};

use crate::case::Refusal;
use crate::check::ROUNDINGS;

/// The tolerance of the coupling that the paper has, in metres and kilograms.
pub(crate) const TOLERANCE: f64 = 1e-10;
/// The velocity is known up to this many tolerances of the coupling: the last change was below one,
/// the state may lag behind it by another, and a relaxed one by twice that.
const TOLERANCES: f64 = 8.0;
/// The change of the velocity that the coupling takes for rounding, over the velocity.
const RELATIVE: f64 = 1e-12;

/// An operator whose entries can be looked at.
pub(crate) trait Entries {
    /// The largest sum of the moduli of a row.
    fn largest_row(&self) -> f64;
}

impl<const C: usize> Entries for SMatrix<f64, C, C> {
    fn largest_row(&self) -> f64 {
        self.abs().column_sum().max()
    }
}

impl<const C: usize> Entries for BlockMatrix<C> {
    fn largest_row(&self) -> f64 {
        let mut sums = vec![SVector::<f64, C>::zeros(); self.rows()];
        for (block, (i, _)) in self {
            sums[i as usize] += block.abs().column_sum();
        }
        sums.iter().map(SVector::max).fold(0.0, f64::max)
    }
}

/// A matrix of a simulation in its format.
pub(crate) fn typed<M: 'static, const C: usize>(matrix: &dyn Matrix<C>) -> Result<&M, Refusal> {
    let matrix: &dyn Any = matrix;
    matrix.downcast_ref().ok_or_else(|| "another format".into())
}

/// The accuracy of the velocity by the coupling.
pub(crate) struct Accuracy<Op> {
    /// `A + M`, the norm in which the coupling measures the velocity.
    norm: Op,
    /// The largest diagonal entry of its inverse on the free components.
    compliance: f64,
    /// That of the coupling, in this norm.
    pub(crate) tolerance: f64,
}

impl<Op> Accuracy<Op> {
    pub(crate) fn of<const C: usize>(
        simulation: &Simulation<C>,
        solver: &mut dyn LinearSolver<Op, C>,
    ) -> Result<Self, Refusal>
    where
        Op: Operator<C>,
    {
        let mass = simulation.mass().map(typed::<Op::Mass, C>).transpose()?;
        let stiffness = typed(simulation.stiffness())?;
        let norm = Op::combination_with(&[(1.0, stiffness)], mass.map(|mass| (1.0, mass)));
        Ok(Self {
            compliance: compliance(&norm, simulation.fixed(), solver)?,
            tolerance: TOLERANCE,
            norm,
        })
    }

    /// The admissible error of a component of the velocity after a step [m/s].
    pub(crate) fn deviation<const C: usize>(&self, ends: [&StepState<C>; 2]) -> f64
    where
        Op: Operator<C>,
    {
        let norms = ends.map(|state| self.norm.norm(&state.velocity));
        let norm = norms[0].max(norms[1]);
        TOLERANCES * self.tolerance.max(RELATIVE * norm) * self.compliance.sqrt()
    }
}

/// The largest diagonal entry of the inverse on the free components.
fn compliance<Op, const C: usize>(
    operator: &Op,
    fixed: &[[bool; C]],
    solver: &mut dyn LinearSolver<Op, C>,
) -> Result<f64, Refusal> {
    solver.prepare(operator, fixed)?;
    let mut largest: f64 = 0.0;
    let mut load = vec![SVector::zeros(); fixed.len()];
    for i in 0..fixed.len() {
        for c in (0..C).filter(|&c| !fixed[i][c]) {
            let mut moved = vec![SVector::zeros(); fixed.len()];
            load[i][c] = 1.0;
            solver.solve(operator, &load, &mut moved)?;
            load[i][c] = 0.0;
            largest = largest.max(moved[i][c]);
        }
    }
    Ok(largest)
}

/// The vertices that slide, with what friction can bear \[N\] and the slip velocity [m/s].
pub(crate) fn frictional<const C: usize>(
    at: Snapshot<'_, C>,
) -> Vec<(usize, f64, SVector<f64, C>)> {
    let contacts = at.contacts();
    let of_each = contacts.flat_map(|contact| {
        (0..contact.len()).map(move |k| {
            let strength = contact.strength(k) * contact.weight(k);
            (contact.vertex(k), strength, contact.slip_velocity(k))
        })
    });
    of_each.collect()
}

/// Adds by how much friction may be wrong at each vertex \[N\] where slip rates are known up to
/// `deviation`, and states are those of such rates.
///
/// Friction is read from the simulation at rates and states that are moved by as much.
pub(crate) fn add_friction_range<const C: usize>(
    simulation: &mut Simulation<C>,
    from: &StepState<C>,
    deviation: f64,
    allowed: &mut [f64],
) -> Result<(), String> {
    let now = simulation.state().clone();
    let here = frictional(simulation.snapshot());
    let mut ranges = vec![0.0; here.len()];
    let ends = [-1.0, 1.0].map(|sign| moved_rates(simulation, sign * deviation));
    let mut lag: f64 = 0.0;
    for end in &ends {
        go_to(simulation, end)?;
        lag = lag.max(simulation.residuals(from).state);
    }
    for (end, sign) in ends.iter().flat_map(|end| [(end, -1.0), (end, 1.0)]) {
        go_to(simulation, &moved_states(end, sign * lag))?;
        let there = frictional(simulation.snapshot());
        for ((range, (_, here, velocity)), (_, there, _)) in ranges.iter_mut().zip(&here).zip(there)
        {
            // Which way so slow a vertex slides is not known.
            let turned = modulus(velocity) <= deviation;
            let difference = if turned {
                there + here
            } else {
                (there - here).abs()
            };
            *range = difference.max(*range);
        }
    }
    for ((vertex, ..), range) in here.iter().zip(ranges) {
        allowed[*vertex] += range;
    }
    go_to(simulation, &now)
}

/// The state with slip rates moved by `deviation`, and by what rounding does to their logarithm.
fn moved_rates<const C: usize>(simulation: &Simulation<C>, deviation: f64) -> StepState<C> {
    let mut moved = simulation.state().clone();
    for (vertex, _, velocity) in frictional(simulation.snapshot()) {
        let rate = modulus(&velocity);
        let logarithm = rate.max(f64::MIN_POSITIVE).ln().abs() + 60.0;
        let rounding = ROUNDINGS * f64::EPSILON * rate * logarithm;
        let there = (rate + deviation + rounding.copysign(deviation)).max(0.0);
        if rate > 0.0 {
            // In this order: the ratio of a rate to a subnormal one overflows.
            let direction = moved.velocity[vertex] / rate;
            moved.velocity[vertex] = direction * there;
        } else {
            moved.velocity[vertex][0] = there;
        }
    }
    moved
}

/// The state with those of the contacts moved by `lag`, and by what rounding does to them.
fn moved_states<const C: usize>(state: &StepState<C>, lag: f64) -> StepState<C> {
    let mut moved = state.clone();
    let contacts = moved.contacts.iter_mut();
    for state in contacts.flat_map(|contact| &mut contact.states) {
        *state += lag + (ROUNDINGS * f64::EPSILON * state.abs()).copysign(lag);
    }
    moved
}

fn go_to<const C: usize>(
    simulation: &mut Simulation<C>,
    state: &StepState<C>,
) -> Result<(), String> {
    simulation.restore(state).map_err(|error| error.to_string())
}
