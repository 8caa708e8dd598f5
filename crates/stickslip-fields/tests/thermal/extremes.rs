//! Any slip rate, step and parameter.

use proptest::prelude::*;
use stickslip_fields::{
    FaultField, PoreFluid, ShearHeating, ShearZone, ThermalPressurization, check_fault_field,
};

/// Ten to a power.
fn decades(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from..to).prop_map(|exponent| 10_f64.powf(exponent))
}

fn diffusivity() -> impl Strategy<Value = f64> {
    prop_oneof![decades(-12.0, 1.0), Just(0.0), Just(1e-6)]
}

/// Parameters of two vertices.
fn parameters() -> impl Strategy<Value = (ShearZone, PoreFluid, usize)> {
    let two = |strategy: fn() -> BoxedStrategy<f64>| [strategy(), strategy()];
    let diffusivities = two(|| diffusivity().boxed());
    let more = two(|| diffusivity().boxed());
    let widths = two(|| decades(-6.0, 0.0).boxed());
    let is_close = prop_oneof![Just(None), (-1e-5..1e-5).prop_map(Some), Just(Some(0.0))];
    (diffusivities, more, widths, is_close, 2..=64_usize).prop_map(
        |(thermal, mut hydraulic, half_width, is_close, modes)| {
            if let Some(by) = is_close {
                hydraulic = thermal.map(|thermal| thermal * (1.0 + by));
            }
            let zone = ShearZone {
                half_width: half_width.to_vec().into(),
                volumetric_heat_capacity: 2.7e6.into(),
                thermal_diffusivity: thermal.to_vec().into(),
                initial_temperature: 300.0.into(),
            };
            let fluid = PoreFluid {
                hydraulic_diffusivity: hydraulic.to_vec().into(),
                pressurization_coefficient: 1e5.into(),
            };
            (zone, fluid, modes)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, ..ProptestConfig::default() })]

    #[test]
    fn fields_of_any_parameters_keep_the_contract((zone, fluid, modes) in parameters()) {
        let heating = ShearHeating::new(2, zone.clone()).and_then(|field| field.with_modes(modes));
        prop_assert_eq!(check_fault_field(&heating.expect("it is legal")), Ok(()));
        let field = ThermalPressurization::new(2, zone, fluid);
        let field = field.and_then(|field| field.with_modes(modes));
        prop_assert_eq!(check_fault_field(&field.expect("it is legal")), Ok(()));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, ..ProptestConfig::default() })]

    /// Heat raises temperature and pressure, and both stay finite.
    #[test]
    fn any_motion_is_finite(
        (zone, fluid, _) in parameters(),
        motion in prop::collection::vec((decades(-30.0, 2.0), decades(-9.0, 15.5)), 1..12),
    ) {
        let field = ThermalPressurization::new(2, zone, fluid).expect("it is legal");
        let mut memory = field.sizes().memory;
        let mut before = [0.0; 2];
        for (slip_rate, dt) in motion {
            let after = [slip_rate * 3e7 / 2.7e6, slip_rate * 6e7 / 2.7e6];
            let from = memory.clone();
            field.advance(&from, [&before, &after], dt, &mut memory).expect("it advances");
            before = after;
            let (mut pressure, mut temperature) = ([0.0; 2], [0.0; 2]);
            field.pressure(&memory, &mut pressure);
            field.read(0, &memory, &mut temperature);
            prop_assert!(memory.iter().all(|value| *value >= 0.0 && value.is_finite()));
            prop_assert!(pressure.iter().all(|value| value.is_finite()));
            prop_assert!(temperature.iter().all(|value| *value >= 300.0 && value.is_finite()));
        }
    }
}
