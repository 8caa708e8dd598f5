//! Local steps: conservation, reversal of time, order, arrivals of ruptures, bits, and what is refused.

use nalgebra::{SVector, Vector2};
use stickslip::fem::{
    Elastic, ElementStiffness, Impedance, P1, dashpot, element_stiffness, lumped_mass,
};
use stickslip::friction::{LinearWeakening, Tresca};
use stickslip::state::{SlipWeakening, Weakening};
use stickslip::{
    CentralDifferences, Contact, Diagonal, ElementOperator, Scene, SceneError, Simulation,
    StepError, Steps,
};

use crate::Outcome;

const ROCK: Elastic = Elastic {
    young_modulus: 2.5,
    poisson_ratio: 0.25,
};

/// A body with edges from 1/8 to 1.
fn graded() -> Outcome<P1<2>> {
    Ok(P1::grid([8.0, 4.0], [8, 4])?.graded(|x| 0.125 + 0.3 * x.norm())?)
}

fn stiffness(space: &P1<2>, finest: &[usize], levels: usize) -> Outcome<ElementStiffness<2>> {
    let mass = lumped_mass(space, 1.0)?;
    Ok(element_stiffness(space, &ROCK)?.with_local_steps(space, &mass, finest, levels)?)
}

/// A free body of four levels.
fn free(
    space: &P1<2>,
    displacement: Vec<Vector2<f64>>,
    velocity: Vec<Vector2<f64>>,
) -> Outcome<Scene<ElementOperator<2>, 2>> {
    Ok(Scene::new(stiffness(space, &[], 4)?)
        .with_mass(lumped_mass(space, 1.0)?)
        .with_displacement(displacement)
        .with_velocity(velocity))
}

fn simulation(scene: Scene<ElementOperator<2>, 2>) -> Outcome<Simulation<2>> {
    Ok(Simulation::new(scene, CentralDifferences, Diagonal::new())?)
}

/// The largest stable step of a scene \[s\].
fn limit(body: &mut Simulation<2>) -> Outcome<f64> {
    let refused = body.step(f64::MAX).err().map(|failure| failure.cause);
    assert!(
        matches!(refused, Some(StepError::Unstable { .. })),
        "{refused:?}"
    );
    Ok(body.step_limit().ok_or("no limit")?)
}

/// Velocities of all frequencies.
fn rough(space: &P1<2>) -> Vec<Vector2<f64>> {
    let number = |i: usize| (1.3 * i as f64).sin();
    (0..space.vertex_count())
        .map(|i| Vector2::new(number(7 * i), number(7 * i + 3)))
        .collect()
}

fn apart<const D: usize>(a: &[SVector<f64, D>], b: &[SVector<f64, D>]) -> f64 {
    let pairs = a.iter().zip(b).map(|(a, b)| (a - b).amax());
    pairs.fold(0.0, f64::max)
}

/// The energy of a body whose fastest waves fill it does not grow in 1e4 steps close to the limit, and its momentum is constant.
#[test]
fn energy_is_bounded_and_momentum_constant() -> Outcome {
    let space = graded()?;
    let (mass, whole) = (
        lumped_mass::<2, 2>(&space, 1.0)?,
        element_stiffness(&space, &ROCK)?,
    );
    let rest = vec![Vector2::zeros(); space.vertex_count()];
    let mut body = simulation(free(&space, rest, rough(&space))?)?;
    let dt = 0.95 * limit(&mut body)?;
    let read = |body: &Simulation<2>| {
        let at = body.snapshot();
        let mut force = vec![Vector2::zeros(); space.vertex_count()];
        whole.multiply_add(1.0, at.displacement, &mut force);
        let (mut energy, mut momentum) = (0.0, Vector2::zeros());
        for (i, v) in at.velocity.iter().enumerate() {
            let mass = mass.data()[i][(0, 0)];
            energy += 0.5 * (mass * v.norm_squared() + at.displacement[i].dot(&force[i]));
            momentum += v * mass;
        }
        (energy, momentum)
    };
    let (energy, momentum) = read(&body);
    let mut largest = [0.0_f64; 2];
    for round in 0..1250 {
        body.run(&Steps::constant(dt).count(8), |_| ())?;
        let (now, carried) = read(&body);
        let half = &mut largest[round / 625];
        *half = half.max(now / energy);
        assert!((carried - momentum).norm() < 1e-10 * mass.data().len() as f64);
    }
    assert!(
        largest[1] < 1.05 * largest[0] && largest[0] < 2.0,
        "{largest:?}"
    );
    Ok(())
}

