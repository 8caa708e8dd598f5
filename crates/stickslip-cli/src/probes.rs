//! The record of a run at vertices of its contact.

use crate::cost::Statistics;
use crate::onsets::Onsets;
use std::time::Instant;

use stickslip::integrate::{IntoControlFlow, RunReport};
use stickslip::{Simulation, Snapshot, StepFailure, Steps};

use crate::plot::Points;
use crate::progress::Progress;

/// The history of a vertex from its start: rows of numbers, the first of which is the time \[s\].
pub struct Probe<const N: usize> {
    /// The vertex index in the body.
    pub vertex: usize,
    place: usize,
    /// One row per step.
    pub rows: Vec<[f64; N]>,
}

impl<const N: usize> Probe<N> {
    /// The last step.
    pub fn last(&self) -> [f64; N] {
        self.rows[self.rows.len() - 1]
    }

    /// A column of the rows, in another unit, over time; without the start.
    pub fn curve(&self, column: usize, scale: f64) -> Points {
        let steps = self.rows.iter().skip(1);
        steps.map(|row| (row[0], scale * row[column])).collect()
    }

    /// The onset times of a rate above the first of two thresholds, separated by a rate below the second \[s\].
    pub fn times(&self, of: (f64, f64), rate: impl Fn(&[f64; N]) -> f64) -> Vec<f64> {
        let mut events = Onsets::new(of.0, of.1);
        for row in &self.rows {
            events.record(row[0], rate(row));
        }
        events.times().to_vec()
    }
}

/// The recorded row of a step at a position of the contact.
type See<const C: usize, const N: usize> = dyn Fn(&Snapshot<'_, C>, usize) -> [f64; N];

/// The histories of some vertices of the first contact, and the cost of the run.
pub struct Probes<const C: usize, const N: usize> {
    /// One history per vertex.
    pub each: Vec<Probe<N>>,
    /// The cost of the steps.
    pub cost: Statistics,
    seconds: f64,
    see: Box<See<C, N>>,
}

impl<const C: usize, const N: usize> Probes<C, N> {
    /// Opens the record before the first step, at the vertices nearest to some positions; `see` returns a row.
    pub fn new<P>(
        at: &Snapshot<'_, C>,
        places: impl IntoIterator<Item = P>,
        distance: impl Fn(&P, [f64; 3]) -> f64,
        see: impl Fn(&Snapshot<'_, C>, usize) -> [f64; N] + 'static,
    ) -> Self {
        let contact = at.contact(0);
        let probe = |place: P| {
            let far = |k: &usize| distance(&place, contact.point(*k));
            let nearest = (0..contact.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
            let place = nearest.unwrap_or(0);
            Probe {
                vertex: contact.vertex(place),
                place,
                rows: vec![see(at, place)],
            }
        };
        Self {
            each: places.into_iter().map(probe).collect(),
            cost: Statistics::default(),
            seconds: 0.0,
            see: Box::new(see),
        }
    }

    /// Takes the steps of a plan and records them, with their progress up to a time \[s\]; `observe` is called with each,
    /// too.
    pub fn run<V: IntoControlFlow>(
        &mut self,
        simulation: &mut Simulation<C>,
        steps: &Steps,
        (progress, end): (&mut Progress, f64),
        mut observe: impl FnMut(Snapshot<'_, C>) -> V,
    ) -> Result<RunReport, StepFailure> {
        let clock = Instant::now();
        let run = simulation.run(steps, |at| {
            self.cost.record(&at);
            for probe in &mut self.each {
                probe.rows.push((self.see)(&at, probe.place));
            }
            progress.at(at.time, end, at.max_slip_rate());
            observe(at)
        });
        self.seconds += clock.elapsed().as_secs_f64();
        run
    }

    /// The mean wall time per step \[ms\].
    pub fn milliseconds_per_step(&self) -> f64 {
        1e3 * self.seconds / self.cost.steps.max(1) as f64
    }
}
