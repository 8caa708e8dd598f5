//! Wells with a bore.

use stickslip_fields::{Diffusion, Line, RateHistory, Well};

use crate::march::{March, zone};

/// A bore and a cell, each of a storage: their difference decays at `WI (1/S_w + 1/C)`.
#[test]
fn a_bore_empties_into_its_cell() {
    let (storage, index, capacity) = (4e-9, 1e-12, 1e-8);
    let rate = index * (1.0 / storage + 1.0 / capacity);
    let errors = [100_u32, 200].map(|steps| {
        let line = Line::uniform([0.0, 10.0], 1).expect("line");
        let rates = RateHistory::constant_between(&[(0.0, 1e-6), (100.0, 0.0)]).expect("rates");
        let field = Diffusion::new(line, &zone(1e-13)).expect("field");
        let well = Well::new(5.0, rates).with_bore_of_index(storage, index);
        let field = field.with_well(well).expect("well");
        let mut march = March::new(&field);
        let end = 2.0 / rate;
        // The injection, then the decay.
        (0..steps).for_each(|_| march.step(100.0 / f64::from(steps)));
        (0..steps).for_each(|_| march.step((end - 100.0) / f64::from(steps)));
        let full = 1e-4 / (storage + capacity);
        // Of a constant rate Q over t_0: the mean of the answers to its parts.
        let spread = ((rate * 100.0).exp_m1() / (rate * 100.0)) * (-rate * end).exp();
        (march.pressure()[0] - full * (1.0 - spread)).abs() / full
    });
    assert!(
        errors[1] < 1e-4 && (errors[0] / errors[1]).log2() > 1.9,
        "{errors:?}"
    );
}
