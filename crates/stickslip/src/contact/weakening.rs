//! Changes of friction with the slip rate, and its weakening.

use std::ops::Range;

use nalgebra::SVector;
use stickslip_friction::{FrictionLaw, modulus};
use stickslip_solvers::{for_contact, gather_contact};

use super::{ContactSet, Trial};
use crate::numerics::NUMERICS;

impl<const C: usize> ContactSet<C> {
    /// Whether friction can weaken with the slip rate at some vertex.
    pub(crate) fn may_weaken(&self) -> bool {
        let mut contacts = self.contacts.iter();
        contacts.any(|contact| contact.trial.may_weaken())
    }

    /// The least slope of the frictional force, with states condensed, at each frictional vertex between the slip rates
    /// of two velocities, 0 where it does not weaken [N s/m]. The states in use are those of the latter velocity.
    /// Returns the number of weakening vertices.
    pub(crate) fn least_slopes(
        &mut self,
        before: &[SVector<f64, C>],
        now: &[SVector<f64, C>],
        slopes: &mut [f64],
    ) -> usize {
        let spacing = NUMERICS.slope_spacing;
        let this = &*self;
        let at_ends = |places: Range<usize>, slopes: &mut [f64]| {
            let (mut weakening, mut apart) = (0, false);
            for (k, slope) in places.zip(slopes) {
                let (start, end) = (this.rate(k, before), this.rate(k, now));
                if start == 0.0 && end == 0.0 {
                    // It rests, and there is no rate in between.
                    *slope = 0.0;
                    continue;
                }
                let here = this.slope_at_end(k, end);
                weakening += usize::from(here < 0.0);
                *slope = here.min(0.0);
                apart |= start > spacing * end || end > spacing * start;
            }
            (weakening, apart)
        };
        let both = |a: (usize, bool), b: (usize, bool)| (a.0 + b.0, a.1 || b.1);
        let (weakening, apart) = gather_contact(slopes.len(), &mut *slopes, &at_ends, &both);
        if apart {
            self.eliminate(true);
            let this = &*self;
            for_contact(slopes.len(), slopes, &|places, slopes| {
                for (k, slope) in places.zip(slopes) {
                    let (start, end) = (this.rate(k, before), this.rate(k, now));
                    if start > 0.0 || end > 0.0 {
                        *slope = slope.min(this.least_slope(k, start, end));
                    }
                }
            });
            self.eliminate(false);
        }
        weakening
    }

    /// The slope of the frictional force with condensed states, at the slip rate of the states in use.
    fn slope_at_end(&self, k: usize, slip_rate: f64) -> f64 {
        let slopes = self.shares_of(k).map(|(contact, place)| {
            let [normal, _] = contact.forces[place];
            if normal > 0.0 && contact.trial.may_weaken() {
                normal * contact.trial.slope_at_end(place, slip_rate)
            } else {
                0.0
            }
        });
        slopes.sum()
    }

    /// The steepest weakening of friction with condensed states, at frictional vertex number `k`, among slip rates up
    /// to `fastest`: the slope, 0 or negative [N s/m], and its slip rate [m/s]. NaN where a law has no solution.
    pub(crate) fn steepest(&self, k: usize, fastest: f64) -> (f64, f64) {
        let law = self.law_at(k);
        let slope = |rate: f64| law.coefficient_and_rate_slope(rate, ()).1;
        let (mut steepest, mut at) = (0.0, 0.0);
        // Down to 1e-24 of the fastest.
        const DECADES: f64 = 24.0;
        let spacing = NUMERICS.slope_spacing.ln() / 8.0;
        let samples = (DECADES * std::f64::consts::LN_10 / spacing) as i32;
        for n in 0..samples {
            let rate = fastest * (-spacing * f64::from(n)).exp();
            let found = slope(rate);
            if found.is_nan() {
                return (found, rate);
            }
            if found < steepest {
                (steepest, at) = (found, rate);
            }
        }
        // Between its neighbours the slope has one minimum: thirds.
        let (mut low, mut high) = (at * (-spacing).exp(), (at * spacing.exp()).min(fastest));
        while high - low > 1e-6 * high {
            let (left, right) = ((2.0 * low + high) / 3.0, (low + 2.0 * high) / 3.0);
            if slope(left) < slope(right) {
                high = right;
            } else {
                low = left;
            }
        }
        let found = slope(high);
        if found < steepest {
            (found, high)
        } else {
            (steepest, at)
        }
    }

