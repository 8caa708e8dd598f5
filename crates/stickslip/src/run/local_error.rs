//! The local error of a step: the same time in one step, two, three, and what they tend to.

use nalgebra::SVector;
use stickslip_tnnmg::Operator;

use super::limit::LocalError;
use super::motion_error::Beginning;
use super::resolution::{Resolution, open_state};
use crate::step::reduction::largest;
use crate::{Failure, Simulation, StepState};

/// How the error of a step is measured, and whether it is taken off.
///
/// A step is taken at once, in two halves, in three thirds and so on, up to `levels`. The error of
/// a symmetric scheme of second order (Newmark with average acceleration and the midpoint state,
/// where everything is smooth) has even powers of the step only, so that each level may gain two
/// orders. A scheme of first order gains one a level; others use two levels and gain one order (W.
/// Gragg 1965; E. Hairer, S. Norsett, G. Wanner, "Solving Ordinary Differential Equations I", Sec.
/// II.9).
///
/// | `levels` | `extrapolate` | result | order | solves a step |
/// | --- | --- | --- | --- | --- |
/// | 2 | no | the two halves | 2 | 3 |
/// | 2 | yes | extrapolated | 4 | 3 |
/// | 3 | yes | extrapolated | 6 | 6 |
/// | 4 | yes | extrapolated | 8 | 10 |
///
/// Extrapolation is for points: what Newmark's scheme leaves of waves that a step does not resolve would grow by
/// 5/3 a step. A run of a body with inertia refuses every scheme with which anything would grow;
/// [`BackwardEuler`](crate::BackwardEuler) may be extrapolated.
///
/// The error is the difference of the last two results, the largest of what the scene has:
///
/// | of | measured as | relative to |
/// | --- | --- | --- |
/// | the slip rate of a contact with state | `dV` | `V`, raised by what counts as rest |
/// | the state | the change of `ln theta` | |
/// | the motion, times its weight | `sqrt(du . A du + dv . M dv)` | the same of `u - u_0` and `v` |
///
/// Two results differ also by what the solver leaves open. With an
/// [absolute tolerance](crate::Simulation::with_absolute_tolerance) of the coupling what eight times the tolerance
/// explains is no error: slip rates and motions that small are not resolved, whatever the step.
///
/// The slip rate of a contact without state may jump; what it does to the body is in the motion. Displacements are
/// measured from the [equilibrium](crate::Scene::in_equilibrium) that the scene starts from, or from zero: what a static
/// load does is no motion then, but motion far below it counts as [rest](Self::rest); else waves that are small beside
/// it, and matter, ask for a smaller tolerance. The motion of a body that begins at rest is compared with that of the
/// longest step tried from there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorControl {
    /// Slip rates well below this count as rest [m/s].
    pub slip_rate_floor: f64,
    /// Slip rates well below this share of the fastest velocity of the body count as rest, too, and so does motion well
    /// below this share of the initial equilibrium: its rounding is no motion.
    pub rest: f64,
    /// The weight of the error of the motion, from 0 to 1. Below 1 the waves of a body need not be followed as
    /// closely as slip: those that hold less than the tolerance over the weight are left to a scheme that damps
    /// what a step does not resolve, [`Sdirk2`](crate::Sdirk2) or
    /// [`GeneralizedAlpha`](crate::GeneralizedAlpha).
    pub motion: f64,
    /// The number of ways to take the step, from 2 to 8; 2 without extrapolation.
    pub levels: usize,
    /// Go on from the extrapolated result; else from that of the smallest steps.
    pub extrapolate: bool,
}

impl Default for ErrorControl {
    /// Rest below 1e-4 of the fastest motion and of the initial equilibrium, motion of weight 1, two levels, no
    /// extrapolation.
    fn default() -> Self {
        Self {
            slip_rate_floor: 0.0,
            rest: 1e-4,
            motion: 1.0,
            levels: 2,
            extrapolate: false,
        }
    }
}

impl ErrorControl {
    /// Extrapolation over `levels` levels.
    pub fn extrapolated(levels: usize) -> Self {
        Self {
            levels,
            extrapolate: true,
            ..Self::default()
        }
    }
}

impl ErrorControl {
    /// The power of the step with which the estimated error falls, for a method of order `order`.
    pub(crate) fn error_order(&self, order: usize, symmetric: bool) -> usize {
        let gain = if symmetric { 2 } else { 1 };
        let levels = self.levels_for(order, symmetric);
        order + gain * (levels - 2) + 1
    }

