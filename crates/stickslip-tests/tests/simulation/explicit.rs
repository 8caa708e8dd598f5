//! Central differences with a lumped mass: the step limit, the order, and what is refused; and the
//! energy that Kelvin-Voigt viscosity takes.

use crate::common::onsets::Onsets;
use nalgebra::{DMatrix, Vector2};
use stickslip::fem::{Assembled, P1, elasticity, lumped_mass, mass};
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::problems::spring_slider::{LoadPath, SpringSlider};
use stickslip::state::LogTheta;
use stickslip::time::check_rate_scheme;
use stickslip::{
    BlockMatrix, CentralDifferences, Components, Contact, Coupling, Diagonal, Matrix, Monolithic,
    Newmark, Operator, Point, RateScheme, Scene, Sdirk2, Simulation, Staggered, StateUpdate,
    StepError, StepFailure, Steps, Tnnmg,
};

use crate::Outcome;
use crate::common::{Sliding, body};

/// The slider with a lumped mass.
fn lumped(refinements: usize, space: &P1<2>) -> Outcome<Scene<BlockMatrix<2>, 2>> {
    let body = PippingSlider {
        lumped: true,
        ..body(refinements)
    };
    let contact = Contact::new(&PippingSlider::bottom(space)?, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    Ok(body.scene(space)?.with_contact(contact))
}

/// The same in explicit steps.
fn explicit(refinements: usize) -> Outcome<Sliding> {
    let scene = lumped(refinements, &body(refinements).space()?)?;
    Ok(Simulation::new(scene, CentralDifferences, Diagonal::new())?
        .with_coupling(Staggered::default())
        .with_state_update(StateUpdate::Midpoint))
}

#[test]
fn the_schemes_keep_their_contract() -> Outcome {
    check_rate_scheme(&CentralDifferences)?;
    check_rate_scheme(&Sdirk2)?;
    Ok(())
}

/// `2/omega_max` by a dense eigenvalue problem on the free components.
#[test]
fn the_step_limit_is_that_of_the_highest_frequency() -> Outcome {
    let body = body(1);
    let space = body.space()?;
    let stiffness = elasticity(&space, &body.elastic)?;
    let lumped: Assembled<2> = lumped_mass(&space, body.density)?;
    let top = space.trace(|x| x[1] == 1.0)?;
    let bottom = PippingSlider::bottom(&space)?;
    let free: Vec<(usize, usize)> = (0..space.vertex_count())
        .filter(|i| !top.vertices().contains(i))
        .flat_map(|i| [(i, 0), (i, 1)])
        .filter(|&(i, c)| c == 0 || !bottom.vertices().contains(&i))
        .collect();
    let matrix = DMatrix::from_fn(free.len(), free.len(), |r, c| {
        let ((i, a), (j, b)) = (free[r], free[c]);
        let weight = |i: usize| lumped.get(i, i).map_or(f64::NAN, |block| block[(0, 0)]);
        stiffness.get(i, j).map_or(0.0, |block| block[(a, b)]) / (weight(i) * weight(j)).sqrt()
    });
    let limit = 2.0 / matrix.symmetric_eigenvalues().max().sqrt();
    let mut slider = explicit(1)?;
    let Err(StepFailure { cause, .. }) = slider.step(1.000_001 * limit) else {
        return Err("a step beyond the limit was taken".into());
    };
    let StepError::Unstable { limit: found, .. } = cause else {
        return Err(cause.into());
    };
    assert!((found / limit - 1.0).abs() < 1e-8, "{found:e}, {limit:e}");
    slider.step(0.999_999 * limit)?;
    // At the limit of stability nothing grows in a thousand steps.
    slider.run(&Steps::constant(0.999_999 * limit).count(1000), |_| ())?;
    assert!(slider.snapshot().velocity.iter().all(|v| v.amax() < 1e-3));
    Ok(())
}

/// A block with inertia after a velocity step, by a scheme, with so many steps to 3 s: `ln V` at the
/// end.
fn after_a_velocity_step(
    scheme: impl RateScheme + 'static,
    coupling: impl Coupling + 'static,
    steps: usize,
) -> Outcome<f64> {
    let slider = SpringSlider {
        stiffness: 1e9,
        normal_stress: 1e6,
        mass: 1e3,
        damping: 0.0,
        load: LoadPath::steady(1e-5),
    };
    let scene = slider.steady(FRICTION, AGING, 1e-6)?;
    let mut block = Simulation::new(scene, scheme, Point)?.with_coupling(coupling);
    block.run(&Steps::constant(3.0 / steps as f64).count(steps), |_| ())?;
    Ok(block.snapshot().velocity[0][0].ln())
}

/// One pass a step, with extrapolated rates, towards what an implicit scheme finds.
#[test]
fn one_staggered_pass_is_of_second_order() -> Outcome {
    let explicit = |steps| after_a_velocity_step(CentralDifferences, Staggered::default(), steps);
    let (coarse, middle, fine) = (explicit(4000)?, explicit(8000)?, explicit(16_000)?);
    let ratio = (coarse - middle) / (middle - fine);
    assert!((3.6..4.4).contains(&ratio), "{ratio}");
    let implicit = after_a_velocity_step(Newmark::default(), Monolithic::default(), 16_000)?;
    let limit = fine + (fine - middle) / 3.0;
    let left = (fine - middle).abs();
    assert!(
        (implicit - limit).abs() < 0.2 * left,
        "{implicit}, {limit}, {left:e}"
    );
    Ok(())
}

/// The slider slips when it does with an implicit scheme and the same mass, to what waves leave open.
#[test]
fn the_slider_slips_as_with_an_implicit_scheme() -> Outcome {
    let space = body(2).space()?;
    let centre = PippingSlider::centre(&space).ok_or("no vertex at x0")?;
    let slip = |slider: &mut Sliding| -> Outcome<f64> {
        let mut events = Onsets::new(1e-4, 1e-4);
        slider.run(&Steps::constant(END / 12e3).count(8100), |at| {
            events.record(at.time, at.velocity[centre][0]);
        })?;
        Ok(*events.times().first().ok_or("no slip")?)
    };
    let solver = Tnnmg::new(space.transfers());
    let mut implicit = Simulation::new(lumped(2, &space)?, Newmark::default(), solver)?;
    let (one, other) = (slip(&mut explicit(2)?)?, slip(&mut implicit)?);
    assert!((one - other).abs() < 5e-5, "{one}, {other}");
    Ok(())
}

#[test]
fn a_mass_that_is_not_diagonal_is_refused() -> Outcome {
    let body = PippingSlider {
        lumped: false,
        ..body(1)
    };
    let space = body.space()?;
    let mut slider = Simulation::new(body.scene(&space)?, CentralDifferences, Diagonal::new())?;
    let Err(failure) = slider.step(1e-4) else {
        return Err("a step was taken".into());
    };
    assert!(failure.to_string().contains("not diagonal"), "{failure}");
    Ok(())
}

/// The energy that the body loses beyond the work of the load is the work of viscosity: with Newmark's
/// average acceleration, of two terms a step exactly `dt v.Cv` at both ends' mean velocity.
#[test]
fn viscosity_takes_the_energy_that_is_missing() -> Outcome {
    let body = PippingSlider {
        gravity: 0.0,
        ..body(2)
    };
    let space = body.space()?;
    let stiffness = elasticity(&space, &body.elastic)?;
    let mass = mass(&space, body.density)?;
    let viscosity = BlockMatrix::combination(&[(1e-3, &stiffness)]);
    let top = space.trace(|x| x[1] == 1.0)?;
    let start =
        space.interpolate(|x| Vector2::new(1e-3 * (1.0 - x[1]), 2e-4 * x[0] * x[1] * (1.0 - x[1])));
    let scene = Scene::new(stiffness.clone())
        .with_mass(mass.clone())
        .with_viscosity(viscosity.clone())
        .fix(&top, Components::ALL)
        .with_displacement(start);
    let solver = Tnnmg::new(space.transfers());
    let mut block =
        Simulation::new(scene, Newmark::default(), solver)?.with_absolute_tolerance(1e-13)?;
    let dt = 1e-3;
    let mut before: Option<(f64, Vec<Vector2<f64>>)> = None;
    let (mut first, mut taken) = (0.0, 0.0);
    for _ in 0..400 {
        block.step(dt)?;
        let at = block.snapshot();
        let energy = 0.5 * (mass.quadratic(at.velocity) + stiffness.quadratic(at.displacement));
        if let Some((old, velocity)) = &before {
            // The force of viscosity enters at both ends of the step, as all forces do.
            let (mut now, mut then) = (
                vec![Vector2::zeros(); velocity.len()],
                vec![Vector2::zeros(); velocity.len()],
            );
            viscosity.multiply_add(1.0, at.velocity, &mut now);
            viscosity.multiply_add(1.0, velocity, &mut then);
            let loss: f64 = (0..velocity.len())
                .map(|i| 0.25 * dt * (at.velocity[i] + velocity[i]).dot(&(now[i] + then[i])))
                .sum();
            assert!(
                (energy - old + loss).abs() < 1e-10 * first,
                "{energy:e} {old:e} {loss:e}"
            );
            taken += loss;
        } else {
            first = energy;
        }
        before = Some((energy, at.velocity.to_vec()));
    }
    assert!(taken > 0.1 * first, "{taken:e} of {first:e}");
    Ok(())
}