    /// The largest `b/a` of all contacts at a slip rate and their states in use: the change of friction by a factor in
    /// the state over the change by the same factor in the slip rate.
    pub(crate) fn b_over_a(&self, slip_rate: f64) -> f64 {
        let ratios = self.contacts.iter().flat_map(|contact| {
            (0..contact.part.vertices.len()).map(move |k| {
                let response = contact.trial.response(k, slip_rate);
                let (direct, evolving) = (slip_rate * response.rate_slope, response.state_slope);
                if evolving == 0.0 {
                    0.0
                } else {
                    evolving / direct
                }
            })
        });
        ratios.fold(0.0, f64::max)
    }

    fn rate(&self, k: usize, velocity: &[SVector<f64, C>]) -> f64 {
        modulus(&self.slip_velocity(k, &velocity[self.vertices[k]]))
    }

    /// The least slope of the frictional force between a slip rate and another one, excluding the latter.
    fn least_slope(&self, k: usize, from: f64, to: f64) -> f64 {
        let slopes = rates_between(from, to)
            .map(|rate| self.law_at(k).coefficient_and_rate_slope(rate, ()).1);
        slopes.fold(0.0, f64::min)
    }

    /// The least of 0 and `(friction(V) - force)/V` for slip rates `V` up to a given one, with condensed states, at
    /// frictional vertex number `k` [N s/m]; NaN where a law has no solution. Between two samples friction lies above its
    /// tangents or above its chord.
    pub(crate) fn least_chord(&mut self, k: usize, force: f64, fastest: f64) -> f64 {
        self.eliminate(true);
        let sample = |rate: f64| {
            let (friction, slope) = self.law_at(k).coefficient_and_rate_slope(rate, ());
            [rate, friction, slope]
        };
        let mut least = 0.0_f64;
        let mut lower = |rate: f64, friction: f64| {
            let chord = (friction - force) / rate;
            if chord < least || chord.is_nan() {
                least = chord;
            }
        };
        let mut above = sample(fastest);
        lower(above[0], above[1]);
        for below in rates_between(0.0, fastest).map(sample) {
            let ([v, f, s], [w, g, t]) = (below, above);
            lower(v, f);
            if s < t {
                let meet = ((f - g + t * w - s * v) / (t - s)).clamp(v, w);
                lower(meet, f + s * (meet - v));
            }
            above = below;
        }
        self.eliminate(false);
        least
    }
}

/// Slip rates between one and another, excluding the latter. Their ratio is
/// [`slope_spacing`](crate::numerics::Numerics::slope_spacing).
fn rates_between(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let smallest = (from.max(to) * f64::EPSILON).max(f64::MIN_POSITIVE);
    let (from, to) = (from.max(smallest), to.max(smallest));
    let width = (from / to).ln();
    let factors = width.abs() / NUMERICS.slope_spacing.ln();
    let count = if factors > 1.0 {
        factors.ceil() as usize
    } else {
        0
    };
    (1..=count).map(move |i| to * (width * (i as f64 / count as f64)).exp())
}

impl Trial {
    /// Whether friction depends on the slip rate at constant state: a vertex under such friction creeps.
    pub(crate) fn reads_rate(&self, count: usize) -> bool {
        let at = |k, rate| self.response(k, rate).coefficient;
        let mut rates = NUMERICS.sample_rates.iter();
        rates.any(|&rate| (0..count).any(|k| at(k, rate) != at(k, 0.0)))
    }
}
