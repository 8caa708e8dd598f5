//! The local error of a step: the same time in one step, two, three, and what they tend to.

use nalgebra::SVector;
use stickslip_friction::FrictionLaw;
use stickslip_state::{StateLaw, StateVariable};
use stickslip_time::RateScheme;
use stickslip_tnnmg::Operator;

use crate::accepted::Accepted;
use crate::simulation::Simulation;
use crate::{Failure, Stepper};

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
/// The error is the difference of the last two results, over the frictional vertices: the larger of
/// the changes of `ln V` (with `V` raised by a floor) and of the state (absolute for `ln theta`,
/// relative for `theta`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorControl {
    /// Slip rates well below this count as rest [m/s].
    pub slip_rate_floor: f64,
    /// The number of ways to take the step, from 2 to 8; 2 without extrapolation.
    pub levels: usize,
    /// Go on from the extrapolated result; else from that of the smallest steps.
    pub extrapolate: bool,
}

impl Default for ErrorControl {
    /// A floor of 1e-20 m/s, two levels, no extrapolation.
    fn default() -> Self {
        Self {
            slip_rate_floor: 1e-20,
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
#[derive(Debug)]
pub(crate) struct Comparison<T, const C: usize> {
    pub(crate) start: Accepted<T, C>,
    ends: Vec<Accepted<T, C>>,
    /// After the first half of the step.
    half: Accepted<T, C>,
    /// The size of that half, if it began at `start`.
    half_size: Option<f64>,
}

impl<Op, L, S, R, const C: usize> Simulation<Op, L, S, R, C>
where
    Op: Operator<C>,
    L: FrictionLaw + Clone,
    S: StateLaw + Clone,
    L::State: From<S::State>,
    R: RateScheme,
{
    /// Whether the error has even powers of the step only.
    pub(crate) fn is_symmetric(&self) -> bool {
        self.scheme.is_symmetric() && self.order() > 1
    }

    pub(crate) fn compare(&mut self, dt: f64, control: &ErrorControl) -> Result<f64, Failure> {
        let mut comparison = self.comparison.take().unwrap_or_else(|| {
            Box::new(Comparison {
                start: self.now.clone(),
                ends: Vec::new(),
                half: self.now.clone(),
                half_size: None,
            })
        });
        // The first step of this many levels takes memory.
        let levels = control.levels_for(self.order(), self.is_symmetric());
        comparison.ends.resize_with(levels - 1, || self.now.clone());
        let result = self.compare_with(&mut comparison, levels, dt, control);
        if result.is_err() {
            self.now.copy_from(&comparison.start);
        }
        self.comparison = Some(comparison);
        result
    }

    fn compare_with(
        &mut self,
        comparison: &mut Comparison<S::State, C>,
        levels: usize,
        dt: f64,
        control: &ErrorControl,
    ) -> Result<f64, Failure> {
        let Comparison {
            start,
            ends,
            half,
            half_size,
        } = comparison;
        // A second try from the same place at half the size: the first half is the new whole.
        let again = self.now.clock == start.clock && self.now.clock.step > 0;
        let known = (again && *half_size == Some(dt)).then(|| std::mem::swap(&mut ends[0], half));
        start.copy_from(&self.now);
        *half_size = None;
        let (mut coupling_iterations, mut solver_iterations, mut fell_back) = (0, 0, false);
        for level in 1..=levels {
            if level == 1 && known.is_some() {
                continue;
            }
            self.now.copy_from(start);
            for part in 1..=level {
                let report = self.step(dt / level as f64)?;
                coupling_iterations += report.coupling_iterations;
                solver_iterations += report.solver_iterations;
                fell_back |= report.fell_back;
                if (level, part) == (2, 1) {
                    half.copy_from(&self.now);
                    *half_size = Some(0.5 * dt);
                }
            }
            if level < levels {
                ends[level - 1].copy_from(&self.now);
            }
        }
        let report = &mut self.now.report;
        report.coupling_iterations = coupling_iterations;
        report.solver_iterations = solver_iterations;
        report.fell_back = fell_back;
        Ok(self.extrapolate(ends, levels, control))
    }

    /// Neville's scheme on the ends; returns the error, and leaves the result if it is asked for.
    fn extrapolate(
        &mut self,
        ends: &mut [Accepted<S::State, C>],
        levels: usize,
        control: &ErrorControl,
    ) -> f64 {
        let power = if self.order() > 1 { 2 } else { 1 };
        let mut error = 0.0;
        // In column k, what ends with level j rests on the levels j - k to j.
        for k in 1..levels {
            let last = k + 1 == levels;
            for j in (k + 1..=levels).rev() {
                let ratio = (j as f64 / (j - k) as f64).powi(power);
                let share = 1.0 / (ratio - 1.0);
                if j < levels {
                    let (coarser, finer) = ends.split_at_mut(j - 1);
                    finer[0].correct(&coarser[j - 2], &self.vertices, share);
                    continue;
                }
                if last {
                    error = share * self.distance(&ends[j - 2], control.slip_rate_floor);
                }
                if control.extrapolate {
                    self.now.correct(&ends[j - 2], &self.vertices, share);
                }
            }
        }
        error
    }

    fn distance(&self, other: &Accepted<S::State, C>, floor: f64) -> f64 {
        let mut largest: f64 = 0.0;
        for (k, &vertex) in self.vertices.iter().enumerate() {
            let velocities = (self.now.velocity[vertex], other.velocity[vertex]);
            let states = (self.now.states[k], other.states[k]);
            let at_vertex = difference(velocities, states, floor);
            // The maximum forgets what is not a number.
            if at_vertex.is_nan() {
                return f64::NAN;
            }
            largest = largest.max(at_vertex);
        }
        largest
    }
}

/// The larger of the differences of `ln V` and of the state at a vertex.
pub(crate) fn difference<T: StateVariable, const C: usize>(
    (a, b): (SVector<f64, C>, SVector<f64, C>),
    (state, other): (T, T),
    floor: f64,
) -> f64 {
    let rate = (a - b).norm() / (a.norm().max(b.norm()) + floor);
    let state = state.distance(other);
    if rate.is_nan() || state.is_nan() {
        f64::NAN
    } else {
        rate.max(state)
    }
}
