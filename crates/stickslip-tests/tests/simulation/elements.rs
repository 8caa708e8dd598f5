//! Explicit steps by elements: those with the matrix, energy and reversal of time, and the bits of one thread.

use nalgebra::{SVector, Vector2, Vector3};
use stickslip::fem::{
    Elastic, ElementStiffness, Impedance, P1, Viscous, dashpot, elasticity_by_cell,
    element_stiffness, element_stiffness_by_cell, lumped_mass, lumped_mass_by_cell,
    viscosity_by_cell,
};
use stickslip::problems::pipping_slider::{AGING, FRICTION};
use stickslip::solvers::IntoOperator;
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, CentralDifferences, Components, Contact, Diagonal, Newmark, NonsmoothSolver,
    Scene, SceneError, Simulation, Steps,
};

use crate::Outcome;

fn rock(cell: usize) -> Elastic {
    Elastic {
        young_modulus: 2.5 + (cell % 7) as f64,
        poisson_ratio: 0.05 * (cell % 9) as f64,
    }
}

fn viscous(cell: usize) -> Viscous {
    Viscous {
        shear_viscosity: 0.002 * (cell % 3) as f64,
        bulk_viscosity: 0.004 * (cell % 2) as f64,
    }
}

/// A body of many materials that slides on its base, under friction, dashpots and Kelvin-Voigt viscosity.
fn sliding<S, const D: usize>(
    space: &P1<D>,
    stiffness: S,
    viscosity: impl IntoOperator<D, Operator: Into<S::Operator>>,
) -> Outcome<Simulation<D>>
where
    S: IntoOperator<D, Operator: From<BlockMatrix<D>>>,
    Diagonal<D>: NonsmoothSolver<S::Operator, D>,
{
    let up = D - 1;
    let base = space.trace(|x| x[up] == 0.0)?;
    let top = space.trace(|x| x[up] == 1.0)?;
    let impedance = Impedance::of(&rock(1), 1.0)?;
    let contact = Contact::new(&base, FRICTION, 0.1).with_state(AGING, LogTheta(0.0));
    let scene = Scene::new(stiffness)
        .with_mass(lumped_mass_by_cell(space, |_, cell| {
            1.0 + (cell % 5) as f64
        })?)
        .with_viscosity(viscosity)
        .with_viscosity(dashpot(space, &top, |_| impedance)?)
        .with_contact(contact)
        .with_velocity(
            space.interpolate(|x| SVector::from_fn(|c, _| if c == 0 { 0.1 + x[up] } else { 0.0 })),
        );
    Ok(Simulation::new(scene, CentralDifferences, Diagonal::new())?)
}

fn difference<const D: usize>(a: &[SVector<f64, D>], b: &[SVector<f64, D>]) -> f64 {
    let largest = b.iter().map(|b| b.amax()).fold(0.0, f64::max);
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).amax())
        .fold(0.0, f64::max)
        / largest
}

fn runs_as_its_matrix<const D: usize>(space: &P1<D>) -> Outcome {
    let elements = element_stiffness_by_cell(space, |_, cell| rock(cell))?;
    let viscosity = elements.viscosity_by_cell(viscous)?;
    let matrix = elasticity_by_cell(space, |_, cell| rock(cell))?;
    // A multiple of the stiffness has one product with it.
    let multiple = sliding(space, elements.clone(), &elements * 1e-3)?;
    let sum = sliding(space, matrix.clone(), matrix.map(|block| block * 1e-3))?;
    are_the_same(multiple, sum)?;
    let own = sliding(space, elements, viscosity)?;
    let viscosity = viscosity_by_cell(space, |_, cell| viscous(cell))?;
    are_the_same(own, sliding(space, matrix, viscosity)?)
}

fn are_the_same<const D: usize>(mut own: Simulation<D>, mut whole: Simulation<D>) -> Outcome {
    own.step(1e-6)?;
    whole.step(1e-6)?;
    let limits = [&own, &whole].map(|body| body.step_limit().unwrap_or_default());
    assert!((limits[0] / limits[1] - 1.0).abs() < 1e-10 && limits[0] > 0.0);
    let steps = Steps::constant(0.9 * limits[1]).count(60);
    own.run(&steps, |_| ())?;
    whole.run(&steps, |_| ())?;
    let (own, whole) = (own.snapshot(), whole.snapshot());
    assert!(difference(own.displacement, whole.displacement) < 1e-10);
    assert!(difference(own.velocity, whole.velocity) < 1e-9);
    Ok(())
}

#[test]
fn steps_are_those_with_the_matrix() -> Outcome {
    runs_as_its_matrix(&P1::grid([2.0, 1.0], [8, 4])?)?;
    runs_as_its_matrix(&P1::grid([2.0, 1.0, 1.0], [6, 4, 3])?)
}

/// A body without friction that is fixed at its base, in motion.
fn swinging(
    space: &P1<3>,
    displacement: Vec<Vector3<f64>>,
    velocity: Vec<Vector3<f64>>,
) -> Outcome<Simulation<3>> {
    let base = space.trace(|x| x[2] == 0.0)?;
    let scene = Scene::new(element_stiffness(space, &rock(3))?)
        .with_mass(lumped_mass(space, 1.0)?)
        .fix(&base, Components::ALL)
        .with_displacement(displacement)
        .with_velocity(velocity);
    Ok(Simulation::new(scene, CentralDifferences, Diagonal::new())?)
}

