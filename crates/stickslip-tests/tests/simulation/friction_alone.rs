//! Quasi-static bodies that friction alone holds: cubes of 1 m on their bottom, pushed along x.

use nalgebra::{DMatrix, SVector};
use stickslip::fem::{Elastic, P1, body_force, elasticity};
use stickslip::friction::{DieterichRuina, RegularizedDieterichRuina, Tresca};
use stickslip::problems::pipping_slider::{AGING, FRICTION};
use stickslip::solvers::SolveError;
use stickslip::state::LogTheta;
use stickslip::{
    BackwardEuler, BlockGaussSeidel, BlockMatrix, Condensed, Contact, DenseNewton, Matrix,
    NonsmoothSolver, Operator, Scene, SceneError, Simulation, StepError, Tnnmg,
};

use crate::Outcome;

/// On an area of one, so that it is the weight of the cube, too [N].
const NORMAL_STRESS: f64 = 5e4;

fn stiffness<const D: usize>(space: &P1<D>) -> Result<BlockMatrix<D>, SceneError> {
    let elastic = Elastic {
        young_modulus: 5e7,
        poisson_ratio: 0.3,
    };
    Ok(elasticity(space, &elastic)?.into_matrix())
}

/// A force of `push` [N] along x, without its contact.
fn pushed<Op: Operator<D>, const D: usize>(
    space: &P1<D>,
    stiffness: Op,
    push: f64,
) -> Scene<Op, D> {
    let force = SVector::from_fn(|c, _| if c == 0 { push } else { 0.0 });
    Scene::new(stiffness).with_load(body_force(space, |_| force))
}

/// Tresca friction that bears `strength` [N].
fn tresca<const D: usize>(space: &P1<D>, strength: f64) -> Outcome<Contact<Tresca, (), D>> {
    let law = Tresca {
        coefficient: strength / NORMAL_STRESS,
    };
    let bottom = space.trace(|x| x[D - 1] == 0.0)?;
    Ok(Contact::new(&bottom, law, NORMAL_STRESS))
}

/// Half of what friction bears: the body is deformed in the first step, and at rest from then on.
fn sticks<Op: Operator<D> + 'static, const D: usize>(
    space: &P1<D>,
    stiffness: Op,
    solver: impl NonsmoothSolver<Op, D> + 'static,
) -> Outcome {
    const STRENGTH: f64 = 3e4;
    let push = 0.5 * STRENGTH;
    let scene = pushed(space, stiffness, push).with_contact(tresca(space, STRENGTH)?);
    let mut cube = Simulation::new(scene, BackwardEuler, solver)?;
    cube.step(1.0)?;
    let deformed = cube.snapshot().displacement.to_vec();
    assert!(deformed.iter().any(|u| u[0] > 0.0));
    for _ in 0..3 {
        cube.step(1.0)?;
        let at = cube.snapshot();
        // The tolerance of the coupling over the root of the smallest stiffness of a vertex.
        let largest = at.velocity.iter().map(|v| v.amax()).fold(0.0, f64::max);
        assert!(largest <= 1e-12, "{largest:e}");
        let contact = at.contact(0);
        let forces = (0..contact.len()).map(|k| contact.traction(k) * contact.weight(k));
        let friction: SVector<f64, D> = forces.sum();
        assert!((friction[0] - push).abs() <= 1e-6 * push, "{friction}");
    }
    Ok(())
}

/// A friction law that strengthens with the rate holds the body at the rate at which it bears the load.
fn creeps<L, Op: Operator<D> + 'static, const D: usize>(
    space: &P1<D>,
    stiffness: Op,
    law: L,
    (push, slip_rate): (f64, f64),
    solver: impl NonsmoothSolver<Op, D> + 'static,
) -> Outcome
where
    L: stickslip::friction::FrictionLaw<State = LogTheta> + 'static,
{
    let bottom = space.trace(|x| x[D - 1] == 0.0)?;
    let contact = Contact::new(&bottom, law, NORMAL_STRESS).with_state(AGING, LogTheta(0.0));
    let scene = pushed(space, stiffness, push).with_contact(contact);
    let mut cube = Simulation::new(scene, BackwardEuler, solver)?;
    // Many times what the contact needs to pass stress on.
    for _ in 0..12 {
        cube.step(1e3)?;
    }
    let at = cube.snapshot();
    for v in at.velocity {
        let expected = SVector::from_fn(|c, _| if c == 0 { slip_rate } else { 0.0 });
        assert!(
            (v - expected).amax() <= 1e-6 * slip_rate,
            "{v} against {slip_rate:e}"
        );
    }
    Ok(())
}

