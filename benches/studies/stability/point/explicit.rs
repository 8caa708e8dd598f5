//! Explicit steps that adapt, the balance of forces checked.

use stickslip::integrate::Stepper;
use stickslip::state::LogTheta;
use stickslip::{RungeKutta, Snapshot, StepFailure, Steps};
use stickslip_cli::laws::{Friction, Law, Laws};

use super::{SECTION, STEPS, scene};
use crate::case::{Case, IntoControlFlow, Outcome, Refusal};
use crate::check::is_finite;
use crate::method::AnyFriction;
use crate::setup::{Setup, one_at_a_time};

/// The laws, all of `ln(theta)`.
const LAWS: [(Law, Friction, &str); 3] = [
    (
        Law::Dieterich,
        Friction::DieterichRuina,
        "Dieterich, cut off",
    ),
    (Law::Ruina, Friction::DieterichRuina, "Ruina, cut off"),
    (Law::Ruina, Friction::Regularized, "Ruina, regularised"),
];
/// Roundings of the terms of the balance of forces that its residual may have.
const ROUNDINGS: f64 = 16.0;

/// Adaptive explicit integration where there is no mass.
pub(crate) fn add(cases: &mut Vec<Case>, quick: bool) {
    let laws = if quick { &LAWS[..1] } else { &LAWS };
    for (name, setup) in one_at_a_time() {
        if name.starts_with("m =") {
            continue;
        }
        for damping in [0.0, 5e6] {
            let setup = Setup {
                mass: 0.0,
                damping,
                ..setup
            };
            for &(law, friction, laws) in laws {
                let member = format!("{laws}, damping {damping:e} Pa s/m");
                cases.push(Case::new(
                    SECTION,
                    &name,
                    "explicit, adaptive",
                    member,
                    move || {
                        let laws = setup.laws(law, friction);
                        adapt(&setup, &laws).unwrap_or_else(IntoControlFlow::refused)
                    },
                ));
            }
        }
    }
}

/// A run over twenty steps' time, with steps down to a ten thousandth of it.
fn adapt(setup: &Setup, laws: &Laws) -> Result<IntoControlFlow, Refusal> {
    let mut stepper = RungeKutta::new(scene(setup, laws)?)?;
    let friction = laws.friction();
    let end = STEPS as f64 * setup.dt;
    let mut wrong = None;
    let mut worst: f64 = 0.0;
    let steps = Steps::adaptive(1e-5)
        .with_min_step(1e-4 * end)
        .with_max_step(end);
    let result = stepper.run(&steps.until(end), |at| {
        let share = residual(setup, &friction, &at);
        if !(is_finite(at.state()) && share <= 1.0) && wrong.is_none() {
            let (step, v, state) = (at.step, at.velocity[0][0], at.contact(0).state(0));
            wrong = Some(format!(
                "step {step}: v = {v:e}, state {state}, residual {share:.2e} times what is allowed"
            ));
        }
        worst = worst.max(share);
    });
    let mut verdict = match (wrong, result) {
        (Some(text), _) => IntoControlFlow::new(Outcome::Defect, text),
        (None, Ok(report)) => {
            let mut verdict = IntoControlFlow::new(Outcome::Solved, "");
            verdict.iterations = (report.accepted + report.rejected + report.failed, 0);
            verdict
        }
        (None, Err(failure)) => resume(&mut stepper, failure, end),
    };
    verdict.residual = worst;
    Ok(verdict)
}

/// The force left over as a share of what may be.
fn residual(setup: &Setup, friction: &AnyFriction, at: &Snapshot<'_, 1>) -> f64 {
    let (u, v, block) = (at.displacement[0][0], at.velocity[0][0], at.contact(0));
    let (rate, state) = (block.slip_rate(0), block.state(0));
    let pull = setup.stiffness * setup.velocity * at.time - setup.stiffness * u;
    let left = pull - setup.damping * v;
    let strength = block.strength(0);
    // What rounding the state and the logarithm of the rate does.
    let slope = friction
        .coefficient_rate_slope(rate, LogTheta(state))
        .min(f64::MAX);
    let by_rate = rate * slope * (rate.max(f64::MIN_POSITIVE).ln().abs() + 60.0);
    let by_state = friction
        .coefficient_state_slope(rate, LogTheta(state))
        .abs()
        * state.abs();
    let terms = setup.stiffness * (setup.velocity * at.time + u.abs())
        + setup.damping * rate
        + strength
        + setup.normal_stress * (by_rate + by_state);
    let missing = if rate > f64::MIN_POSITIVE {
        (left - strength.copysign(v)).abs()
    } else {
        let least = friction.coefficient(f64::MIN_POSITIVE, LogTheta(state));
        (left.abs() - setup.normal_stress * least).max(0.0)
    };
    missing / (ROUNDINGS * f64::EPSILON * terms + f64::MIN_POSITIVE)
}

/// After a run that gave up: nothing is lost, and a small step may still be taken.
fn resume(stepper: &mut RungeKutta<1>, failure: StepFailure, end: f64) -> IntoControlFlow {
    let mut verdict = IntoControlFlow::new(Outcome::Reported, failure);
    let before = stepper.snapshot().state().clone();
    for power in [6, 8, 10] {
        let size = end * 10f64.powi(-power);
        let taken = stepper.step(size).is_ok();
        let at = stepper.snapshot();
        if taken && is_finite(at.state()) {
            verdict.resumed = Some(size / end);
            break;
        }
        if taken || *at.state() != before {
            let text = "a failed step left its trace, or no numbers".into();
            return verdict.with(Outcome::Defect, text);
        }
    }
    verdict
}
