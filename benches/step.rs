//! One whole time step of the paper's slider: prediction, coupling of rate and state, acceptance.

use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use stickslip::problems::{AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, Slider};
use stickslip::state::LogTheta;
use stickslip::{Newmark, SceneError, Simulation, Stepper, Tnnmg};

const TIME_STEP: f64 = 1.5e-3;

fn slider(refinements: usize) -> Result<impl Stepper<2>, SceneError> {
    let slider = Slider {
        refinements,
        ..Slider::default()
    };
    let space = slider.space()?;
    let scene = slider
        .scene(&space)?
        .with_friction(&Slider::bottom(&space)?, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let solver = Tnnmg::new(space.hierarchy().prolongations());
    Simulation::new(scene, Newmark::default(), solver)
}

fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step of the slider");
    for refinements in [4, 6] {
        let mut simulation = slider(refinements).expect("the slider is a valid scene");
        // The body sticks and is loaded: the common case. The state has forgotten its start.
        for _ in 0..20 {
            simulation.step(TIME_STEP).expect("the step is solvable");
        }
        group.bench_function(format!("{refinements} refinements"), |bencher| {
            bencher.iter(|| simulation.step(TIME_STEP));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2));
    targets = steps
}
criterion_main!(benches);
