//! What a curve shows without a model: steady levels, direct effect, stiffness.

use std::ops::Range;

use crate::load::LoadHistory;
use crate::record::Record;

/// Features of the curve that need no model.
pub(crate) struct Features {
    /// The slope of the steady levels in `ln V`.
    pub(crate) a_minus_b: f64,
    /// The largest deviation from a level per `ln V` behind a velocity step, or `a` by the relaxation in a hold.
    pub(crate) direct_effect: f64,
    /// The steepest rise behind a velocity step [1/m].
    pub(crate) stiffness: f64,
    /// The displacement of the load point between samples and over the longest piece \[m\].
    pub(crate) distances: (f64, f64),
    /// The slowest and the fastest slip rate [m/s]: those of slides, and `a/(k t)` at the end of a hold of `t`.
    pub(crate) rates: (f64, f64),
}

/// A piece of constant velocity and its samples.
struct Piece {
    velocity: f64,
    start: f64,
    samples: Range<usize>,
}

/// The slides and holds with samples.
fn pieces(load: &LoadHistory, times: &[f64]) -> Vec<Piece> {
    let (first, last) = (times[0], times[times.len() - 1]);
    let phases = load.phases(first, last);
    let from = |k: usize| match phases.get(k) {
        // A sample at a velocity step has the level before.
        Some(phase) if k > 0 => times.partition_point(|&time| time <= phase.start),
        Some(_) => 0,
        None => times.len(),
    };
    let pieces = phases.iter().enumerate().map(|(k, phase)| Piece {
        velocity: phase.velocity,
        start: phase.start,
        samples: from(k)..from(k + 1),
    });
    pieces.filter(|piece| !piece.samples.is_empty()).collect()
}

/// A record in pieces.
struct Curve<'a> {
    times: &'a [f64],
    friction: &'a [f64],
    pieces: Vec<Piece>,
}

impl Features {
    /// The features of a record; the stiffness [1/m] is given if it is known.
    pub(crate) fn new(
        record: &Record,
        load: &LoadHistory,
        v0: f64,
        trend: &[f64],
        stiffness: Option<f64>,
    ) -> Self {
        let curve = Curve {
            times: record.times(),
            friction: record.friction(),
            pieces: pieces(load, record.times()),
        };
        let moving = || curve.pieces.iter().filter(|piece| piece.velocity > 0.0);
        let levels: Vec<[f64; 3]> = moving()
            .map(|piece| {
                let ln_rate = (piece.velocity / v0).ln();
                [
                    ln_rate,
                    curve.level(piece, trend),
                    curve.level(piece, curve.friction),
                ]
            })
            .collect();
        let length = |piece: &Piece| {
            let Range { start, end } = piece.samples;
            piece.velocity * (curve.times[end - 1] - curve.times[start])
        };
        let spacing = |piece: &Piece| length(piece) / (piece.samples.len() - 1) as f64;
        let longest = moving().map(length).fold(0.0, f64::max);
        let several = moving().filter(|piece| piece.samples.len() > 1);
        let shortest = several.map(spacing).fold(longest, f64::min);
        let spread = curve.spread();
        let or = |value: f64, otherwise: f64| if value > 0.0 { value } else { otherwise };
        let found = or(curve.stiffness(), spread / longest);
        let direct_effect = (curve.steps()).max(curve.relaxation(stiffness.unwrap_or(found)));
        let direct_effect = or(direct_effect, or(spread, f64::MIN_POSITIVE));
        let found = or(found, 1.0 / or(longest, 1.0));
        let rates = curve.rates(direct_effect / stiffness.unwrap_or(found));
        Self {
            a_minus_b: slope(&levels),
            direct_effect,
            stiffness: found,
            distances: (or(shortest, 1.0), or(longest, 1.0)),
            rates,
        }
    }
}

impl Features {
    /// What several curves show of parameters that they share; their stiffness is that of the first. A soft machine shows less
    /// of the direct effect than a stiff one, and a curve of one velocity shows no `a - b`.
    pub(crate) fn of_all(each: &[Self]) -> Self {
        let largest = |of: fn(&Self) -> f64| each.iter().map(of).fold(0.0, f64::max);
        let least = |of: fn(&Self) -> f64| each.iter().map(of).fold(f64::INFINITY, f64::min);
        let slopes = each.iter().map(|features| features.a_minus_b);
        let slopes: Vec<f64> = slopes.filter(|slope| *slope != 0.0).collect();
        Self {
            a_minus_b: slopes.iter().sum::<f64>() / slopes.len().max(1) as f64,
            direct_effect: largest(|features| features.direct_effect),
            stiffness: each.first().map_or(1.0, |features| features.stiffness),
            distances: (
                least(|features| features.distances.0),
                largest(|features| features.distances.1),
            ),
            rates: (
                least(|features| features.rates.0),
                largest(|features| features.rates.1),
            ),
        }
    }
}

