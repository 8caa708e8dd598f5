//! Extreme steps and rates.

use proptest::prelude::*;
use stickslip_fields::{
    Boundary, Diffusion, Dilatancy, FaultField, LeakOff, Line, PermeabilityEvolution, RateHistory,
    Side, Well,
};

use crate::march::zone;

proptest! {
    #[test]
    fn everything_is_finite(
        speed in -30.0..2.0_f64,
        step in -9.0..15.5_f64,
        pressure in -1e8..1e8_f64,
        leaky in any::<bool>(),
    ) {
        let (v, dt) = (10.0_f64.powf(speed), 10.0_f64.powf(step));
        let evolution = PermeabilityEvolution {
            minimum: 0.0.into(),
            maximum: 1e-11.into(),
            slip_distance: 1e-3.into(),
            healing_time: 1e7.into(),
        };
        let dilatancy = Dilatancy {
            coefficient: 1e-4,
            reference_velocity: 1e-6,
            slip_distance: 1e-2,
            initial_change: 1e-4,
        };
        let field = Diffusion::new(Line::uniform([0.0, 1e3], 40).expect("line"), &zone(1e-13))
            .and_then(|field| field.with_permeability_evolution(&evolution))
            .and_then(|field| field.with_dilatancy(dilatancy))
            .and_then(|field| field.with_side(Side::End, Boundary::Pressure(pressure)))
            .and_then(|field| field.with_well(Well::new(0.0, RateHistory::constant(1e-6)?).with_bore_of_index(1e-8, 1e-10)))
            .expect("field");
        let leak = LeakOff { drainage_time: 1e-3.into(), far_pressure: 1e5.into() };
        let field = if leaky { field.with_leak_off(&leak).expect("leak-off") } else { field };
        let sizes = field.sizes();
        let mut to = sizes.memory.clone();
        let mut source = vec![0.0; sizes.sources];
        source[..40].fill(v);
        field.advance(&sizes.memory, [&source, &source], dt, &mut to).expect("advances");
        prop_assert!(to.iter().all(|value| value.is_finite()));
        let mut error = vec![0.0; 40];
        field.error(&sizes.memory, [&source, &source], dt, &to, &mut error);
        prop_assert!(error.iter().all(|value| value.is_finite()));
    }

    /// Without sources the greatest pressure does not grow beyond what the trapezoidal part allows, and a long step ends
    /// at the mean.
    #[test]
    fn long_steps_relax(values in prop::collection::vec(-1e7..1e7_f64, 30), step in 12.0..15.5_f64) {
        let line = Line::uniform([0.0, 300.0], 30).expect("line");
        let field = Diffusion::new(line, &zone(1e-13)).expect("field");
        let field = field.with_initial_pressure(values.clone()).expect("pressure");
        let memory = field.sizes().memory;
        let mut to = memory.clone();
        field.advance(&memory, [&[], &[]], 10.0_f64.powf(step), &mut to).expect("advances");
        let mut pressure = vec![0.0; 30];
        field.pressure(&to, &mut pressure);
        let mean = values.iter().sum::<f64>() / 30.0;
        for pressure in pressure {
            prop_assert!((pressure - mean).abs() < 10.0, "{pressure:e} {mean:e}");
        }
    }
}

#[test]
fn a_step_of_no_time_changes_nothing() {
    let line = Line::uniform([0.0, 300.0], 3).expect("line");
    let field = Diffusion::new(line, &zone(1e-13)).expect("field");
    let field = field
        .with_initial_pressure(vec![1.0, 5.0, 2.0])
        .expect("pressure");
    let memory = field.sizes().memory;
    let (mut to, mut error) = (vec![0.0; memory.len()], vec![0.0; 3]);
    field
        .advance(&memory, [&[], &[]], 0.0, &mut to)
        .expect("advances");
    field.error(&memory, [&[], &[]], 0.0, &to, &mut error);
    assert_eq!((to, error), (memory, vec![0.0; 3]));
}
