//! The estimated error of a step, and what must not change.

use stickslip_fields::{
    Boundary, Diffusion, FaultField, Hydraulics, Line, Place, Plane, RateHistory, Side, Well,
};

use crate::march::{March, zone};

/// A smooth state: the error of a step against many small ones.
fn estimate_and_error(field: &Diffusion, smooth: u32, dt: f64) -> [f64; 2] {
    let mut march = March::new(field);
    (0..smooth).for_each(|_| march.step(dt));
    let start = march.memory.clone();
    let mut to = start.clone();
    field
        .advance(&start, [&[], &[]], dt, &mut to)
        .expect("advances");
    let vertices = field.sizes().vertices;
    let (mut estimate, mut coarse) = (vec![0.0; vertices], vec![0.0; vertices]);
    field.error(&start, [&[], &[]], dt, &to, &mut estimate);
    field.pressure(&to, &mut coarse);
    (0..64).for_each(|_| march.step(dt / 64.0));
    let fine = march.pressure();
    let most =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, |most, x| most.max(x.abs()));
    let difference = most(
        &mut coarse
            .iter()
            .zip(&fine)
            .zip(&estimate)
            .map(|((a, b), e)| a - b - e),
    );
    let error = most(&mut coarse.iter().zip(&fine).map(|(a, b)| a - b));
    [difference, error]
}

/// The estimate has the sign and the size of the error: what it leaves falls faster.
#[test]
fn estimates_are_the_errors_of_small_steps() {
    let line = Line::uniform([0.0, 100.0], 40).expect("line");
    let rates = || RateHistory::linear_between(&[(0.0, 1e-7), (1e9, 2e-4)]).expect("rates");
    let bore = Well::new(30.0, rates()).with_bore_of_index(1e-9, 1e-9);
    let line = Diffusion::new(line, &zone(1e-13))
        .and_then(|field| field.with_well(bore))
        .and_then(|field| field.with_side(Side::End, Boundary::Pressure(1e5)));
    let plane = Plane::new([[0.0, 100.0], [0.0, 60.0]], [20, 12]).expect("plane");
    let bore = Well::new([33.0, 21.0], rates()).with_bore(1e-9, 0.1);
    let plane = Diffusion::new(plane, &zone(1e-13))
        .and_then(|field| field.with_well(bore))
        .and_then(|field| field.with_side(Side::Top, Boundary::Pressure(1e5)));
    for field in [line, plane].map(|field| field.expect("field")) {
        // The same state, as far as it goes: smooth after 40 steps.
        let [coarse, fine] =
            [(40, 500.0), (80, 250.0)].map(|(n, dt)| estimate_and_error(&field, n, dt));
        assert!(coarse[0] < 0.35 * coarse[1], "{coarse:?}");
        assert!(fine[0] < 0.2 * fine[1], "{fine:?}");
        let order = (coarse[1] / fine[1]).log2();
        assert!(order > 2.5, "{coarse:?} {fine:?}: {order}");
    }
}

