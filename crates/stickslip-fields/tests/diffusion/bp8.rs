//! The pore pressure of BP8 (SEAS) with a Gaussian source, no flux at the sides of its square.

use stickslip_fields::{Diffusion, GaussianSource, Plane, RateHistory};

use crate::march::{March, zone};

const HOUR: f64 = 3600.0;

/// Diffusivity .05 m^2/s, 3 litres per second for 100 hours, a deviation of 50 m.
fn field(cells: usize) -> Diffusion {
    let plane = Plane::new([[-400.0, 400.0]; 2], [cells; 2]).expect("plane");
    let rates = RateHistory::constant_between(&[(0.0, 3e-3), (100.0 * HOUR, 0.0)]).expect("rates");
    let source = GaussianSource::new([0.0, 0.0], 50.0, rates);
    let field = Diffusion::new(plane, &zone(5e-14)).expect("field");
    field.with_gaussian_source(source).expect("source")
}

/// By interpolation of fifth degree: the point is a corner of cells.
fn at(pressure: &[f64], cells: usize, point: [f64; 2]) -> f64 {
    let length = 800.0 / cells as f64;
    let corner = point.map(|x| ((x + 400.0) / length).round() as usize);
    let weights = [3.0, -25.0, 150.0, 150.0, -25.0, 3.0].map(|weight| weight / 256.0);
    let mut sum = 0.0;
    for (i, down) in weights.iter().enumerate() {
        for (j, along) in weights.iter().enumerate() {
            sum += down * along * pressure[(corner[1] + i - 3) * cells + corner[0] + j - 3];
        }
    }
    sum
}

/// By quadrature of the heat kernel with its images \[MPa\]: hours, at (0, 0) and (200, 0).
const TABLE: [[f64; 3]; 4] = [
    [100.0, 13.056152, 2.571104],
    [200.0, 3.202374, 2.305918],
    [240.0, 2.591537, 2.085874],
    [720.0, 1.691367, 1.689432],
];

/// The relative errors at both points, and the number of steps.
fn errors(field: &Diffusion, cells: usize, tolerance: f64) -> (Vec<[f64; 2]>, usize) {
    let mut march = March::new(field);
    let (mut dt, mut before) = (60.0, 0.0);
    let errors = TABLE.map(|[hour, center, beside]| {
        dt = march.adaptively(dt, tolerance, (hour - before) * HOUR);
        // After the shut-in as at the start.
        dt = if before == 0.0 { 60.0 } else { dt };
        before = hour;
        let pressure = march.pressure();
        let found = [[0.0, 0.0], [200.0, 0.0]].map(|point| at(&pressure, cells, point) / 1e6);
        [found[0] / center - 1.0, found[1] / beside - 1.0]
    });
    let (injected, stored) = (march.total("injected_volume"), march.total("stored_volume"));
    assert!((stored / injected - 1.0).abs() < 1e-13);
    (errors.to_vec(), march.steps)
}

/// Cells of 10 m are within 6e-4, and without the error of second order in their size within 1e-4.
#[test]
fn pressure_of_bp8_is_of_second_order() {
    let [coarse, fine] = [40, 80].map(|cells| errors(&field(cells), cells, 10.0).0);
    for (coarse, fine) in coarse.iter().flatten().zip(fine.iter().flatten()) {
        assert!(fine.abs() < 6e-4, "{fine:e}");
        let extrapolated = (4.0 * fine - coarse) / 3.0;
        assert!(
            extrapolated.abs() < 1e-4,
            "{coarse:e} {fine:e} {extrapolated:e}"
        );
    }
}

/// With flow of fourth order cells of 10 m are within 1e-4, by steps of an estimated error of 30 Pa.
#[test]
fn pressure_of_bp8_by_flow_of_fourth_order() {
    let field = field(80).with_fourth_order().expect("plane");
    let (errors, steps) = errors(&field, 80, 30.0);
    assert!(
        errors.iter().flatten().all(|error| error.abs() < 1e-4),
        "{errors:?}"
    );
    assert!(steps < 250, "{steps} steps");
}
