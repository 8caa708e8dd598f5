//! Spikes of a record: single samples far beside their neighbours.

use crate::loss::deviation;

/// The samples on each side with which one is compared: a spike of up to three samples is less than half of them.
const SIDE: usize = 3;
/// The expected number of samples of a record without spikes that are reported.
const CHANCE: f64 = 1e-4;

/// A sample far beside its neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spike {
    /// Its time \[s\].
    pub time: f64,
    /// Data minus model there.
    pub residual: f64,
}

/// The samples whose residuals differ from the median of those around by so many standard deviations that one of ten
/// thousand records without spikes has such a sample: `(2 ln(N/1e-4))^(1/2)`, a bound of the normal distribution. The standard
/// deviation is that by the median of these differences, and that of the samples that is known. Source: F. R. Hampel, "The influence curve and its role in robust
/// estimation", J. Am. Stat. Assoc. 69 (1974).
pub(crate) fn spikes(residuals: &[f64], weighted: &[bool], known: &[f64]) -> Vec<usize> {
    let kept: Vec<usize> = (0..residuals.len()).filter(|&n| weighted[n]).collect();
    let differences: Vec<f64> = (0..kept.len())
        .map(|k| {
            let around = &kept[k.saturating_sub(SIDE)..(k + SIDE + 1).min(kept.len())];
            let mut around: Vec<f64> = around.iter().map(|&n| residuals[n]).collect();
            let middle = around.len() / 2;
            residuals[kept[k]] - *around.select_nth_unstable_by(middle, f64::total_cmp).1
        })
        .collect();
    // A sample that is the median itself says nothing.
    let others = differences
        .iter()
        .copied()
        .filter(|difference| *difference != 0.0);
    let far = (2.0 * (kept.len() as f64 / CHANCE).ln()).sqrt();
    let noise = deviation(others);
    let spikes = kept
        .iter()
        .zip(&differences)
        .filter(|&(&n, difference)| difference.abs() > far * noise.hypot(known[n]));
    spikes.map(|(&n, _)| n).collect()
}