fn released() -> Outcome<(P1<3>, Simulation<3>, f64)> {
    let space = P1::grid([1.0, 1.0, 2.0], [2, 2, 4])?;
    let pulled = space.interpolate(|x| Vector3::new(x[2], 0.3 * x[2] * x[0], 0.1 * x[2]));
    let rest = vec![Vector3::zeros(); space.vertex_count()];
    let mut body = swinging(&space, pulled.clone(), rest.clone())?;
    body.step(1e-6)?;
    let dt = 0.5 * body.step_limit().unwrap_or_default();
    Ok((space.clone(), swinging(&space, pulled, rest)?, dt))
}

/// Central differences conserve `v.Mv/2 + u.Au/2 - (dt^2/8) a.Ma` of a linear body.
#[test]
fn the_energy_of_the_scheme_is_constant() -> Outcome {
    let (space, mut body, dt) = released()?;
    let (mass, stiffness) = (
        lumped_mass::<3, 3>(&space, 1.0)?,
        element_stiffness(&space, &rock(3))?,
    );
    let energy = |body: &Simulation<3>| {
        let at = body.snapshot();
        let mut force = vec![Vector3::zeros(); space.vertex_count()];
        stiffness.multiply_add(1.0, at.displacement, &mut force);
        let terms = mass.data().iter().enumerate().map(|(i, mass)| {
            let (v, a) = (
                at.velocity[i].norm_squared(),
                at.acceleration[i].norm_squared(),
            );
            mass[(0, 0)] * (v - dt * dt / 4.0 * a) + at.displacement[i].dot(&force[i])
        });
        terms.sum::<f64>()
    };
    let start = energy(&body);
    let mut apart = 0.0_f64;
    for _ in 0..100 {
        body.run(&Steps::constant(dt).count(100), |_| ())?;
        apart = apart.max((energy(&body) / start - 1.0).abs());
    }
    assert!(apart < 1e-11, "{apart:e}");
    Ok(())
}

#[test]
fn reversed_velocities_lead_back() -> Outcome {
    let (space, mut body, dt) = released()?;
    let start = body.snapshot().displacement.to_vec();
    body.run(&Steps::constant(dt).count(500), |_| ())?;
    let end = body.snapshot();
    let velocity = end.velocity.iter().map(|v| -v).collect();
    let mut back = swinging(&space, end.displacement.to_vec(), velocity)?;
    back.run(&Steps::constant(dt).count(500), |_| ())?;
    let error = difference(back.snapshot().displacement, &start);
    assert!(error < 1e-11, "{error:e}");
    Ok(())
}

/// An implicit scheme has no rows to solve with, and a stiffness by elements is no mass.
#[test]
fn what_needs_rows_is_refused() -> Outcome {
    let space = P1::grid([2.0, 1.0], [2, 1])?;
    let stiffness = element_stiffness(&space, &rock(0))?;
    let scene = Scene::new(stiffness.clone()).with_mass(lumped_mass(&space, 1.0)?);
    let refused = Simulation::new(scene, Newmark::default(), Diagonal::new()).err();
    let Some(error @ SceneError::Unsupported { .. }) = refused else {
        return Err(format!("{refused:?}").into());
    };
    assert!(error.to_string().contains("elasticity"), "{error}");
    let scene = Scene::new(stiffness.clone()).with_mass(stiffness);
    let refused = Simulation::new(scene, CentralDifferences, Diagonal::new()).err();
    assert!(
        matches!(refused, Some(SceneError::Length { .. })),
        "{refused:?}"
    );
    Ok(())
}

/// A body of several parts.
#[test]
fn bits_do_not_depend_on_threads() -> Outcome {
    let space = P1::grid([2.0, 1.0, 1.0], [40, 20, 14])?;
    let run = |threads: usize| -> Outcome<Vec<u64>> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()?;
        let elements: ElementStiffness<3> =
            element_stiffness_by_cell(&space, |_, cell| rock(cell))?;
        let viscosity = elements.viscosity_by_cell(viscous)?;
        let mut body = sliding(&space, elements, viscosity)?;
        pool.install(|| (0..10).try_for_each(|_| body.step(2e-3).map(|_| ())))?;
        let at = body.snapshot();
        let fields = at
            .displacement
            .iter()
            .chain(at.velocity)
            .chain(at.acceleration);
        Ok(fields.flatten().map(|x| x.to_bits()).collect())
    };
    let alone = run(1)?;
    for threads in [2, 4] {
        assert!(run(threads)? == alone, "{threads} threads");
    }
    Ok(())
}

/// In the plane the unknowns are those of the matrix, too.
#[test]
fn a_point_moves_under_its_own_load() -> Outcome {
    let space = P1::grid([1.0, 1.0], [1, 1])?;
    let size = space.vertex_count();
    let scene = Scene::new(element_stiffness(&space, &rock(0))?)
        .with_mass(lumped_mass(&space, 4.0)?)
        .with_load(vec![Vector2::new(1.0, 0.0); size]);
    let mut body = Simulation::new(scene, CentralDifferences, Diagonal::new())?;
    body.run(&Steps::constant(0.01).count(10), |_| ())?;
    let at = body.snapshot();
    // The force of 4 N on 4 kg, whatever the share of each vertex: no strain moves the centre of mass.
    let mass = lumped_mass::<2, 2>(&space, 4.0)?;
    let momentum: f64 = (mass.data().iter().zip(at.velocity))
        .map(|(mass, v)| mass[(0, 0)] * v[0])
        .sum();
    assert!((momentum - 0.1 * size as f64).abs() < 1e-13);
    Ok(())
}
