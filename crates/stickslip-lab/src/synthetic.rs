//! Curves of known parameters.

use crate::course::Course;
use crate::curve::curve;
use crate::error::LabError;
use crate::evolution::Evolution;
use crate::load::{LoadHistory, ascending};
use crate::parameters::Parameters;
use crate::point::Point;
use crate::trend::Trend;

/// The local error of a step in `ln V` and each `ln theta`.
const TOLERANCE: f64 = 1e-10;

impl Parameters {
    /// The coefficient of friction at ascending times \[s\], without the trend; before the first one the block is in
    /// steady sliding with the load point, or in its initial state. There is a state law per state.
    ///
    /// # Errors
    /// [`LabError::Value`] for parameters or times out of range and for a load point at rest at first,
    /// [`LabError::States`] for other than one law per state, [`LabError::Unstable`] for a slip instability.
    pub fn curve(
        &self,
        laws: &[Evolution<'_>],
        load: &LoadHistory,
        times: &[f64],
    ) -> Result<Vec<f64>, LabError> {
        self.validate()?;
        ascending(times)?;
        if laws.len() != self.states.len() {
            return Err(LabError::States {
                expected: "as many as there are state laws",
                found: self.states.len(),
            });
        }
        if let Some(&first) = times.first() {
            let velocity = load.velocity_before(first);
            let requirement = "positive: begin while the load point moves";
            LabError::check(
                "velocity of the load point at the first time [m/s]",
                requirement,
                0,
                velocity,
                velocity > 0.0,
            )?;
        }
        let mut course = Course::default();
        let (mu0, point) = (self.reference_friction, Point::new(self.clone()));
        Ok(if laws.len() == 1 {
            let rows = curve::<2, 1>(laws, &point, load, times, TOLERANCE, &mut course)?;
            rows.iter().map(|row| mu0 + row[0]).collect()
        } else {
            let rows = curve::<3, 1>(laws, &point, load, times, TOLERANCE, &mut course)?;
            rows.iter().map(|row| mu0 + row[0]).collect()
        })
    }

    /// The trend of friction at ascending times \[s\], 0 at the first one: `trend` as a slope of this kind.
    pub fn trend_at(&self, kind: Trend, load: &LoadHistory, times: &[f64]) -> Vec<f64> {
        let basis = kind.basis(load, times);
        basis.iter().map(|x| self.trend * x).collect()
    }
}