#[test]
fn reversed_velocities_lead_back() -> Outcome {
    let space = graded()?;
    let pulled = space.interpolate(|x| Vector2::new((0.7 * x[0]).sin(), 0.2 * x[1]));
    let mut body = simulation(free(&space, pulled.clone(), rough(&space))?)?;
    let dt = 0.9 * limit(&mut body)?;
    body.run(&Steps::constant(dt).count(800), |_| ())?;
    let end = body.snapshot();
    let velocity = end.velocity.iter().map(|v| -v).collect();
    let mut back = simulation(free(&space, end.displacement.to_vec(), velocity)?)?;
    back.run(&Steps::constant(dt).count(800), |_| ())?;
    let error = apart(back.snapshot().displacement, &pulled);
    assert!(error < 1e-10, "{error:e}");
    Ok(())
}

/// The orders of errors of a pulse inside a graded body, against many steps without levels; with Kelvin-Voigt viscosity of a
/// relaxation time \[s\].
fn orders(relaxation: f64) -> Outcome<[f64; 2]> {
    let space = graded()?;
    let pulse = space.interpolate(|x| {
        let squared = (x[0] - 3.0).powi(2) + (x[1] - 2.0).powi(2);
        Vector2::new((-squared).exp(), 0.5 * (-2.0 * squared).exp())
    });
    let scene = |levels: usize| -> Outcome<_> {
        let stiffness = stiffness(&space, &[], levels)?;
        let viscosity = &stiffness * relaxation;
        let scene = Scene::new(stiffness)
            .with_mass(lumped_mass(&space, 1.0)?)
            .with_displacement(pulse.clone());
        Ok(if relaxation > 0.0 {
            scene.with_viscosity(viscosity)
        } else {
            scene
        })
    };
    let end = 160.0 * limit(&mut simulation(scene(4)?)?)?;
    let run = |levels: usize, steps: usize| -> Outcome<Vec<Vector2<f64>>> {
        let mut body = simulation(scene(levels)?)?;
        body.run(&Steps::constant(end / steps as f64).count(steps), |_| ())?;
        Ok(body.snapshot().displacement.to_vec())
    };
    let exact = run(1, 16384)?;
    let error = |steps| -> Outcome<f64> {
        let found = run(4, steps)?;
        let squares = found
            .iter()
            .zip(&exact)
            .map(|(a, b)| (a - b).norm_squared());
        Ok(squares.sum::<f64>().sqrt())
    };
    let errors = [error(512)?, error(1024)?, error(2048)?];
    Ok([errors[0] / errors[1], errors[1] / errors[2]].map(f64::log2))
}

#[test]
fn the_order_is_two() -> Outcome {
    let orders = orders(0.0)?;
    assert!(
        orders.iter().all(|order| (1.9..2.2).contains(order)),
        "{orders:?}"
    );
    Ok(())
}

/// Viscous forces lag by half of a cell's own step: of first order, as in equal steps.
#[test]
fn the_order_of_viscous_bodies_is_one() -> Outcome {
    let orders = orders(0.02)?;
    assert!(
        orders.iter().all(|order| (0.9..1.4).contains(order)),
        "{orders:?}"
    );
    Ok(())
}

