//! Bodies that nothing moves rest, whatever their law, solver and coupling.

use nalgebra::Vector3;
use stickslip::fem::{Elastic, P1, body_force, elasticity, mass};
use stickslip::friction::{
    DieterichRuina, FrictionLaw, RegularizedDieterichRuina, StateDependentTresca, Tresca,
};
use stickslip::problems::pipping_slider::AGING;
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, Cholesky, Components, Condensed, Contact, Coupling, FixedPoint, GeneralizedAlpha,
    Monolithic, Newmark, Scene, Simulation, Steps,
};

use crate::Outcome;
use crate::common::Solver;

const ELASTIC: Elastic = Elastic {
    young_modulus: 5e7,
    poisson_ratio: 0.3,
};
const LAW: DieterichRuina = stickslip::problems::pipping_slider::FRICTION;

/// The velocity of a top until 1 s, and then.
type Top = fn(f64) -> [f64; 2];

/// A quasi-static strip between its top and a contact.
fn strip(space: &P1<2>, law: usize, top: Top) -> Outcome<Scene<BlockMatrix<2>, 2>> {
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let scene = Scene::new(elasticity(space, &ELASTIC)?).prescribe_velocity(
        &space.trace(|x| x[1] == 1.0)?,
        Components::ALL,
        top,
    );
    let law: Box<dyn FrictionLaw<State = LogTheta>> = match law {
        0 => Box::new(LAW),
        1 => Box::new(RegularizedDieterichRuina::from(LAW)),
        2 => Box::new(StateDependentTresca {
            b: LAW.b,
            reference_friction: LAW.reference_friction,
            reference_velocity: LAW.reference_velocity,
            slip_distance: LAW.slip_distance,
        }),
        _ => {
            let contact = Contact::new(&bottom, Tresca { coefficient: 0.6 }, 5e4);
            return Ok(scene.with_contact(contact));
        }
    };
    let contact = Contact::new(&bottom, law, 5e4).with_state(AGING, LogTheta(2.0));
    Ok(scene.with_contact(contact))
}

#[test]
fn a_body_that_nothing_moves_rests() -> Outcome {
    let space = P1::grid([4.0, 1.0], [4, 1])?;
    let tops: [Top; 3] = [
        |_| [0.0, 0.0],
        |time| if time < 0.5 { [0.0, 0.0] } else { [1e-9, 0.0] },
        |time| if time < 0.5 { [0.0, 0.0] } else { [1e-4, 0.0] },
    ];
    for law in 0..4 {
        for solver in Solver::ALL {
            for coupled in 0..3 {
                for (number, top) in tops.into_iter().enumerate() {
                    let coupling: Box<dyn Coupling> = match coupled {
                        0 => Box::new(Monolithic::default()),
                        1 => Box::new(FixedPoint::accelerated()),
                        _ => Box::new(FixedPoint::paper()),
                    };
                    let scene = strip(&space, law, top)?;
                    let mut body = Simulation::new(scene, Newmark::default(), solver.on(&space))?
                        .with_coupling(coupling);
                    let name = format!("law {law}, {solver:?}, coupling {coupled}, top {number}");
                    let start = body.state().clone();
                    for steps in [
                        Steps::constant(0.1),
                        Steps::adaptive(1e-3).with_max_steps(1000),
                    ] {
                        body.restore(&start)?;
                        let mut moved = false;
                        body.run(&steps.until(1.0), |at| {
                            moved |= at.time < 0.45 && at.max_slip_rate() > 0.0;
                        })
                        .map_err(|failure| format!("{name}: {failure}"))?;
                        // Regularised friction creeps under any stress, and there is none.
                        assert!(!moved, "{name}");
                    }
                }
            }
        }
    }
    Ok(())
}

/// A cube with inertia that nothing but friction holds starts in equilibrium with its weight, and stays there, on the
/// level and on a slope that friction bears.
#[test]
fn a_cube_on_a_slope_starts_in_equilibrium() -> Outcome {
    let space = P1::grid([0.1, 0.1, 0.1], [2, 2, 2])?;
    let bottom = space.trace(|x| x[2] == 0.0)?;
    let pressure = 981.0;
    for slope in [0.0, 0.1, 0.3_f64] {
        let (sin, cos) = slope.atan().sin_cos();
        let weight = Vector3::new(9810.0 * sin, 0.0, -9810.0 * cos);
        // Enough at the edges, too, where the sole would spread.
        let contact = Contact::new(&bottom, Tresca { coefficient: 10.0 }, pressure * cos);
        let scene = Scene::new(elasticity(&space, &ELASTIC)?)
            .with_mass(mass(&space, 1e3)?)
            .with_load(body_force(&space, |_| weight))
            .with_contact(contact)
            .in_equilibrium(Cholesky::new());
        let mut cube = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
        let start = cube.snapshot().displacement.to_vec();
        let size = start.iter().map(|u| u.amax()).fold(0.0, f64::max);
        cube.run(&Steps::constant(1e-3).count(100), |_| ())?;
        let moved = crate::common::distance(cube.snapshot().displacement, &start);
        assert!(moved <= 1e-8 * size, "{slope}: {moved:e} of {size:e}");
    }
    Ok(())
}
