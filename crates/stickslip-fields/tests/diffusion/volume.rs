//! Conservation of volume.

use proptest::prelude::*;
use stickslip_fields::{Diffusion, Hydraulics, Line, RateHistory, Well};

use crate::march::{March, zone};

#[test]
fn volume_over_thousands_of_steps_on_a_line() {
    let line = Line::uniform([-10e3, 10e3], 2001).expect("line");
    let rates = [(0.0, 1e-6), (3.21e6, 2.5e-6), (5.4e6, 0.0)];
    let rates = RateHistory::constant_between(&rates).expect("rates");
    let field = Diffusion::new(line, &zone(1e-13)).expect("field");
    let field = field.with_well(Well::new(0.0, rates)).expect("well");
    let mut march = March::new(&field);
    for i in 0..3000_u32 {
        march.step(600.0 * (1.0 + 5.0 * f64::from(i % 7)));
    }
    let (injected, stored) = (march.total("injected_volume"), march.total("stored_volume"));
    assert!(
        (stored / injected - 1.0).abs() < 1e-13,
        "{:e}",
        stored / injected - 1.0
    );
    assert!((injected / (3.21e6 * 1e-6 + 2.19e6 * 2.5e-6) - 1.0).abs() < 1e-14);
}

proptest! {
    /// Any permeabilities, lengths and steps, with a bore: what went in is there.
    #[test]
    fn volume_is_conserved(
        exponents in prop::collection::vec(-18.0..-11.0_f64, 20),
        lengths in prop::collection::vec(0.1..100.0_f64, 20),
        steps in prop::collection::vec(0.0..9.0_f64, 12),
        cell in 0..20_usize,
        storage in -9.0..-3.0_f64,
    ) {
        let mut edges = vec![0.0];
        for length in lengths {
            edges.push(edges[edges.len() - 1] + length);
        }
        let permeability: Vec<f64> = exponents.iter().map(|e| 10.0_f64.powf(*e)).collect();
        let hydraulics = Hydraulics { permeability: permeability.into(), ..zone(0.0) };
        let rates = RateHistory::linear_between(&[(0.0, 1e-6), (1e6, 3e-6), (1e6, 0.0)]).expect("rates");
        let well = Well::new(stickslip_fields::Place::Cell(cell), rates);
        let well = well.with_bore_of_index(10.0_f64.powf(storage), 1e-10);
        let field = Diffusion::new(Line::between(&edges).expect("line"), &hydraulics).expect("field");
        let field = field.with_well(well).expect("well");
        let mut march = March::new(&field);
        for step in steps {
            march.step(10.0_f64.powf(step));
            let (injected, stored) = (march.total("injected_volume"), march.total("stored_volume"));
            prop_assert!((stored - injected).abs() <= 1e-12 * injected, "{injected:e} {stored:e}");
        }
    }
}
