//! The cost of one step of the spring slider: implicit, or as a differential equation.

mod common;

use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use stickslip::friction::DieterichRuina;
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
use stickslip::time::QuasiStatic;
use stickslip::{
    FixedPoint, Monolithic, Newmark, Point, RateScheme, Run, RungeKutta, SceneError, Sdirk2,
    Simulation, Steps,
};

use common::{Begun, Window};

/// A velocity step from 1 to 10 um/s at time zero, which fades.
fn stepped(mass: f64) -> SpringSlider {
    SpringSlider {
        stiffness: 1e9,
        normal_stress: 1e6,
        mass,
        damping: 0.0,
        load: LoadPath::steady(1e-5),
    }
}

const STEPPED: DieterichRuina = DieterichRuina {
    a: 0.005,
    b: 0.01,
    ..FRICTION
};

/// The 10 s after the velocity step.
const AFTER_STEP: Window = Window {
    dt: 5e-3,
    steps: 2000,
    repeats: 1,
};

type Block = Simulation<1>;

fn implicit<R: RateScheme + 'static>(scheme: R) -> Result<Block, SceneError> {
    let scene = stepped(1e3).steady(STEPPED, AGING, 1e-6)?;
    Simulation::new(scene, scheme, Point)
}

/// One step of a scheme by both couplings.
fn couplings<R: RateScheme + Copy + 'static>(criterion: &mut Criterion, name: &str, scheme: R) {
    let mut group = criterion.benchmark_group("velocity step");
    AFTER_STEP.measure(&mut group, BenchmarkId::new(name, "fixed point"), || {
        let motion = implicit(scheme)?.with_coupling(FixedPoint::paper());
        Ok(Box::new(motion))
    });
    AFTER_STEP.measure(&mut group, BenchmarkId::new(name, "monolithic"), || {
        let motion = implicit(scheme)?.with_coupling(Monolithic::default());
        Ok(Box::new(motion))
    });
    group.finish();
}

fn velocity_step(criterion: &mut Criterion) {
    couplings(criterion, "Newmark", Newmark::default());
    couplings(criterion, "quasi-static", QuasiStatic(Newmark::default()));
    let mut group = criterion.benchmark_group("velocity step");
    AFTER_STEP.measure(
        &mut group,
        BenchmarkId::from_parameter("RungeKutta"),
        || {
            let scene = stepped(0.0).steady(STEPPED, AGING, 1e-6)?;
            Ok(Box::new(RungeKutta::new(scene)?))
        },
    );
    group.finish();
}

/// Stick-slip on a spring of half the critical stiffness, with radiation damping.
fn cycling() -> SpringSlider {
    SpringSlider {
        stiffness: 2.5e8,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 5e6,
        load: LoadPath::steady(1e-6),
    }
}

/// Mean time of a step that adapts, over the cycles of 1200 s, rejected steps included in the time.
fn adaptive(criterion: &mut Criterion, name: &str, tolerance: f64, begin: impl Fn() -> Begun<1>) {
    let mut group = criterion.benchmark_group("cycles, accepted step");
    group.bench_function(
        BenchmarkId::new(name, format!("{tolerance:e}")),
        |bencher| {
            bencher.iter_custom(|runs| {
                let (mut elapsed, mut accepted) = (Duration::ZERO, 0);
                for _ in 0..runs {
                    let mut motion = begin().expect("the motion begins");
                    let clock = Instant::now();
                    let report = motion.run(&Steps::adaptive(tolerance).until(1200.0), |_| ());
                    elapsed += clock.elapsed();
                    accepted = report.expect("the run is completed").accepted as u32;
                }
                elapsed / accepted
            });
        },
    );
    group.finish();
}

fn cycles(criterion: &mut Criterion) {
    let scene = || cycling().steady(FRICTION, AGING, 1.01e-6);
    for tolerance in [1e-3, 1e-6] {
        adaptive(criterion, "RungeKutta", tolerance, || {
            Ok(Box::new(RungeKutta::new(scene()?)?))
        });
    }
    adaptive(criterion, "Sdirk2, monolithic", 1e-3, || {
        let motion = Simulation::new(scene()?, Sdirk2, Point)?;
        Ok(Box::new(motion))
    });
}

criterion_group! {
    name = benches;
    config = common::config(0.8);
    targets = velocity_step, cycles
}
criterion_main!(benches);
