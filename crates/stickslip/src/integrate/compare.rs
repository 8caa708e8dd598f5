//! A step and its local error: the step in one, two, three and more substeps, and their extrapolation.

use std::mem;

use nalgebra::SVector;

use super::ErrorControl;
use super::distance::{Ends, distance};
use super::landing::landing;
use crate::step::{Span, step};
use crate::{Clock, LocalError, Simulation, StepFailure, StepState};

/// The end of a step by the substeps of each level, and data for a second attempt.
#[derive(Clone)]
pub(crate) struct Comparison<const C: usize> {
    /// The ends of all levels but the last one.
    ends: Vec<StepState<C>>,
    /// The end by the smallest substeps; the previous state once the step is accepted.
    pub(super) end: StepState<C>,
    /// The end by the smallest substeps, before extrapolation.
    plain: StepState<C>,
    /// The state after the first half of the step.
    half: StepState<C>,
    /// The start of that half, and its size \[s\].
    half_of: Option<(Clock, f64)>,
    /// The difference of two results.
    difference: Vec<SVector<f64, C>>,
    /// Twice the energy of the equilibrium, `u_0 . A u_0` \[J\].
    at_rest: f64,
    /// The sum of the diagonal of the stiffness in this process [N/m].
    trace: f64,
}

impl<const C: usize> Comparison<C> {
    /// Clears the stored half: the next attempt has another start.
    pub(crate) fn forget(&mut self) {
        self.half_of = None;
    }
}

/// Takes a step by the substeps of each level, and makes its end the state.
pub(super) fn compare<const C: usize>(
    simulation: &mut Simulation<C>,
    dt: f64,
    control: &ErrorControl,
) -> Result<LocalError, StepFailure> {
    let state = &simulation.state;
    let (stiffness, equilibrium) = (
        &simulation.problem.matrices.stiffness(),
        &simulation.problem.equilibrium,
    );
    let mut comparison = simulation.comparison.take().unwrap_or_else(|| {
        Box::new(Comparison {
            ends: Vec::new(),
            end: state.clone(),
            plain: state.clone(),
            half: state.clone(),
            half_of: None,
            difference: state.velocity.clone(),
            at_rest: if equilibrium.is_empty() {
                0.0
            } else {
                stiffness.quadratic(equilibrium)
            },
            trace: (0..stiffness.vertex_count())
                .map(|i| stiffness.diagonal_block(i).trace())
                .sum(),
        })
    });
    // The first step of this many levels takes memory.
    let method = &simulation.problem.method;
    let levels = control.levels_for(method.order(), method.is_symmetric());
    (comparison.ends).resize_with(levels - 1, || state.clone());
    simulation.work.compared = true;
    let result = take_levels(simulation, &mut comparison, levels, dt, control);
    simulation.work.compared = false;
    if result.is_ok() {
        mem::swap(&mut simulation.state, &mut comparison.end);
        simulation.show();
    }
    simulation.comparison = Some(comparison);
    result
}

