//! Planes of cells.

use std::f64::consts::PI;

use proptest::prelude::*;
use stickslip_fields::{Boundary, Diffusion, Hydraulics, Line, Plane, RateHistory, Side, Well};

use crate::march::{March, zone};

/// `E1(x)`, by its series and its continued fraction.
fn e1(x: f64) -> f64 {
    if x < 2.0 {
        let (mut term, mut sum) = (1.0, 0.0);
        for n in 1..60 {
            term *= -x / f64::from(n);
            sum -= term / f64::from(n);
        }
        return sum - x.ln() - 0.577_215_664_901_532_9;
    }
    let mut tail = 0.0;
    for n in (1..200).rev() {
        let n = f64::from(n);
        tail = n * n / (x + 2.0 * n + 1.0 - tail);
    }
    (-x).exp() / (x + 1.0 - tail)
}

#[test]
fn exponential_integral_of_the_tests() {
    let table = [
        (0.01, 4.0379295765),
        (0.1, 1.8229239584),
        (1.0, 0.2193839344),
        (4.0, 0.0037793524),
    ];
    for (x, value) in table {
        assert!((e1(x) - value).abs() < 1e-10, "{x}");
    }
}

/// A point source in an unbounded plane: `p = Q eta_f/(4 pi k w_h) E1(r^2/(4 alpha t))`.
fn radial(cell: f64, radii: &[f64]) -> Vec<f64> {
    let half = (1000.0 / cell).round();
    let end = (half + 0.5) * cell;
    let count = 2 * half as usize + 1;
    let plane = Plane::new([[-end, end]; 2], [count; 2]).expect("plane");
    let rates = RateHistory::constant_between(&[(0.0, 3e-3)]).expect("rates");
    let field = Diffusion::new(plane, &zone(5e-14)).expect("field");
    let field = field.with_well(Well::new([0.0, 0.0], rates)).expect("well");
    let mut march = March::new(&field);
    march.adaptively(10.0, 20.0, 3.6e5);
    let pressure = march.pressure();
    let middle = half as usize;
    let error = |&radius: &f64| {
        let found = pressure[middle * count + middle + (radius / cell).round() as usize];
        // The well's cell shows the pressure at its equivalent radius.
        let at = if radius > 0.0 {
            radius
        } else {
            0.198_506 * cell
        };
        let exact = 15e6 / PI * e1(at * at / (4.0 * 0.05 * 3.6e5));
        found / exact - 1.0
    };
    radii.iter().map(error).collect()
}

#[test]
fn a_point_source_is_of_second_order() {
    let radii = [0.0, 40.0, 100.0, 200.0];
    let (coarse, fine) = (radial(20.0, &radii), radial(10.0, &radii));
    let bounds = [5e-4, 4e-3, 1e-3, 4e-4];
    for (error, bound) in fine.iter().zip(bounds) {
        assert!(error.abs() < bound, "{fine:?}");
    }
    // From four cells on.
    for i in 2..4 {
        let order = (coarse[i] / fine[i]).log2();
        assert!(order > 1.8, "{coarse:?} {fine:?}: {order}");
    }
}

/// A bore without much storage differs from its cell by `Q/WI`.
#[test]
fn a_bore_shows_the_pressure_at_its_radius() {
    let plane = Plane::new([[-205.0, 205.0]; 2], [41; 2]).expect("plane");
    let field = Diffusion::new(plane, &zone(5e-14)).expect("field");
    let rates = RateHistory::constant_between(&[(0.0, 3e-3)]).expect("rates");
    let well = Well::new([0.0, 0.0], rates).with_bore(1e-12, 0.1);
    let field = field.with_well(well).expect("well");
    let mut march = March::new(&field);
    march.adaptively(1.0, 100.0, 3.6e4);
    let bore = field.bore_pressures(&march.memory)[0];
    let exact = 15e6 / PI * e1(0.01 / (4.0 * 0.05 * 3.6e4));
    assert!((bore / exact - 1.0).abs() < 1e-3, "{bore:e} {exact:e}");
    let (injected, stored) = (march.total("injected_volume"), march.total("stored_volume"));
    assert!((stored / injected - 1.0).abs() < 1e-12);
}

