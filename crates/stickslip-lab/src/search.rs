//! The least minimum of several starts.

use crate::candidates::Shown;
use crate::course::Course;
use crate::error::LabError;
use crate::least_squares::{Minimum, Stop, minimize};
use crate::model::Model;

/// The local error of a step in `ln V` and each `ln theta`, and the end of iterations, in the choice among starts and
/// in the end.
pub(crate) const COARSE: f64 = 1e-3;
pub(crate) const FINE: f64 = 1e-7;
/// The error of a curve over that of a step: errors add up over the steps behind a change of the velocity, some ten.
pub(crate) const ERRORS: f64 = 10.0;
/// The largest relative offset at convergence, by the rule of Bates and Watts, and that at which the iteration ends.
pub(crate) const CONVERGED: f64 = 1e-3;
const OFFSET: f64 = 1e-5;
/// The relative offset and the number of steps at which an iteration from one of several starts is interrupted.
pub(crate) const ROUGH: f64 = 0.03;
pub(crate) const ROUGH_STEPS: usize = 20;
pub(crate) const MAX_STEPS: usize = 100;
/// The damping at the start, relative to the diagonal of the normal equations.
pub(crate) const DAMPING: f64 = 1e-3;

/// A search for the least minimum, with its work.
pub(crate) struct Search<'a> {
    pub(crate) model: &'a Model<'a>,
    pub(crate) bounds: &'a [(f64, f64)],
    /// The scale of friction in the data.
    pub(crate) scale: f64,
    /// The number of attempted steps.
    pub(crate) steps: usize,
    pub(crate) course: Course<'a>,
}

impl<'a> Search<'a> {
    pub(crate) fn new(
        model: &'a Model<'a>,
        bounds: &'a [(f64, f64)],
        scale: f64,
        course: Course<'a>,
    ) -> Self {
        Self {
            model,
            bounds,
            scale,
            steps: 0,
            course,
        }
    }

    /// The minimum from the best of the starts computed from the curves; from the next one where the best does not
    /// converge. If it is interrupted, the least sum of squares so far.
    ///
    /// # Errors
    /// [`LabError::NoStart`], that of the best one if none converges, and [`LabError::Interrupted`] before the first start.
    pub(crate) fn among(&mut self, shown: &Shown) -> Result<Minimum, LabError> {
        let (starts, tried) = shown.starts(self.model, self.bounds, &mut self.course);
        let first = starts.first().cloned();
        let mut ends = self.rough(starts);
        if let Some(end) = ends.first() {
            let end = self.model.points(&end.parameters);
            let end: Vec<_> = end.into_iter().map(|point| point.parameters).collect();
            let restarts = shown.restarts(self.model, self.bounds, &end, &mut self.course);
            ends.extend(self.rough(restarts));
            sort(&mut ends);
        }
        if self.course.is_interrupted() {
            let begun = ends.into_iter().next();
            let first = || first.map(Minimum::at_start);
            return begun.or_else(first).ok_or(LabError::Interrupted);
        }
        let mut first = Err(LabError::NoStart { starts: tried });
        for end in ends {
            let minimum = self.finish(end.parameters, end.damping.min(DAMPING));
            if minimum.is_ok() {
                return minimum;
            }
            if matches!(first, Err(LabError::NoStart { .. })) {
                first = minimum;
            }
        }
        first
    }

    /// The ends of interrupted iterations, the best one first.
    fn rough(&mut self, starts: Vec<Vec<f64>>) -> Vec<Minimum> {
        let stop = Stop {
            offset: ROUGH,
            change: COARSE * self.scale,
            steps: ROUGH_STEPS,
            damping: DAMPING,
        };
        let ends = starts
            .into_iter()
            .map(|start| self.descend(start, COARSE, stop));
        let mut ends: Vec<Minimum> = ends.filter_map(Result::ok).collect();
        sort(&mut ends);
        ends
    }

    /// The minimum from one start, or where it is interrupted on the way.
    ///
    /// # Errors
    /// That of the curve at the start, and [`LabError::NotConverged`].
    pub(crate) fn from(&mut self, start: Vec<f64>) -> Result<Minimum, LabError> {
        self.finish(start, DAMPING)
    }

    fn finish(&mut self, start: Vec<f64>, damping: f64) -> Result<Minimum, LabError> {
        let stop = Stop {
            offset: OFFSET,
            change: FINE * self.scale,
            steps: MAX_STEPS,
            damping,
        };
        let begin = start.clone();
        let minimum = match self.descend(start, FINE, stop) {
            Err(LabError::Interrupted) => Minimum::at_start(begin),
            minimum => minimum?,
        };
        let converged = minimum.offset <= CONVERGED || minimum.flat;
        if converged || self.course.is_interrupted() {
            return Ok(minimum);
        }
        Err(LabError::NotConverged {
            steps: minimum.steps,
            offset: minimum.offset,
        })
    }

    pub(crate) fn descend(
        &mut self,
        start: Vec<f64>,
        tolerance: f64,
        stop: Stop,
    ) -> Result<Minimum, LabError> {
        let minimum = minimize(start, self.bounds, stop, |values| {
            self.model.linearised(values, tolerance, &mut self.course)
        })?;
        self.steps += minimum.steps;
        Ok(minimum)
    }
}

/// Sorts by the sum of squares.
fn sort(ends: &mut [Minimum]) {
    let squares = |end: &Minimum| end.residual.norm_squared();
    ends.sort_by(|one, two| squares(one).total_cmp(&squares(two)));
}