/// A sealed cell keeps its pressure, and fluid stays on its side.
#[test]
fn a_sealed_cell_parts_a_line_and_a_plane() {
    let permeability = |column: usize| if column == 4 { 0.0 } else { 1e-13 };
    let line = Line::uniform([0.0, 100.0], 10).expect("line");
    let plane = Plane::new([[0.0, 100.0], [0.0, 30.0]], [10, 3]).expect("plane");
    let of = |count: usize| Hydraulics {
        permeability: (0..count)
            .map(|cell| permeability(cell % 10))
            .collect::<Vec<_>>()
            .into(),
        ..zone(0.0)
    };
    let fields = [
        Diffusion::new(line, &of(10)),
        Diffusion::new(plane, &of(30)),
    ];
    for field in fields {
        let rates = RateHistory::constant(1e-6).expect("rate");
        let field = field.and_then(|field| field.with_well(Well::new(Place::Cell(2), rates)));
        let field = field
            .and_then(|field| field.with_initial_pressure(1e5))
            .expect("field");
        let mut march = March::new(&field);
        for dt in [1.0, 1e3, 1e6, 1e9] {
            march.step(dt);
            let pressure = march.pressure();
            let most = pressure.iter().fold(0.0_f64, |most, p| most.max(p.abs()));
            for (cell, &pressure) in pressure.iter().enumerate() {
                match cell % 10 {
                    0..4 => assert!(pressure >= 1e5 * (1.0 - 1e-12)),
                    _ => assert!((pressure - 1e5).abs() <= 1e-12 * most, "{pressure:e}"),
                }
            }
            let (injected, stored) = (march.total("injected_volume"), march.total("stored_volume"));
            // To the rounding of all that is stored.
            assert!(
                (stored - injected).abs() < 1e-12 * injected + 1e-15 * 0.3,
                "{dt:e}: {stored:e} {injected:e}"
            );
        }
    }
}

/// A contact that covers a part of the cells sees their pressure; its slip feeds them alone.
#[test]
fn vertices_of_a_part_of_the_cells() {
    let plane = Plane::new([[0.0, 50.0], [0.0, 40.0]], [5, 4]).expect("plane");
    let pressure: Vec<f64> = (0..20).map(f64::from).collect();
    let field = Diffusion::new(plane, &zone(1e-13)).expect("field");
    let field = field.with_initial_pressure(pressure).expect("pressure");
    let field = field.with_vertices(&[7, 6, 12]).expect("vertices");
    assert_eq!(March::new(&field).pressure(), [7.0, 6.0, 12.0]);
    assert_eq!(field.sizes().vertices, 3);
    assert_eq!(field.cell_pressures(&field.sizes().memory)[19], 19.0);
}

/// Shares of a source, in the order of the vertices of a trace.
#[test]
fn shares_of_a_source_follow_the_vertices() {
    let line = Line::trace(&[30.0, 0.0, 10.0, 20.0]).expect("trace");
    let rates = RateHistory::constant(1e-6).expect("rate");
    let field = Diffusion::new(line, &zone(1e-20)).expect("field");
    let field = field
        .with_source(&[1.0, 2.0, 0.0, 0.0], rates)
        .expect("source");
    let mut march = March::new(&field);
    march.step(10.0);
    let lengths = [5.0, 5.0, 10.0, 10.0];
    let volumes: Vec<f64> = march
        .pressure()
        .iter()
        .zip(lengths)
        .map(|(p, length)| p * 1e-9 * length)
        .collect();
    for (volume, exact) in volumes.iter().zip([1e-5, 2e-5, 0.0, 0.0]) {
        assert!((volume - exact).abs() < 1e-8 * 1e-5, "{volumes:?}");
    }
    assert!((march.total("injected_volume") / 3e-5 - 1.0).abs() < 1e-14);
}

/// Scratch is shared by all calls: results do not depend on those before.
#[test]
fn results_do_not_depend_on_scratch() {
    let plane = Plane::new([[0.0, 50.0], [0.0, 40.0]], [5, 4]).expect("plane");
    let rates = RateHistory::constant(1e-6).expect("rate");
    let new = || {
        Diffusion::new(plane.clone(), &zone(1e-13))
            .and_then(|field| {
                field.with_well(Well::new([1.0, 1.0], rates.clone()).with_bore(1e-9, 0.1))
            })
            .expect("field")
    };
    let (used, start) = (new(), new().sizes().memory);
    let mut to = start.clone();
    for dt in [1.0, 1e7, 3.0, 1e3] {
        used.advance(&start, [&[], &[]], dt, &mut to)
            .expect("advances");
        let mut fresh = start.clone();
        new()
            .advance(&start, [&[], &[]], dt, &mut fresh)
            .expect("advances");
        assert_eq!(to, fresh);
    }
}
