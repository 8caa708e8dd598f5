//! Without inertia the surface is all there is: no mode, and nothing left out.
//!
//! From rest in equilibrium, that is: what an interior without inertia starts with beside that, the trapezoidal rule
//! carries on in its velocity, and a reduced body has no place for it.

use stickslip::fem::{Elastic, Impedance, P1, Viscous, dashpot, elasticity, viscosity};
use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::{AGING, FRICTION};
use stickslip::reduced::Reduced;
use stickslip::state::LogTheta;
use stickslip::{Cholesky, Components, Contact, Scene, SceneError};

use super::{Full, Pair};
use crate::Outcome;

const ELASTIC: Elastic = Elastic {
    young_modulus: 5e7,
    poisson_ratio: 0.3,
};
/// Slip over which it weakens by so much that no jump occurs.
const LAW: DieterichRuina = DieterichRuina {
    slip_distance: 1e-3,
    ..FRICTION
};

/// A plate between two contacts of different laws, pulled at its right side.
fn plate(space: &P1<2>) -> Outcome<Full<2>> {
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let top = space.trace(|x| x[1] == 1.0)?;
    let side = space.trace(|x| x[0] == 3.0)?;
    let weak = DieterichRuina { b: 0.002, ..LAW };
    Ok(Scene::new(elasticity(space, &ELASTIC)?)
        .with_contact(Contact::new(&bottom, LAW, 2e4).with_state(AGING, LogTheta(0.0)))
        .with_contact(Contact::new(&top, weak, 1e4).with_state(AGING, LogTheta(2.0)))
        .prescribe_velocity(&side, Components::X, |time| [1e-4 * time, 0.0]))
}

/// A block on its bottom, pulled obliquely at its top, under its weight.
fn block(space: &P1<3>) -> Outcome<Full<3>> {
    let bottom = space.trace(|x| x[2] == 0.0)?;
    let top = space.trace(|x| x[2] == 1.0)?;
    Ok(Scene::new(elasticity(space, &ELASTIC)?)
        .with_load(weight(space))
        .in_equilibrium(Cholesky::new())
        .with_contact(Contact::new(&bottom, LAW, 2e4).with_state(AGING, LogTheta(0.0)))
        .prescribe_velocity(&top, [true; 3], |time| [1e-4 * time, 3e-5 * time, 0.0]))
}

fn weight(space: &P1<3>) -> Vec<nalgebra::SVector<f64, 3>> {
    stickslip::fem::body_force(space, |_| [0.0, 0.0, -5e4].into())
}

#[test]
fn a_plate_between_two_contacts_is_exact() -> Outcome {
    let space = P1::grid([3.0, 1.0], [6, 4])?;
    let scene = || plate(&space);
    // No mode is looked for, whatever the frequency.
    let mut pair = Pair::new(&scene, 1.0)?;
    assert_eq!(pair.body.frequencies().count(), 0);
    assert_eq!(
        (pair.body.first_left_out(), pair.body.left_out(1e9)?),
        (None, 0.0)
    );
    // Velocities balance forces of `A u/dt`, whose rounding grows with the displacement: some 1e-12 after 200 steps.
    for _ in 0..150 {
        pair.step(0.05)?;
        let apart = pair.apart(None)?;
        assert!(apart < 1e-12, "{apart:e}");
    }
    assert!(pair.full.snapshot().max_slip_rate() > 1e-5);
    Ok(())
}

#[test]
fn a_block_in_space_is_exact() -> Outcome {
    let space = P1::<3>::grid([2.0, 1.0, 1.0], [4, 2, 2])?;
    let scene = || block(&space);
    let mut pair = Pair::new(&scene, 1.0)?;
    let weight = weight(&space);
    // Until shortly before slip runs away.
    for _ in 0..65 {
        pair.step(0.05)?;
        let apart = pair.apart(Some(&weight))?;
        assert!(apart < 1e-12, "{apart:e}");
    }
    assert!(pair.full.snapshot().max_slip_rate() > 1e-5);
    Ok(())
}

/// Radiation damping on the contact itself has no interior.
#[test]
fn dashpots_on_the_contact_are_exact() -> Outcome {
    let space = P1::grid([3.0, 1.0], [6, 4])?;
    let impedance = Impedance::of(&ELASTIC, 5e3)?;
    let scene = || -> Outcome<_> {
        let bottom = space.trace(|x| x[1] == 0.0)?;
        Ok(plate(&space)?.with_viscosity(dashpot(&space, &bottom, |_| impedance)?))
    };
    let mut pair = Pair::new(&scene, 1.0)?;
    for _ in 0..200 {
        pair.step(0.05)?;
        let apart = pair.apart(None)?;
        assert!(apart < 1e-12, "{apart:e}");
    }
    Ok(())
}

#[test]
fn viscosity_inside_is_refused() -> Outcome {
    let space = P1::grid([3.0, 1.0], [6, 4])?;
    let inside = viscosity(
        &space,
        &Viscous {
            shear_viscosity: 1e4,
            bulk_viscosity: 1e4,
        },
    )?;
    let left = space.trace(|x| x[0] == 0.0)?;
    let absorbing = dashpot(&space, &left, |_| Impedance {
        normal: 1e5,
        tangential: 1e5,
    })?;
    for viscosity in [inside, absorbing] {
        let scene = plate(&space)?.with_viscosity(viscosity);
        let error = Reduced::new(&scene).up_to_frequency(100.0).err();
        assert!(
            matches!(
                error,
                Some(SceneError::Unsupported {
                    by: SceneError::REDUCTION,
                    ..
                })
            ),
            "{error:?}"
        );
    }
    Ok(())
}
