//! The bound of the error of a cell against the error itself.

use nalgebra::Vector2;
use proptest::prelude::*;
use stickslip_friction::{
    CellState, EvolutionLaw, QuasiDynamicFriction, RegularizedDieterichRuina,
};

use super::*;

/// A logarithmic range.
fn size(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

proptest! {
    /// A cell whose error is the larger one is never left out by the bound.
    #[test]
    fn the_bound_leaves_out_no_larger_error(
        (a, b, damping) in (size(1e-4, 1.0), size(1e-4, 1.0), size(1e3, 1e8)),
        (rate, angle) in (size(1e-30, 1e2), 0.0..6.3),
        (normal, coefficient) in (size(1e2, 1e10), size(1e-6, 2.0)),
        errors in [-1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0],
        scales in (size(1e-8, 1e8), size(1e-12, 1.0), size(1e-8, 1e8)),
        floor in prop_oneof![Just(0.0), size(1e-30, 1.0)],
    ) {
        let direction = Vector2::new(f64::cos(angle), f64::sin(angle));
        let shear = direction * (normal * coefficient + damping * rate);
        let law = RegularizedDieterichRuina {
            a,
            b,
            reference_friction: 0.6,
            reference_velocity: 1e-6,
            slip_distance: 1e-2,
        };
        let friction = QuasiDynamicFriction::new(
            &[law],
            damping,
            CellState::LogTheta,
            EvolutionLaw::Aging,
            f64::MIN_POSITIVE,
        );
        let cell = Cells {
            cells: None,
            friction: friction.map_err(|error| TestCaseError::fail(error.to_string()))?,
            direct_and_evolving: vec![[a, b]],
            damping,
            per_area: vec![1.0],
            shear_stress: [vec![shear.x], vec![shear.y]],
            slip_rate: [vec![0.0], vec![0.0]],
        };
        let at = (direction * rate, normal);
        let [x, y, state, clamped] = errors;
        let of_cell = (Vector2::new(x, y) * scales.0, state * scales.1, clamped * scales.2);
        let deviation = cell.deviation(0, at, of_cell);
        let distance = rate_distance(at.0, at.0 - deviation, floor);
        prop_assume!(distance.is_finite() && distance > f64::MIN_POSITIVE);
        prop_assert!(cell.exceeds(0, at, of_cell, [0.999_999_999_999 * distance, floor]));
    }
}