fn take_levels<const C: usize>(
    simulation: &mut Simulation<C>,
    comparison: &mut Comparison<C>,
    levels: usize,
    dt: f64,
    control: &ErrorControl,
) -> Result<LocalError, StepFailure> {
    let (p, w, from) = (&simulation.problem, &mut simulation.work, &simulation.state);
    let Comparison {
        ends,
        end,
        plain,
        half,
        half_of,
        difference,
        at_rest,
        trace,
    } = comparison;
    // A second try from the same place at half the size: the first half is the new whole.
    let known = half_of.take() == Some((from.clock, dt));
    if known {
        mem::swap(&mut ends[0], half);
    }
    let mut report = from.report;
    (report.coupling_iterations, report.solver_iterations) = (0, 0);
    (report.reaction_iterations, report.contraction) = (0, 0.0);
    report.fell_back = false;
    for level in if known { 2 } else { 1 }..=levels {
        for part in 1..=level {
            let begin = if part == 1 { from } else { &*end };
            let (size, clock) = (dt / level as f64, begin.clock);
            let taken = step(p, w, begin, size);
            let taken = taken.map_err(|cause| StepFailure::of(&clock.after(size), cause))?;
            report.coupling_iterations += taken.coupling_iterations;
            report.solver_iterations += taken.solver_iterations;
            report.reaction_iterations += taken.reaction_iterations;
            report.contraction = report.contraction.max(taken.contraction);
            report.fell_back |= taken.fell_back;
            (report.damped, report.weakening_nodes) = (taken.damped, taken.weakening_nodes);
            mem::swap(end, &mut w.end);
            if (level, part) == (2, 1) {
                half.copy_from(end);
                *half_of = Some((from.clock, size));
            }
        }
        if level < levels {
            ends[level - 1].copy_from(end);
        }
    }
    end.report = report;
    let power = if p.method.order() > 1 { 2 } else { 1 };
    // Neville's scheme: in column k, what ends with level j rests on the levels j - k to j.
    let (mut first, mut error) = (LocalError::default(), LocalError::default());
    let landing = landing(p, w, [from, &*half, &*end], dt, control);
    let mut largest_motion = from.control.largest_motion;
    if levels > 2 {
        plain.copy_from(end);
    }
    for k in 1..levels {
        for j in (k + 1..=levels).rev() {
            let ratio = (j as f64 / (j - k) as f64).powi(power);
            let share = 1.0 / (ratio - 1.0);
            if j < levels {
                let (coarser, finer) = ends.split_at_mut(j - 1);
                correct(&mut finer[0], &coarser[j - 2], &w.contacts.vertices, share);
                continue;
            }
            let coarser = &ends[j - 2];
            if k == 1 || k + 1 == levels {
                let ends = Ends {
                    start: from,
                    end,
                    coarser,
                    middle: (levels == 2 && p.matrices.has_mass()).then_some(&*half),
                    dt,
                    at_rest: *at_rest,
                    trace: *trace,
                };
                let found = distance(p, w, &ends, control, difference, &mut largest_motion);
                error = found.scaled(share);
                if k == 1 {
                    first = error;
                }
            }
            if control.extrapolate {
                correct(end, coarser, &w.contacts.vertices, share);
                w.balanced = None;
            }
        }
    }
    if control.extrapolate {
        w.contacts.end_penetration(end);
        let time = Span::seen(&end.clock, &p.stops);
        (w.contacts.renew_normal_stresses(time, end))
            .map_err(|cause| StepFailure::of(&end.clock, cause))?;
    }
    if levels > 2 && error.largest() > first.largest() {
        // The levels do not approach one another as powers of the step do: what is not resolved would grow.
        end.copy_from(plain);
        error = first;
    }
    (error.slip).raise(landing.error, landing.vertex, || landing.value);
    end.control.largest_motion = largest_motion;
    Ok(error)
}

/// Adds `share` times the difference from `coarser`. The logarithm of slip rates is extrapolated, since their growth is
/// nearly exponential; their direction is preserved.
fn correct<const C: usize>(
    fine: &mut StepState<C>,
    coarser: &StepState<C>,
    sliding: &[usize],
    share: f64,
) {
    for (fine, coarse) in [
        (&mut fine.displacement, &coarser.displacement),
        (&mut fine.acceleration, &coarser.acceleration),
        (&mut fine.algorithmic, &coarser.algorithmic),
    ] {
        for (fine, coarse) in fine.iter_mut().zip(coarse) {
            *fine += (*fine - coarse) * share;
        }
    }
    let mut sliding = sliding.iter().copied().peekable();
    for (i, (fine, coarse)) in fine.velocity.iter_mut().zip(&coarser.velocity).enumerate() {
        let slides = sliding.next_if_eq(&i).is_some();
        let ratio = fine.norm() / coarse.norm();
        if slides && (0.1..10.0).contains(&ratio) && fine.dot(coarse) > 0.0 {
            *fine *= (share * ratio.ln()).exp();
        } else {
            *fine += (*fine - coarse) * share;
        }
    }
    for (fine, coarse) in fine.contacts.iter_mut().zip(&coarser.contacts) {
        for (fine, coarse) in fine.states.iter_mut().zip(&coarse.states) {
            *fine += share * (*fine - coarse);
        }
        let memories = fine.fields.iter_mut().zip(&coarse.fields);
        for (fine, coarse) in memories.flat_map(|(fine, coarse)| fine.iter_mut().zip(coarse)) {
            *fine += share * (*fine - coarse);
        }
        for (fine, coarse) in fine.pore_pressure.iter_mut().zip(&coarse.pore_pressure) {
            *fine += share * (*fine - coarse);
        }
    }
}
