//! Methods and laws that must give the same motion.

use stickslip::friction::RegularizedDieterichRuina;
use stickslip::integrate::Stepper;
use stickslip::problems::spring_slider::{AGING, FRICTION, SpringScene, SpringSlider};
use stickslip::state::LogTheta;
use stickslip::{ErrorControl, Run, RungeKutta, SceneError, Steps};

use super::{RUINA, STEPPED, implicit, stepped};
use crate::Outcome;

/// A disturbed slider above its critical stiffness, after 30 s.
fn settled(block: &mut dyn Stepper<1>, control: ErrorControl) -> Outcome<[f64; 3]> {
    let steps = Steps::adaptive(1e-11)
        .with_error_control(control)
        .stopping_at([10.0])
        .until(30.0);
    block.run(&steps, |_| ())?;
    let at = block.snapshot();
    let state = at.contact(0).state(0);
    Ok([at.velocity[0][0], state, at.displacement[0][0]])
}

/// By an explicit method and by extrapolated implicit steps, which share the laws and nothing of
/// the integration.
pub(crate) fn methods_agree(scene: impl Fn() -> Result<SpringScene, SceneError>) -> Outcome {
    let control = ErrorControl::default();
    let explicit = settled(&mut RungeKutta::new(scene()?)?, control)?;
    let extrapolated = settled(&mut implicit(scene()?)?, ErrorControl::extrapolated(4))?;
    for (a, b) in explicit.iter().zip(extrapolated) {
        assert!(
            (a - b).abs() < 1e-9 * a.abs(),
            "{explicit:?}, {extrapolated:?}"
        );
    }
    Ok(())
}

#[test]
fn explicit_and_implicit_methods_agree() -> Outcome {
    let slider = SpringSlider {
        damping: 5e6,
        ..stepped(6e8)
    };
    methods_agree(|| slider.steady(FRICTION, AGING, 1e-6))?;
    methods_agree(|| slider.steady(FRICTION, RUINA, 1e-6))
}

/// Above the cut-off the two laws differ by less than `a (Vm/V)^2`, far below rounding here.
#[test]
fn the_regularised_law_gives_the_same_motion() -> Outcome {
    let slider = stepped(1e9);
    let regularised = RegularizedDieterichRuina {
        a: STEPPED.a,
        b: STEPPED.b,
        reference_friction: STEPPED.reference_friction,
        reference_velocity: STEPPED.reference_velocity,
        slip_distance: STEPPED.slip_distance,
    };
    let mut cut = implicit(slider.steady(STEPPED, AGING, 1e-6)?)?;
    let mut smooth = implicit(slider.steady(regularised, AGING, 1e-6)?)?;
    let mut closest = f64::INFINITY;
    for _ in 0..2000 {
        cut.step(1e-2)?;
        smooth.step(1e-2)?;
        let (a, b) = (cut.snapshot(), smooth.snapshot());
        let excess =
            a.velocity[0][0].ln() - STEPPED.ln_cutoff_rate(LogTheta(a.contact(0).state(0)));
        closest = closest.min(excess);
        let difference = (a.velocity[0][0] / b.velocity[0][0] - 1.0).abs();
        assert!(difference < 1e-11, "{difference:e}");
        assert!((a.contact(0).state(0) - b.contact(0).state(0)).abs() < 1e-11);
    }
    assert!((-2.0 * closest).exp() < 1e-40, "{closest}");
    Ok(())
}
