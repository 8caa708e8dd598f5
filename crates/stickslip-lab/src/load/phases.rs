//! Slides and holds: the pieces of a history without those that do not matter.

use super::LoadHistory;

/// The ratio of velocities between which a slide goes on: the pieces of a ramp, and the noise of displacements with a
/// resolution of 0.
const NO_STEP: f64 = 1.5;
/// The share of the velocity of its neighbours below which a piece is a hold: velocity steps of one experiment span two
/// decades, and the creep of a machine that is at rest is below three.
const AT_REST: f64 = 1e-3;

/// A slide or a hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Phase {
    /// Its begin \[s\]; the first one begins at the first sample.
    pub(crate) start: f64,
    /// The velocity at its begin [m/s]; 0 in a hold.
    pub(crate) velocity: f64,
}

impl LoadHistory {
    /// The slides and holds between two times \[s\], at least one.
    ///
    /// A piece is a hold if its speed is below a thousandth of that of a neighbour that slides. Holds in a row are one, and
    /// so are slides whose velocities differ by less than a factor of 1.5 from the first one. A ramp is part of both
    /// neighbours, up to its middle: it is shorter than both, and its velocity between theirs.
    pub(crate) fn phases(&self, from: f64, to: f64) -> Vec<Phase> {
        let mut all = vec![Phase {
            start: from,
            velocity: self.velocity_before(from),
        }];
        let changes = self.changes(from, to);
        all.extend(changes.map(|(start, velocity)| Phase { start, velocity }));
        let rests = at_rest(&all);
        for (phase, rests) in all.iter_mut().zip(rests) {
            if rests {
                phase.velocity = 0.0;
            }
        }
        join(&mut all);
        while remove_ramps(&mut all, to) {
            join(&mut all);
        }
        all
    }

    /// Whether the load point rests at some time from one to another \[s\]: it is slower there than a thousandth of its speed
    /// before or behind.
    pub fn has_hold(&self, from: f64, to: f64) -> bool {
        self.phases(from, to)
            .iter()
            .any(|phase| phase.velocity == 0.0)
    }
}

/// Joins holds in a row, and slides whose velocities hardly change.
fn join(all: &mut Vec<Phase>) {
    all.dedup_by(|next, last| {
        let ratio = next.velocity / last.velocity;
        next.velocity == last.velocity || (NO_STEP.recip()..=NO_STEP).contains(&ratio)
    });
}

/// Removes the ramps of phases up to an end, and whether there were any. Of two in a row the shorter one is removed.
fn remove_ramps(all: &mut Vec<Phase>, to: f64) -> bool {
    let length = |k: usize| all.get(k + 1).map_or(to, |next| next.start) - all[k].start;
    let is_ramp = |k: usize| {
        if k == 0 || k + 1 >= all.len() {
            return false;
        }
        let [before, at, behind] = [k - 1, k, k + 1].map(|k| all[k].velocity);
        let between = before.min(behind) < at && at < before.max(behind);
        between && length(k) < length(k - 1).min(length(k + 1))
    };
    let kept = (0..all.len()).filter(|&k| !is_ramp(k)).map(|k| {
        let Phase {
            mut start,
            velocity,
        } = all[k];
        if k > 0 && is_ramp(k - 1) {
            start = 0.5 * (all[k - 1].start + start);
        }
        Phase { start, velocity }
    });
    let kept: Vec<Phase> = kept.collect();
    let removed = kept.len() < all.len();
    *all = kept;
    removed
}

/// True for each piece that is a hold. Its neighbours are the next pieces that are not holds: several may be in a row.
fn at_rest(all: &[Phase]) -> Vec<bool> {
    let mut rests: Vec<bool> = all.iter().map(|phase| phase.velocity == 0.0).collect();
    loop {
        let mut fastest = vec![0.0_f64; all.len()];
        let mut neighbour = 0.0;
        for (k, phase) in all.iter().enumerate() {
            fastest[k] = neighbour;
            if !rests[k] {
                neighbour = phase.velocity.abs();
            }
        }
        neighbour = 0.0;
        let mut settled = true;
        for (k, phase) in all.iter().enumerate().rev() {
            let speed = phase.velocity.abs();
            if !rests[k] {
                if speed < AT_REST * fastest[k].max(neighbour) {
                    rests[k] = true;
                    settled = false;
                } else {
                    neighbour = speed;
                }
            }
        }
        if settled {
            return rests;
        }
    }
}
