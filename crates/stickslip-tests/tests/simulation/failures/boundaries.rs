//! Parts of the boundary that are none, that meet, or that do not support a body.

use nalgebra::{Vector1, Vector2};
use stickslip::fem::{Elastic, Mesh, P1, Trace, antiplane, elasticity, mass};
use stickslip::friction::Tresca;
use stickslip::problems::pipping_slider::PippingSlider;
use stickslip::solvers::ConjugateGradients;
use stickslip::time::QuasiStatic;
use stickslip::{
    BackwardEuler, BlockMatrix, BoundaryPart, Cholesky, Components, Condensed, Contact,
    LinearSolver, MultigridSolver, Newmark, Scene, SceneError, Simulation, Tnnmg,
};

use super::{COULOMB, body_error};
use crate::Outcome;
use crate::common::body;

#[test]
fn boundary_parts_must_be_sets_of_vertices() -> Outcome {
    let paper = body(1);
    let space = paper.space()?;
    let part = |vertices: Vec<usize>| BoundaryPart {
        weights: vec![1.0; vertices.len()],
        vertices,
        ..BoundaryPart::point(1.0)
    };
    let scene = || paper.scene(&space);
    let errors = |part: BoundaryPart| -> Outcome<_> {
        let contact = Contact::new(&part, COULOMB, 1e5);
        Ok([
            body_error(scene()?.with_contact(contact))?,
            body_error(scene()?.fix(&part, Components::X))?,
            body_error(scene()?.prescribe_velocity(&part, Components::X, |_| [0.0; 2]))?,
        ])
    };
    let roles = ["contact", "held boundary", "moved boundary"];
    for (error, role) in errors(part(vec![]))?.into_iter().zip(roles) {
        assert_eq!(error, SceneError::EmptyBoundary { what: role });
    }
    for (vertices, position) in [
        (vec![3, 2], 1),
        (vec![2, 2], 1),
        (vec![0, 33], 1),
        (vec![99], 0),
    ] {
        for (error, role) in errors(part(vertices.clone()))?.into_iter().zip(roles) {
            let SceneError::Value {
                what,
                position: found,
                value,
                ..
            } = error
            else {
                return Err(error.into());
            };
            assert_eq!((what, found), (role, position));
            assert_eq!(value, vertices[position] as f64);
        }
    }
    Ok(())
}

/// Where a contact meets a fixed or driven part the prescription holds, and friction has what is
/// left.
#[test]
fn what_is_prescribed_holds_where_a_contact_meets_it() -> Outcome {
    let paper = body(1);
    let space = paper.space()?;
    let bottom = PippingSlider::bottom(&space)?;
    let corner = space.vertex_at([0.0, 0.0]).ok_or("no corner")?;
    let side = space.trace(|x| x[0] == 0.0 && x[1] < 1.0)?;
    let scene = || -> Result<_, SceneError> {
        let contact = Contact::new(&bottom, COULOMB, 1e5);
        Ok(paper.scene(&space)?.with_contact(contact))
    };
    let pull = |_: f64| [-0.25, 0.0];
    let cases = [
        (scene()?.fix(&side, Components::ALL), 0.0),
        // Each of two parts holds one component.
        (
            scene()?
                .fix(&side, Components::X)
                .fix(&bottom, Components::Y),
            0.0,
        ),
        // The contact holds the other one.
        (scene()?.fix(&side, Components::X), 0.0),
        (
            scene()?.prescribe_velocity(&side, Components::ALL, pull),
            -0.25,
        ),
        (
            scene()?.prescribe_velocity(&side, Components::X, pull),
            -0.25,
        ),
    ];
    for (scene, expected) in cases {
        let solver = Tnnmg::new(space.transfers());
        let mut body = Simulation::new(scene, Newmark::default(), solver)?;
        for _ in 0..3 {
            body.step(1e-3)?;
            let at = body.snapshot();
            assert_eq!(at.velocity[corner].as_slice(), [expected, 0.0]);
            let contact = at.contact(0);
            let k = contact.position_of(corner).ok_or("not in contact")?;
            assert_eq!(contact.slip_rate(k), f64::abs(expected));
            let traction = if expected < 0.0 { -0.6 * 1e5 } else { 0.0 };
            assert!((contact.traction(k)[0] - traction).abs() < 1e-9);
        }
    }
    Ok(())
}

