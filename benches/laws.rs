//! What one vertex costs: special function, state laws, friction law, local minimisation.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::{SMatrix, SVector};
use stickslip::friction::{ConvexPotential, FrictionLaw, Radial};
use stickslip::problems::{AGING, FRICTION, NORMAL_STRESS};
use stickslip::state::wright::omega;
use stickslip::state::{LogTheta, Ruina, StateLaw};

/// Arguments over the range of an earthquake cycle, in turn.
fn cycle<T: Copy>(values: impl Iterator<Item = T>) -> impl FnMut() -> T {
    let values: Vec<T> = values.collect();
    let mut next = 0;
    move || {
        next = (next + 1) % values.len();
        values[next]
    }
}

/// Rates from 1e-16 to 1 m/s.
fn rates() -> impl FnMut() -> f64 {
    cycle((0..=64).map(|k| 10f64.powf(-16.0 + 0.25 * f64::from(k))))
}

fn scalar_laws(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("laws");
    let mut x = cycle((0..64).map(|k| -60.0 + 2.5 * f64::from(k)));
    group.bench_function("omega", |bencher| bencher.iter(|| omega(black_box(x()))));
    let mut rate = rates();
    group.bench_function("aging law, one step", |bencher| {
        bencher.iter(|| AGING.advance(LogTheta(black_box(1.0)), rate(), 1.5e-3));
    });
    let slip_law = Ruina {
        slip_distance: AGING.slip_distance,
    };
    group.bench_function("slip law, one step", |bencher| {
        bencher.iter(|| slip_law.advance(LogTheta(black_box(1.0)), rate(), 1.5e-3));
    });
    let mut drive = cycle((0..64).map(|k| 0.02 * f64::from(k)));
    group.bench_function("friction, slip rate", |bencher| {
        bencher.iter(|| FRICTION.slip_rate(black_box(1e2), drive(), LogTheta(2.0)));
    });
    group.finish();
}

/// A coupled block, and forces from deep inside the friction cone to three times its size.
fn minimize<const C: usize>(criterion: &mut Criterion) {
    let radial = Radial {
        law: FRICTION,
        force: NORMAL_STRESS / 16.0,
        state: LogTheta(2.0),
    };
    let block =
        SMatrix::<f64, C, C>::from_fn(|i, j| if i == j { 2e5 + 1e5 * i as f64 } else { 5e4 });
    let mut force = cycle((1..64).map(|k| {
        SVector::<f64, C>::from_fn(|c, _| {
            radial.force * 0.03 * f64::from(k) * (1.0 - 0.3 * c as f64)
        })
    }));
    criterion
        .benchmark_group("local minimisation")
        .bench_function(format!("{C} components"), |bencher| {
            bencher.iter(|| radial.minimize(black_box(&block), &force()));
        });
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(500));
    targets = scalar_laws, minimize::<1>, minimize::<2>, minimize::<3>
}
criterion_main!(benches);
