//! What a step starts from and ends with.

use nalgebra::SVector;
use stickslip_state::StateVariable;
use stickslip_time::Motion;

use crate::StepReport;
use crate::clock::Clock;

/// An accepted step: motion of all vertices, state of the frictional ones.
#[derive(Debug, Clone)]
pub(crate) struct Accepted<T, const C: usize> {
    pub(crate) clock: Clock,
    pub(crate) displacement: Vec<SVector<f64, C>>,
    pub(crate) velocity: Vec<SVector<f64, C>>,
    /// Empty without mass.
    pub(crate) acceleration: Vec<SVector<f64, C>>,
    /// What the scheme carries on beside the motion; empty if nothing, and without mass.
    pub(crate) carried: Vec<SVector<f64, C>>,
    pub(crate) states: Vec<T>,
    /// The velocity of the frictional vertices one step earlier, and the step since; empty without
    /// state.
    pub(crate) earlier: Vec<SVector<f64, C>>,
    pub(crate) last_step: f64,
    pub(crate) report: StepReport,
}

impl<T: StateVariable, const C: usize> Accepted<T, C> {
    /// The motion of component `c` of vertex `i`.
    #[inline]
    pub(crate) fn motion(&self, i: usize, c: usize) -> Motion {
        let or_zero = |field: &[SVector<f64, C>]| field.get(i).map_or(0.0, |value| value[c]);
        Motion {
            displacement: self.displacement[i][c],
            velocity: self.velocity[i][c],
            acceleration: or_zero(&self.acceleration),
            carried: or_zero(&self.carried),
        }
    }

    /// `old + weight (self - old)`.
    pub(crate) fn move_beyond(&mut self, old: &Self, weight: f64) {
        for (now, old) in [
            (&mut self.displacement, &old.displacement),
            (&mut self.velocity, &old.velocity),
        ] {
            for (now, old) in now.iter_mut().zip(old) {
                *now = old + (*now - old) * weight;
            }
        }
        for (now, old) in self.states.iter_mut().zip(&old.states) {
            let (to, from) = (now.value(), old.value());
            *now = T::from_value(from + weight * (to - from));
        }
    }

    /// Takes the values of another step of the same scene.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.clock = other.clock;
        self.displacement.copy_from_slice(&other.displacement);
        self.velocity.copy_from_slice(&other.velocity);
        self.acceleration.copy_from_slice(&other.acceleration);
        self.carried.copy_from_slice(&other.carried);
        self.states.copy_from_slice(&other.states);
        self.earlier.copy_from_slice(&other.earlier);
        self.last_step = other.last_step;
        self.report = other.report;
    }

    /// Adds `share` times the difference from `coarser`. Slip rates are extrapolated by their
    /// logarithm, in which their growth is nearly linear, and keep their direction.
    pub(crate) fn correct(&mut self, coarser: &Self, frictional: &[usize], share: f64) {
        for (fine, coarse) in [
            (&mut self.displacement, &coarser.displacement),
            (&mut self.acceleration, &coarser.acceleration),
            (&mut self.carried, &coarser.carried),
        ] {
            for (fine, coarse) in fine.iter_mut().zip(coarse) {
                *fine += (*fine - coarse) * share;
            }
        }
        let mut sliding = frictional.iter().copied().peekable();
        for (i, (fine, coarse)) in self.velocity.iter_mut().zip(&coarser.velocity).enumerate() {
            let slides = sliding.next_if_eq(&i).is_some();
            let ratio = fine.norm() / coarse.norm();
            if slides && (0.1..10.0).contains(&ratio) && fine.dot(coarse) > 0.0 {
                *fine *= (share * ratio.ln()).exp();
            } else {
                *fine += (*fine - coarse) * share;
            }
        }
        for (fine, coarse) in self.states.iter_mut().zip(&coarser.states) {
            let value = fine.value();
            *fine = T::from_value(value + share * (value - coarse.value()));
        }
    }
}
