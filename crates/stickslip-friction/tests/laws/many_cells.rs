//! Friction of many cells is the friction of each.

use nalgebra::Vector2;
use proptest::prelude::*;
use stickslip_friction::{
    CellState, EvolutionLaw, FrictionLaw, ManyCellsError, QuasiDynamicFriction,
    RegularizedDieterichRuina,
};
use stickslip_state::LogTheta;

use crate::common::cases;

/// `mu/(2 c_s)` [Pa s/m] of the problems of SEAS.
const DAMPING: f64 = 32.04e9 / (2.0 * 3464.0);
const FLOOR: f64 = 1e3;
const VARIABLES: [CellState; 2] = [CellState::LogTheta, CellState::Psi];
const EVOLUTIONS: [EvolutionLaw; 2] = [EvolutionLaw::Aging, EvolutionLaw::Slip];

const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 8e-3,
};

/// A law, shear stress, normal stress and `ln theta`.
type Cell = (RegularizedDieterichRuina, f64, f64, f64);

/// Cells at any slip rate, from `1e-25` to 100 m/s.
fn a_cell() -> impl Strategy<Value = Cell> {
    let law = (0.004..0.04, 0.001..0.03, 0.2..0.8, -9.0..-4.0, -6.0..0.0);
    let law =
        law.prop_map(
            |(a, b, reference_friction, rate, distance)| RegularizedDieterichRuina {
                a,
                b,
                reference_friction,
                reference_velocity: 10_f64.powf(rate),
                slip_distance: 10_f64.powf(distance),
            },
        );
    (law, 4.0..8.5, -25.0..2.0, -10.0..25.0).prop_map(
        |(law, stress, rate, alpha): (_, f64, f64, f64)| {
            let (normal, rate) = (10_f64.powf(stress), 10_f64.powf(rate));
            let shear = normal * law.coefficient(rate, LogTheta(alpha)) + DAMPING * rate;
            (law, shear, normal, alpha)
        },
    )
}

fn psi(law: &RegularizedDieterichRuina, alpha: f64) -> f64 {
    let steady = (law.reference_velocity / law.slip_distance).ln();
    law.reference_friction + law.b * (alpha + steady)
}

/// The rounding of `a ln V`: each part of it is rounded a few times.
fn rounding_of_friction(&(law, shear, normal, alpha): &Cell) -> f64 {
    let parts = [
        shear / normal,
        law.reference_friction,
        law.b * alpha,
        law.b * 25.0,
    ];
    f64::EPSILON * parts.iter().map(|part| part.abs()).sum::<f64>()
}

fn rates(cells: &[Cell], variable: CellState, evolution: EvolutionLaw) -> [Vec<f64>; 2] {
    let laws: Vec<_> = cells.iter().map(|cell| cell.0).collect();
    let friction = QuasiDynamicFriction::new(&laws, DAMPING, variable, evolution, FLOOR);
    let friction = friction.expect("legal laws");
    let shear: Vec<_> = cells.iter().map(|cell| cell.1).collect();
    let normal: Vec<_> = cells.iter().map(|cell| cell.2).collect();
    let state = cells.iter().map(|(law, _, _, alpha)| match variable {
        CellState::LogTheta => *alpha,
        CellState::Psi => psi(law, *alpha),
    });
    let state: Vec<_> = state.collect();
    let mut rates = [vec![0.0; laws.len()], vec![0.0; laws.len()]];
    let [slip_rate, state_rate] = &mut rates;
    friction.rates(&shear, &normal, &state, slip_rate, state_rate);
    rates
}

