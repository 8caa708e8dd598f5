//! Contacts that can open, against the contract and against Signorini's conditions.

use crate::common::SLIDER;
use nalgebra::{SMatrix, SVector};
use proptest::prelude::*;
use stickslip_friction::{ConvexPotential, DieterichRuina, Radial, Sliding, Unilateral};
use stickslip_state::LogTheta;

/// A contact that slides along x and can open along y, into a surface below or above.
fn contact(outward: f64, bound: f64, pull: f64) -> Unilateral<Sliding<DieterichRuina, 2>, 2> {
    Unilateral {
        potential: Sliding {
            friction: Radial {
                law: SLIDER,
                force: 100.0,
                state: LogTheta(2.0),
            },
            slides: [true, false],
            prescribed: SVector::zeros(),
        },
        axis: 1,
        outward,
        bound,
        pull,
    }
}

proptest! {
    /// The gap is not negative, nor is the reaction, and one of them is zero; friction balances the rest.
    #[test]
    fn either_gap_or_reaction_is_zero(
        log_stiffness in -2.0..10.0_f64, coupling in -0.9..0.9_f64, force in prop::array::uniform2(-1e3..1e3_f64),
        up in prop::bool::ANY, bound in -1.0..1.0_f64, pull in -100.0..100.0_f64,
    ) {
        let outward = if up { 1.0 } else { -1.0 };
        let stiffness = 10f64.powf(log_stiffness);
        let contact = contact(outward, bound, pull);
        let block = SMatrix::<f64, 2, 2>::new(stiffness, coupling * stiffness, coupling * stiffness, stiffness);
        let force = SVector::from(force);
        let v = contact.minimize(&block, &force);
        let into = outward * v[1];
        prop_assert!(into <= bound);
        let left = force - block * v;
        let reaction = pull + outward * left[1];
        let rounding = 1e-12 * (force.norm() + (block * v).norm() + pull.abs() + stiffness * bound.abs());
        prop_assert!(reaction >= -rounding, "{reaction:e}");
        prop_assert!(into == bound || reaction.abs() <= rounding, "{into} {reaction:e}");
        let Radial { law, force: normal, state } = contact.potential.friction;
        let strength = normal * stickslip_friction::FrictionLaw::coefficient(&law, v[0].abs(), state);
        if v[0] == 0.0 {
            prop_assert!(left[0].abs() <= strength + rounding);
        } else {
            let friction = strength.copysign(v[0]);
            prop_assert!((left[0] - friction).abs() <= 1e-9 * strength + rounding, "{} {friction}", left[0]);
        }
        // A correction leads to the bound and no further.
        let d = SVector::from([0.0, 3.0 * outward]);
        let kept = contact.keep_smooth(&SVector::from([1.0, outward * (bound - 1.0)]), &d);
        prop_assert!((outward * kept[1] - 1.0).abs() < 1e-15 && contact.value(&(SVector::from([1.0, outward * (bound + 1.0)]))).is_infinite());
    }
}
