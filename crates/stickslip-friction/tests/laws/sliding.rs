//! Friction beside components that are free or prescribed, against the contract and against a search.

use crate::common::SLIDER;
use nalgebra::{SMatrix, SVector};
use proptest::prelude::*;
use stickslip_friction::{
    ConvexPotential, DieterichRuina, FrictionLaw, FrictionViolation, Radial, Sliding, Tresca,
    check_convex_potential,
};
use stickslip_state::LogTheta;

fn friction(alpha: f64) -> Radial<DieterichRuina> {
    Radial {
        law: SLIDER,
        force: 100.0,
        state: LogTheta(alpha),
    }
}

fn free<const C: usize>(slides: [bool; C]) -> Sliding<DieterichRuina, C> {
    Sliding {
        friction: friction(2.0),
        slides,
        prescribed: SVector::zeros(),
    }
}

#[test]
fn a_free_normal_keeps_the_contract() -> Result<(), FrictionViolation> {
    check_convex_potential::<_, 2>(&free([true, false]), 1e-6, 60.0)?;
    check_convex_potential::<_, 2>(&free([false, true]), 1e-6, 60.0)?;
    check_convex_potential::<_, 3>(&free([true, true, false]), 1e-6, 60.0)?;
    check_convex_potential::<_, 3>(&free([false, true, false]), 1e-6, 60.0)?;
    let kinked = Sliding {
        friction: Radial {
            law: Tresca { coefficient: 0.6 },
            force: 100.0,
            state: (),
        },
        slides: [true, false, true],
        prescribed: SVector::zeros(),
    };
    check_convex_potential::<_, 3>(&kinked, 1e-6, 60.0)
}

proptest! {
    /// Along x prescribed, free along y, z normal: what is found balances the forces.
    #[test]
    fn beside_a_prescribed_component_forces_balance(
        log_p in -12.0..0.0_f64, log_stiffness in -2.0..10.0_f64, log_force in -3.0..4.0_f64,
        sign in prop::bool::ANY, alpha in -10.0..10.0_f64, lifts in prop::bool::ANY,
    ) {
        let (p, s) = (10f64.powf(log_p), 10f64.powf(log_stiffness));
        let g = 10f64.powf(log_force) * if sign { 1.0 } else { -1.0 };
        let potential = Sliding {
            friction: friction(alpha),
            slides: [true, true, false],
            prescribed: SVector::from([p, 0.0, 0.0]),
        };
        // As a solver passes it on: the prescribed component, and a held normal one, decoupled.
        let coupling = if lifts { 0.5 * s } else { 0.0 };
        let block = SMatrix::<f64, 3, 3>::new(
            1.0, 0.0, 0.0,
            0.0, 2.0 * s, coupling,
            0.0, coupling, if lifts { s } else { 1.0 },
        );
        let force = SVector::from([0.0, g, if lifts { 0.3 * g } else { 0.0 }]);
        let t = potential.minimize(&block, &force);
        prop_assert_eq!(t[0], 0.0);
        let rate = p.hypot(t[1]);
        let resisting = 100.0 * SLIDER.coefficient(rate, LogTheta(alpha)) * t[1] / rate;
        let left = force - block * t - SVector::from([0.0, resisting, 0.0]);
        // The logarithm of the rate is resolved to a rounding, and friction with it.
        let terms = force.norm() + (block * t).norm() + resisting.abs()
            + 100.0 * (SLIDER.a + SLIDER.b * alpha.abs());
        prop_assert!(left.norm() <= 32.0 * f64::EPSILON * terms, "{left} of {terms:e}");
        // The gradient says the same, seen from the whole velocity.
        let gradient = potential.local_model(&SVector::from([p, t[1], t[2]])).gradient;
        prop_assert!((gradient[1] - resisting).abs() <= 1e-12 * terms);
    }
}
