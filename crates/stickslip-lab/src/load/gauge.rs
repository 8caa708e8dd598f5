//! The errors of a history that was measured.

use super::{LoadHistory, Piece};

/// The standard errors of the line of a piece.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct LineError {
    /// The mean time of its samples \[s\], at which the errors of displacement and velocity are independent.
    pub(super) middle: f64,
    /// The standard error of the displacement there \[m\]; 0 for a given history.
    pub(super) displacement: f64,
    /// The standard error of the velocity [m/s].
    pub(super) velocity: f64,
}

impl Piece {
    /// The change of the displacement at a time by errors of so many standard errors.
    fn moved(&self, time: f64, [displacement, velocity]: [f64; 2]) -> f64 {
        let LineError {
            middle,
            displacement: level,
            velocity: slope,
        } = self.error;
        displacement * level + velocity * slope * (time - middle)
    }

    /// The standard error of the displacement at a time, squared [m^2].
    fn variance(&self, time: f64) -> f64 {
        self.moved(time, [1.0, 0.0]).powi(2) + self.moved(time, [0.0, 1.0]).powi(2)
    }
}

impl LoadHistory {
    /// The largest standard error of the displacement at a corner \[m\]; 0 of a history that is given.
    pub(crate) fn displacement_error(&self) -> f64 {
        let ends = self.pieces.iter().skip(1).map(|next| next.start);
        let ends = ends.chain([self.end]);
        let variances = (self.pieces.iter().zip(ends))
            .map(|(piece, end)| piece.variance(piece.start).max(piece.variance(end)));
        variances.fold(0.0, f64::max).sqrt()
    }

    /// The history with lines that differ by `signs` standard errors of each displacement and velocity, number after number;
    /// the corners are where they meet, as long as these stay nearest.
    pub(crate) fn disturbed(&self, signs: impl Fn(usize) -> f64) -> Self {
        let by = |k: usize| [signs(2 * k), signs(2 * k + 1)];
        let mut disturbed = self.clone();
        for (k, piece) in self.pieces.iter().enumerate() {
            let start = piece.start;
            let velocity = piece.velocity + by(k)[1] * piece.error.velocity;
            let moved = piece.moved(start, by(k));
            let mut to = start;
            if let Some(before) = k.checked_sub(1) {
                let last = &self.pieces[before];
                let faster = last.velocity + by(before)[1] * last.error.velocity - velocity;
                let meeting = start + (moved - last.moved(start, by(before))) / faster;
                let end = self.pieces.get(k + 1).map_or(self.end, |next| next.start);
                let [low, high] = [last.start, end].map(|other| 0.5 * (start + other));
                if meeting > low && meeting < high {
                    to = meeting;
                }
            }
            let there = &mut disturbed.pieces[k];
            there.start = to;
            there.velocity = velocity;
            there.displacement = piece.displacement + moved + velocity * (to - start);
        }
        disturbed
    }

    /// The largest standard error of the time of a corner between two times \[s\].
    pub(crate) fn corner_error(&self, from: f64, to: f64) -> f64 {
        let pairs = self.pieces.windows(2).map(|pair| (&pair[0], &pair[1]));
        let inside = pairs.filter(|(_, piece)| piece.start >= from && piece.start < to);
        let errors = inside.map(|(before, behind)| {
            let time = behind.start;
            let variance = before.variance(time) + behind.variance(time);
            variance.sqrt() / (before.velocity - behind.velocity).abs()
        });
        errors.fold(0.0, f64::max)
    }
}
