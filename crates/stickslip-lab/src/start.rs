//! Starts of a fit, computed from the curve.

use std::ops::Range;

use crate::curve::Work;
use crate::load::LoadHistory;
use crate::model::Model;
use crate::parameters::{Parameter, Parameters, StateParameters};
use crate::record::Record;

/// The local error of curves that are only compared.
const TOLERANCE: f64 = 1e-2;
/// The factors on the direct effect that the curve shows: a soft machine shows less than `a`.
const DIRECT_EFFECTS: [f64; 3] = [0.7, 1.5, 3.0];
/// The factors on the steepest rise of the curve, which is less steep than the machine's.
const STIFFNESSES: [f64; 2] = [1.0, 2.0];
/// The ratio of neighbouring slip distances.
const RATIO: f64 = 2.5;
/// The shares of the first of two states in `b1 + b2`.
const SHARES: [f64; 3] = [0.3, 0.7, 1.3];

/// What the curve shows without a model.
pub(crate) struct Features {
    /// The slope of the steady levels in `ln V`.
    a_minus_b: f64,
    /// The largest deviation from a level per `ln V`.
    pub(crate) direct_effect: f64,
    /// The steepest rise behind a velocity step [1/m].
    pub(crate) stiffness: f64,
    /// The displacement of the load point between samples and over the longest piece \[m\].
    pub(crate) distances: (f64, f64),
}

/// A piece of constant velocity and its samples.
struct Piece {
    velocity: f64,
    start: f64,
    samples: Range<usize>,
}

fn pieces(load: &LoadHistory, times: &[f64]) -> Vec<Piece> {
    let (first, last) = (times[0], times[times.len() - 1]);
    let mut pieces = vec![Piece {
        velocity: load.velocity_before(first),
        start: first,
        samples: 0..times.len(),
    }];
    for (start, velocity) in load.changes(first, last) {
        let from = times.partition_point(|&time| time <= start);
        if let Some(before) = pieces.last_mut() {
            before.samples.end = from;
        }
        pieces.push(Piece {
            velocity,
            start,
            samples: from..times.len(),
        });
    }
    pieces
}

impl Features {
    pub(crate) fn new(record: &Record, load: &LoadHistory, v0: f64, trend: &[f64]) -> Self {
        let (times, mu) = (record.times(), record.friction());
        let pieces = pieces(load, times);
        // The mean over the last quarter of the time, of the last sample at least.
        let level = |piece: &Piece, of: &[f64]| {
            let Range { start, end } = piece.samples;
            let quarter = times[end - 1] - 0.25 * (times[end - 1] - piece.start);
            let from = times.partition_point(|&time| time < quarter);
            let last = &of[from.clamp(start, end - 1)..end];
            last.iter().sum::<f64>() / last.len() as f64
        };
        let full = |piece: &&Piece| piece.velocity > 0.0 && !piece.samples.is_empty();
        let levels: Vec<[f64; 3]> = (pieces.iter().filter(full))
            .map(|piece| {
                let ln_rate = (piece.velocity / v0).ln();
                [ln_rate, level(piece, trend), level(piece, mu)]
            })
            .collect();
        let spread = spread(mu.iter().copied());
        let mut direct_effect = 0.0_f64;
        let mut stiffness = 0.0_f64;
        for pair in pieces.windows(2) {
            let [before, after] = pair else { continue };
            if before.samples.is_empty() || after.samples.is_empty() || after.velocity <= 0.0 {
                continue;
            }
            let faster = (after.velocity / before.velocity).ln();
            let from = if before.velocity > 0.0 {
                level(before, mu)
            } else {
                mu[before.samples.end - 1]
            };
            let excess = |n: usize| faster.signum() * (mu[n] - from);
            let peak = after.samples.clone().map(excess).fold(0.0, f64::max);
            if faster.is_finite() {
                direct_effect = direct_effect.max(peak / faster.abs());
            }
            for n in after.samples.clone() {
                let moved = after.velocity * (times[n] - after.start);
                if excess(n) >= 0.5 * peak && moved > 0.0 {
                    stiffness = stiffness.max(excess(n) / moved);
                }
                if excess(n) >= peak {
                    break;
                }
            }
        }
        if direct_effect == 0.0 {
            direct_effect = spread / std::f64::consts::LN_10;
        }
        let moving = || {
            pieces
                .iter()
                .filter(full)
                .filter(|piece| piece.samples.len() > 1)
        };
        let length = |piece: &Piece| {
            piece.velocity * (times[piece.samples.end - 1] - times[piece.samples.start])
        };
        let spacing = |piece: &Piece| length(piece) / (piece.samples.len() - 1) as f64;
        let longest = moving().map(length).fold(0.0, f64::max);
        let shortest = moving().map(spacing).fold(longest, f64::min);
        if stiffness == 0.0 {
            stiffness = spread / longest;
        }
        Self {
            a_minus_b: slope(&levels),
            direct_effect,
            stiffness,
            distances: (shortest, longest),
        }
    }

    /// Slip distances from twice the distance of the samples to the length of a piece.
    fn slip_distances(&self) -> Vec<f64> {
        let (low, high) = (2.0 * self.distances.0, self.distances.1);
        let count = ((high / low).ln() / RATIO.ln()).ceil().clamp(1.0, 12.0) as i32;
        let ratio = (high / low).powf(1.0 / f64::from(count));
        (0..=count).map(|k| low * ratio.powi(k)).collect()
    }

