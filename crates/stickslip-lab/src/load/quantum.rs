//! The steps of a gauge.

use super::noise::quantile;

/// The largest length \[m\] of which all changes of a displacement are multiples, by Euclid's algorithm; none without a
/// change, and none that is as small as the rounding of the displacements \[m\].
pub(super) fn quantum(displacements: &[f64], rounding: f64) -> Option<f64> {
    let mut quantum = None;
    for pair in displacements.windows(2) {
        let change = (pair[1] - pair[0]).abs();
        if change == 0.0 {
            continue;
        }
        let (mut least, mut other) = (quantum.unwrap_or(change), change);
        loop {
            let rest = (other - least * (other / least).round()).abs();
            if rest <= LEFT * rounding {
                break;
            }
            (other, least) = (least, rest);
        }
        if least <= LEFT * LEFT * rounding {
            return None;
        }
        quantum = Some(least);
    }
    quantum
}

/// What rounding leaves of multiples, in units of the rounding of one displacement: that of two, and of a quantum that was
/// found by some divisions.
const LEFT: f64 = 10.0;

/// The number of samples from one multiple of the quantum to the next larger one, which three quarters of the multiples do
/// not exceed: those of a hold are one of many. Noise of a quantum leads to and fro between two, and is counted once.
pub(super) fn repeated(displacements: &[f64], quantum: f64) -> f64 {
    let (mut runs, mut run, mut largest) = (Vec::new(), 0.0_f64, displacements[0]);
    for &displacement in displacements {
        if displacement > largest + 0.5 * quantum {
            runs.push(run);
            (run, largest) = (0.0, displacement);
        }
        run += 1.0;
    }
    runs.push(run);
    quantile(&mut runs, 0.75).max(1.0)
}

/// Whether so many pieces that meet all samples say less than the steps of the gauge beside few: `4 ln n` for each
/// ([`Noise::penalty`](super::noise::Noise::penalty)) where one bit, `2 ln 2`, says which of two multiples a sample is.
pub(super) fn is_exact(pieces: usize, samples: usize) -> bool {
    4.0 * pieces as f64 * (samples as f64).ln() < 2.0 * std::f64::consts::LN_2 * samples as f64
}
