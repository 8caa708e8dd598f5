//! The time of velocity steps as a parameter.

use crate::course::Course;
use crate::error::LabError;
use crate::part::Part;
use crate::point::Point;

/// The increment in differences, as a share of the time in which the direct effect of the fastest step relaxes: the error
/// of a central difference is its square, a millionth.
const DIFFERENCE: f64 = 1e-3;

impl Part<'_> {
    /// The times of the samples on the clock of the load history \[s\].
    pub(crate) fn times(&self, point: &Point) -> Vec<f64> {
        let times = self.record.times().iter();
        times.map(|time| time - point.step_offset).collect()
    }

    /// The derivative of friction at the samples in the offset of the steps [1/s], by central differences.
    pub(crate) fn by_offset(
        &self,
        point: &Point,
        tolerance: f64,
        course: &mut Course<'_>,
    ) -> Result<Vec<f64>, LabError> {
        let h = DIFFERENCE * self.rise(point);
        let mut at = |by: f64| {
            let mut moved = point.clone();
            moved.step_offset += by;
            self.change(&moved, tolerance, course)
        };
        let (late, early) = (at(h)?, at(-h)?);
        let pairs = late.iter().zip(&early);
        Ok(pairs
            .map(|(late, early)| (late - early) / (2.0 * h))
            .collect())
    }

    /// The time in which the direct effect relaxes behind the fastest step, `a/(k V)` \[s\].
    fn rise(&self, point: &Point) -> f64 {
        let (first, last) = self.ends();
        let steps = self.load.phases(first, last);
        let fastest = steps.iter().map(|phase| phase.velocity).fold(0.0, f64::max);
        point.parameters.a / (point.parameters.stiffness * fastest)
    }

    /// The shortest time between changes of the velocity, the ends of the record, and the last change before it \[s\].
    pub(crate) fn shortest_phase(&self) -> f64 {
        let (first, last) = self.ends();
        let phases = self.load.phases(first, last);
        let mut times: Vec<f64> = phases.iter().map(|phase| phase.start).collect();
        times.push(last);
        let before = self.load.change_before(first);
        let lead = before.map_or(f64::INFINITY, |before| first - before);
        let spans = times.windows(2).map(|pair| pair[1] - pair[0]);
        spans.filter(|span| *span > 0.0).fold(lead, f64::min)
    }
}
