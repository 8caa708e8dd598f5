//! The polygon of a measured displacement with as few corners as the data defend.

use super::Piece;
use super::gauge::LineError;
use super::line::Line;
use super::noise::{Noise, rounding};
use super::pieces::Pieces;
use super::quantum::{is_exact, quantum, repeated};

/// The number of times that pieces are removed by the noise beside those that are left, at most. It rises as pieces are
/// removed, and ends with a removal of none.
const ROUNDS: usize = 30;

/// The pieces of the polygon, the first one from the first sample on. Times ascend strictly, and there are two or more.
///
/// Each piece is the least-squares line of its samples, and a corner the point where two lines meet. Where all changes are
/// multiples of a quantum, these may be the steps of a gauge or those of the load point between samples, of which the latter
/// have few pieces without noise.
pub(super) fn polygon(times: &[f64], displacements: &[f64]) -> Vec<Piece> {
    let noise = Noise::between_neighbours(times, displacements);
    let Some(quantum) = quantum(displacements, rounding(times, displacements)) else {
        return by_noise(times, displacements, noise);
    };
    let repeated = repeated(displacements, quantum);
    if repeated <= 1.0 {
        let exact = Noise::of_rounding(times, displacements);
        let pieces = by_noise(times, displacements, exact);
        if is_exact(pieces.len(), times.len()) {
            return pieces;
        }
    }
    by_noise(times, displacements, noise.of_steps(quantum, repeated))
}

/// The pieces by a noise of at least this.
///
/// From a piece for each two samples pieces are removed as long as that raises the sum of squares by less than the penalty
/// of a piece ([`Noise::penalty`]), the cheapest first, with the noise estimated beside the pieces that are left. A piece
/// whose velocity the data do not tell from 0 is a hold. It takes `n ln n` operations.
fn by_noise(times: &[f64], displacements: &[f64], mut noise: Noise) -> Vec<Piece> {
    let samples = times.len();
    let mut pieces = Pieces::new(times, displacements);
    for _ in 0..ROUNDS {
        pieces.remove(noise.penalty(samples));
        let larger = noise.beside(&pieces.lines(), times, displacements);
        let settled = larger.penalty(samples) <= noise.penalty(samples);
        noise = larger;
        if settled {
            break;
        }
    }
    let penalty = noise.penalty(samples);
    pieces.settle(penalty);
    let mut lines = pieces.lines();
    // The first piece has the initial velocity.
    for (line, ..) in &mut lines[1..] {
        if !noise.tells_from_rest(line, samples) {
            *line = line.at_rest();
        }
    }
    joined(&lines, times, displacements, noise)
}

/// The pieces along lines, which begin where two lines meet. Where two lines do not meet between their samples, to within the
/// penalty, they are joined by a piece between the last sample of the one and the first of the other.
fn joined(
    lines: &[(Line, usize, usize)],
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
        let ((before, from, limit), (behind, _, to)) = (pair[0], pair[1]);
        let meeting = before.meets(&behind);
        // Each keeps half of its samples.
        let [earliest, latest] = [(from + limit) / 2, (limit + to) / 2].map(|n| times[n]);
        if meeting > earliest.max(times[from]) && meeting < latest {
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
            if moved.map(excess).sum::<f64>() <= noise.penalty(times.len()) {
                pieces.push(piece(meeting, &behind));
                continue;
            }
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
