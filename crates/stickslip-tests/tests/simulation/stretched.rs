//! Stretched cells and nearly incompressible bodies: the cycles that multigrid takes, and the motion that the
//! factorised body has.

use stickslip::fem::{Elastic, P1, Trace, elasticity, lumped_mass, mass};
use stickslip::problems::pipping_slider::{AGING, FRICTION, NORMAL_STRESS};
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, Condensed, Contact, Newmark, NonsmoothSolver, Scene, Simulation, Tnnmg,
};

use crate::Outcome;
use crate::common::distance;

const STEPS: usize = 10;
const DENSITY: f64 = 5e3;

/// Ten steps of a body that is moved at its top; the largest number of cycles that one takes, and the velocity.
fn march<const D: usize>(
    scene: Scene<BlockMatrix<D>, D>,
    solver: impl NonsmoothSolver<BlockMatrix<D>, D> + 'static,
) -> Outcome<(usize, Simulation<D>)> {
    let mut body = Simulation::new(scene, Newmark::default(), solver)?;
    let mut most = 0;
    for _ in 0..STEPS {
        most = most.max(body.step(1.5e-3)?.solver_iterations);
    }
    Ok((most, body))
}

/// Moves a body by multigrid, within `limit` cycles a step, and by condensation.
fn agree<const D: usize>(
    space: &P1<D>,
    [bottom, top]: [Trace<D>; 2],
    poisson_ratio: f64,
    limit: usize,
) -> Outcome {
    let elastic = Elastic {
        young_modulus: 5e7,
        poisson_ratio,
    };
    let scene = || -> Outcome<_> {
        let contact =
            Contact::new(&bottom, FRICTION, NORMAL_STRESS).with_state(AGING, LogTheta(-10.0));
        Ok(Scene::new(elasticity(space, &elastic)?)
            .with_mass(mass(space, DENSITY)?)
            .with_contact(contact)
            .prescribe_velocity(&top, [true; D], |time| {
                std::array::from_fn(|c| {
                    if c == 0 {
                        2e-3 * (time / 0.01).min(1.0)
                    } else {
                        0.0
                    }
                })
            }))
    };
    let (most, multigrid) = march(scene()?, Tnnmg::new(space.transfers()))?;
    assert!(most <= limit, "{most} cycles, {limit} allowed");
    let (_, condensed) = march(scene()?, Condensed::new())?;
    // A step's error in the norm of the coupling, which the mass bounds from below, times the steps.
    let lumped = lumped_mass::<D, D>(space, DENSITY)?;
    let lightest = lumped
        .data()
        .iter()
        .fold(f64::MAX, |m, block| m.min(block[(0, 0)]));
    // The consistent mass of simplices is at least 1/(D + 2) of the lumped one.
    let error = 1e-10 / (lightest / (D + 2) as f64).sqrt() * STEPS as f64;
    let (a, b) = (multigrid.snapshot(), condensed.snapshot());
    let apart = distance(a.velocity, b.velocity);
    assert!(apart <= 2.0 * error, "{apart:e} against {error:e}");
    Ok(())
}

fn plane(size: [f64; 2], poisson_ratio: f64, limit: usize) -> Outcome {
    let space = P1::grid(size, [5, 1])?.refined(3)?;
    let ends = [0.0, size[1]].map(|height| space.trace(move |x| x[1] == height));
    let [bottom, top] = ends;
    agree(&space, [bottom?, top?], poisson_ratio, limit)
}

fn block(size: [f64; 3], poisson_ratio: f64, limit: usize) -> Outcome {
    let space = P1::<3>::grid(size, [1; 3])?.refined(3)?;
    let ends = [0.0, size[2]].map(|height| space.trace(move |x| x[2] == height));
    let [bottom, top] = ends;
    agree(&space, [bottom?, top?], poisson_ratio, limit)
}

/// Squares take 15 cycles a step.
#[test]
fn stretched_cells_take_as_few_cycles_as_squares() -> Outcome {
    plane([5.0, 1.0], 0.3, 20)?;
    for ratio in [1e2, 1e4] {
        plane([5.0 / ratio, 1.0], 0.3, 20)?;
        plane([5.0, 1.0 / ratio], 0.3, 20)?;
    }
    Ok(())
}

/// Needles and plates, flat and upright.
#[test]
fn stretched_cells_in_space_take_few_cycles() -> Outcome {
    block([1.0; 3], 0.3, 20)?;
    for ratio in [1e2, 1e4] {
        let thin = 1.0 / ratio;
        block([thin, thin, 1.0], 0.3, 40)?;
        block([1.0, 1.0, thin], 0.3, 40)?;
        block([thin, 1.0, 1.0], 0.3, 150)?;
    }
    Ok(())
}

/// Linear elements lock: coarse meshes are stiffer than fine ones by `1/(1 - 2 nu)`, and conjugate gradients
/// need about the root of that, 70, times as many cycles. On bodies of this size a factor takes their place.
#[test]
fn nearly_incompressible_bodies_take_a_bounded_number_of_cycles() -> Outcome {
    plane([5.0, 1.0], 0.4999, 60)?;
    block([1.0; 3], 0.4999, 100)
}