impl Curve<'_> {
    /// The mean over the last quarter of the time of a piece, of its last sample at least.
    fn level(&self, piece: &Piece, of: &[f64]) -> f64 {
        let Range { start, end } = piece.samples;
        let quarter = self.times[end - 1] - 0.25 * (self.times[end - 1] - piece.start);
        let from = self.times.partition_point(|&time| time < quarter);
        let last = &of[from.clamp(start, end - 1)..end];
        last.iter().sum::<f64>() / last.len() as f64
    }

    /// The slowest and the fastest slip rate, of a hold with the slip `a/k` per factor of e in time.
    fn rates(&self, relaxation: f64) -> (f64, f64) {
        let rates = self.pieces.iter().map(|piece| {
            if piece.velocity > 0.0 {
                return piece.velocity;
            }
            relaxation / (self.times[piece.samples.end - 1] - piece.start)
        });
        let rates = rates.filter(|rate| *rate > 0.0 && rate.is_finite());
        rates.fold((f64::INFINITY, 0.0), |(low, high), rate| {
            (low.min(rate), high.max(rate))
        })
    }

    fn spread(&self) -> f64 {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        let values = self.friction.iter();
        let (low, high) = values.fold(ends, |(low, high), &x| (low.min(x), high.max(x)));
        high - low
    }

    /// A piece that moves, the one before, the level before, and the sign of the change to come.
    fn changes(&self) -> impl Iterator<Item = (&Piece, &Piece, f64, f64)> {
        let pairs = self.pieces.windows(2).map(|pair| (&pair[0], &pair[1]));
        pairs
            .filter(|(_, after)| after.velocity > 0.0)
            .map(|(before, after)| {
                let from = if before.velocity > 0.0 {
                    self.level(before, self.friction)
                } else {
                    self.friction[before.samples.end - 1]
                };
                (
                    before,
                    after,
                    from,
                    (after.velocity - before.velocity).signum(),
                )
            })
    }

    /// The largest deviation from the level per `ln V` behind velocity steps; 0 without one.
    fn steps(&self) -> f64 {
        let mut largest = 0.0_f64;
        for (before, after, from, sign) in self.changes() {
            let excess = |n: usize| sign * (self.friction[n] - from);
            let peak = after.samples.clone().map(excess).fold(0.0, f64::max);
            if before.velocity > 0.0 {
                largest = largest.max(peak / (after.velocity / before.velocity).ln().abs());
            }
        }
        largest
    }

    /// The steepest rise per displacement of the load point behind a change of its velocity, up to the peak; 0 without a
    /// change.
    fn stiffness(&self) -> f64 {
        let mut steepest = 0.0_f64;
        for (_, after, from, sign) in self.changes() {
            let excess = |n: usize| sign * (self.friction[n] - from);
            let peak = after.samples.clone().map(excess).fold(0.0, f64::max);
            for n in after.samples.clone() {
                let moved = after.velocity * (self.times[n] - after.start);
                // Less is noise.
                if excess(n) >= 0.5 * peak && moved > 0.0 {
                    steepest = steepest.max(excess(n) / moved);
                }
                if excess(n) >= peak {
                    break;
                }
            }
        }
        steepest
    }

    /// The largest `a` by which friction relaxes in a hold as it does, `a ln(1 + k V t/a)` after a slide at `V` without an
    /// evolution effect; 0 without a hold.
    fn relaxation(&self, stiffness: f64) -> f64 {
        let mut largest = 0.0_f64;
        for pair in self.pieces.windows(2) {
            let (before, hold) = (&pair[0], &pair[1]);
            if before.velocity <= 0.0 || hold.velocity != 0.0 {
                continue;
            }
            let last = hold.samples.end - 1;
            let drop = self.level(before, self.friction) - self.friction[last];
            let unloaded = stiffness * before.velocity * (self.times[last] - hold.start);
            // `a ln(1 + x/a)` increases from 0 to x: the iteration from above contracts.
            let mut a = drop;
            for _ in 0..20 {
                a = drop / (unloaded / a).ln_1p();
            }
            if drop > 0.0 && unloaded > drop {
                largest = largest.max(a);
            }
        }
        largest
    }
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
