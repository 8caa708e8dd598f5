//! Where a slip rate passes a value between two steps.

/// The time at which a rate that goes from `from` to `to`, each a time and a rate, passes `level`: its logarithm
/// is taken as linear. A rate of zero at either end leaves nothing to interpolate, and the later time is taken.
pub(super) fn time_of(level: f64, from: (f64, f64), to: (f64, f64)) -> f64 {
    let share = if from.1 > 0.0 && to.1 > 0.0 {
        (level.ln() - from.1.ln()) / (to.1.ln() - from.1.ln())
    } else {
        1.0
    };
    let share = if share.is_finite() { share } else { 1.0 };
    from.0 + share * (to.0 - from.0)
}
