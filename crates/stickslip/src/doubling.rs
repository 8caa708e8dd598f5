//! The local error of a step: the difference between the step and its two halves.

use stickslip_friction::FrictionLaw;
use stickslip_state::{StateLaw, StateVariable};
use stickslip_time::RateScheme;
use stickslip_tnnmg::Operator;

use crate::simulation::{Accepted, Simulation};
use crate::{Failure, Stepper};

/// How the error of a step is measured, and whether it is taken off.
///
/// Over the frictional vertices, the larger of the changes of `ln V` (with `V` raised by a floor)
/// and of the state (absolute for `ln theta`, relative for `theta`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorControl {
    /// Slip rates well below this count as rest [m/s].
    pub slip_rate_floor: f64,
    /// Take the estimated error off the result. The error of a symmetric scheme (Newmark with
    /// average acceleration and the midpoint state) has even powers of the step only, so that this
    /// gains two orders; others gain one.
    pub extrapolate: bool,
}

impl Default for ErrorControl {
    /// A floor of 1e-20 m/s, no extrapolation.
    fn default() -> Self {
        Self {
            slip_rate_floor: 1e-20,
            extrapolate: false,
        }
    }
}

/// Where a doubled step began, where its first half ended, where the whole ends at once.
#[derive(Debug)]
pub(crate) struct Doubling<T, const C: usize> {
    pub(crate) start: Accepted<T, C>,
    half: Accepted<T, C>,
    whole: Accepted<T, C>,
    /// The size of the step that `half` is the result of, if it began at `start`.
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
    pub(crate) fn double(&mut self, dt: f64, control: &ErrorControl) -> Result<f64, Failure> {
        let mut doubling = self.doubling.take().unwrap_or_else(|| {
            Box::new(Doubling {
                start: self.now.clone(),
                half: self.now.clone(),
                whole: self.now.clone(),
                half_size: None,
            })
        });
        let result = self.double_with(&mut doubling, dt, control);
        if result.is_err() {
            self.now.copy_from(&doubling.start);
        }
        self.doubling = Some(doubling);
        result
    }

    fn double_with(
        &mut self,
        doubling: &mut Doubling<S::State, C>,
        dt: f64,
        control: &ErrorControl,
    ) -> Result<f64, Failure> {
        // A second try from the same place at half the size: the first half is the new whole.
        let again = self.now.clock == doubling.start.clock && self.now.clock.step > 0;
        let known = again && doubling.half_size == Some(dt);
        doubling.start.copy_from(&self.now);
        if known {
            std::mem::swap(&mut doubling.whole, &mut doubling.half);
        } else {
            doubling.half_size = None;
            self.step(dt)?;
            doubling.whole.copy_from(&self.now);
            self.now.copy_from(&doubling.start);
        }
        doubling.half_size = None;
        self.step(0.5 * dt)?;
        doubling.half.copy_from(&self.now);
        doubling.half_size = Some(0.5 * dt);
        self.step(0.5 * dt)?;
        let order = self.order();
        let scale = 1.0 / ((1 << order) as f64 - 1.0);
        let error = scale * self.distance(&doubling.whole, control.slip_rate_floor);
        if control.extrapolate && error.is_finite() {
            self.extrapolate(&doubling.whole, scale);
        }
        let (first, second) = (doubling.half.report, &mut self.now.report);
        for (sum, share) in [
            (&mut second.coupling_iterations, first.coupling_iterations),
            (&mut second.solver_iterations, first.solver_iterations),
        ] {
            *sum += share;
        }
        second.fell_back |= first.fell_back;
        Ok(error)
    }

    fn distance(&self, whole: &Accepted<S::State, C>, floor: f64) -> f64 {
        let mut largest: f64 = 0.0;
        for (k, &vertex) in self.vertices.iter().enumerate() {
            let (fine, coarse) = (self.now.velocity[vertex], whole.velocity[vertex]);
            let rate = (fine - coarse).norm() / (fine.norm().max(coarse.norm()) + floor);
            let state = self.now.states[k].distance(whole.states[k]);
            largest = largest.max(rate).max(state);
            // The maximum forgets what is not a number.
            if rate.is_nan() || state.is_nan() {
                return f64::NAN;
            }
        }
        largest
    }

    /// Adds `share` times what the halves changed of the whole.
    fn extrapolate(&mut self, whole: &Accepted<S::State, C>, share: f64) {
        for (now, whole) in [
            (&mut self.now.displacement, &whole.displacement),
            (&mut self.now.velocity, &whole.velocity),
            (&mut self.now.acceleration, &whole.acceleration),
        ] {
            for (now, whole) in now.iter_mut().zip(whole) {
                *now += (*now - whole) * share;
            }
        }
        for (now, whole) in self.now.states.iter_mut().zip(&whole.states) {
            let fine = now.value();
            *now = S::State::from_value(fine + share * (fine - whole.value()));
        }
    }
}
