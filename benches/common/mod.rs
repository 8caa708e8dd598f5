//! The settings and problems of the benches, and the time per step.
#![allow(dead_code)]

pub(crate) mod slider;
pub(crate) mod velocity;

use std::error::Error;
use std::time::{Duration, Instant};

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion};
use stickslip::integrate::Stepper;
use stickslip::{Run, Steps};

/// The refinements of the slider.
pub(crate) const LEVELS: [usize; 3] = [4, 6, 8];
/// The paper's time step \[s\].
pub(crate) const TIME_STEP: f64 = 1.5e-3;

/// Ten samples, which take about so long \[s\].
pub(crate) fn config(seconds: f64) -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_secs_f64(seconds))
}

/// Velocity components of the refined slider, two a vertex.
pub(crate) fn components(refinements: usize) -> u64 {
    let cells = 1 << refinements;
    2 * (5 * cells + 1) * (cells + 1)
}

/// A motion at the beginning of what is measured of it.
pub(crate) type Begun<const C: usize> = Result<Box<dyn Stepper<C>>, Box<dyn Error>>;

/// The part of a motion over which the time of a step is averaged.
pub(crate) struct Window {
    /// The step \[s\].
    pub(crate) dt: f64,
    /// The steps of one measurement.
    pub(crate) steps: u32,
    /// The measurements after which the motion begins anew, before it leaves what is to be measured.
    pub(crate) repeats: usize,
}

impl Window {
    /// Measures the mean time of a step. What is not selected is not begun.
    pub(crate) fn measure<const C: usize>(
        &self,
        group: &mut BenchmarkGroup<'_, WallTime>,
        id: BenchmarkId,
        begin: impl Fn() -> Begun<C>,
    ) {
        let begin = || (begin().expect("the motion begins"), self.repeats);
        let steps = Steps::constant(self.dt).count(self.steps as usize);
        let mut running = None;
        group.bench_function(id, |bencher| {
            let (motion, left) = running.get_or_insert_with(begin);
            bencher.iter_custom(|measurements| {
                let mut elapsed = Duration::ZERO;
                for _ in 0..measurements {
                    if *left == 0 {
                        (*motion, *left) = begin();
                    }
                    let clock = Instant::now();
                    motion.run(&steps, |_| ()).expect("the steps are solvable");
                    elapsed += clock.elapsed();
                    *left -= 1;
                }
                elapsed / self.steps
            });
        });
    }
}
