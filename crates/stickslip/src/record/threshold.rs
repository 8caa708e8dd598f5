//! The crossing of a threshold by the slip rate between two steps.

/// The time at which a rate passes `level` between `from` and `to`, each a time and a rate, by linear interpolation of
/// its logarithm. If a rate is zero at either end, the result is the later time.
pub(super) fn time_of(level: f64, from: (f64, f64), to: (f64, f64)) -> f64 {
    let share = if from.1 > 0.0 && to.1 > 0.0 {
        (level.ln() - from.1.ln()) / (to.1.ln() - from.1.ln())
    } else {
        1.0
    };
    let share = if share.is_finite() { share } else { 1.0 };
    from.0 + share * (to.0 - from.0)
}
