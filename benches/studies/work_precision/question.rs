//! The event by whose time the methods are judged.

use std::ops::ControlFlow;
use stickslip_cli::onsets::Onsets;

use stickslip::fem::{P1, Trace};
use stickslip::friction::DieterichRuina;
use stickslip::integrate::Stepper;
use stickslip::problems::pipping_slider::{AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS};
use stickslip::reduced::Reduced;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::work_precision::{Measurement, WorkPrecision};
use stickslip::{BlockMatrix, Contact, Run, Scene, SceneError, Simulation, Steps};
use stickslip_cli::cli::Problem;

use crate::method::{ADAPTIVE, Method, PLAIN, SECOND_ORDER};
use crate::study::Effort;

/// A body with its friction, at rest; with a lumped mass or the consistent one.
pub(crate) type Body<'a, const C: usize> =
    Box<dyn Fn(bool) -> Result<Scene<BlockMatrix<C>, C>, SceneError> + 'a>;

/// The paper's contact on a part of the boundary.
pub(crate) fn contact<const C: usize>(part: &Trace<2>) -> Contact<DieterichRuina, Dieterich, C> {
    Contact::new(part, FRICTION, NORMAL_STRESS).with_state(AGING, LogTheta(INITIAL_LOG_THETA))
}

/// The question to a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Wanted {
    /// The time at which the vertex slips for so many times \[s\].
    Slip(usize),
    /// The logarithm of its largest slip rate.
    Peak,
}

/// When does this vertex slip, or how fast?
pub(crate) struct Question<'a, const C: usize> {
    pub(crate) space: &'a P1<2>,
    pub(crate) body: Body<'a, C>,
    pub(crate) vertex: usize,
    pub(crate) wanted: Wanted,
    /// The slip rate that counts as slip [m/s].
    pub(crate) slip: f64,
    /// A kink of the data, at which an adaptive step must end \[s\].
    pub(crate) kink: f64,
    /// Steps that adapt begin with this \[s\].
    pub(crate) first_step: f64,
    /// The times at which adaptive and constant steps give up waiting for slip \[s\].
    pub(crate) until: [f64; 2],
}

/// The course of an adaptive run.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct StepCount {
    /// Accepted until the first slip, and after it.
    pub(crate) before: usize,
    pub(crate) after: usize,
    /// The time that each of these took \[s\].
    pub(crate) span_before: f64,
    pub(crate) span_after: f64,
    /// The largest step after the first slip \[s\].
    pub(crate) largest_after: f64,
    pub(crate) rejected: usize,
}

impl<const C: usize> Question<'_, C> {
    /// The answer of a method at a step size or tolerance.
    pub(crate) fn answer(&self, method: Method, setting: f64) -> Result<f64, Problem> {
        let (mut body, vertex) = self.stepper(method)?;
        let mut slips = Onsets::new(self.slip, self.slip);
        let mut peak: f64 = 0.0;
        let steps = if method.adaptive {
            self.adaptive(setting).until(self.until[0])
        } else {
            Steps::constant(setting).count((self.until[1] / setting).ceil() as usize)
        };
        body.run(&steps, |at| {
            let rate = at.velocity[vertex].norm();
            slips.record(at.time, rate);
            peak = peak.max(rate);
            // Adaptive runs end by their time, shortly after the event.
            if !method.adaptive && self.wanted == Wanted::Slip(slips.times().len()) {
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        })?;
        match self.wanted {
            Wanted::Peak => Ok(peak.ln()),
            Wanted::Slip(count) => {
                let time = slips.times().get(count.wrapping_sub(1)).copied();
                time.ok_or_else(|| {
                    let (found, until) = (slips.times().len(), body.snapshot().time);
                    format!("slip number {found} is the last until {until} s").into()
                })
            }
        }
    }

    /// Each scheme of second order at tolerances and at constant steps.
    pub(crate) fn adaptive_and_constant(
        &self,
        reference: f64,
        effort: Effort,
        tolerances: &[f64],
        steps: &[f64],
    ) -> Vec<Measurement> {
        let mut table = WorkPrecision::against(reference).with_runs(effort.runs);
        for (name, scheme) in SECOND_ORDER {
            for (way, method, settings) in [
                ("adaptive", ADAPTIVE, tolerances),
                ("constant steps", PLAIN, steps),
            ] {
                let settings = effort.settings(settings);
                table = table.method(&format!("{name}, {way}"), settings, |setting| {
                    self.answer(method.by(scheme), setting)
                });
            }
        }
        table.finish()
    }

    /// The steps of an adaptive run until the vertex first slips, and from there to the end.
    pub(crate) fn count_steps(
        &self,
        method: Method,
        tolerance: f64,
        until: f64,
    ) -> Result<StepCount, Problem> {
        let mut body = self.simulation(method)?;
        let mut slips = Onsets::new(self.slip, self.slip);
        let mut steps = StepCount::default();
        let mut last = 0.0;
        let report = body.run(&self.adaptive(tolerance).until(until), |at| {
            slips.record(at.time, at.velocity[self.vertex].norm());
            let dt = at.time - last;
            last = at.time;
            if slips.times().is_empty() {
                steps.before += 1;
                steps.span_before = at.time;
            } else {
                steps.after += 1;
                steps.span_after = at.time - steps.span_before;
                steps.largest_after = steps.largest_after.max(dt);
            }
        })?;
        steps.rejected = report.rejected;
        Ok(steps)
    }

    fn adaptive(&self, tolerance: f64) -> Steps {
        Steps::adaptive(tolerance)
            .with_first_step(self.first_step)
            .in_powers_of_two()
            .stopping_at([self.kink])
            .with_max_steps(1_000_000)
    }

    /// The body in motion, and the vertex that is asked about; a reduced body takes the time of its reduction.
    fn stepper(&self, method: Method) -> Result<(Box<dyn Stepper<C>>, usize), Problem> {
        let Some(frequency) = method.reduced else {
            return Ok((Box::new(self.simulation(method)?), self.vertex));
        };
        let scene = (self.body)(method.is_lumped())?;
        let body = Reduced::new(&scene)
            .with_vertices([self.vertex])
            .up_to_frequency(frequency)?;
        let vertex = body.vertex(self.vertex).ok_or("the vertex is not kept")?;
        let simulation = method.simulate_reduced(body.reduce(scene)?)?;
        Ok((Box::new(simulation), vertex))
    }

    fn simulation(&self, method: Method) -> Result<Simulation<C>, SceneError> {
        method.simulate((self.body)(method.is_lumped())?, self.space)
    }
}
