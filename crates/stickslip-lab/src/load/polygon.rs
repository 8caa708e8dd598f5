//! The polygon of a measured displacement with as few corners as the data defend.

use super::Piece;
use super::joints::joined;
use super::memory::criterion;
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
/// of a piece ([`Noise::penalty`]), the cheapest first, with the noise estimated beside the pieces that are left, and further
/// where these follow noise with a memory. A piece whose velocity the data do not tell from 0 is a hold. It takes `n ln n` operations.
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
    let (mut pieces, noise) = beside_memory(pieces, noise);
    let penalty = noise.penalty(samples);
    pieces.settle(penalty);
    pieces.join(penalty);
    let mut lines = pieces.lines();
    // The first piece has the initial velocity.
    for (line, ..) in &mut lines[1..] {
        if !noise.tells_from_rest(line, samples) {
            *line = line.at_rest();
        }
    }
    joined(&lines, times, displacements, noise)
}

/// The pieces and the noise with the least [`criterion`], of those that are left with a noise that is twice as large, four
/// times, .. up to the one at which a single piece is left.
fn beside_memory<'a>(mut pieces: Pieces<'a>, mut noise: Noise) -> (Pieces<'a>, Noise) {
    let (times, displacements) = (pieces.times, pieces.displacements);
    let least = Noise::of_rounding(times, displacements).variance;
    let mut lines = pieces.lines();
    let mut count = lines.len();
    let mut best = (
        criterion(&lines, times, displacements, least),
        pieces.clone(),
        noise,
    );
    while count > 1 {
        noise.variance = (4.0 * noise.variance).max(f64::MIN_POSITIVE);
        pieces.remove(noise.penalty(times.len()));
        lines = pieces.lines();
        if lines.len() < count {
            count = lines.len();
            let value = criterion(&lines, times, displacements, least);
            if value < best.0 {
                best = (value, pieces.clone(), noise);
            }
        }
    }
    (best.1, best.2)
}
