//! The joints of lines: corners where they meet, and jumps where they do not.

use super::Piece;
use super::gauge::LineError;
use super::line::Line;
use super::noise::Noise;
use super::pieces::Pieces;

/// A line, its first sample, and that behind its last one.
type Part = (Line, usize, usize);

impl Pieces<'_> {
    /// Removes pieces beside jumps that the data do not defend: a jump is two corners, and a piece beside it lowers the sum of
    /// squares by twice the penalty, or is noise.
    pub(super) fn join(&mut self, penalty: f64) {
        loop {
            let (lines, left) = (self.lines(), self.left().collect::<Vec<_>>());
            let jumps = (1..lines.len()).filter(|&k| {
                let pair = [lines[k - 1], lines[k]];
                meeting(pair, self.times, self.displacements, penalty).is_none()
            });
            let beside = jumps.flat_map(|k| [left[k - 1], left[k]]);
            match beside.filter_map(|k| self.cheapest(k)).max() {
                Some(removal) if removal.cost <= 2.0 * penalty => self.remove_one(removal),
                _ => return,
            }
        }
    }
}

/// The time at which two lines in a row meet: between the halves of their samples, and such that to divide the samples there
/// raises the sum of squares by no more than the penalty; none for a jump.
fn meeting(
    [(before, from, limit), (behind, _, to)]: [Part; 2],
    times: &[f64],
    displacements: &[f64],
    penalty: f64,
) -> Option<f64> {
    let meeting = before.meets(&behind);
    let [earliest, latest] = [(from + limit) / 2, (limit + to) / 2].map(|n| times[n]);
    if !(meeting > earliest && meeting < latest) {
        return None;
    }
    let excess = |n: usize| {
        let [own, other] = if n < limit {
            [before, behind]
        } else {
            [behind, before]
        };
        let square = |line: Line| (displacements[n] - line.at(times[n])).powi(2);
        square(other) - square(own)
    };
    let at = times.partition_point(|&time| time < meeting);
    let moved = at.min(limit)..at.max(limit);
    (moved.map(excess).sum::<f64>() <= penalty).then_some(meeting)
}

/// The pieces along lines, which begin where two lines meet. A jump is a piece between the last sample of the one and the first
/// of the other.
pub(super) fn joined(
    lines: &[Part],
    times: &[f64],
    displacements: &[f64],
    noise: Noise,
) -> Vec<Piece> {
    let piece = |start: f64, line: &Line| Piece {
        start,
        displacement: line.at(start),
        velocity: line.velocity,
        error: noise.of_line(line),
    };
    let mut pieces = vec![piece(times[0], &lines[0].0)];
    for pair in lines.windows(2) {
        let pair = [pair[0], pair[1]];
        let [(before, ..), (behind, limit, _)] = pair;
        if let Some(meeting) = meeting(pair, times, displacements, noise.penalty(times.len())) {
            pieces.push(piece(meeting, &behind));
            continue;
        }
        let [start, end] = [times[limit - 1], times[limit]];
        let (low, high) = (before.at(start), behind.at(end));
        pieces.push(Piece {
            start,
            displacement: low,
            velocity: (high - low) / (end - start),
            error: LineError::default(),
        });
        pieces.push(piece(end, &behind));
    }
    pieces
}
