//! The cost per vertex of heat and fluid across a fault: one advance of the memory, and the pressure of a stage.

mod common;

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use stickslip::fields::{FaultField, PerVertex, PoreFluid, ShearZone, ThermalPressurization};

const VERTICES: usize = 4000;

/// One value, or one of each vertex that differs from it by up to a factor of 2.
fn values(value: f64, each: bool) -> PerVertex {
    if each {
        let at = |k| value * (1.0 + k as f64 / VERTICES as f64);
        (0..VERTICES).map(at).collect::<Vec<_>>().into()
    } else {
        value.into()
    }
}

/// Uniform diffusivities, those of each vertex for the fluid, and for both.
fn thermal(criterion: &mut Criterion) {
    let source: [Vec<f64>; 2] = [1.0, 1.1].map(|factor| {
        (0..VERTICES)
            .map(|k| factor * (10.0 + 1e-3 * k as f64))
            .collect()
    });
    let source = [source[0].as_slice(), &source[1]];
    for (name, each) in [
        ("uniform", [false; 2]),
        ("hydraulic diffusivity of each", [false, true]),
        ("both diffusivities of each", [true; 2]),
    ] {
        let zone = ShearZone {
            half_width: 0.01.into(),
            volumetric_heat_capacity: 2.7e6.into(),
            thermal_diffusivity: values(1e-6, each[0]),
            initial_temperature: 483.15.into(),
        };
        let fluid = PoreFluid {
            hydraulic_diffusivity: values(1e-4, each[1]),
            pressurization_coefficient: 1e5.into(),
        };
        let field = ThermalPressurization::new(VERTICES, zone, fluid).expect("it is legal");
        let mut group = criterion.benchmark_group(format!("thermal pressurization, {name}"));
        group.throughput(Throughput::Elements(VERTICES as u64));
        let start = field.sizes().memory;
        let (mut from, mut to) = (start.clone(), start.clone());
        field
            .advance(&start, source, 1.0, &mut from)
            .expect("it advances");
        group.bench_function("advance", |bencher| {
            bencher.iter(|| field.advance(black_box(&from), source, black_box(0.3), &mut to));
        });
        let mut pressure = vec![0.0; VERTICES];
        group.bench_function("pressure of a stage", |bencher| {
            bencher.iter(|| {
                let dt = black_box(0.3);
                field.pressure_after(black_box(&from), source, dt, &mut pressure, &mut to)
            });
        });
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = common::config(1.0);
    targets = thermal
}
criterion_main!(benches);
