//! The regularised law against 60-digit arithmetic, the generic solver and the cut-off law.

use crate::common::{Generic, cases, decades, default_slope_error};
use proptest::prelude::*;
use stickslip_friction::{DieterichRuina, FrictionLaw, RegularizedDieterichRuina};
use stickslip_state::LogTheta;

/// With `ln Vm = -alpha`, exactly.
fn plain(a: f64) -> RegularizedDieterichRuina {
    RegularizedDieterichRuina {
        a,
        b: a,
        reference_friction: 0.0,
        reference_velocity: 1.0,
        slip_distance: 1.0,
    }
}

fn table() -> Vec<[f64; 9]> {
    include_str!("regularized.csv")
        .lines()
        .skip(1)
        .map(|line| {
            let mut row = [0.0; 9];
            for (entry, field) in row.iter_mut().zip(line.split(',')) {
                *entry = field.parse().expect("a number");
            }
            row
        })
        .collect()
}

/// The error in units of the rounding of a number of that size.
fn roundings(got: f64, want: f64, size: f64) -> f64 {
    if got == want {
        return 0.0;
    }
    (got - want).abs() / (f64::EPSILON * (size + f64::MIN_POSITIVE))
}

#[test]
fn agrees_with_sixty_digits() {
    let mut worst = [0f64; 5];
    for row in table() {
        let [a, alpha, viscosity, drive, x, rate, mu, slope, potential] = row;
        let (law, state) = (plain(a), LogTheta(alpha));
        let got = law.slip_rate(viscosity, drive, state);
        let friction = a * x.tanh();
        let resistance = viscosity * rate + friction;
        // What a rounding of the drive and of the logarithms, of Vm and of the stiffness, does to V.
        let logarithms = 1.0 + alpha.abs() + (viscosity / a).ln().abs();
        let sensitivity = 1.0 + (drive + friction * logarithms) / resistance;
        // The functions of V see the rounding of t = ln V + alpha.
        let t = 1.0 + rate.ln().abs() + alpha.abs();
        let residual = viscosity * got + law.coefficient(got, state) - drive;
        let scale = drive + friction * t;
        let errors = [
            roundings(got, rate, rate * sensitivity),
            roundings(law.coefficient(rate, state), mu, mu + friction * t),
            roundings(law.coefficient_rate_slope(rate, state), slope, slope * t),
            roundings(
                law.potential(rate, state),
                potential,
                potential * t + a * rate * f64::MIN_POSITIVE,
            ),
            roundings(residual, 0.0, scale),
        ];
        for (k, error) in errors.into_iter().enumerate() {
            worst[k] = worst[k].max(error);
            assert!(error <= 4.0, "{k}: {error} at {row:?}, {got:e}");
        }
    }
    println!("slip rate, coefficient, slope, potential, residual: {worst:?} roundings");
}

