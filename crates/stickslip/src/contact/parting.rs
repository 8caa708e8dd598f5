//! Where a step may have several solutions, and which of them continues the last one.

use nalgebra::SVector;
use stickslip_friction::{FrictionLaw, modulus};

use super::ContactSet;

/// A slip rate within this factor of the last one continues it, or of what is expected within this factor...
const NEAR: f64 = 2.0;
/// ...unless slip is enough in the step for the state to forget where it began, and it leaves that by that factor as well,
/// or there is no state that could hold it there.
const SLIPPED: f64 = 1.0;
/// A slip rate that is followed as the step grows falls behind where it leads by no more than this in a short part, both by
/// their logarithms: a solution that ends runs ahead of that, and one that begins close behind does not lead on from it...
const BENT: f64 = 0.5;
/// ...unless the part is shorter than this share of what is reached.
const SLIGHT: f64 = 1e-3;
/// Between two rates the slope of friction is looked at once in this factor, at the ends and in the middle at least.
const COARSE: f64 = 16.0;
/// Between them and around them by this factor...
const AROUND: f64 = 4.0;
/// ...it is bounded from what it is once in this factor...
const FINE: f64 = 1.5;
/// ...as many times at most.
const MOST: usize = 64;
/// The steepest weakening is searched at so many slip rates, down to some 1e-24 of the fastest...
const SAMPLES: u32 = 950;
/// ...this far apart in their logarithm.
const SPACING: f64 = 0.06;

impl<const C: usize> ContactSet<C> {
    /// Whether friction may weaken with the slip rate anywhere.
    pub(crate) fn may_weaken(&self) -> bool {
        let mut contacts = self.contacts.iter();
        contacts.any(|contact| contact.interface.may_weaken())
    }

    /// Whether friction without a state may weaken: what it holds may rest or slide under one force.
    pub(crate) fn may_rest_or_slide(&self) -> bool {
        let mut contacts = self.contacts.iter();
        contacts.any(|contact| contact.interface.may_weaken() && !contact.interface.has_state())
    }

    /// The first frictional vertex, by its number here, whose slip rate has left `from` by more than a factor through
    /// rates at which friction, its states following, weakens: there may be another solution, nearer to `from`.
    ///
    /// `from` are the last velocities and those expected. After a whole step, what is near them continues them where a
    /// state remembers or the vertex rests: slip that has no state may stop on the way, and another solution be near. Of a
    /// part of a step that adds this share to what is reached, what is near them and does not fall behind continues them.
    pub(crate) fn parted(
        &mut self,
        from: [&[SVector<f64, C>]; 2],
        to: &[SVector<f64, C>],
        part: Option<f64>,
    ) -> Option<usize> {
        let mut eliminated = false;
        let mut parted = None;
        for k in 0..self.vertices.len() {
            let ([last, expected], end) = (from.map(|v| self.rate(k, v)), self.rate(k, to));
            let expected = expected.max(last / NEAR).min(NEAR * last);
            let [low, high] = [last.min(expected), last.max(expected)];
            let is_near = end <= NEAR * high && NEAR * end >= low;
            let continues = match part {
                Some(part) => {
                    self.shortfall(k, from, to) <= BENT * part.max(SLIGHT) * last.max(end)
                }
                None if self.remembers(k) => !self.forgets(k, end),
                None => end == 0.0,
            };
            if is_near && continues {
                continue;
            }
            if !eliminated {
                self.eliminate(true);
                eliminated = true;
            }
            if self.least_slope(k, [low.min(end), high.max(end)], COARSE) < 0.0 {
                parted = Some(k);
                break;
            }
        }
        if eliminated {
            self.eliminate(false);
        }
        parted
    }

    /// By how much friction, its states following, may weaken with the slip rate at each frictional vertex from its
    /// rates in `from` to that in `to`, and somewhat beyond: 0 or a negative slope [N s/m].
    pub(crate) fn weakest(
        &mut self,
        from: [&[SVector<f64, C>]; 2],
        to: &[SVector<f64, C>],
        slopes: &mut [f64],
    ) {
        self.eliminate(true);
        for (k, slope) in slopes.iter_mut().enumerate() {
            let ([low, high], end) = (self.rates(k, from), self.rate(k, to));
            let around = [low.min(end) / AROUND, high.max(end) * AROUND * AROUND];
            *slope = self.least_slope(k, around, FINE).min(0.0);
        }
        self.eliminate(false);
    }