/// Held in its normal component alone the bottom can still slide, as it can without.
#[test]
fn holding_a_contact_in_its_normal_component_changes_nothing() -> Outcome {
    let paper = body(1);
    let space = paper.space()?;
    let bottom = PippingSlider::bottom(&space)?;
    let run = |held: bool| -> Outcome<_> {
        let contact = Contact::new(&bottom, COULOMB, 10.0);
        let mut scene = paper.scene(&space)?.with_contact(contact);
        if held {
            scene = scene.fix(&bottom, Components::Y);
        }
        let solver = Tnnmg::new(space.transfers());
        let mut body = Simulation::new(scene, Newmark::default(), solver)?;
        for _ in 0..100 {
            body.step(1e-2)?;
        }
        assert!(body.snapshot().max_slip_rate() > 1e-6);
        Ok(body.state().clone())
    };
    assert_eq!(run(true)?, run(false)?);
    Ok(())
}

/// Without any support there is no equilibrium under a push, whatever rounding makes of the last
/// pivot.
#[test]
fn a_floating_body_has_no_equilibrium() -> Outcome {
    for refinements in 0..4 {
        let space = P1::grid([2.0, 1.0], [2, 1])?.refined(refinements)?;
        let multigrid = MultigridSolver::new(space.transfers());
        let solvers: [(_, Box<dyn LinearSolver<BlockMatrix<1>, 1>>); 3] = [
            ("multigrid", Box::new(multigrid)),
            ("Cholesky", Box::new(Cholesky::new())),
            (
                "conjugate gradients",
                Box::new(ConjugateGradients::default()),
            ),
        ];
        for (name, solver) in solvers {
            let push = vec![Vector1::new(1.0); space.vertex_count()];
            let scene = Scene::new(antiplane(&space, 1e7)?).with_mass(mass(&space, 5e3)?);
            let error = body_error(scene.with_load(push).in_equilibrium(solver));
            assert!(
                matches!(error, Ok(SceneError::Equilibrium(_))),
                "{name}, refined {refinements} times: {error:?}"
            );
        }
    }
    Ok(())
}

/// Two squares side by side whose common edge was cut open: a contact on both of its walls, or one on each, is refused
/// with vertices at one place.
#[test]
fn both_walls_of_an_open_mesh_are_refused() -> Outcome {
    let square = |x: f64| [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]];
    let points = [square(0.0), square(1.0)].concat();
    let mesh = Mesh::new(
        points.into_iter().map(Vector2::from).collect(),
        vec![0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7],
    )?
    .with_part("left wall", &[[1, 2]])?
    .with_part("right wall", &[[7, 4]])?;
    assert_eq!(mesh.nonconforming_nodes(1e-9)?.vertices, [[1, 4], [2, 7]]);
    let space = P1::new(mesh);
    let ends = space.trace(|x| x[0] == 0.0 || x[0] == 2.0)?;
    let scene = |walls: &[Trace<2>]| -> Outcome<Scene<BlockMatrix<2>, 2>> {
        let material = Elastic {
            young_modulus: 1e9,
            poisson_ratio: 0.25,
        };
        let scene = Scene::new(elasticity(&space, &material)?).fix(&ends, Components::ALL);
        Ok(walls.iter().fold(scene, |scene, wall| {
            scene.with_contact(Contact::new(wall, Tresca { coefficient: 0.6 }, 1e6))
        }))
    };
    let built = |scene| Simulation::new(scene, QuasiStatic(BackwardEuler), Condensed::new());
    let both = || -> Outcome<_> { Ok(space.trace(|x| x[0] == 1.0)?) };
    let (left, right) = (space.part("left wall")?, space.part("right wall")?);
    for walls in [vec![both()?], vec![left.clone(), right]] {
        let error = built(scene(&walls)?).err().ok_or("two walls")?;
        let SceneError::Coincident { vertices, at } = &error else {
            return Err(error.into());
        };
        let of_both = [[1, 4], [2, 7]].map(|pair| (pair, space.mesh().vertices()[pair[0]]));
        let found = of_both.iter().find(|(pair, _)| pair == vertices);
        assert!(
            found.is_some_and(|(_, x)| (x[0], x[1]) == (at[0], at[1])),
            "{error}"
        );
        assert!(error.to_string().contains("with_open_walls"), "{error}");
        built(scene(&walls)?.with_open_walls())?;
    }
    built(scene(&[left])?)?;
    Ok(())
}
