//! Consolidation of a layer that drains at one end (Terzaghi).

use stickslip_fields::{Boundary, Diffusion, Line, Side};

use crate::march::{March, zone};

const LAYER: f64 = 100.0;
/// `alpha t/H^2`, the pressure at the sealed end and its mean over the initial one.
const TABLE: [[f64; 3]; 5] = [
    [0.05, 0.996869195, 0.747686748],
    [0.1, 0.949305363, 0.643176600],
    [0.2, 0.772311607, 0.495912180],
    [0.5, 0.370777430, 0.236049669],
    [1.0, 0.107977044, 0.068740322],
];

/// The greatest errors of the mean and of the pressure at the sealed end.
fn errors(line: Line, side: Side, steps: u32) -> [f64; 2] {
    let cell = if side == Side::Begin {
        line.count() - 1
    } else {
        0
    };
    let sealed = line.positions()[cell];
    let field = Diffusion::new(line, &zone(1e-13)).expect("field");
    let field = field
        .with_side(side, Boundary::Pressure(0.0))
        .expect("side");
    let field = field.with_initial_pressure(1e6).expect("pressure");
    let mut march = March::new(&field);
    let (mut before, mut most) = (0.0, [0.0_f64; 2]);
    for [time, end, mean] in TABLE {
        // Steps that grow with time: the initial pressure jumps at the side.
        let steps = if before == 0.0 { 8 * steps } else { steps };
        for i in 0..steps {
            let share =
                |i: u32| (f64::from(i) / f64::from(steps)).powi(if before == 0.0 { 3 } else { 1 });
            march.step((share(i + 1) - share(i)) * (time - before) * LAYER * LAYER / 0.1);
        }
        before = time;
        let found = march.pressure();
        let stored = march.total("stored_volume") / (1e-9 * LAYER * 1e6) + 1.0;
        let drained = march.total("drained_volume") / (1e-9 * LAYER * 1e6);
        assert!((stored + drained - 1.0).abs() < 1e-13, "{stored} {drained}");
        most[0] = most[0].max((stored - mean).abs());
        // The pressure at the end by its parabola from the centre of the last cell.
        let distance = (if cell == 0 { sealed } else { LAYER - sealed }) / LAYER;
        let slope = 0.5 * std::f64::consts::PI * distance;
        most[1] = most[1].max((found[cell] / 1e6 / slope.cos() - end).abs());
    }
    most
}

#[test]
fn terzaghi_is_of_second_order() {
    for side in [Side::Begin, Side::End] {
        let [coarse, fine] = [(40, 20), (80, 40)].map(|(cells, steps)| {
            errors(
                Line::uniform([0.0, LAYER], cells).expect("line"),
                side,
                steps,
            )
        });
        for (coarse, fine) in coarse.iter().zip(fine) {
            let order = (coarse / fine).log2();
            assert!(order > 1.85 && fine < 1e-4, "{coarse:e} {fine:e}: {order}");
        }
    }
}

#[test]
fn graded_cells_converge() {
    // Cells that shrink to the drained end.
    let errors = [40, 80].map(|count| {
        let share = |i: u32| f64::from(i) / f64::from(count);
        let edges: Vec<f64> = (0..=count).map(|i| LAYER * share(i).powf(1.5)).collect();
        errors(Line::between(&edges).expect("line"), Side::Begin, count / 2)
    });
    assert!(errors[1].iter().all(|&error| error < 2e-4), "{errors:?}");
    assert!((errors[0][0] / errors[1][0]).log2() > 1.7, "{errors:?}");
}

#[test]
fn a_trace_in_any_order_is_the_line() {
    let positions: Vec<f64> = (0..=40).map(|i| 2.5 * f64::from(i)).collect();
    // 17 is prime to 41.
    let shuffled: Vec<f64> = (0..41).map(|i| positions[17 * i % 41]).collect();
    let run = |positions: &[f64]| {
        let line = Line::trace(positions).expect("trace");
        let initial: Vec<f64> = positions.iter().map(|x| 1e6 + 1e4 * x).collect();
        let field = Diffusion::new(line, &zone(1e-13)).expect("field");
        let field = field.with_initial_pressure(initial).expect("pressure");
        let mut march = March::new(&field);
        (0..20).for_each(|_| march.step(1e3));
        march.pressure()
    };
    let (sorted, mixed) = (run(&positions), run(&shuffled));
    for (i, mixed) in mixed.iter().enumerate() {
        assert_eq!(mixed.to_bits(), sorted[17 * i % 41].to_bits());
    }
}

#[test]
fn a_given_flux_fills_at_its_rate() {
    let line = Line::uniform([0.0, LAYER], 50).expect("line");
    let field = Diffusion::new(line, &zone(1e-13)).expect("field");
    let field = field
        .with_side(Side::End, Boundary::Flux(2e-7))
        .expect("side");
    let mut march = March::new(&field);
    (0..40).for_each(|_| march.step(1e4));
    let stored = march.total("stored_volume");
    assert!((stored / (2e-7 * 4e5) - 1.0).abs() < 1e-13);
    assert!((march.total("drained_volume") / stored + 1.0).abs() < 1e-13);
    // Late: q x^2/(2 H), over k/eta_f, and a constant: q H/2 between both ends.
    let pressure = march.pressure();
    let drop = 2e-7 * (0.5 * LAYER - 1.0) / 1e-10;
    assert!(
        ((pressure[49] - pressure[0]) / drop - 1.0).abs() < 1e-3,
        "{drop:e}"
    );
}

#[test]
fn terzaghi_on_a_trace_is_of_second_order() {
    let [coarse, fine] = [(40_u32, 20), (80, 40)].map(|(cells, steps)| {
        let share = |i: u32| f64::from(i) / f64::from(cells);
        let positions: Vec<f64> = (0..=cells).map(|i| LAYER * share(i)).collect();
        errors(Line::trace(&positions).expect("trace"), Side::Begin, steps)
    });
    // The mean is of first order, by half the end cell, whose pressure is that of the side.
    let order = (coarse[1] / fine[1]).log2();
    assert!(
        order > 1.7 && fine[1] < 2e-4,
        "{coarse:?} {fine:?}: {order}"
    );
}
