//! Pins: vertices that hold a free body against rigid motion.

use nalgebra::{Vector2, Vector3};
use stickslip::fem::{Elastic, P1, Trace, elasticity, traction};
use stickslip::{
    BoundaryPart, Cholesky, Components, Condensed, GeneralizedAlpha, Scene, SceneError, Simulation,
};

use crate::Outcome;

const ROCK: Elastic = Elastic {
    young_modulus: 60e9,
    poisson_ratio: 0.25,
};
/// The tension \[Pa\].
const PULL: f64 = 3e6;

/// A bar under tension, held by three pins: `u = (sigma/E) (x, -nu y, -nu z)` from its corner, and no force on pins.
#[test]
fn a_bar_in_space_is_strained_between_pins_that_hold_no_force() -> Outcome {
    let size = [3.0, 2.0, 1.0];
    let space = P1::<3>::grid(size, [3, 2, 2])?;
    let end = |at: f64| space.trace(move |x| x[0] == at);
    let load = |end: &Trace<3>, pull: f64| traction(&space, end, |_| Vector3::new(pull, 0.0, 0.0));
    let pins = [[0.0; 3], [3.0, 0.0, 0.0], [0.0, 2.0, 0.0]]
        .map(|point| BoundaryPart::nearest_vertex(&space, point));
    let scene = Scene::new(elasticity(&space, &ROCK)?)
        .with_load(load(&end(0.0)?, -PULL)?)
        .with_load(load(&end(3.0)?, PULL)?)
        .fix(&pins[0], Components::ALL)
        .fix(&pins[1], [false, true, true])
        .fix(&pins[2], [false, false, true])
        .in_equilibrium(Cholesky::new());
    let body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    let at = body.snapshot();
    let strain = PULL / ROCK.young_modulus;
    for (u, x) in at.displacement.iter().zip(space.mesh().vertices()) {
        let exact = Vector3::new(x[0], -0.25 * x[1], -0.25 * x[2]) * strain;
        assert!(
            (u - exact).norm() < 1e-11 * strain,
            "{u} instead of {exact}"
        );
    }
    for pin in &pins {
        let reaction: Vector3<f64> = at.reaction(pin)?;
        assert!(reaction.norm() < 1e-9 * PULL, "{reaction}");
    }
    Ok(())
}

/// An edge that is fixed in space is the support of a plate in plane strain; a part without vertices is refused.
#[test]
fn an_edge_and_a_pin_hold_a_plate() -> Outcome {
    let space = P1::<3>::grid([2.0, 1.0, 1.0], [2, 2, 2])?;
    let edge = BoundaryPart::vertices_where(&space, |x| x[0] == 0.0 && x[1] == 0.0);
    assert_eq!((edge.vertices.len(), edge.dimension), (3, 3));
    assert!(edge.points.iter().all(|x| x[0] == 0.0 && x[1] == 0.0));
    let plane = P1::<2>::grid([2.0, 1.0], [4, 2])?;
    let sides = [0.0, 2.0].map(|at| plane.trace(move |x| x[0] == at));
    let mut scene = Scene::new(elasticity(&plane, &ROCK)?);
    for (side, pull) in sides.into_iter().zip([-PULL, PULL]) {
        scene = scene.with_load(traction(&plane, &side?, |_| Vector2::new(pull, 0.0))?);
    }
    let corner = BoundaryPart::nearest_vertex(&plane, [-0.1, 0.1]);
    let foot = BoundaryPart::nearest_vertex(&plane, [2.0, 0.0]);
    let scene = scene
        .fix(&corner, Components::ALL)
        .fix(&foot, Components::Y)
        .in_equilibrium(Cholesky::new());
    let body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    let strain = PULL / ROCK.young_modulus;
    for (u, x) in body
        .snapshot()
        .displacement
        .iter()
        .zip(plane.mesh().vertices())
    {
        // Plane strain: (1 - nu^2) along, -nu (1 + nu) across.
        let exact = Vector2::new(0.9375 * x[0], -0.3125 * x[1]) * strain;
        assert!(
            (u - exact).norm() < 1e-11 * strain,
            "{u} instead of {exact}"
        );
    }
    let nowhere = BoundaryPart::vertices_where(&plane, |x| x[0] > 5.0);
    let scene = Scene::new(elasticity(&plane, &ROCK)?).fix(&nowhere, Components::ALL);
    let refused = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new()).err();
    assert!(
        matches!(refused, Some(SceneError::EmptyBoundary { .. })),
        "{refused:?}"
    );
    Ok(())
}