    /// The levels that make sense: with odd powers of the step beside a missing first one, a third
    /// level does not fit the scheme of elimination, and without extrapolation none does.
    pub(crate) fn levels_for(&self, order: usize, symmetric: bool) -> usize {
        if !self.extrapolate || order > 1 && !symmetric {
            2
        } else {
            self.levels.clamp(2, 8)
        }
    }
}

/// Where a step began, and where it ends by each level's way, the last one excepted.
pub(crate) struct Comparison<const C: usize> {
    pub(crate) start: StepState<C>,
    ends: Vec<StepState<C>>,
    /// After the first half of the step.
    half: StepState<C>,
    /// The square of the initial equilibrium in the energy norm.
    equilibrium: f64,
    /// Of two results.
    difference: Vec<SVector<f64, C>>,
    /// The size of that half, if it began at `start`.
    pub(crate) half_size: Option<f64>,
    /// The largest motion of steps from rest, see [`ControlState`](crate::ControlState), and how many were tried at
    /// `start`.
    pub(crate) onset: (f64, usize),
}

impl<Op: Operator<C>, const C: usize> Simulation<Op, C> {
    /// The step by each level's way; what is seen stays the step before, and is the last accepted one if this fails.
    pub(crate) fn compare(
        &mut self,
        dt: f64,
        control: &ErrorControl,
    ) -> Result<LocalError, Failure> {
        let mut comparison = self.comparison.take().unwrap_or_else(|| {
            let equilibrium = match &*self.equilibrium {
                [] => 0.0,
                displacement => self.scene.stiffness.quadratic(displacement),
            };
            Box::new(Comparison {
                equilibrium,
                start: self.state.clone(),
                ends: Vec::new(),
                half: self.state.clone(),
                difference: self.state.velocity.clone(),
                half_size: None,
                onset: (self.state.control.onset, 0),
            })
        });
        // The first step of this many levels takes memory.
        let levels = control.levels_for(self.order(), self.is_symmetric());
        (comparison.ends).resize_with(levels - 1, || self.state.clone());
        // A smaller step is cheaper than following a solution through this one.
        self.follows = false;
        let result = self.compare_with(&mut comparison, levels, dt, control);
        self.follows = true;
        if result.is_err() {
            self.set_state(&comparison.start);
        }
        self.comparison = Some(comparison);
        result
    }

    fn compare_with(
        &mut self,
        comparison: &mut Comparison<C>,
        levels: usize,
        dt: f64,
        control: &ErrorControl,
    ) -> Result<LocalError, Failure> {
        let Comparison {
            start,
            ends,
            half,
            half_size,
            equilibrium,
            difference,
            onset,
        } = comparison;
        // A second try from the same place at half the size: the first half is the new whole.
        let again = self.state.clock == start.clock && self.state.clock.step() > 0;
        if self.state.clock != start.clock {
            *onset = (self.state.control.onset, 0);
        }
        let known = (again && *half_size == Some(dt)).then(|| std::mem::swap(&mut ends[0], half));
        start.copy_from(&self.state);
        *half_size = None;
        let (mut coupling_iterations, mut solver_iterations, mut fell_back) = (0, 0, false);
        for level in 1..=levels {
            if level == 1 && known.is_some() {
                continue;
            }
            self.set_state(start);
            for part in 1..=level {
                let report = self.step_unseen(dt / level as f64)?;
                coupling_iterations += report.coupling_iterations;
                solver_iterations += report.solver_iterations;
                fell_back |= report.fell_back;
                if (level, part) == (2, 1) {
                    half.copy_from(&self.state);
                    *half_size = Some(0.5 * dt);
                }
            }
            if level < levels {
                ends[level - 1].copy_from(&self.state);
            }
        }
        let report = &mut self.state.report;
        report.coupling_iterations = coupling_iterations;
        report.solver_iterations = solver_iterations;
        report.fell_back = fell_back;
        let rest = control.rest.powi(2) * *equilibrium;
        let beginning = Beginning {
            start,
            rest,
            difference,
            onset,
        };
        let error = self.extrapolate(beginning, ends, levels, control);
        self.state.control.onset = onset.0;
        Ok(error)
    }

