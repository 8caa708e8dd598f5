//! Every state law with every friction law and every scheme, by both solvers.

use stickslip::friction::{FrictionLaw, StateDependentTresca, Tresca};
use stickslip::problems::pipping_slider::{AGING, FRICTION, INITIAL_LOG_THETA, PippingSlider};
use stickslip::state::{Discontinuous, LogTheta, Reads, Ruina, StateLaw};
use stickslip::{BackwardEuler, Newmark, RateScheme};

use crate::Outcome;
use crate::common::{STEP, Solver, body, distance, slide};

const BY_STATE: StateDependentTresca = StateDependentTresca {
    reference_friction: FRICTION.reference_friction,
    b: FRICTION.b,
    reference_velocity: FRICTION.reference_velocity,
    slip_distance: FRICTION.slip_distance,
};
const SLIP: Ruina = Ruina {
    slip_distance: FRICTION.slip_distance,
};
const ALPHA: LogTheta = LogTheta(INITIAL_LOG_THETA);

/// Into sliding by both solvers side by side, with steps of `short` after `stuck` seconds.
fn compare<L, S, R>(laws: (L, S, S::State), scheme: R, (stuck, short): (f64, f64)) -> Outcome
where
    L: FrictionLaw + Copy + 'static,
    S: StateLaw + Copy + 'static,
    L::State: Reads<S::State>,
    R: RateScheme + Copy + 'static,
{
    // Without gravity both start from exactly the same displacement, zero.
    let body = PippingSlider {
        gravity: 0.0,
        ..body(2)
    };
    let space = body.space()?;
    let mut fast = slide(&body, &space, laws, scheme, Solver::Tnnmg, 1e-11)?;
    let mut plain = slide(&body, &space, laws, scheme, Solver::GaussSeidel, 1e-11)?;
    let mut peak = 0_f64;
    // Long steps while everything sticks, short ones where it begins to slide.
    let long = std::iter::repeat_n(0.015, (stuck / 0.015) as usize);
    for dt in long.chain(std::iter::repeat_n(short, 800)) {
        let (report, plain_report) = (fast.step(dt)?, plain.step(dt)?);
        let (at, plain) = (fast.snapshot(), plain.snapshot());
        let problem = format!("t = {}, {report:?}, {plain_report:?}", at.time);
        let largest = at.velocity.iter().map(|v| v.amax()).fold(0.0, f64::max);
        peak = peak.max(at.max_slip_rate());
        assert!(
            distance(at.velocity, plain.velocity) < 1e-7 * largest,
            "{problem}"
        );
        let slid = at.displacement.iter().map(|v| v.amax()).fold(0.0, f64::max);
        assert!(
            distance(at.displacement, plain.displacement) < 1e-9 * slid,
            "{problem}"
        );
        let (contact, plain_contact) = (at.contact(0), plain.contact(0));
        for k in 0..contact.len() {
            let (state, plain) = (contact.state(k), plain_contact.state(k));
            assert!(
                (state - plain).abs() < 1e-7 * (1.0 + plain.abs()),
                "{problem}"
            );
        }
        // Multigrid, not a hidden sequence of sweeps.
        assert!(
            report.solver_iterations < 60 * report.coupling_iterations,
            "{problem}"
        );
    }
    assert!(peak > 1e-6, "nothing slid: {peak:e}");
    Ok(())
}

// The slip law under a friction without rate only weakens: the multiplier of the fixed point grows
// with the step, and the paper's step is too long for it.
macro_rules! combinations {
    ($($name:ident: $laws:expr, $scheme:expr, $stuck:expr;)*) => {$(
        #[test]
        fn $name() -> Outcome {
            compare($laws, $scheme, $stuck)
        }
    )*};
}

combinations! {
    aging_rate_and_state_newmark: (FRICTION, AGING, ALPHA), Newmark::default(), (9.3, STEP);
    aging_rate_and_state_backward_euler: (FRICTION, AGING, ALPHA), BackwardEuler, (9.3, STEP);
    aging_tresca_newmark: (BY_STATE, AGING, ALPHA), Newmark::default(), (6.2, STEP);
    aging_tresca_backward_euler: (BY_STATE, AGING, ALPHA), BackwardEuler, (6.2, STEP);
    slip_rate_and_state_newmark: (FRICTION, SLIP, ALPHA), Newmark::default(), (9.3, STEP);
    slip_rate_and_state_backward_euler: (FRICTION, SLIP, ALPHA), BackwardEuler, (9.3, STEP);
    slip_tresca_newmark: (BY_STATE, SLIP, ALPHA), Newmark::default(), (4.8, 0.2 * STEP);
    slip_tresca_backward_euler: (BY_STATE, SLIP, ALPHA), BackwardEuler, (4.8, 0.2 * STEP);
    jump_rate_and_state_newmark: (FRICTION, Discontinuous, ALPHA.into()), Newmark::default(), (9.3, STEP);
    jump_rate_and_state_backward_euler: (FRICTION, Discontinuous, ALPHA.into()), BackwardEuler, (9.3, STEP);
    jump_tresca_newmark: (BY_STATE, Discontinuous, ALPHA.into()), Newmark::default(), (4.5, STEP);
    jump_tresca_backward_euler: (BY_STATE, Discontinuous, ALPHA.into()), BackwardEuler, (4.5, STEP);
    tresca_newmark: (Tresca { coefficient: 0.6 }, (), ()), Newmark::default(), (9.0, STEP);
    tresca_backward_euler: (Tresca { coefficient: 0.6 }, (), ()), BackwardEuler, (9.0, STEP);
}
