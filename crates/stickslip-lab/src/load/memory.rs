//! The criterion of a polygon beside noise with a memory.

use super::line::Line;

/// The number of samples over which noise is predicted is `n^(1/2)` over this. A prediction over `p` samples follows a missed
/// corner with `4/p` more of the variance of independent noise, which is that of the end of a line of `p` samples: over a
/// record `120 n^(1/2)` in the criterion, more than that of ten corners and more from a hundred samples on.
const SHARE: f64 = 30.0;

/// Schwarz's modified criterion of lines, `n ln s^2 + 4 m ln n`, with the variance `s^2` of what is left of the residuals
/// after their linear prediction from those before, at least `least` [m^2]. The ripple of a machine and slow noise are
/// predicted, and do not defend a piece for each of their turns. The prediction is that of Yule and Walker, solved by
/// Levinson's recursion. Source: P. J. Brockwell, R. A. Davis, *Time Series: Theory and Methods* (1991), Sec. 5.2 and 8.1.
pub(super) fn criterion(
    lines: &[(Line, usize, usize)],
    times: &[f64],
    displacements: &[f64],
    least: f64,
) -> f64 {
    let residuals: Vec<f64> = lines
        .iter()
        .flat_map(|(line, from, to)| (*from..*to).map(|n| displacements[n] - line.at(times[n])))
        .collect();
    let samples = residuals.len() as f64;
    let order = ((samples.sqrt() / SHARE).round() as usize).max(1);
    let order = order.min(residuals.len() - 1);
    let covariance = |lag: usize| {
        let pairs = residuals.iter().zip(&residuals[lag..]);
        pairs.map(|(one, other)| one * other).sum::<f64>() / samples
    };
    let left = innovation(&(0..=order).map(covariance).collect::<Vec<_>>());
    samples * left.max(least).ln() + 4.0 * lines.len() as f64 * samples.ln()
}

/// The variance that is left by the best prediction with these covariances, of lag 0, 1, ..
fn innovation(covariances: &[f64]) -> f64 {
    let mut left = covariances[0];
    let mut weights: Vec<f64> = Vec::new();
    for lag in 1..covariances.len() {
        if left <= 0.0 {
            return 0.0;
        }
        let known: f64 = (weights.iter().enumerate())
            .map(|(k, weight)| weight * covariances[lag - 1 - k])
            .sum();
        let last = (covariances[lag] - known) / left;
        let before = weights.clone();
        for (k, weight) in weights.iter_mut().enumerate() {
            *weight -= last * before[lag - 2 - k];
        }
        weights.push(last);
        left *= 1.0 - last * last;
    }
    left
}