proptest! {
    #![proptest_config(cases(128))]

    /// Friction and radiation damping balance the traction; the state evolves by the formulas of its law.
    #[test]
    fn each_cell_is_in_balance(cells in prop::collection::vec(a_cell(), 1..200)) {
        for (variable, evolution) in VARIABLES.map(|v| EVOLUTIONS.map(|e| (v, e))).concat() {
            let [slip_rate, state_rate] = rates(&cells, variable, evolution);
            for (i, &(law, shear, normal, alpha)) in cells.iter().enumerate() {
                let rate = slip_rate[i];
                let taken = normal * law.coefficient(rate, LogTheta(alpha)) + DAMPING * rate;
                let rounding = normal * rounding_of_friction(&cells[i]) + f64::EPSILON * shear;
                prop_assert!((taken - shear).abs() <= 8.0 * rounding);
                let per_time = rate / law.slip_distance;
                let of_log_theta = match evolution {
                    EvolutionLaw::Aging => (-alpha).exp() - per_time,
                    EvolutionLaw::Slip => -per_time * (alpha + per_time.ln()),
                };
                let scale = if variable == CellState::Psi { law.b } else { 1.0 };
                // psi holds ln theta over b, with the rounding of mu0.
                let conversion = 64.0 + (8.0 * law.reference_friction / law.b) + 8.0 * 60.0;
                let largest = (-alpha).exp() + per_time * (1.0 + alpha.abs() + per_time.ln().abs());
                let bound = f64::EPSILON * conversion * largest * scale;
                prop_assert!((state_rate[i] - scale * of_log_theta).abs() <= bound);
            }
        }
    }

    /// In any place among others, to the last bit.
    #[test]
    fn cells_do_not_notice_each_other(cells in prop::collection::vec(a_cell(), 1..150), place in any::<prop::sample::Index>()) {
        let one = place.index(cells.len());
        let mut others = cells.clone();
        others[one].1 = f64::NAN;
        for evolution in EVOLUTIONS {
            let [all, all_states] = rates(&cells, CellState::LogTheta, evolution);
            let [alone, state_alone] = rates(&[cells[one]], CellState::LogTheta, evolution);
            prop_assert_eq!((all[one].to_bits(), all_states[one].to_bits()), (alone[0].to_bits(), state_alone[0].to_bits()));
            let [broken, _] = rates(&others, CellState::LogTheta, evolution);
            for i in 0..cells.len() {
                let same = broken[i].to_bits() == all[i].to_bits();
                let expected = if i == one { broken[i].is_nan() } else { same };
                prop_assert!(expected);
            }
        }
    }

    #[test]
    fn slip_rate_is_odd_and_along_the_traction(cell in a_cell(), angle in 0.0..std::f64::consts::TAU) {
        let (law, shear, normal, alpha) = cell;
        let [forth, _] = rates(&[cell], CellState::LogTheta, EvolutionLaw::Aging);
        let [back, state] = rates(&[(law, -shear, normal, alpha)], CellState::LogTheta, EvolutionLaw::Aging);
        prop_assert_eq!(back[0].to_bits(), (-forth[0]).to_bits());
        let friction = QuasiDynamicFriction::new(
            &[law], DAMPING, CellState::LogTheta, EvolutionLaw::Aging, FLOOR,
        ).expect("a legal law");
        let direction = Vector2::new(angle.cos(), angle.sin());
        let traction = direction * shear;
        let (mut x, mut y, mut state_rate) = ([0.0], [0.0], [0.0]);
        let components = [&[traction.x][..], &[traction.y]];
        friction.vector_rates(components, &[normal], &[alpha], [&mut x, &mut y], &mut state_rate);
        // The traction differs in its last digit, and so do the roundings of a ln V on the way.
        let bound = 4.0 * (f64::EPSILON + rounding_of_friction(&cell) / law.a) * forth[0];
        prop_assert!((Vector2::new(x[0], y[0]) - direction * forth[0]).norm() <= bound);
        let per_time = forth[0] / law.slip_distance;
        prop_assert!((state_rate[0] - state[0]).abs() <= 4.0 * (bound / forth[0]) * ((-alpha).exp() + per_time));
    }
}

#[test]
fn without_traction_there_is_no_slip() {
    for evolution in EVOLUTIONS {
        let [rate, state] = rates(&[(LAW, 0.0, 50e6, 3.0)], CellState::LogTheta, evolution);
        let healing = if evolution == EvolutionLaw::Aging {
            (-3.0_f64).exp()
        } else {
            0.0
        };
        assert_eq!(rate[0], 0.0);
        assert!((state[0] - healing).abs() <= 2.0 * f64::EPSILON * healing);
    }
    let (variable, evolution) = (CellState::LogTheta, EvolutionLaw::Aging);
    let friction = QuasiDynamicFriction::new(&[LAW], DAMPING, variable, evolution, FLOOR);
    let (mut x, mut y, mut state_rate) = ([1.0], [1.0], [0.0]);
    let friction = friction.expect("a legal law");
    let none = [&[0.0][..], &[-0.0]];
    friction.vector_rates(none, &[50e6], &[3.0], [&mut x, &mut y], &mut state_rate);
    assert_eq!((x, y), ([0.0], [0.0]));
}

