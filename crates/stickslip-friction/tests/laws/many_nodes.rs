//! Friction of many nodes is the friction of each.

use proptest::prelude::*;
use stickslip_friction::{FrictionLaw, RegularizedDieterichRuina, SlipRates};
use stickslip_state::LogTheta;

use crate::common::cases;

/// `mu/(2 c_s)` [Pa s/m] of the problems of SEAS.
const DAMPING: f64 = 32.04e9 / (2.0 * 3464.0);

/// A law, `eta/sigma`, `tau/sigma` and `ln theta`.
type Node = (RegularizedDieterichRuina, f64, f64, f64);

/// Nodes at any slip rate, from `1e-25` to 100 m/s.
fn a_node() -> impl Strategy<Value = Node> {
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
            let (viscosity, rate) = (DAMPING / 10_f64.powf(stress), 10_f64.powf(rate));
            let drive = law.coefficient(rate, LogTheta(alpha)) + viscosity * rate;
            (law, viscosity, drive, alpha)
        },
    )
}

/// The rounding of `a ln V`: each part of it is rounded a few times.
fn rounding_of_friction(&(law, viscosity, drive, alpha): &Node) -> f64 {
    let parts = [
        drive,
        law.reference_friction,
        law.b * alpha,
        law.b * 25.0,
        law.a * viscosity.ln(),
    ];
    f64::EPSILON * parts.iter().map(|part| part.abs()).sum::<f64>()
}

fn prepared(laws: &[RegularizedDieterichRuina]) -> Box<dyn SlipRates<LogTheta>> {
    RegularizedDieterichRuina::slip_rates(laws).expect("passes of its own")
}

fn slip_rates(nodes: &[Node]) -> Vec<f64> {
    let laws: Vec<_> = nodes.iter().map(|node| node.0).collect();
    let viscosity: Vec<_> = nodes.iter().map(|node| node.1).collect();
    let drive: Vec<_> = nodes.iter().map(|node| node.2).collect();
    let states: Vec<_> = nodes.iter().map(|node| LogTheta(node.3)).collect();
    let mut rates = vec![0.0; nodes.len()];
    prepared(&laws).slip_rates(0, [&viscosity, &drive], &states, &mut rates);
    rates
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn each_node_is_in_balance(nodes in prop::collection::vec(a_node(), 1..200)) {
        for (node, rate) in nodes.iter().zip(slip_rates(&nodes)) {
            let (law, viscosity, drive, alpha) = *node;
            let taken = law.coefficient(rate, LogTheta(alpha)) + viscosity * rate;
            let rounding = rounding_of_friction(node) + f64::EPSILON * drive;
            prop_assert!((taken - drive).abs() <= 8.0 * rounding, "{taken} {drive}");
        }
    }

    /// In any place among others, to the last bit; also by one law of all.
    #[test]
    fn nodes_do_not_notice_each_other(nodes in prop::collection::vec(a_node(), 1..150), place in any::<prop::sample::Index>()) {
        let one = place.index(nodes.len());
        let all = slip_rates(&nodes);
        let (law, viscosity, drive, alpha) = nodes[one];
        let mut alone = [0.0; 2];
        prepared(&[law]).slip_rates(one, [&[viscosity; 2], &[drive; 2]], &[LogTheta(alpha); 2], &mut alone);
        prop_assert_eq!([all[one].to_bits(); 2], alone.map(f64::to_bits));
        let mut others = nodes.clone();
        others[one].2 = f64::NAN;
        for (i, (broken, all)) in slip_rates(&others).into_iter().zip(all).enumerate() {
            let expected = if i == one { broken.is_nan() } else { broken.to_bits() == all.to_bits() };
            prop_assert!(expected);
        }
    }

    #[test]
    fn slopes_are_those_of_each_node(nodes in prop::collection::vec(a_node(), 1..150)) {
        let laws: Vec<_> = nodes.iter().map(|node| node.0).collect();
        let states: Vec<_> = nodes.iter().map(|node| LogTheta(node.3)).collect();
        let rates = slip_rates(&nodes);
        let (mut by_rate, mut by_state) = (vec![0.0; nodes.len()], vec![0.0; nodes.len()]);
        prepared(&laws).slopes(0, &rates, &states, [&mut by_rate, &mut by_state]);
        for k in 0..nodes.len() {
            let each = laws[k].response(rates[k], states[k]);
            // The logarithm of V/Vm rounds with the terms of friction over a.
            let bound = 1e-14 + 8.0 * rounding_of_friction(&nodes[k]) / laws[k].a;
            prop_assert!((by_rate[k] - each.rate_slope).abs() <= bound * each.rate_slope);
            prop_assert!((by_state[k] - each.state_slope).abs() <= bound * each.state_slope);
        }
    }

    /// Where numbers are not normal, and where the drive is none, as accurate as the trait asks of both.
    #[test]
    fn ends_of_the_range_are_those_of_each_node(
        (law, _, _, alpha) in a_node(),
        viscosity in prop_oneof![Just(1e-310), Just(f64::MIN_POSITIVE), Just(1e300), (-700.0..700.0).prop_map(f64::exp)],
        drive in prop_oneof![Just(0.0), Just(1e-300), Just(1e300), Just(f64::INFINITY), Just(f64::NAN), 0.0..2.0, (-700.0..700.0).prop_map(f64::exp)],
    ) {
        let [rate] = slip_rates(&[(law, viscosity, drive, alpha)])[..] else { unreachable!() };
        let each = law.slip_rate(viscosity, drive, LogTheta(alpha));
        let same = rate == each || rate.is_nan() && each.is_nan();
        // Both are rest below the normal numbers.
        let rest = rate.max(each) < 1e-290;
        prop_assert!(same || rest || (rate - each).abs() <= 2e-9 * each, "{rate:e} {each:e}");
    }
}

/// The viscous stress `1.9e-317` has lost digits, the slip rate 1.5e-208 m/s has not.
#[test]
fn viscous_stress_below_the_normal_numbers_takes_no_digits() {
    let law = RegularizedDieterichRuina {
        a: 0.009231180850783735,
        b: 0.001,
        reference_friction: 0.6849994361478436,
        reference_velocity: 1e-4,
        slip_distance: 1.0,
    };
    let (viscosity, drive) = (1.1363306675055052e-111, 4.394548329544111e-175);
    // mu = a V/(2 Vm) next to rest.
    let viscous = 0.5 * law.a * (-law.ln_cutoff_rate(LogTheta(0.0))).exp();
    let [rate] = slip_rates(&[(law, viscosity, drive, 0.0)])[..] else {
        unreachable!()
    };
    let exact = drive / (viscosity + viscous);
    assert!((rate / exact - 1.0).abs() < 1e-13, "{rate:e} {exact:e}");
}

#[test]
fn slip_rates_take_no_memory() {
    let law = RegularizedDieterichRuina {
        a: 0.010,
        b: 0.015,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 8e-3,
    };
    let many = prepared(&[law]);
    let mut rates = [0.0; 100];
    let taken = allocation_counter::measure(|| {
        many.slip_rates(
            0,
            [&[0.1; 100], &[0.6; 100]],
            &[LogTheta(3.0); 100],
            &mut rates,
        );
    });
    assert_eq!(taken.count_total, 0);
}