/// A body with edges of 1/8 at its base, which grow with the distance from it up to 1.
fn above_a_fault(growth: f64) -> Outcome<P1<2>> {
    Ok(P1::grid([16.0, 16.0], [16, 16])?.graded(|x| 0.125 + growth * x[1])?)
}

/// A fault that weakens with slip, overstressed at one end; with dashpots, and Kelvin-Voigt viscosity of a relaxation time \[s\].
fn rupture(space: &P1<2>, levels: usize, relaxation: f64) -> Outcome<Scene<ElementOperator<2>, 2>> {
    let base = space.trace(|x| x[1] == 0.0)?;
    let sides = space.trace(|x| x[0] == 16.0 || x[1] == 16.0)?;
    let stiffness = stiffness(space, base.vertices(), levels)?;
    let (viscosity, impedance) = (&stiffness * relaxation, Impedance::of(&ROCK, 1.0)?);
    let law = LinearWeakening {
        static_friction: 0.6,
        dynamic_friction: 0.4,
    };
    let shear = base.map(|x| Vector2::new(if x[0] < 2.0 { 0.61 } else { 0.52 }, 0.0));
    let contact = Contact::new(&base, law, 1.0)
        .with_state(SlipWeakening { slip_distance: 0.2 }, Weakening(0.0))
        .with_shear_stress(shear);
    let scene = Scene::new(stiffness)
        .with_mass(lumped_mass(space, 1.0)?)
        .with_viscosity(dashpot(space, &sides, |_| impedance)?)
        .with_contact(contact);
    Ok(if relaxation > 0.0 {
        scene.with_viscosity(viscosity)
    } else {
        scene
    })
}

/// The times at which vertices of the base begin to slip faster than a rate, in steps of `dt` \[s\], and the last displacement.
fn arrivals(
    space: &P1<2>,
    levels: usize,
    relaxation: f64,
    dt: f64,
) -> Outcome<(Vec<f64>, Vec<Vector2<f64>>)> {
    let base = space.trace(|x| x[1] == 0.0)?;
    let mut body = simulation(rupture(space, levels, relaxation)?)?;
    let mut times = vec![f64::INFINITY; base.vertices().len()];
    let mut before = vec![0.0; times.len()];
    body.run(&Steps::constant(dt).count((10.0 / dt) as usize), |at| {
        for (k, &vertex) in base.vertices().iter().enumerate() {
            let (rate, old) = (at.velocity[vertex][0], before[k]);
            if rate > 0.01 && times[k].is_infinite() {
                times[k] = at.time - dt * (rate - 0.01) / (rate - old);
            }
            before[k] = rate;
        }
    })?;
    Ok((times, body.snapshot().displacement.to_vec()))
}

/// Local steps change no arrival of a rupture by more than a tenth of a step, with viscosity and without, whether edges grow
/// slowly or fast.
#[test]
fn arrivals_are_those_of_equal_steps() -> Outcome {
    let mut found = Vec::new();
    for (growth, relaxation) in [(0.1, 0.0), (0.1, 0.01), (0.2, 0.0), (0.2, 0.01)] {
        let space = above_a_fault(growth)?;
        let dt = 0.9 * limit(&mut simulation(rupture(&space, 4, relaxation)?)?)?;
        let (own, local) = arrivals(&space, 4, relaxation, dt)?;
        let (whole, equal) = arrivals(&space, 1, relaxation, dt)?;
        let ruptured = own.iter().zip(&whole).filter(|(_, b)| b.is_finite());
        let changes: Vec<f64> = ruptured.map(|(a, b)| (a - b).abs() / dt).collect();
        assert!(changes.len() > 60, "{}", changes.len());
        found.push(changes.into_iter().fold(0.0, f64::max));
        let largest = equal.iter().map(|u| u.amax()).fold(0.0, f64::max);
        assert!(apart(&local, &equal) < 0.01 * largest);
    }
    assert!(found.iter().all(|steps| *steps < 0.1), "{found:?}");
    Ok(())
}