    /// The steepest weakening of friction, its states following, at the frictional vertex number `k`, among slip rates up
    /// to `fastest`: the slope, 0 or negative [N s/m], and where it is [m/s]. Not a number where a law has no answer.
    pub(crate) fn steepest(&self, k: usize, fastest: f64) -> (f64, f64) {
        let law = self.law_at(k);
        let slope = |rate: f64| law.coefficient_and_rate_slope(rate, ()).1;
        let (mut steepest, mut at) = (0.0, 0.0);
        for n in 0..SAMPLES {
            let rate = fastest * (-SPACING * f64::from(n)).exp();
            let found = slope(rate);
            if found.is_nan() {
                return (found, rate);
            }
            if found < steepest {
                (steepest, at) = (found, rate);
            }
        }
        // Between its neighbours the slope has one minimum: thirds.
        let (mut low, mut high) = (at * (-SPACING).exp(), (at * SPACING.exp()).min(fastest));
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

    /// The largest `b/a` of all contacts at a slip rate and their states in use: what a factor in the state changes of
    /// friction over what the same factor in the slip rate changes.
    pub(crate) fn effect_ratio(&self, slip_rate: f64) -> f64 {
        let ratios = self.contacts.iter().flat_map(|contact| {
            (0..contact.part.vertices.len()).map(move |k| {
                let [direct, evolving] = contact.interface.effects(k, slip_rate);
                if evolving == 0.0 {
                    0.0
                } else {
                    evolving / direct
                }
            })
        });
        ratios.fold(0.0, f64::max)
    }

    /// Whether slip leads a state at a frictional vertex away from where it began.
    fn forgets(&self, k: usize, slip_rate: f64) -> bool {
        self.shares_of(k).any(|(contact, place)| {
            let states = &contact.interface;
            states.distance_from_start(place) > NEAR.ln()
                && states.change_by_slip(place, slip_rate) > SLIPPED
        })
    }

    /// By how much the slip at a frictional vertex has fallen behind, on its way from the last velocity, where it was
    /// expected to lead [m/s].
    fn shortfall(&self, k: usize, from: [&[SVector<f64, C>]; 2], to: &[SVector<f64, C>]) -> f64 {
        let slip =
            |velocity: &[SVector<f64, C>]| self.slip_velocity(k, &velocity[self.vertices[k]]);
        let ([last, expected], end) = (from.map(slip), slip(to));
        let beyond = end - expected;
        if (expected - last).dot(&beyond) < 0.0 {
            modulus(&beyond)
        } else {
            0.0
        }
    }

    /// Whether a frictional vertex has a state.
    fn remembers(&self, k: usize) -> bool {
        self.shares_of(k)
            .any(|(contact, _)| contact.interface.has_state())
    }

    fn rate(&self, k: usize, velocity: &[SVector<f64, C>]) -> f64 {
        modulus(&self.slip_velocity(k, &velocity[self.vertices[k]]))
    }

    fn rates(&self, k: usize, from: [&[SVector<f64, C>]; 2]) -> [f64; 2] {
        let [one, other] = from.map(|velocity| self.rate(k, velocity));
        [one.min(other), one.max(other)]
    }

    /// The least slope of the frictional force among slip rates from one to another, about a factor apart.
    fn least_slope(&self, k: usize, [low, high]: [f64; 2], factor: f64) -> f64 {
        let low = low.max(high * f64::EPSILON).max(f64::MIN_POSITIVE);
        let width = (high / low).ln().max(0.0);
        let count = (width / factor.ln()).clamp(2.0, MOST as f64).ceil();
        let slopes = (0..=count as usize).map(|i| {
            let rate = low * (width * (i as f64 / count)).exp();
            self.law_at(k).coefficient_and_rate_slope(rate, ()).1
        });
        slopes.fold(f64::INFINITY, f64::min)
    }
}
