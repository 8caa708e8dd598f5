//! Boundary parts of other meshes are refused in every role, also those of meshes of equal size.

use nalgebra::SVector;
use stickslip::fem::{
    Elastic, Impedance, P1, Trace, Viscous, dashpot, elasticity, lumped_mass, mass, viscosity,
};
use stickslip::reduced::Reduced;
use stickslip::solvers::{MeshMismatch, SolveError};
use stickslip::{
    BackwardEuler, BlockMatrix, BoundaryCondition, BoundaryPart, Condensed, Contact, DenseNewton,
    MultigridSolver, Scene, SceneError, Simulation, StepError, Tnnmg,
};

use super::{COULOMB, body_error};
use crate::Outcome;

type Body<const D: usize> = Scene<BlockMatrix<D>, D>;

const ELASTIC: Elastic = Elastic {
    young_modulus: 5e7,
    poisson_ratio: 0.3,
};

const HONEY: Viscous = Viscous {
    shear_viscosity: 1e3,
    bulk_viscosity: 0.0,
};

fn bottom<const D: usize>(space: &P1<D>) -> Outcome<Trace<D>> {
    Ok(space.trace(|x| x[D - 1] == 0.0)?)
}

fn top<const D: usize>(space: &P1<D>) -> Outcome<Trace<D>> {
    Ok(space.trace(|x| x[D - 1] == 1.0)?)
}

/// A body whose matrix is one of its user's.
fn own<const D: usize>(space: &P1<D>) -> Outcome<Body<D>> {
    let stiffness = elasticity(space, &ELASTIC)?;
    Ok(Scene::new(stiffness.into_matrix()))
}

/// A scene with a part in each role.
fn uses<const D: usize>(
    scene: impl Fn() -> Outcome<Body<D>>,
    part: BoundaryPart,
) -> Outcome<[Body<D>; 3]> {
    Ok([
        scene()?.fix(&part, [true; D]),
        scene()?.prescribe_velocity(&part, [true; D], |_| [0.0; D]),
        scene()?.with_contact(Contact::new(part, COULOMB, 1e5)),
    ])
}

fn check<const D: usize>(space: &P1<D>, other: &P1<D>) -> Outcome {
    assert_eq!(space.vertex_count(), other.vertex_count());
    let (expected, found) = (space.mesh().identity(), other.mesh().identity());
    // A body whose matrix knows its mesh; one that is told; and one that is known to be of the mesh of another part.
    let assembled = || -> Outcome<_> { Ok(Scene::new(elasticity(space, &ELASTIC)?)) };
    let body = || -> Outcome<_> { own(space) };
    let known = || -> Outcome<_> { Ok(body()?.on(space)) };
    let by_part = || -> Outcome<_> { Ok(body()?.fix(&top(space)?, [true; D])) };
    let refusals = [
        (uses(assembled, BoundaryPart::from(&bottom(other)?))?, 1),
        (uses(known, BoundaryPart::from(&bottom(other)?))?, 1),
        (uses(by_part, BoundaryPart::from(&bottom(other)?))?, 2),
    ];
    for (scenes, held) in refusals {
        let roles = [
            BoundaryCondition::Fixed(held),
            BoundaryCondition::Prescribed(1),
            BoundaryCondition::Contact(1),
        ];
        for (scene, part) in scenes.into_iter().zip(roles) {
            let error = MeshMismatch::new(part, expected, found);
            assert_eq!(body_error(scene)?, SceneError::Mesh(error));
        }
    }
    let accepted = || -> Outcome<_> { by_part().map(|scene| scene.on(&space.clone())) };
    for scene in uses(accepted, BoundaryPart::from(&bottom(space)?))? {
        let solver = stickslip::BlockGaussSeidel::new();
        let body = stickslip::Simulation::new(scene, stickslip::BackwardEuler, solver)?;
        let at = body.snapshot();
        assert_eq!(at.reaction(&top(space)?)?, SVector::<f64, D>::zeros());
        let error = MeshMismatch::new("part of a reaction", expected, found);
        assert_eq!(at.reaction(&top(other)?), Err(SceneError::Mesh(error)));
        let beyond = BoundaryPart {
            vertices: vec![space.vertex_count()],
            ..BoundaryPart::point(1.0)
        };
        assert!(at.reaction(beyond).is_err());
    }
    let twice = body_error(known()?.on(space))?;
    assert_eq!(twice, SceneError::Repeated { what: "space" });
    Ok(())
}