proptest! {
    #![proptest_config(cases(5000))]

    #[test]
    fn agrees_with_the_generic_solver(
        alpha in prop_oneof![-1000.0..1e3, -60.0..60.0f64], a in decades(-6.0..0.0),
        viscosity in decades(-12.0..20.0), drive in prop_oneof![decades(-12.0..4.0), 0.0..3.0],
    ) {
        let (law, state) = (plain(a), LogTheta(alpha));
        let closed = law.slip_rate(viscosity, drive, state);
        let generic = Generic(law).slip_rate(viscosity, drive, state);
        prop_assert!(closed.is_finite() && closed >= 0.0);
        let logarithms = 30.0 + drive / a + alpha.abs() + closed.max(f64::MIN_POSITIVE).ln().abs();
        prop_assert!((closed - generic).abs() <= 1e-14 * logarithms * closed + 1e-307, "{closed:e} {generic:e}");
    }

    /// Slower than the cut-off law, by no more than the largest difference of the coefficients.
    #[test]
    fn is_bracketed_by_the_cut_off_law(
        alpha in prop_oneof![-1000.0..1e3, -60.0..60.0f64, decades(3.0..5.0)], a in decades(-6.0..0.0),
        viscosity in decades(-12.0..20.0), drive in prop_oneof![decades(-12.0..4.0), 0.0..3.0],
        rate in decades(-300.0..10.0),
    ) {
        let law = plain(a);
        let cut_off = DieterichRuina { a, b: a, reference_friction: 0.0, reference_velocity: 1.0, slip_distance: 1.0 };
        let state = LogTheta(alpha);
        let (mu, below) = (law.coefficient(rate, state), cut_off.coefficient(rate, state));
        prop_assert!(below <= mu && mu <= below + a * 0.5f64.asinh() + 4.0 * f64::EPSILON * mu);
        let (slow, fast) = (law.slip_rate(viscosity, drive, state), cut_off.slip_rate(viscosity, drive, state));
        let fastest = cut_off.slip_rate(viscosity, (drive - a * 0.5f64.asinh()).max(0.0), state);
        let rounding = 1e-14 * (100.0 + (drive / a).min(1e5) + alpha.abs());
        prop_assert!(slow <= fast * (1.0 + rounding), "{slow:e} {fast:e}");
        prop_assert!(fastest <= slow * (1.0 + rounding) + f64::MIN_POSITIVE, "{slow:e} {fastest:e}");
    }

    #[test]
    fn state_slopes_match_the_default(
        alpha in prop_oneof![-300.0..300.0f64, -1e-3..1e-3], t in -30.0..60.0f64, a in decades(-6.0..0.0),
    ) {
        let (law, state, rate) = (plain(a), LogTheta(alpha), (t - alpha).exp());
        let closed = law.coefficient_state_slope(rate, state);
        let coefficient = law.coefficient(rate, state);
        // Roundings of the strength, its share of a and the sum with the rate; the hyperbolic function and the
        // product, to four units.
        let noise = 0.5 * f64::EPSILON * (a * (2.0 * alpha.abs() + t.abs()) + 8.0 * coefficient);
        // The step is at most 2.4e-5 where the coefficient is less than 61 times its slope, and the third derivative
        // of asinh(exp(t)/2) is at most 0.28.
        let truncation = 0.28 / 6.0 * 2.4e-5f64.powi(2) * a;
        let bound = default_slope_error(alpha, (closed, coefficient), noise) + truncation;
        let default = Generic(law).coefficient_state_slope(rate, state);
        prop_assert!((closed - default).abs() <= bound, "{closed} {default} {bound:e}");
        // Far above Vm that of the cut-off law.
        prop_assert!(t < 20.0 || closed == law.b);
    }
}

#[test]
fn extreme_states_stick_or_slide_freely() {
    let stuck = LogTheta(1000.0);
    let law = plain(0.01);
    assert_eq!(law.slip_rate(1.0, 1.0, stuck), 0.0);
    assert!(law.coefficient(0.0, stuck) > 1.0);
    assert_eq!(law.coefficient_rate_slope(0.0, stuck), f64::INFINITY);
    assert_eq!(law.potential(0.0, stuck), 0.0);
    let free = LogTheta(-1000.0);
    assert_eq!(law.slip_rate(2.0, 1.0, free), 0.5);
    assert_eq!(law.coefficient(1e10, free), 0.0);
    let ordinary = LogTheta(10.0);
    assert_eq!(law.coefficient(0.0, ordinary), 0.0);
    assert_eq!(law.slip_rate(1e6, 0.0, ordinary), 0.0);
    let slope = law.coefficient_rate_slope(0.0, ordinary);
    assert!((slope / (0.005 * 10f64.exp()) - 1.0).abs() < 1e-15);
    // Creep with a subnormal rate is creep.
    assert_eq!(law.slip_rate(1e-320f64.recip(), 0.5, ordinary), 0.0);
    let rate = law.slip_rate(1.0, 1e-310, ordinary);
    assert!(rate > 0.0 && rate < 1e-310, "{rate:e}");
    assert!(plain(-1.0).validate().is_err());
    assert!(plain(1.0).validate().is_ok());
}
