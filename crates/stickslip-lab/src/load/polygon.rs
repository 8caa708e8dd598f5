//! The polygon of a measured displacement with as few corners as the data defend.

use super::line::Line;
use super::noise::{Noise, rounding};
use super::pieces::Pieces;
use super::quantum::{is_exact, quantum, repeated};

/// The number of times that pieces are removed by the noise beside those that are left, at most. It rises as pieces are
/// removed, and ends with a removal of none.
const ROUNDS: usize = 30;

/// A corner of a polygon: the time \[s\], the displacement \[m\], and the velocity from there on [m/s].
pub(super) struct Corner {
    pub(super) time: f64,
    pub(super) displacement: f64,
    pub(super) velocity: f64,
}

/// The corners of the polygon; the first one is at the first sample. Times ascend strictly, and there are two or more.
///
/// Each piece is the least-squares line of its samples, and a corner the point where two lines meet. Where all changes are
/// multiples of a quantum, these may be the steps of a gauge or those of the load point between samples, of which the latter
/// have few pieces without noise.
pub(super) fn polygon(times: &[f64], displacements: &[f64]) -> Vec<Corner> {
    let noise = Noise::between_neighbours(times, displacements);
    let Some(quantum) = quantum(displacements, rounding(times, displacements)) else {
        return by_noise(times, displacements, noise).0;
    };
    let repeated = repeated(displacements, quantum);
    if repeated <= 1.0 {
        let exact = Noise::of_rounding(times, displacements);
        let (corners, pieces) = by_noise(times, displacements, exact);
        if is_exact(pieces, times.len()) {
            return corners;
        }
    }
    by_noise(times, displacements, noise.of_steps(quantum, repeated)).0
}

/// The corners by a noise of at least this, and the number of pieces.
///
/// From a piece for each two samples pieces are removed as long as that raises the sum of squares by less than the penalty
/// of a piece ([`Noise::penalty`]), the cheapest first, with the noise estimated beside the pieces that are left. A piece
/// whose velocity the data do not tell from 0 is a hold. It takes `n ln n` operations.
fn by_noise(times: &[f64], displacements: &[f64], mut noise: Noise) -> (Vec<Corner>, usize) {
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
    (corners(&lines, times, displacements, penalty), lines.len())
}

/// The corners between lines. Where two lines do not meet between their samples, to within the penalty, they are joined by
/// a piece between the last sample of the one and the first of the other.
fn corners(
    lines: &[(Line, usize, usize)],
    times: &[f64],
    displacements: &[f64],
    penalty: f64,
) -> Vec<Corner> {
    let first = lines[0].0;
    let mut corners = vec![Corner {
        time: times[0],
        displacement: first.at(times[0]),
        velocity: first.velocity,
    }];
    for pair in lines.windows(2) {
        let ((before, from, limit), (behind, _, to)) = (pair[0], pair[1]);
        let meeting = before.meets(&behind);
        // Each keeps half of its samples.
        let [earliest, latest] = [(from + limit) / 2, (limit + to) / 2].map(|n| times[n]);
        let mut corner = |time: f64, velocity: f64, displacement: f64| {
            corners.push(Corner {
                time,
                displacement,
                velocity,
            });
        };
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
            if moved.map(excess).sum::<f64>() <= penalty {
                corner(meeting, behind.velocity, behind.at(meeting));
                continue;
            }
        }
        let [start, end] = [times[limit - 1], times[limit]];
        let (low, high) = (before.at(start), behind.at(end));
        corner(start, (high - low) / (end - start), low);
        corner(end, behind.velocity, high);
    }
    corners
}