#[test]
fn parts_of_other_meshes_are_refused_in_every_role() -> Outcome {
    let plane = [[2.0, 1.0], [3.0, 1.0]].map(|size| P1::grid(size, [2, 2]));
    let [space, longer] = plane;
    let space = space?;
    check(&space, &longer?)?;
    check(&space, &P1::mirrored_grid([2.0, 1.0], [2, 2])?)?;
    let turned = P1::grid([1.0, 1.0, 1.0], [1, 2, 3])?;
    check(&P1::grid([1.0, 1.0, 1.0], [3, 2, 1])?, &turned)
}

/// Matrices of two meshes make no body, with the space of one or without.
fn check_matrices<const D: usize>(space: &P1<D>, other: &P1<D>) -> Outcome {
    let (expected, found) = (space.mesh().identity(), other.mesh().identity());
    let elastic = |space: &P1<D>| -> Outcome<_> { Ok(elasticity(space, &ELASTIC)?) };
    let side = bottom(other)?;
    let impedance = Impedance::of(&ELASTIC, 5e3)?;
    let body = || -> Outcome<_> { Ok(Scene::new(elastic(space)?).with_mass(mass(space, 5e3)?)) };
    let foreign = [
        (
            "mass matrix",
            Scene::new(elastic(space)?).with_mass(mass(other, 5e3)?),
        ),
        (
            "mass matrix",
            own(space)?.on(space).with_mass(lumped_mass(other, 5e3)?),
        ),
        ("viscosity matrix", body()?.with_viscosity(elastic(other)?)),
        (
            "viscosity matrix",
            body()?.with_viscosity(dashpot(other, &side, |_| impedance)?),
        ),
        ("stiffness matrix", Scene::new(elastic(other)?).on(space)),
    ];
    for (what, scene) in foreign {
        let error = MeshMismatch::new(what, expected, found);
        assert_eq!(body_error(scene)?, SceneError::Mesh(error));
    }
    // As those of one mesh do, also where it was made twice.
    let again = space.clone();
    let scene = body()?
        .with_viscosity(viscosity(&again, &HONEY)?)
        .with_viscosity(dashpot(&again, &bottom(&again)?, |_| impedance)?)
        .on(&again)
        .with_contact(Contact::new(&bottom(space)?, COULOMB, 1e5));
    Simulation::new(scene, BackwardEuler, Condensed::new())?;
    Ok(())
}

#[test]
fn matrices_of_other_meshes_are_refused() -> Outcome {
    let [space, longer] = [2.0, 3.0].map(|length| P1::grid([length, 1.0], [2, 2]));
    check_matrices(&space?, &longer?)?;
    let [space, longer] = [2.0, 3.0].map(|length| P1::grid([length, 1.0, 1.0], [2, 1, 2]));
    check_matrices(&space?, &longer?)
}

/// A refused mesh is named with its size, and that of the scene.
#[test]
fn a_mismatch_says_both_sizes() -> Outcome {
    let [space, finer] = [2, 4].map(|cells| P1::grid([2.0, 1.0], [cells, 1]));
    let (space, finer) = (space?, finer?);
    let mismatch = |other: &P1<2>| -> Outcome<String> {
        let contact = Contact::new(&bottom(other)?, COULOMB, 1e5);
        let scene = Scene::new(elasticity(&space, &ELASTIC)?).with_contact(contact);
        Ok(body_error(scene)?.to_string())
    };
    let [here, there] = [&space, &finer].map(|space| {
        let mesh = space.mesh();
        let (vertices, elements) = (mesh.vertex_count(), mesh.cell_count());
        format!("of {vertices} vertices and {elements} elements")
    });
    let text = mismatch(&finer)?;
    let has = &here["of ".len()..];
    assert!(
        text.contains(&format!("{there}, and the scene has {has}")),
        "{text}"
    );
    assert!(
        text.starts_with("contact 1 belongs to another mesh"),
        "{text}"
    );
    let longer = mismatch(&P1::grid([3.0, 1.0], [2, 1])?)?;
    assert!(longer.contains(&format!("also {here}")), "{longer}");
    Ok(())
}

