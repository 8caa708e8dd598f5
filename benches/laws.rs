//! The cost per vertex: the special function, a state step, the local problem of friction, laws of many nodes.

mod common;

use std::hint::black_box;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use nalgebra::{SMatrix, SVector};
use stickslip::friction::{
    ConvexPotential, FrictionLaw, Radial, RegularizedDieterichRuina, StateDependentTresca, Tresca,
};
use stickslip::problems::pipping_slider::{AGING, FRICTION, NORMAL_STRESS};
use stickslip::state::wright::{ln_omega, omega};
use stickslip::state::{Dieterich, Discontinuous, LogTheta, Ruina, StateLaw, Theta};

use common::TIME_STEP;

const VALUES: usize = 64;

/// Values in turn, again and again.
fn cycle<T: Copy>(value: impl Fn(usize) -> T) -> impl FnMut() -> T {
    let values: [T; VALUES] = std::array::from_fn(value);
    let mut next = 0;
    move || {
        next = (next + 1) % VALUES;
        values[next]
    }
}

/// The `k`-th of so many numbers between two.
fn between(low: f64, high: f64, k: usize) -> f64 {
    low + (high - low) * (k as f64 + 0.5) / VALUES as f64
}

/// Rates from 1e-16 to 1 m/s.
fn rates() -> impl FnMut() -> f64 {
    cycle(|k| 10f64.powf(between(-16.0, 0.0, k)))
}

/// Each function on each side of the point where its formula changes.
fn wright(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("wright");
    let mut function = |name, of: fn(f64) -> f64, low, high| {
        let mut x = cycle(|k| between(low, high, k));
        group.bench_function(name, |bencher| bencher.iter(|| of(black_box(x()))));
    };
    function("omega, x < 0", omega, -20.0, 0.0);
    function("omega, x > 0", omega, 0.0, 100.0);
    function("ln_omega, x < 0", ln_omega, -20.0, 0.0);
    function("ln_omega, 0 < x < 4", ln_omega, 0.0, 4.0);
    function("ln_omega, x > 4", ln_omega, 4.0, 100.0);
    group.finish();
}

/// A step of both state updates; for the midpoint rule at the mean rate.
fn state<S: StateLaw>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    law: &S,
    from: S::State,
) {
    let mut rate = rates();
    group.bench_function(format!("{name}, backward Euler"), |bencher| {
        bencher.iter(|| law.advance(black_box(from), rate(), TIME_STEP));
    });
    group.bench_function(format!("{name}, midpoint"), |bencher| {
        bencher.iter(|| law.advance_at_constant_rate(black_box(from), rate(), TIME_STEP));
    });
}

fn states(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("state step");
    let slip_distance = AGING.slip_distance;
    state(&mut group, "Dieterich", &AGING, LogTheta(1.0));
    state(&mut group, "Ruina", &Ruina { slip_distance }, LogTheta(1.0));
    state(&mut group, "Discontinuous", &Discontinuous, Theta(1.0));
    group.finish();
}

/// `V` with `viscosity V + mu(V, alpha) = drive`, from rest to twice the strength.
fn slip_rate<L: FrictionLaw>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    law: &L,
    state: L::State,
) {
    let mut drive = cycle(|k| between(0.0, 1.3, k));
    group.bench_function(name, |bencher| {
        bencher.iter(|| law.slip_rate(black_box(1e2), drive(), state));
    });
}

fn slip_rates(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("slip rate");
    let (alpha, law) = (LogTheta(2.0), FRICTION);
    let tresca = Tresca {
        coefficient: law.reference_friction,
    };
    let state_dependent = StateDependentTresca {
        reference_friction: law.reference_friction,
        b: law.b,
        reference_velocity: law.reference_velocity,
        slip_distance: law.slip_distance,
    };
    let regularized = RegularizedDieterichRuina {
        a: law.a,
        b: law.b,
        reference_friction: law.reference_friction,
        reference_velocity: law.reference_velocity,
        slip_distance: law.slip_distance,
    };
    slip_rate(&mut group, "Tresca", &tresca, ());
    slip_rate(&mut group, "StateDependentTresca", &state_dependent, alpha);
    slip_rate(&mut group, "DieterichRuina", &law, alpha);
    slip_rate(&mut group, "RegularizedDieterichRuina", &regularized, alpha);
    group.finish();
}

/// A coupled block, and forces from deep inside the friction cone to three times its size.
fn local_minimisation<const C: usize>(criterion: &mut Criterion) {
    let radial = Radial {
        law: FRICTION,
        force: NORMAL_STRESS / 16.0,
        state: LogTheta(2.0),
    };
    let block =
        SMatrix::<f64, C, C>::from_fn(|i, j| if i == j { 2e5 + 1e5 * i as f64 } else { 5e4 });
    let mut force = cycle(|k| {
        let pull = radial.force * between(0.0, 1.9, k);
        SVector::<f64, C>::from_fn(|c, _| pull * (1.0 - 0.3 * c as f64))
    });
    criterion
        .benchmark_group("local minimisation")
        .bench_function(format!("{C} components"), |bencher| {
            bencher.iter(|| radial.minimize(black_box(&block), &force()));
        });
}

/// Slip rates and rates of the state of a quasi-dynamic fault, at rates from 1e-12 to 10 m/s, half of the cells above
/// steady state and half below.
fn many_nodes(criterion: &mut Criterion) {
    const COUNT: usize = 4000;
    let viscosity = [32.04e9 / (2.0 * 3464.0) / 50e6; COUNT];
    let law = RegularizedDieterichRuina::from(FRICTION);
    let rate =
        |cell: usize| 10f64.powf(-12.0 + 13.0 * ((7919 * cell) % COUNT) as f64 / COUNT as f64);
    let state = |cell: usize| {
        LogTheta((law.slip_distance / rate(cell)).ln() + (cell % 17) as f64 * 0.25 - 2.0)
    };
    let states: Vec<_> = (0..COUNT).map(state).collect();
    let drive =
        |cell: usize| law.coefficient(rate(cell), states[cell]) + viscosity[cell] * rate(cell);
    let drive: Vec<f64> = (0..COUNT).map(drive).collect();
    let mut group = criterion.benchmark_group("many nodes");
    group.throughput(Throughput::Elements(COUNT as u64));
    let mut rates = vec![0.0; COUNT];
    let friction = RegularizedDieterichRuina::slip_rates(&[law; COUNT]).expect("passes");
    group.bench_function("slip rates", |bencher| {
        bencher.iter(|| {
            friction.slip_rates(0, [&viscosity, black_box(&drive)], &states, &mut rates);
        });
    });
    let slip_distance = law.slip_distance;
    let laws = [
        (
            "aging law",
            Dieterich::evolutions(&[Dieterich { slip_distance }]),
        ),
        ("slip law", Ruina::evolutions(&[Ruina { slip_distance }])),
    ];
    let slip_rates: Vec<f64> = (0..COUNT).map(rate).collect();
    for (name, law) in laws {
        let law = law.expect("passes");
        group.bench_function(name, |bencher| {
            bencher.iter(|| law.evolutions(0, &states, black_box(&slip_rates), &mut rates));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = common::config(0.5).sample_size(20);
    targets = wright, states, slip_rates, many_nodes,
        local_minimisation::<1>, local_minimisation::<2>, local_minimisation::<3>
}
criterion_main!(benches);
