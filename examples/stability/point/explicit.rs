//! Explicit steps that adapt, the balance of forces checked.

use stickslip::friction::FrictionLaw;
use stickslip::state::{Dieterich, LogTheta, Ruina, StateLaw, StateVariable};
use stickslip::{Adaptive, Failure, RungeKutta, Stepper};

use super::{SECTION, STEPS, slider};
use crate::case::{Case, Outcome, Verdict};
use crate::check::Moment;
use crate::method::friction;
use crate::setup::{Setup, one_at_a_time};

/// Adaptive explicit integration where there is no mass.
pub(crate) fn add(cases: &mut Vec<Case>, quick: bool) {
    let setups = one_at_a_time()
        .into_iter()
        .filter(|(name, _)| !name.starts_with("m ="));
    for (name, setup) in setups {
        for damping in [0.0, 5e6] {
            let setup = Setup {
                mass: 0.0,
                damping,
                ..setup
            };
            let (cut_off, regularised, _) = friction(setup.a, setup.ratio, setup.slip_distance);
            let slip_distance = setup.slip_distance;
            let alpha = LogTheta(setup.alpha);
            let label = "explicit, adaptive";
            let member = |laws: &str| format!("{laws}, damping {damping:e} Pa s/m");
            cases.push(Case::new(
                SECTION,
                &name,
                label,
                member("Dieterich, cut off"),
                move || adapt(&setup, cut_off, Dieterich { slip_distance }, alpha),
            ));
            if !quick {
                cases.push(Case::new(
                    SECTION,
                    &name,
                    label,
                    member("Ruina, cut off"),
                    move || adapt(&setup, cut_off, Ruina { slip_distance }, alpha),
                ));
                cases.push(Case::new(
                    SECTION,
                    &name,
                    label,
                    member("Ruina, regularised"),
                    move || adapt(&setup, regularised, Ruina { slip_distance }, alpha),
                ));
            }
        }
    }
}

/// A run over twenty steps' time, with steps down to a ten thousandth of it.
fn adapt<L, S>(setup: &Setup, friction: L, law: S, initial: S::State) -> Verdict
where
    L: FrictionLaw + Copy + 'static,
    S: StateLaw + Copy + 'static,
    L::State: From<S::State>,
{
    let scene = slider(setup).scene(friction, law, setup.slip_rate, initial);
    let mut stepper = match scene.and_then(RungeKutta::new) {
        Ok(stepper) => stepper,
        Err(error) => return Verdict::refused(error),
    };
    let end = STEPS as f64 * setup.dt;
    let mut wrong = None;
    let mut worst: f64 = 0.0;
    let mut observe = |at: stickslip::Snapshot<'_, 1>| {
        let (u, v) = (at.displacement[0][0], at.velocity[0][0]);
        let state = at.states.state(0);
        let rate = v.abs();
        let variable = S::State::from_value(state).into();
        let strength = setup.normal_stress * friction.coefficient(rate, variable);
        let pull = setup.stiffness * setup.velocity * at.time - setup.stiffness * u;
        let left = pull - setup.damping * v;
        let terms = setup.stiffness * (setup.velocity * at.time + u.abs())
            + setup.damping * rate
            + strength
            + setup.normal_stress
                * (friction.coefficient_state_slope(rate, variable).abs() * state.abs()
                    + rate
                        * friction.coefficient_slope(rate, variable).min(f64::MAX)
                        * (rate.max(f64::MIN_POSITIVE).ln().abs() + 60.0));
        let missing = if rate > f64::MIN_POSITIVE {
            (left - strength.copysign(v)).abs()
        } else {
            (left.abs() - setup.normal_stress * friction.coefficient(f64::MIN_POSITIVE, variable))
                .max(0.0)
        };
        let residual = missing / (16.0 * f64::EPSILON * terms + f64::MIN_POSITIVE);
        let finite = u.is_finite() && v.is_finite() && state.is_finite();
        if !(finite && residual <= 1.0) && wrong.is_none() {
            wrong = Some(format!(
                "step {}: v = {v:e}, state {state}, residual {residual:.2e} times what is allowed",
                at.step
            ));
        }
        worst = worst.max(residual);
    };
    let adaptive = Adaptive::new(1e-5).with_step_bounds(1e-4 * end, end);
    let result = adaptive.run(&mut stepper, end, &mut observe);
    let mut verdict = match (wrong, result) {
        (Some(text), _) => Verdict::new(Outcome::Defect, text),
        (None, Ok(report)) => {
            let mut verdict = Verdict::new(Outcome::Solved, "");
            verdict.iterations = (report.accepted + report.rejected + report.failed, 0);
            verdict
        }
        (None, Err(failure)) => go_on(&mut stepper, failure, end),
    };
    verdict.residual = worst;
    verdict
}

/// After a run that gave up: nothing is lost, and a small step may still be taken.
fn go_on<const C: usize>(stepper: &mut dyn Stepper<C>, failure: Failure, end: f64) -> Verdict {
    let mut verdict = Verdict::new(Outcome::Reported, failure);
    let before = Moment::of(&stepper.snapshot());
    for power in [6, 8, 10] {
        let size = end * 10f64.powi(-power);
        let taken = stepper.step(size).is_ok();
        let after = Moment::of(&stepper.snapshot());
        if taken && after.is_finite() {
            verdict.resumed = Some(size / end);
            break;
        }
        if taken || after != before {
            return Verdict::new(
                Outcome::Defect,
                "a failed step left its trace, or no numbers",
            );
        }
    }
    verdict
}