/// Of a reduced body, too, which has forgotten most of its vertices.
#[test]
fn a_reduced_body_knows_its_mesh() -> Outcome {
    let [space, longer] = [2.0, 3.0].map(|length| P1::grid([length, 1.0], [2, 2]));
    let (space, other) = (space?, longer?);
    let (expected, found) = (space.mesh().identity(), other.mesh().identity());
    let refused = |part: &str| SceneError::Mesh(MeshMismatch::new(part, expected, found));
    let on = |space: &P1<2>, contact: &P1<2>| -> Outcome<_> {
        let held = Scene::new(elasticity(space, &ELASTIC)?).fix(&top(space)?, [true; 2]);
        Ok(held.with_contact(Contact::new(&bottom(contact)?, COULOMB, 1e5)))
    };
    let body = Reduced::new(&on(&space, &space)?).up_to_frequency(1.0)?;
    let outer = bottom(&other)?;
    assert_eq!(
        body.part(&outer).err(),
        Some(refused("part of a reduced body"))
    );
    let error = body.reduce(on(&space, &other)?).err();
    assert_eq!(error, Some(refused("contact 1")));
    // What is reduced already is no part of the whole.
    let part = body.part(&bottom(&space)?)?;
    assert!(body.part(&part).is_err());
    let scene = body.reduce(on(&space, &space)?)?;
    let surface = Simulation::new(scene, BackwardEuler, DenseNewton::new())?;
    let whole = body.displacement(&surface.snapshot())?;
    assert_eq!(whole.len(), space.vertex_count());
    // The same contact on a body of another length has a surface of as many vertices.
    let longer = Reduced::new(&on(&other, &other)?).up_to_frequency(1.0)?;
    let error = longer.displacement(&surface.snapshot());
    let other = matches!(&error, Err(SceneError::Mesh(error)) if error.what == "snapshot");
    assert!(other, "{error:?}");
    assert!(longer.velocity(&surface.snapshot()).is_err());
    Ok(())
}

/// Solvers for a mesh of equal size, at the start, for the equilibrium, and on the way.
#[test]
fn solvers_for_other_meshes_are_refused() -> Outcome {
    let space = P1::grid([2.0, 1.0], [2, 1])?.refined(2)?;
    let other = P1::mirrored_grid([2.0, 1.0], [2, 1])?.refined(2)?;
    assert_eq!(space.vertex_count(), other.vertex_count());
    let (expected, found) = (space.mesh().identity(), other.mesh().identity());
    let scene = || -> Outcome<_> {
        let held = Scene::new(elasticity(&space, &ELASTIC)?).fix(&top(&space)?, [true; 2]);
        Ok(held.with_contact(Contact::new(&bottom(&space)?, COULOMB, 1e5)))
    };
    let made = Simulation::new(scene()?, BackwardEuler, Tnnmg::new(other.transfers()));
    let error = super::one_line(made.err().ok_or("the solver was accepted")?)?;
    let mismatch = MeshMismatch::new("solver", expected, found);
    assert_eq!(error, SceneError::Mesh(mismatch.clone()));

    let equilibrium = MultigridSolver::new(other.transfers());
    let error = body_error(scene()?.in_equilibrium(equilibrium))?;
    let cause = SolveError::Mesh(mismatch);
    assert_eq!(error, SceneError::Equilibrium(cause.clone()));

    let mut body = Simulation::new(scene()?, BackwardEuler, Tnnmg::new(space.transfers()))?;
    body.step(1e-3)?;
    body.set_solver(Tnnmg::new(other.transfers()))?;
    let failure = body.step(1e-3).err().ok_or("the solver was accepted")?;
    assert_eq!(failure.cause, StepError::Solver(cause));
    body.set_solver(Condensed::new())?;
    body.step(1e-3)?;
    Ok(())
}
