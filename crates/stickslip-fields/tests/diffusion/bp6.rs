//! The pore pressure of BP6-QD (SEAS): injection at the middle of a line for 100 days.

use std::f64::consts::PI;

use stickslip_fields::{Diffusion, Line, RateHistory, Well};

use crate::march::{DAY, March, zone};

const DIFFUSIVITY: f64 = 0.1;
const FLUX: f64 = 1.25e-6;
const SHUT: f64 = 100.0 * DAY;
const PEAK: f64 = 6.555e6;

fn field(cell: f64) -> (Diffusion, Line) {
    let half = (20e3 / cell - 0.5).round();
    let end = (half + 0.5) * cell;
    let line = Line::uniform([-end, end], 2 * half as usize + 1).expect("line");
    let rates = RateHistory::constant_between(&[(0.0, FLUX), (SHUT, 0.0)]).expect("rates");
    let field = Diffusion::new(line.clone(), &zone(1e-13)).expect("field");
    (field.with_well(Well::new(0.0, rates)).expect("well"), line)
}

/// `sqrt(t) (exp(-x^2)/sqrt(pi) - x erfc(x))` with `x = abs(z)/sqrt(4 alpha t)`.
fn spread(z: f64, time: f64) -> f64 {
    if time <= 0.0 {
        return 0.0;
    }
    let x = z.abs() / (4.0 * DIFFUSIVITY * time).sqrt();
    time.sqrt() * ((-x * x).exp() / PI.sqrt() - x * libm::erfc(x))
}

fn exact(z: f64, time: f64) -> f64 {
    FLUX / (1e-9 * DIFFUSIVITY.sqrt()) * (spread(z, time) - spread(z, time - SHUT))
}

fn error(line: &Line, pressure: &[f64], time: f64) -> f64 {
    let cells = line.positions().iter().zip(pressure);
    cells.fold(0.0, |most: f64, (&z, p)| {
        most.max((p - exact(z, time)).abs())
    }) / PEAK
}

#[test]
fn pressure_of_bp6_by_its_own_error_control() {
    let (field, line) = field(10.0);
    let mut march = March::new(&field);
    let (mut dt, mut before) = (60.0, 0.0);
    for day in [1.0, 10.0, 50.0, 100.0, 101.0, 110.0, 200.0, 730.0] {
        dt = march.adaptively(dt, 3.0, (day - before) * DAY);
        // After the shut-in as at the start.
        dt = if day == 100.0 { 60.0 } else { dt };
        before = day;
        let error = error(&line, &march.pressure(), day * DAY);
        assert!(
            error < 8e-5,
            "day {day}: {error:.2e}, {} steps",
            march.steps
        );
    }
    assert!(march.steps < 1000, "{} steps", march.steps);
}

#[test]
fn pressure_of_bp6_is_of_second_order_in_space() {
    let errors = [40.0, 20.0].map(|cell| {
        let (field, line) = field(cell);
        let mut march = March::new(&field);
        march.adaptively(60.0, 3.0, DAY);
        error(&line, &march.pressure(), DAY)
    });
    assert!((errors[0] / errors[1]).log2() > 1.9, "{errors:?}");
}

#[test]
fn shut_in_does_not_ring() {
    let (field, line) = field(10.0);
    let mut march = March::new(&field);
    march.adaptively(60.0, 30.0, SHUT);
    let (middle, mut before) = (line.count() / 2, f64::INFINITY);
    for step in 1..=4 {
        march.step(10.0 * DAY);
        let (at, truth) = (
            march.pressure()[middle],
            exact(0.0, SHUT + 10.0 * DAY * f64::from(step)),
        );
        let tolerance = if step == 1 { 0.03 } else { 3e-3 };
        assert!(
            at < before && (at / truth - 1.0).abs() < tolerance,
            "step {step}: {at:e}, {truth:e}"
        );
        before = at;
    }
}

#[test]
fn darcy_velocity_of_bp6() {
    let (field, line) = field(10.0);
    let mut march = March::new(&field);
    march.adaptively(60.0, 3.0, 50.0 * DAY);
    let velocity = march.read("darcy_velocity");
    for (&z, velocity) in line.positions().iter().zip(velocity) {
        // -(k/eta_f) p' = (q_0/2) sign(z) erfc(abs(z)/sqrt(4 alpha t)); the mean of both directions in the well's cell.
        let reach = (4.0 * DIFFUSIVITY * 50.0 * DAY).sqrt();
        let side = if z.abs() < 1.0 { 0.0 } else { z.signum() };
        let exact = 0.5 * FLUX * side * libm::erfc(z.abs() / reach);
        assert!(
            (velocity - exact).abs() < 1e-4 * FLUX,
            "{z} m: {velocity:e}, {exact:e}"
        );
    }
}