/// `a`, and the laws without a part of the state: `mu = a ln(V/Vm)` and `a asinh(V/(2 Vm))`.
const A: f64 = 0.05;

fn cut_off() -> DieterichRuina {
    DieterichRuina {
        a: A,
        b: 0.0,
        ..FRICTION
    }
}

/// The rate below which the law that is cut off has no friction [m/s].
fn lowest() -> f64 {
    FRICTION.reference_velocity * (-FRICTION.reference_friction / A).exp()
}

const PUSH: f64 = 0.65 * NORMAL_STRESS;

#[test]
fn a_body_on_friction_alone_sticks_below_its_limit() -> Outcome {
    let plane = P1::grid([1.0, 1.0], [1, 1])?.refined(3)?;
    let space = P1::<3>::grid([1.0; 3], [1; 3])?.refined(2)?;
    sticks(&plane, stiffness(&plane)?, Condensed::new())?;
    sticks(&plane, stiffness(&plane)?, Tnnmg::new(plane.transfers()))?;
    sticks(&plane, stiffness(&plane)?, BlockGaussSeidel::new())?;
    sticks(&plane, dense(&stiffness(&plane)?), DenseNewton::new())?;
    sticks(&space, stiffness(&space)?, Condensed::new())?;
    sticks(&space, stiffness(&space)?, Tnnmg::new(space.transfers()))
}

#[test]
fn a_body_on_friction_alone_creeps_at_the_rate_that_bears_its_load() -> Outcome {
    let plane = P1::grid([1.0, 1.0], [1, 1])?.refined(3)?;
    let space = P1::<3>::grid([1.0; 3], [1; 3])?.refined(2)?;
    let load = PUSH / (A * NORMAL_STRESS);
    let rate = (PUSH, lowest() * load.exp());
    let multigrid = || Tnnmg::new(plane.transfers());
    creeps(
        &plane,
        stiffness(&plane)?,
        cut_off(),
        rate,
        Condensed::new(),
    )?;
    creeps(&plane, stiffness(&plane)?, cut_off(), rate, multigrid())?;
    creeps(
        &plane,
        dense(&stiffness(&plane)?),
        cut_off(),
        rate,
        DenseNewton::new(),
    )?;
    creeps(
        &space,
        stiffness(&space)?,
        cut_off(),
        rate,
        Condensed::new(),
    )?;
    let multigrid_in_space = Tnnmg::new(space.transfers());
    creeps(
        &space,
        stiffness(&space)?,
        cut_off(),
        rate,
        multigrid_in_space,
    )?;
    let law = RegularizedDieterichRuina::from(cut_off());
    let rate = (PUSH, 2.0 * lowest() * load.sinh());
    creeps(&plane, stiffness(&plane)?, law, rate, Condensed::new())?;
    creeps(&plane, stiffness(&plane)?, law, rate, multigrid())
}

/// Twice what friction bears, or no friction at all: there is no velocity, and the error says why.
#[test]
fn a_body_that_friction_does_not_hold_is_refused() -> Outcome {
    let plane = P1::grid([1.0, 1.0], [1, 1])?.refined(3)?;
    for strength in [0.0, 1e4] {
        let scene = || -> Outcome<_> {
            let scene = pushed(&plane, stiffness(&plane)?, 2e4);
            Ok(scene.with_contact(tresca(&plane, strength)?))
        };
        let refused = |cube: &mut Simulation<2>| {
            let failure = cube.step(1.0).err();
            let cause = failure.as_ref().map(|failure| &failure.cause);
            assert!(
                matches!(
                    cause,
                    Some(StepError::Solver(SolveError::NoEquilibrium { .. }))
                ),
                "{failure:?}"
            );
        };
        refused(&mut Simulation::new(
            scene()?,
            BackwardEuler,
            Condensed::new(),
        )?);
        let multigrid = Tnnmg::new(plane.transfers());
        refused(&mut Simulation::new(scene()?, BackwardEuler, multigrid)?);
    }
    Ok(())
}

fn dense(matrix: &BlockMatrix<2>) -> DMatrix<f64> {
    let size = 2 * matrix.vertex_count();
    let mut full = DMatrix::zeros(size, size);
    for (block, (i, j)) in matrix.iter() {
        full.fixed_view_mut::<2, 2>(2 * i as usize, 2 * j as usize)
            .copy_from(block);
    }
    full
}