/// All conditions at both ends, along both directions.
#[test]
fn plane_waves_are_those_of_a_line() {
    let conditions = [
        Boundary::Sealed,
        Boundary::Pressure(3e5),
        Boundary::Flux(1e-8),
    ];
    for first in conditions {
        for last in conditions {
            let line = Line::uniform([0.0, 120.0], 12).expect("line");
            let wave: Vec<f64> = (0..12).map(|i| 1e5 * f64::from(i * i % 7)).collect();
            let field = Diffusion::new(line, &zone(1e-13)).expect("field");
            let field = field.with_initial_pressure(wave.clone()).expect("pressure");
            let field = field.with_side(Side::Begin, first).expect("side");
            let field_of_line = field.with_side(Side::End, last).expect("side");
            let mut line = March::new(&field_of_line);
            for along in [true, false] {
                let (counts, sides) = if along {
                    ([12, 5], [Side::Begin, Side::End])
                } else {
                    ([5, 12], [Side::Top, Side::Bottom])
                };
                let ends = counts.map(|count| [0.0, 10.0 * count as f64]);
                let plane = Plane::new(ends, counts).expect("plane");
                let place = |cell: usize| if along { cell % 12 } else { cell / 5 };
                let initial: Vec<f64> = (0..60).map(|cell| wave[place(cell)]).collect();
                let field = Diffusion::new(plane, &zone(1e-13)).expect("field");
                let field = field.with_initial_pressure(initial).expect("pressure");
                let field = field.with_side(sides[0], first).expect("side");
                let field = field.with_side(sides[1], last).expect("side");
                let mut plane = March::new(&field);
                line.memory = stickslip_fields::FaultField::sizes(&field_of_line).memory;
                for dt in [1.0, 100.0, 1e3, 1e4, 1e6] {
                    line.step(dt);
                    plane.step(dt);
                    let line = line.pressure();
                    for (cell, value) in plane.pressure().into_iter().enumerate() {
                        let exact = line[place(cell)];
                        assert!(
                            (value - exact).abs() < 1e-10 * 6e5,
                            "{first:?} {last:?} {along} {dt}: {value:e} {exact:e}"
                        );
                    }
                }
                let velocity =
                    ["darcy_velocity_along_strike", "darcy_velocity_down_dip"][usize::from(!along)];
                let (plane, line) = (plane.read(velocity), line.read("darcy_velocity"));
                for (cell, value) in plane.into_iter().enumerate() {
                    assert!((value - line[place(cell)]).abs() < 1e-10 * 1e-6);
                }
            }
        }
    }
}

