//! The cost of one whole time step of the paper's slider: prediction, load, coupling of rate and state, acceptance.

mod common;

use std::cell::LazyCell;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

use common::slider::{GAUSS_SEIDEL, METHODS, Sliding, small_step, sticking, sticking_explicitly};
use common::{LEVELS, TIME_STEP, Window};

/// Until then the body certainly sticks \[s\].
const STUCK: f64 = 3.0;

/// The body sticks and is loaded: the common case.
fn stick(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step, stick");
    let window = Window {
        dt: TIME_STEP,
        steps: 1,
        repeats: (STUCK / TIME_STEP) as usize,
    };
    for method in METHODS {
        for level in LEVELS {
            let id = BenchmarkId::new(method.name, level);
            window.measure(&mut group, id, || sticking(&method, level));
        }
    }
    // At 6 refinements a step takes a thousand sweeps.
    let id = BenchmarkId::new(GAUSS_SEIDEL.name, LEVELS[0]);
    window.measure(&mut group, id, || sticking(&GAUSS_SEIDEL, LEVELS[0]));
    group.finish();
}

/// Central differences with a lumped mass. For one step of the implicit scheme it takes 4 at 4
/// refinements, 16 at 6 and 64 at 8.
fn explicit(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step, stick");
    for level in LEVELS {
        let dt = small_step(level);
        let window = Window {
            dt,
            steps: 1,
            repeats: (STUCK / dt) as usize,
        };
        let id = BenchmarkId::new("central differences", level);
        window.measure(&mut group, id, || sticking_explicitly(level));
    }
    group.finish();
}

/// The mean of 40 steps, the same again and again: slip rates of 1e-6 to 4e-4 m/s, two small events.
fn slip(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step, slip");
    let window = Window {
        dt: TIME_STEP,
        steps: 40,
        repeats: 1,
    };
    let level = LEVELS[0];
    let sliding = LazyCell::new(|| Sliding::new(level).expect("the slider comes to slide"));
    for method in METHODS {
        let id = BenchmarkId::new(method.name, level);
        window.measure(&mut group, id, || sliding.go_on(&method));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = common::config(1.0);
    targets = stick, explicit, slip
}
criterion_main!(benches);
