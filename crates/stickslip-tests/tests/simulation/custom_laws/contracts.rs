//! The laws' contracts, the closed form, and the difference of the soft cut-off.

use stickslip::friction::{
    DieterichRuina, FrictionLaw, Radial, check_convex_potential, check_friction_law,
};
use stickslip::problems::spring_slider::{FRICTION, steady_state};
use stickslip::state::{LogTheta, StateLaw, Theta, check_state_law};

use super::{ALPHA, OWN_FRICTION, OWN_STATE, SoftCutoff};
use crate::Outcome;

#[test]
fn the_state_law_keeps_its_contract() -> Outcome {
    check_state_law(&OWN_STATE, &[1e-12, 1e-5, 1.0, 1e3, 1e9].map(Theta))?;
    let Theta(steady) = steady_state(&OWN_STATE, 1e-6)?;
    assert!((steady / 20.0 - 1.0).abs() < 1e-12);
    Ok(())
}

/// `theta = (2L/V) tanh(V t/2L + artanh(V theta_o/2L))` at constant slip rate, by the law's own
/// solver: of second order.
#[test]
fn the_state_follows_its_closed_form_to_second_order() -> Outcome {
    let (rate, time) = (1e-5, 2.0);
    let steady = 2.0 * OWN_STATE.slip_distance / rate;
    let exact = steady * (time / steady + 0.25_f64.atanh()).tanh();
    let mut errors = Vec::new();
    for steps in [16, 32, 64] {
        let mut state = Theta(0.25 * steady);
        for _ in 0..steps {
            state = OWN_STATE.advance_at_constant_rate(state, rate, time / f64::from(steps))?;
        }
        errors.push((state.0 - exact).abs());
    }
    for pair in errors.windows(2) {
        assert!(((pair[0] / pair[1]).log2() - 2.0).abs() < 0.1, "{errors:?}");
    }
    assert!(errors[2] < 1e-4 * steady, "{errors:?}");
    Ok(())
}

#[test]
fn the_friction_law_keeps_its_contract() -> Outcome {
    for alpha in [-300.0, -50.0, -10.0, 2.0, 30.0, 300.0, 700.0] {
        check_friction_law(&OWN_FRICTION, &[LogTheta(alpha)])?;
    }
    let at_vertex = Radial {
        law: OWN_FRICTION,
        force: 100.0,
        state: ALPHA,
    };
    check_convex_potential::<_, 1>(&at_vertex, 1e-6, 60.0)?;
    check_convex_potential::<_, 3>(&at_vertex, 1e-6, 60.0)?;
    assert!(
        check_friction_law(&SoftCutoff(DieterichRuina { a: 0.0, ..FRICTION }), &[ALPHA]).is_err()
    );
    Ok(())
}

/// Above the law with the hard cut-off by `a ln(1 + Vm/V)`: `a ln 2` at `Vm`, nothing far beyond.
#[test]
fn the_soft_cutoff_differs_where_it_says() {
    // Vm = 1e-6 exp(-1.5) m/s.
    let young = LogTheta(10f64.ln() - 39.0);
    let cutoff = FRICTION.ln_cutoff_rate(young).exp();
    assert!(((cutoff * 1e6).ln() + 1.5).abs() < 1e-12);
    for ratio in [1.0, 10.0, 1e3, 1e6] {
        let rate = ratio * cutoff;
        let more = OWN_FRICTION.coefficient(rate, young) - FRICTION.coefficient(rate, young);
        assert!(
            (more - FRICTION.a * ratio.recip().ln_1p()).abs() < 1e-15,
            "{ratio}: {more}"
        );
    }
    for rate in [1e-9, 1e-6, 1e-3] {
        let steady = LogTheta((FRICTION.slip_distance / rate).ln());
        let more = OWN_FRICTION.coefficient(rate, steady) - FRICTION.coefficient(rate, steady);
        assert!(more.abs() < 4.0 * f64::EPSILON, "{rate}: {more}");
    }
}
