//! The slope of friction with its state following.

use stickslip_friction::Nodal;
use stickslip_state::{LogScale, LogTheta, Reads, StateLaw, StateVariable, Theta};

use super::*;
use crate::laws::NormalStressEffect;
use crate::problems::spring_slider::FRICTION;
use crate::scene::erase;

/// `theta' = 1 - V theta/L` in `theta` itself.
struct Aging;

impl StateLaw for Aging {
    type State = Theta;

    fn evolution(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
        1.0 - slip_rate * theta / 1e-5
    }

    fn evolution_state_slope(&self, _: Theta, slip_rate: f64) -> f64 {
        -slip_rate / 1e-5
    }
}

/// The slope is that of the coefficient, also behind a normal stress that rises by half.
fn check<S: StateLaw + 'static>(evolution: fn() -> S, start: S::State)
where
    S::State: LogScale,
    LogTheta: Reads<S::State>,
{
    for update in [StateUpdate::BackwardEuler, StateUpdate::Midpoint] {
        let laws = (Nodal::Uniform(FRICTION), Nodal::Uniform(evolution()));
        let effect = NormalStressEffect::new(Nodal::Uniform(0.4));
        let built = erase(laws, &Nodal::Uniform(start), Some(effect), false, 1);
        let mut trial = Trial::new(built.expect("legal laws"));
        let step = StateStep {
            dt: 2.0,
            update,
            new_share: 0.5,
        };
        let begun = trial.begin(step, (&[start.value()], &[1e-6]), [&[2e6], &[3e6]]);
        assert!(begun.is_ok());
        trial.eliminate(true);
        let coefficient = |rate: f64| trial.coefficient_and_rate_slope(0, rate).0;
        for rate in [1e-7_f64, 1e-6, 1e-4] {
            let h = 1e-4 * rate;
            let difference = coefficient(rate + h) - coefficient(rate - h);
            let (_, slope) = trial.coefficient_and_rate_slope(0, rate);
            // The difference keeps h^2/rate^2 of it, and rounding over h.
            let bound = 1e-6 * slope.abs() + 1e-15 / h;
            assert!((difference / (2.0 * h) - slope).abs() < bound, "{rate}");
        }
    }
}

#[test]
fn the_slope_follows_state_and_normal_stress() {
    check(|| crate::problems::spring_slider::AGING, LogTheta(2.0));
    check(|| Aging, Theta(5.0));
}