/// The pressures after a step of TR-BDF2, by elimination of the dense matrix.
fn dense(counts: [usize; 2], mobility: &[f64], start: &[f64], cell: usize, dt: f64) -> Vec<f64> {
    let n = counts[0] * counts[1];
    let mut laplacian = vec![vec![0.0; n]; n];
    let mut join = |a: usize, b: usize| {
        let conductance = 2.0 / (1.0 / mobility[a] + 1.0 / mobility[b]);
        for (i, j) in [(a, b), (b, a)] {
            laplacian[i][i] += conductance;
            laplacian[i][j] -= conductance;
        }
    };
    for a in 0..n {
        if a % counts[0] + 1 < counts[0] {
            join(a, a + 1);
        }
        if a + counts[0] < n {
            join(a, a + counts[0]);
        }
    }
    let (gamma, capacity) = (2.0 - 2.0_f64.sqrt(), 1e-9 * 100.0);
    let q = 0.5 * gamma * dt;
    let product = |p: &[f64], i: usize| -> f64 { (0..n).map(|j| laplacian[i][j] * p[j]).sum() };
    let solve = |mut b: Vec<f64>| {
        let mut a = laplacian.clone();
        for (i, row) in a.iter_mut().enumerate() {
            row.iter_mut().for_each(|value| *value *= q);
            row[i] += capacity;
        }
        for i in 0..n {
            for j in i + 1..n {
                let factor = a[j][i] / a[i][i];
                for k in i..n {
                    a[j][k] -= factor * a[i][k];
                }
                b[j] -= factor * b[i];
            }
        }
        for i in (0..n).rev() {
            let sum: f64 = (i + 1..n).map(|j| a[i][j] * b[j]).sum();
            b[i] = (b[i] - sum) / a[i][i];
        }
        b
    };
    let well = |i: usize| if i == cell { 1e-6 } else { 0.0 };
    let middle = solve(
        (0..n)
            .map(|i| capacity * start[i] + q * (2.0 * well(i) - product(start, i)))
            .collect(),
    );
    let weight = 1.0 / (gamma * (2.0 - gamma));
    let past = |i: usize| weight * middle[i] - (1.0 - gamma).powi(2) * weight * start[i];
    solve((0..n).map(|i| capacity * past(i) + q * well(i)).collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn a_plane_of_any_contrast_is_its_dense_solution(
        exponents in prop::collection::vec(-16.0..-10.0_f64, 48),
        start in prop::collection::vec(-1e6..1e6_f64, 48),
        step in 0.0..7.0_f64,
        cell in 0..48_usize,
    ) {
        let permeability: Vec<f64> = exponents.iter().map(|e| 10.0_f64.powf(*e)).collect();
        let mobility: Vec<f64> = permeability.iter().map(|k| k / 1e-3).collect();
        let hydraulics = Hydraulics { permeability: permeability.into(), ..zone(0.0) };
        let plane = Plane::new([[0.0, 80.0], [0.0, 60.0]], [8, 6]).expect("plane");
        let center = plane.center(cell);
        let rates = RateHistory::constant(1e-6).expect("rate");
        let field = Diffusion::new(plane, &hydraulics)
            .and_then(|field| field.with_well(Well::new(center, rates)))
            .and_then(|field| field.with_initial_pressure(start.clone()))
            .expect("field");
        let mut march = March::new(&field);
        let dt = 10.0_f64.powf(step);
        march.step(dt);
        let exact = dense([8, 6], &mobility, &start, cell, dt);
        let most = exact.iter().fold(1e6, |most: f64, value| most.max(value.abs()));
        for (value, exact) in march.pressure().iter().zip(&exact) {
            prop_assert!((value - exact).abs() < 1e-8 * most, "{value:e} {exact:e}");
        }
        let (injected, stored) = (march.total("injected_volume"), march.total("stored_volume"));
        prop_assert!((stored - injected).abs() < 1e-12 * (injected + 48.0 * 1e-7 * 1e6));
    }
}

#[test]
fn volume_over_thousands_of_steps_on_a_plane() {
    let plane = Plane::new([[-160.0, 160.0]; 2], [32; 2]).expect("plane");
    let permeability: Vec<f64> = (0..1024).map(|i| 1e-14 * 10.0_f64.powi(i % 3)).collect();
    let hydraulics = Hydraulics {
        permeability: permeability.into(),
        ..zone(0.0)
    };
    let rates = [(0.0, 1e-3), (3.21e5, 2.5e-3), (5.4e5, 0.0)];
    let rates = RateHistory::linear_between(&rates).expect("rates");
    let field = Diffusion::new(plane, &hydraulics).expect("field");
    let field = field.with_well(Well::new([1.0, 1.0], rates)).expect("well");
    let mut march = March::new(&field);
    for i in 0..3000_u32 {
        march.step(60.0 * (1.0 + 5.0 * f64::from(i % 7)));
    }
    let (injected, stored) = (march.total("injected_volume"), march.total("stored_volume"));
    assert!(
        (stored / injected - 1.0).abs() < 1e-13,
        "{:e}",
        stored / injected - 1.0
    );
}