    /// Neville's scheme on the ends; returns the error, and leaves the result if it is asked for.
    fn extrapolate(
        &mut self,
        mut beginning: Beginning<'_, C>,
        ends: &mut [StepState<C>],
        levels: usize,
        control: &ErrorControl,
    ) -> LocalError {
        let power = self.error_power();
        let mut error = LocalError::default();
        // In column k, what ends with level j rests on the levels j - k to j.
        for k in 1..levels {
            let last = k + 1 == levels;
            for j in (k + 1..=levels).rev() {
                let ratio = (j as f64 / (j - k) as f64).powi(power);
                let share = 1.0 / (ratio - 1.0);
                if j < levels {
                    let (coarser, finer) = ends.split_at_mut(j - 1);
                    let sliding = &self.contacts.vertices;
                    finer[0].correct(&coarser[j - 2], sliding, share);
                    continue;
                }
                if last {
                    let coarser = &ends[j - 2];
                    let resolution = self.resolution(coarser, beginning.difference);
                    let mut found = self.distance(coarser, control, &resolution);
                    if control.motion > 0.0 {
                        let motion = self.motion_error(&mut beginning, coarser, &resolution);
                        found.motion = control.motion * motion;
                    }
                    error = found.scaled(share);
                }
                if control.extrapolate {
                    let sliding = &self.contacts.vertices;
                    self.state.correct(&ends[j - 2], sliding, share);
                    self.trial.balanced = None;
                }
            }
        }
        error
    }
}

impl<Op: Operator<C>, const C: usize> Simulation<Op, C> {
    /// The largest distance of a slip rate from that of `coarser`, and the largest of a state, over all contacts with
    /// a state.
    fn distance(
        &self,
        coarser: &StepState<C>,
        control: &ErrorControl,
        resolution: &Resolution,
    ) -> LocalError {
        let now = &self.state;
        let fastest = largest(now.velocity.iter().map(|v| v.norm_squared()));
        let fastest = self.operators.step.largest(fastest).sqrt();
        let floor = control.slip_rate_floor.max(control.rest * fastest);
        let mut error = LocalError::default();
        let states = now.contacts.iter().zip(&coarser.contacts);
        for (contact, (state, coarser_state)) in self.contacts.contacts.iter().zip(states) {
            if !contact.interface.has_state() {
                continue;
            }
            for (k, &vertex) in contact.part.vertices.iter().enumerate() {
                let rate = contact.tangential(k, &now.velocity[vertex]);
                let coarser = contact.tangential(k, &coarser.velocity[vertex]);
                let open = || self.open_rate(resolution, vertex, (rate - coarser).norm());
                // Only for the largest it matters what the solver leaves open.
                let mut rates = rate_distance(rate, coarser, floor, 0.0);
                if !resolution.is_exact() && rates > error.slip_rate.error {
                    rates = rate_distance(rate, coarser, floor, open());
                }
                error.slip_rate.raise(rates, vertex, || rate.norm());
                let Some((&a, &b)) = state.states.get(k).zip(coarser_state.states.get(k)) else {
                    continue;
                };
                let mut states = contact.interface.distance(a, b);
                if !resolution.is_exact() && states > error.state.error {
                    states = (states - open_state(contact, k, rate.norm(), open())).max(0.0);
                }
                error.state.raise(states, vertex, || a);
            }
        }
        for found in [&mut error.slip_rate.error, &mut error.state.error] {
            *found = self.operators.step.largest(*found);
        }
        error
    }
}

impl<const C: usize> StepState<C> {
    /// Adds `share` times the difference from `coarser`. Slip rates are extrapolated by their
    /// logarithm, in which their growth is nearly linear, and keep their direction.
    fn correct(&mut self, coarser: &Self, sliding: &[usize], share: f64) {
        for (fine, coarse) in [
            (&mut self.displacement, &coarser.displacement),
            (&mut self.acceleration, &coarser.acceleration),
            (&mut self.carried, &coarser.carried),
        ] {
            for (fine, coarse) in fine.iter_mut().zip(coarse) {
                *fine += (*fine - coarse) * share;
            }
        }
        let mut sliding = sliding.iter().copied().peekable();
        for (i, (fine, coarse)) in self.velocity.iter_mut().zip(&coarser.velocity).enumerate() {
            let slides = sliding.next_if_eq(&i).is_some();
            let ratio = fine.norm() / coarse.norm();
            if slides && (0.1..10.0).contains(&ratio) && fine.dot(coarse) > 0.0 {
                *fine *= (share * ratio.ln()).exp();
            } else {
                *fine += (*fine - coarse) * share;
            }
        }
        for (fine, coarse) in self.contacts.iter_mut().zip(&coarser.contacts) {
            for (fine, coarse) in fine.states.iter_mut().zip(&coarse.states) {
                *fine += share * (*fine - coarse);
            }
        }
    }
}

/// The difference of `ln V`, as far as it is more than what is `open`.
pub(super) fn rate_distance<const C: usize>(
    a: SVector<f64, C>,
    b: SVector<f64, C>,
    floor: f64,
    open: f64,
) -> f64 {
    let difference = (a - b).norm() - open;
    if difference < 0.0 {
        return 0.0;
    }
    // At rest on both sides nothing differs.
    difference / (a.norm().max(b.norm()) + floor).max(f64::MIN_POSITIVE)
}