    /// Parameters with one state, and with two.
    fn candidates(&self, model: &Model<'_>) -> Vec<Parameters> {
        let stiffnesses = if model.free.contains(&Parameter::Stiffness) {
            STIFFNESSES
                .iter()
                .map(|factor| factor * self.stiffness)
                .collect()
        } else {
            vec![model.fixed.stiffness]
        };
        let lengths = self.slip_distances();
        let mut candidates = Vec::new();
        for stiffness in stiffnesses {
            for larger in DIRECT_EFFECTS {
                let a = larger * self.direct_effect;
                let b = a - self.a_minus_b;
                let mut add = |states: Vec<StateParameters>| {
                    candidates.push(Parameters {
                        a,
                        states,
                        stiffness,
                        trend: 0.0,
                        ..model.fixed.clone()
                    });
                };
                for &one in &lengths {
                    if model.laws.len() == 1 {
                        add(vec![StateParameters::steady(b, one)]);
                        continue;
                    }
                    // Two different laws can have either order.
                    let ordered = model.laws[0].name() == model.laws[1].name();
                    let apart = |two: f64| two > RATIO * one || (!ordered && one > RATIO * two);
                    for &two in lengths.iter().filter(|two| apart(**two)) {
                        for share in SHARES {
                            add(vec![
                                StateParameters::steady(share * b, one),
                                StateParameters::steady((1.0 - share) * b, two),
                            ]);
                        }
                    }
                }
            }
        }
        candidates
    }

    /// The best starts with different slip distances, at most `count`, and the number of those tried.
    pub(crate) fn starts(
        &self,
        model: &Model<'_>,
        bounds: &[(f64, f64)],
        count: usize,
        work: &mut Work,
    ) -> (Vec<Vec<f64>>, usize) {
        let mut candidates = self.candidates(model);
        let tried = candidates.len();
        // Near the critical stiffness curves oscillate, and below it they are records of no experiment.
        candidates.retain(|start| start.critical_stiffness() < start.stiffness);
        let mut ranked = Vec::new();
        for candidate in candidates {
            let mut values = model.values(&candidate);
            for (value, &(low, high)) in values.iter_mut().zip(bounds) {
                *value = value.clamp(low, high);
            }
            let mut parameters = model.parameters(&values);
            if let Ok(change) = model.change(&parameters, TOLERANCE, work) {
                let squares = level(model, &mut parameters, &change);
                if squares.is_finite() {
                    ranked.push((squares, parameters));
                }
            }
        }
        ranked.sort_by(|one, two| one.0.total_cmp(&two.0));
        let lengths = |parameters: &Parameters| -> Vec<f64> {
            parameters.states.iter().map(|s| s.slip_distance).collect()
        };
        let mut chosen: Vec<Parameters> = Vec::new();
        // First different in `a` or `k`, too.
        for both in [true, false] {
            for (_, start) in &ranked {
                let new = chosen.iter().all(|other| {
                    lengths(other) != lengths(start)
                        && (!both || (other.a, other.stiffness) != (start.a, start.stiffness))
                });
                if new && chosen.len() < count {
                    chosen.push(start.clone());
                }
            }
        }
        let starts = chosen.iter().map(|start| model.values(start));
        (starts.collect(), tried)
    }
}

/// Sets `mu0` and the trend, where they are fitted, to those of the least squares, and returns their sum.
fn level(model: &Model<'_>, parameters: &mut Parameters, change: &[f64]) -> f64 {
    let record = model.record;
    let [free_level, free_trend] = [Parameter::ReferenceFriction, Parameter::Trend]
        .map(|parameter| model.free.contains(&parameter));
    let rest = |n: usize, parameters: &Parameters| {
        let fixed = parameters.reference_friction + parameters.trend * model.trend[n];
        record.friction()[n] - change[n] - fixed
    };
    let mut sums = [0.0; 5];
    for (n, &weight) in record.weights().iter().enumerate() {
        let (x, y) = (model.trend[n], rest(n, parameters));
        for (sum, term) in sums.iter_mut().zip([1.0, x, x * x, y, x * y]) {
            *sum += weight * term;
        }
    }
    let [count, x, xx, y, xy] = sums;
    let determinant = count * xx - x * x;
    if free_level && free_trend && determinant > 0.0 {
        parameters.reference_friction += (y * xx - x * xy) / determinant;
        parameters.trend += (count * xy - x * y) / determinant;
    } else if free_level {
        parameters.reference_friction += y / count;
    } else if free_trend {
        parameters.trend += xy / xx;
    }
    let squares = record.weights().iter().enumerate();
    squares
        .map(|(n, weight)| weight * rest(n, parameters).powi(2))
        .sum()
}

fn spread(values: impl Iterator<Item = f64>) -> f64 {
    let ends = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = values.fold(ends, |(low, high), x| (low.min(x), high.max(x)));
    high - low
}

/// The slope of levels in `ln V`, beside a trend if there are enough levels for one; 0 for one velocity.
fn slope(levels: &[[f64; 3]]) -> f64 {
    let count = levels.len() as f64;
    let mean = |k: usize| levels.iter().map(|level| level[k]).sum::<f64>() / count;
    let means = [mean(0), mean(1), mean(2)];
    let product = |i: usize, j: usize| {
        let terms = levels.iter().map(|l| (l[i] - means[i]) * (l[j] - means[j]));
        terms.sum::<f64>()
    };
    let (vv, vt, tt) = (product(0, 0), product(0, 1), product(1, 1));
    let determinant = vv * tt - vt * vt;
    if levels.len() > 2 && determinant > 1e-6 * vv * tt {
        (product(0, 2) * tt - product(1, 2) * vt) / determinant
    } else if vv > 0.0 {
        product(0, 2) / vv
    } else {
        0.0
    }
}
