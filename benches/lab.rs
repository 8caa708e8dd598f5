//! The cost of a fit of three velocity steps and two holds, and of its curve.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use stickslip::lab::{Evolution, Fit, LabError, LoadHistory, Parameters, Record, StateParameters};

/// `K/sigma_n` [1/m].
const STIFFNESS: f64 = 1500.0;

fn load() -> Result<LoadHistory, LabError> {
    let changes = [
        (50.0, 1e-5),
        (90.0, 3e-6),
        (220.0, 3e-5),
        (235.0, 0.0),
        (265.0, 1e-5),
        (305.0, 0.0),
        (605.0, 1e-5),
    ];
    LoadHistory::new(1e-6, &changes)?.ending(650.0)
}

fn parameters(states: usize) -> Parameters {
    Parameters {
        a: 0.009,
        states: if states == 1 {
            vec![StateParameters::steady(0.012, 1.2e-5)]
        } else {
            vec![
                StateParameters::steady(0.008, 5e-6),
                StateParameters::steady(0.004, 8e-5),
            ]
        },
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        stiffness: STIFFNESS,
        trend: 0.0,
    }
}

/// Thousand samples with an error of 1e-3 of alternating sign.
fn measure(criterion: &mut Criterion) -> Result<(), LabError> {
    let load = load()?;
    let times = load.samples(125);
    let mut group = criterion.benchmark_group("fit");
    for states in [1, 2] {
        for law in [Evolution::Aging, Evolution::Slip] {
            let laws = vec![law; states];
            let mut friction = parameters(states).curve(&laws, &load, &times)?;
            for (n, mu) in friction.iter_mut().enumerate() {
                *mu += if n % 2 == 0 { 1e-3 } else { -1e-3 };
            }
            let record = Record::new(times.clone(), friction)?;
            let name = format!("{states} states, {}", law.name());
            for (stiffness, fit) in [
                ("known", Fit::new(&laws).with_stiffness(STIFFNESS)),
                ("free", Fit::new(&laws)),
            ] {
                group.bench_function(BenchmarkId::new(&name, stiffness), |bencher| {
                    bencher.iter(|| fit.run(&record, &load));
                });
            }
            group.bench_function(BenchmarkId::new(&name, "curve"), |bencher| {
                bencher.iter(|| parameters(states).curve(&laws, &load, &times));
            });
        }
    }
    group.finish();
    Ok(())
}

fn fits(criterion: &mut Criterion) {
    measure(criterion).expect("parameters in their ranges");
}

criterion_group!(benches, fits);
criterion_main!(benches);
