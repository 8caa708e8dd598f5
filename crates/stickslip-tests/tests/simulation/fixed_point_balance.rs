//! A fixed point whose velocity no longer moves may still be far from balance: friction stiff enough hides a change
//! of the state. Such a step goes on, or is reported.

use stickslip::friction::{DieterichRuina, FrictionLaw};
use stickslip::problems::spring_slider::{FRICTION, LoadPath, SpringSlider};
use stickslip::state::{Dieterich, LogTheta, Ruina, StateLaw};
use stickslip::{FixedPoint, Newmark, Point, Simulation};

use crate::Outcome;

/// A spring slider at extreme parameters.
struct Case {
    dt: f64,
    stiffness: f64,
    normal_stress: f64,
    velocity: f64,
    slip_rate: f64,
    alpha: f64,
    slip_distance: f64,
    a: f64,
    ratio: f64,
    ruina: bool,
}

impl Case {
    /// Up to five steps, each in balance or failed. How many were taken.
    fn march(&self, coupling: FixedPoint) -> Outcome<usize> {
        let slip_distance = self.slip_distance;
        let friction = DieterichRuina {
            a: self.a,
            b: self.ratio * self.a,
            slip_distance,
            ..FRICTION
        };
        let law: Box<dyn StateLaw<State = LogTheta>> = if self.ruina {
            Box::new(Ruina { slip_distance })
        } else {
            Box::new(Dieterich { slip_distance })
        };
        let body = SpringSlider {
            stiffness: self.stiffness,
            normal_stress: self.normal_stress,
            mass: 0.0,
            damping: 0.0,
            load: LoadPath::steady(self.velocity),
        };
        let scene = body.scene(friction, law, self.slip_rate, LogTheta(self.alpha))?;
        let mut spring = Simulation::new(scene, Newmark::default(), Point)?.with_coupling(coupling);
        for step in 0..5 {
            let from = spring.state().clone();
            if spring.step(self.dt).is_err() {
                return Ok(step);
            }
            let left = spring.residuals(&from);
            // The velocity is known to some tolerances of 1e-10 in the norm of the stiffness, friction to what that
            // makes of it.
            let at = spring.snapshot();
            let (rate, state) = (at.max_slip_rate(), LogTheta(at.contact(0).state(0)));
            let doubt = 1e-9 / self.stiffness.sqrt();
            let weakest = friction.coefficient((rate - doubt).max(0.0), state);
            let band = friction.coefficient(rate + doubt, state) - weakest;
            let allowed = 1e-6 * left.force_terms + self.normal_stress * band;
            assert!(left.force <= allowed, "{step}: {left:?}, {allowed:e}");
        }
        Ok(5)
    }
}

#[test]
fn a_step_is_in_balance_or_reported() -> Outcome {
    let at_rest = Case {
        dt: 214.4,
        stiffness: 1.0,
        normal_stress: 1.0,
        velocity: 0.0,
        slip_rate: 5.46e-17,
        alpha: 730.7,
        slip_distance: 2.53e-11,
        a: 1.0,
        ratio: 2.0,
        ruina: true,
    };
    let cases = [
        Case {
            dt: 4790.0,
            slip_rate: 9.29e-16,
            alpha: 50.9,
            slip_distance: 6.5e-10,
            ratio: 1.5,
            ..at_rest
        },
        Case {
            dt: 0.0391,
            stiffness: 1.70e7,
            normal_stress: 783.0,
            velocity: 0.0321,
            slip_rate: 0.0,
            alpha: -503.9,
            slip_distance: 1.0,
            a: 0.304,
            ratio: 0.5,
            ruina: false,
        },
        Case {
            dt: 7.4e-8,
            stiffness: 1.88e10,
            velocity: 2.9e-6,
            slip_rate: 0.0,
            alpha: -116.3,
            slip_distance: 1.0,
            ratio: 0.5,
            ruina: false,
            ..at_rest
        },
        at_rest,
    ];
    for case in &cases {
        for coupling in [FixedPoint::paper(), FixedPoint::accelerated()] {
            case.march(coupling)?;
        }
    }
    Ok(())
}
