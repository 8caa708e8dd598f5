//! The exact solution and what is compared of it.

use stickslip::problems::{END, ExactSample, FRICTION, Layer};
use stickslip::state::{LogTheta, StateLaw};
use stickslip::{Events, StepError};

use crate::{Arguments, EVENT, SLIP};

/// The exact solution, to second order in its own small step.
pub(crate) struct Exact {
    /// About as many samples as steps are kept of the computed history.
    pub(crate) samples: Vec<ExactSample>,
    /// Every time at which the base begins to slip.
    pub(crate) slips: Events,
    /// The events of the base.
    pub(crate) events: Events,
    /// The largest slip rate [m/s].
    pub(crate) peak_slip_rate: f64,
    /// The displacement at [`END`] \[m\].
    pub(crate) displacement_end: f64,
}

impl Exact {
    /// Solves the wave equation of the base.
    pub(crate) fn solve<S: StateLaw<State = LogTheta>>(
        arguments: &Arguments,
        layer: &Layer,
        law: &S,
        initial: LogTheta,
    ) -> Result<Self, StepError> {
        let kept = (arguments.steps.get() / arguments.every.get()).max(1);
        let mut exact = Self {
            samples: Vec::new(),
            slips: Events::new(SLIP, SLIP),
            events: Events::new(EVENT.0, EVENT.1),
            peak_slip_rate: 0.0,
            displacement_end: 0.0,
        };
        let mut last = ExactSample {
            time: 0.0,
            slip_rate: 0.0,
            displacement: 0.0,
        };
        exact.slips.record(0.0, 0.0);
        exact.events.record(0.0, 0.0);
        layer.exact(
            &FRICTION,
            law,
            initial,
            arguments.transit_steps.get(),
            |at| {
                if at.time * kept as f64 >= END * (exact.samples.len() + 1) as f64 {
                    exact.samples.push(at);
                }
                if last.time < END {
                    exact.slips.record(at.time, at.slip_rate);
                    exact.events.record(at.time, at.slip_rate);
                    exact.peak_slip_rate = exact.peak_slip_rate.max(at.slip_rate);
                    let share = ((END - last.time) / (at.time - last.time)).min(1.0);
                    exact.displacement_end =
                        last.displacement + share * (at.displacement - last.displacement);
                    last = at;
                }
            },
        )?;
        Ok(exact)
    }
}