/// What is left of the equations, with the forces that act in a step.
#[test]
fn residuals_are_rounding() -> Outcome {
    let space = above_a_fault(0.1)?;
    let mut body = simulation(rupture(&space, 4, 0.01)?)?;
    let dt = 0.9 * limit(&mut body)?;
    for _ in 0..16 {
        body.run(&Steps::constant(dt).count(2), |_| ())?;
        let kept = body.state().clone();
        body.step(dt)?;
        let residuals = body.residuals(&kept);
        assert!(
            residuals.force < 1e-9 * residuals.force_terms,
            "{residuals:?}"
        );
    }
    Ok(())
}

/// The bits are those of one thread, and those of a run that goes on amid a cycle from a checkpoint.
#[test]
fn bits_are_the_same() -> Outcome {
    let space = above_a_fault(0.1)?;
    let dt = 0.9 * limit(&mut simulation(rupture(&space, 4, 0.01)?)?)?;
    let run = |threads: usize| -> Outcome<Vec<Vector2<f64>>> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()?;
        let mut body = simulation(rupture(&space, 4, 0.01)?)?;
        pool.install(|| body.run(&Steps::constant(dt).count(45), |_| ()).map(|_| ()))?;
        Ok(body.snapshot().displacement.to_vec())
    };
    let one = run(1)?;
    assert!(one.iter().any(|u| u.norm() > 0.0));
    assert_eq!(run(2)?, one);
    assert_eq!(run(4)?, one);
    let mut body = simulation(rupture(&space, 4, 0.01)?)?;
    body.run(&Steps::constant(dt).count(13), |_| ())?;
    let kept = body.state().clone();
    let mut other = simulation(rupture(&space, 4, 0.01)?)?;
    other.restore(&kept)?;
    other.run(&Steps::constant(dt).count(32), |_| ())?;
    assert_eq!(other.snapshot().displacement, one);
    Ok(())
}

#[test]
fn what_breaks_a_cycle_is_refused() -> Outcome {
    let space = above_a_fault(0.1)?;
    let mut body = simulation(rupture(&space, 4, 0.01)?)?;
    let dt = 0.5 * limit(&mut body)?;
    body.run(&Steps::constant(dt).count(3), |_| ())?;
    let refused = body.step(0.5 * dt).err().map(|failure| failure.cause);
    let expected = StepError::AmidCycle {
        dt: 0.5 * dt,
        before: dt,
        taken: 3,
        cycle: 8,
    };
    assert_eq!(refused, Some(expected));
    body.run(&Steps::constant(dt).count(5), |_| ())?;
    body.step(0.5 * dt)?;
    let base = space.trace(|x| x[1] == 0.0)?;
    let contact = || Contact::new(&base, Tresca { coefficient: 0.6 }, 1.0);
    let scene = |finest: &[usize]| -> Outcome<_> {
        Ok(Scene::new(stiffness(&space, finest, 4)?).with_mass(lumped_mass(&space, 1.0)?))
    };
    let top = space.trace(|x| x[1] == 16.0)?;
    let slow = Contact::new(&top, Tresca { coefficient: 0.6 }, 1.0);
    let refused = Simulation::new(
        scene(&[])?.with_contact(slow),
        CentralDifferences,
        Diagonal::new(),
    );
    assert!(matches!(
        refused.err(),
        Some(SceneError::LocalSteps {
            contact: 0,
            level: 3,
            ..
        })
    ));
    let given = scene(base.vertices())?
        .with_contact(contact())
        .with_acceleration(vec![Vector2::zeros(); space.vertex_count()]);
    let refused = Simulation::new(given, CentralDifferences, Diagonal::new()).err();
    assert!(
        matches!(refused, Some(SceneError::Unsupported { .. })),
        "{refused:?}"
    );
    Ok(())
}
