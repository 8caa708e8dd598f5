//! The times of a step, and the side from which its data are evaluated.

use crate::{Clock, StepError};

/// A step from one time to another. Data are functions of time that can jump at stops: a step that ends at a stop sees
/// them from the left, one that begins there from the right.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Span {
    /// The length \[s\].
    pub(crate) dt: f64,
    pub(crate) begin: f64,
    pub(crate) next: Clock,
    /// The evaluation times of the data \[s\]; the former only where the step begins at a stop.
    pub(crate) from_right: Option<f64>,
    end: f64,
}

impl Span {
    pub(crate) fn new(clock: &Clock, dt: f64, stops: &[f64]) -> Result<Self, StepError> {
        if !(dt > 0.0 && dt.is_finite()) {
            return Err(StepError::StepSize { dt });
        }
        let (begin, next) = (clock.time(), clock.after(dt));
        let end = next.time();
        Ok(Self {
            dt,
            begin,
            next,
            from_right: is_stop(stops, begin).then(|| begin.next_up()),
            end: if is_stop(stops, end) {
                end.next_down()
            } else {
                end
            },
        })
    }

    /// The evaluation time \[s\] of the data of an accepted step.
    pub(crate) fn seen(clock: &Clock, stops: &[f64]) -> f64 {
        let time = clock.time();
        if clock.step() > 0 && is_stop(stops, time) {
            time.next_down()
        } else {
            time
        }
    }

    /// The evaluation time of the data after a share of the step \[s\].
    pub(crate) fn at(&self, share: f64) -> f64 {
        if share < 1.0 {
            self.begin + share * self.dt
        } else {
            self.end
        }
    }
}

fn is_stop(stops: &[f64], time: f64) -> bool {
    stops.binary_search_by(|stop| stop.total_cmp(&time)).is_ok()
}
