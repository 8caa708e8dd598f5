//! Linear trends of friction.

use crate::load::LoadHistory;

/// A linear trend of friction beside the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[doc(alias = "detrend")]
pub enum Trend {
    /// Linear in time.
    Time,
    /// Linear in the displacement of the load point.
    Displacement,
}

impl Trend {
    /// Time \[s\] or displacement \[m\] since the first sample.
    pub(crate) fn basis(self, load: &LoadHistory, times: &[f64]) -> Vec<f64> {
        let at = |time: f64| match self {
            Self::Time => time,
            Self::Displacement => load.displacement(time),
        };
        let first = times.first().map_or(0.0, |&time| at(time));
        times.iter().map(|&time| at(time) - first).collect()
    }
}