#[test]
fn small_normal_stress_counts_as_the_floor() {
    let at = |normal| {
        rates(
            &[(LAW, 1e6, normal, 3.0)],
            CellState::LogTheta,
            EvolutionLaw::Aging,
        )
    };
    for below in [0.9 * FLOOR, 0.0, -1e6, f64::NEG_INFINITY] {
        assert_eq!(at(below), at(FLOOR));
    }
    assert_ne!(at(1.1 * FLOOR), at(FLOOR));
}

#[test]
fn nan_gives_nan() {
    let (shear, normal, alpha) = (20e6, 50e6, 3.0);
    for (shear, normal, alpha) in [
        (f64::NAN, normal, alpha),
        (shear, f64::NAN, alpha),
        (shear, normal, f64::NAN),
        (f64::INFINITY, normal, alpha),
    ] {
        for (variable, evolution) in VARIABLES.map(|v| EVOLUTIONS.map(|e| (v, e))).concat() {
            let [rate, state] = rates(&[(LAW, shear, normal, alpha)], variable, evolution);
            assert!(rate[0].is_nan() && state[0].is_nan());
        }
    }
}

#[test]
fn parameters_out_of_their_ranges_are_refused() {
    let new = |law, damping, variable, floor| {
        QuasiDynamicFriction::new(&[LAW, law], damping, variable, EvolutionLaw::Aging, floor)
            .expect_err("accepted")
    };
    let of_cell = |error: ManyCellsError, name: &str| {
        assert_eq!((error.cell, error.source.what), (Some(1), name));
    };
    let log_theta = CellState::LogTheta;
    of_cell(
        new(
            RegularizedDieterichRuina { a: 0.0, ..LAW },
            DAMPING,
            log_theta,
            FLOOR,
        ),
        "a",
    );
    let slip_distance = f64::NAN;
    let law = RegularizedDieterichRuina {
        slip_distance,
        ..LAW
    };
    of_cell(new(law, DAMPING, log_theta, FLOOR), "slip_distance");
    let constant = RegularizedDieterichRuina { b: 0.0, ..LAW };
    let error = new(constant, DAMPING, CellState::Psi, FLOOR);
    assert_eq!(
        error.to_string(),
        "cell 1: b must be finite and positive, is 0"
    );
    of_cell(error, "b");
    let legal =
        QuasiDynamicFriction::new(&[constant], DAMPING, log_theta, EvolutionLaw::Slip, FLOOR);
    assert_eq!(legal.map(|friction| friction.cell_count()), Ok(1));
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (error, name) in [
            (new(LAW, wrong, log_theta, FLOOR), "damping"),
            (new(LAW, DAMPING, log_theta, wrong), "least_normal_stress"),
        ] {
            assert_eq!((error.cell, error.source.what), (None, name));
        }
    }
}

#[test]
fn rates_take_no_memory() {
    let (variable, evolution) = (CellState::LogTheta, EvolutionLaw::Aging);
    let friction = QuasiDynamicFriction::new(&[LAW; 100], DAMPING, variable, evolution, FLOOR);
    let friction = friction.expect("legal laws");
    let (mut x, mut y, mut state_rate) = ([0.0; 100], [0.0; 100], [0.0; 100]);
    let (shear, normal, alpha) = ([20e6; 100], [50e6; 100], [3.0; 100]);
    let taken = allocation_counter::measure(|| {
        friction.rates(&shear, &normal, &alpha, &mut x, &mut state_rate);
        let both = [&shear[..], &shear];
        friction.vector_rates(both, &normal, &alpha, [&mut x, &mut y], &mut state_rate);
    });
    assert_eq!(taken.count_total, 0);
}

#[test]
#[should_panic(expected = "one number per cell, of which there are 2")]
fn fields_have_one_number_per_cell() {
    let (variable, evolution) = (CellState::LogTheta, EvolutionLaw::Aging);
    let friction = QuasiDynamicFriction::new(&[LAW; 2], DAMPING, variable, evolution, FLOOR);
    let friction = friction.expect("legal laws");
    friction.rates(
        &[0.0; 2],
        &[1e6; 2],
        &[0.0; 3],
        &mut [0.0; 2],
        &mut [0.0; 2],
    );
}
