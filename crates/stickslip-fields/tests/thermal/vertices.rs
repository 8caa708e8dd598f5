//! Vertices do not see each other, whatever block they are in.

use stickslip_fields::{FaultField, FaultRates, PoreFluid, ShearZone, ThermalPressurization};

use super::zones::{fluid, zone};

/// Memory, pressure and temperature after two steps, and the pressure after the second without the memory.
fn outcome(field: &ThermalPressurization, heat: &[f64]) -> [Vec<f64>; 4] {
    let n = heat.len();
    let later: Vec<f64> = heat.iter().map(|heat| 3.0 * heat).collect();
    let mut memories = vec![field.sizes().memory; 3];
    for (k, (sources, dt)) in [([heat, &later], 0.7), ([&later, heat], 1e3)]
        .into_iter()
        .enumerate()
    {
        let (from, to) = memories.split_at_mut(k + 1);
        field
            .advance(&from[k], sources, dt, &mut to[0])
            .expect("the field advances");
    }
    let [mut pressure, mut after, mut temperature] = [vec![0.0; n], vec![0.0; n], vec![0.0; n]];
    field.pressure(&memories[2], &mut pressure);
    let mut scratch = memories[0].clone();
    field
        .pressure_after(&memories[1], [&later, heat], 1e3, &mut after, &mut scratch)
        .expect("the field advances");
    field.read(0, &memories[2], &mut temperature);
    [memories[2].clone(), pressure, after, temperature]
}

fn heat(n: usize) -> Vec<f64> {
    (0..n).map(|k| 1.0 + (k * 37 % 11) as f64).collect()
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// The bits of each vertex are those of a fault of one vertex with its parameters.
#[test]
fn bits_do_not_depend_on_the_neighbours() {
    let n = 131;
    let at = |k: usize| 1.0 + 0.01 * (k * 53 % 101) as f64;
    let each = |value: f64| (0..n).map(|k| value * at(k)).collect::<Vec<f64>>();
    let field = ThermalPressurization::new(
        n,
        ShearZone {
            half_width: each(0.01).into(),
            volumetric_heat_capacity: each(2e6).into(),
            thermal_diffusivity: vec![1e-6; n].into(),
            initial_temperature: each(300.0).into(),
        },
        PoreFluid {
            hydraulic_diffusivity: each(1e-4).into(),
            pressurization_coefficient: each(1e5).into(),
        },
    )
    .expect("the parameters are legal");
    let all = outcome(&field, &heat(n));
    let alone = |k: usize| {
        let zone = ShearZone {
            half_width: (0.01 * at(k)).into(),
            volumetric_heat_capacity: (2e6 * at(k)).into(),
            thermal_diffusivity: 1e-6.into(),
            initial_temperature: (300.0 * at(k)).into(),
        };
        let fluid = PoreFluid {
            hydraulic_diffusivity: (1e-4 * at(k)).into(),
            pressurization_coefficient: (1e5 * at(k)).into(),
        };
        let field = ThermalPressurization::new(1, zone, fluid).expect("the parameters are legal");
        outcome(&field, &heat(n)[k..=k])
    };
    for k in 0..n {
        let alone = alone(k);
        for what in [1, 3] {
            assert_eq!(
                all[what][k].to_bits(),
                alone[what][0].to_bits(),
                "{what} {k}"
            );
        }
        // Sources are summed in another order where all vertices are alike.
        assert!(
            (all[2][k] - alone[2][0]).abs() < 1e-12 * alone[2][0].abs(),
            "{k}"
        );
        assert!(
            (all[2][k] - all[1][k]).abs() < 1e-12 * all[1][k].abs(),
            "{k}"
        );
    }
}

/// Faults of any length: each vertex as in a longer one.
#[test]
fn bits_do_not_depend_on_the_number_of_vertices() {
    for each in [false, true] {
        let field = |n: usize| {
            let own: Vec<f64> = (0..n).map(|k| 1e-4 * (1.0 + k as f64)).collect();
            let fluid = if each { fluid(own) } else { fluid(1e-4) };
            ThermalPressurization::new(n, zone(0.01, 1e-6), fluid).expect("it is legal")
        };
        let long = outcome(&field(200), &heat(200));
        for n in [2, 3, 63, 64, 65, 128, 130] {
            let short = outcome(&field(n), &heat(n));
            for what in 1..4 {
                assert_eq!(
                    bits(&short[what]),
                    bits(&long[what][..n]),
                    "{n} {what} {each}"
                );
            }
        }
    }
}

/// The heat is the work of friction over the heat capacity.
#[test]
fn the_source_is_the_power_of_friction() {
    let capacities = vec![2e6, 4e6];
    let zone = ShearZone {
        volumetric_heat_capacity: capacities.clone().into(),
        ..zone(0.01, 1e-6)
    };
    let field = ThermalPressurization::new(2, zone, fluid(1e-4)).expect("it is legal");
    let at = FaultRates {
        time: 5.0,
        slip_rate: &[2.0, 3.0],
        friction: &[1e7, 2e7],
        state_rate: &[0.0; 2],
        normal_stress: &[1e6; 2],
    };
    let mut source = [0.0; 2];
    field.source(&at, &field.sizes().memory, &mut source);
    assert_eq!(source, [2e7 / 2e6, 6e7 / 4e6]);
}
