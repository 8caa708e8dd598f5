//! Accelerations agree with the forces: from the start, behind stops, at rest.

use nalgebra::{SMatrix, SVector, Vector1, Vector2};
use stickslip::fem::{Elastic, P1, antiplane, elasticity, mass};
use stickslip::friction::Tresca;
use stickslip::problems::pipping_slider::{AGING, FRICTION};
use stickslip::state::LogTheta;
use stickslip::time::Motion;
use stickslip::{
    BackwardEuler, BlockMatrix, BoundaryPart, Components, Condensed, Contact, GeneralizedAlpha,
    Newmark, Point, RateScheme, Scene, Simulation, Steps,
};

use crate::Outcome;

/// A vertex whose first component is moved and whose second one follows, by inertia and by elasticity:
/// `m22 y'' + k22 y = - m12 x'' - k12 x`, with `x'` growing linearly up to a kink.
struct Follower {
    mass: [f64; 2],
    stiffness: [f64; 2],
    speed: f64,
    kink: f64,
}

const FOLLOWER: Follower = Follower {
    mass: [0.5, 2.0],
    stiffness: [3.0, 50.0],
    speed: 0.7,
    kink: 1.0,
};
const END: f64 = 2.0;

impl Follower {
    fn scene(&self) -> Scene<SMatrix<f64, 2, 2>, 2> {
        let symmetric =
            |[beside, own]: [f64; 2]| SMatrix::<f64, 2, 2>::new(own, beside, beside, own);
        let (speed, kink) = (self.speed, self.kink);
        Scene::new(symmetric(self.stiffness))
            .with_mass(symmetric(self.mass))
            .prescribe_velocity(BoundaryPart::point(1.0), Components::X, move |time| {
                [speed * (time / kink).min(1.0), 0.0]
            })
    }

    /// `y` at the end, by undetermined coefficients on both sides of the kink.
    fn exact(&self) -> f64 {
        let ([m12, m22], [k12, k22]) = (self.mass, self.stiffness);
        let (speed, kink) = (self.speed, self.kink);
        let frequency = (k22 / m22).sqrt();
        let square = -k12 * speed / (2.0 * kink * k22);
        let constant = (-m12 * speed / kink - 2.0 * square * m22) / k22;
        let angle = frequency * kink;
        let y = square * kink * kink + constant * (1.0 - angle.cos());
        let rate = 2.0 * square * kink + constant * frequency * angle.sin();
        let (slope, offset) = (-k12 * speed / k22, -k12 * speed * kink / (2.0 * k22));
        let since = END - self.kink;
        let angle = frequency * since;
        slope * since
            + offset
            + (y - offset) * angle.cos()
            + (rate - slope) / frequency * angle.sin()
    }
}

/// The error of `y` at the end.
fn error(scheme: impl RateScheme + 'static, steps: usize) -> Outcome<f64> {
    let mut follower = Simulation::new(FOLLOWER.scene(), scheme, Point)?;
    follower.run(&Steps::constant(END / steps as f64).count(steps), |_| ())?;
    Ok((follower.snapshot().displacement[0][1] - FOLLOWER.exact()).abs())
}

/// Before the first step `M a = l - A u` holds, with the acceleration that the motion prescribes.
#[test]
fn the_start_is_in_balance() -> Outcome {
    let follower = Simulation::new(FOLLOWER.scene(), Newmark::default(), Point)?;
    let a = follower.snapshot().acceleration[0];
    let moved = FOLLOWER.speed / FOLLOWER.kink;
    let [beside, own] = FOLLOWER.mass;
    let expected = Vector2::new(moved, -beside / own * moved);
    assert!((a - expected).norm() < 1e-9, "{a}");
    let recurrent = FOLLOWER.scene().with_zero_acceleration();
    let recurrent = Simulation::new(recurrent, Newmark::default(), Point)?;
    assert_eq!(recurrent.snapshot().acceleration[0], Vector2::zeros());
    Ok(())
}

#[test]
fn a_kink_between_steps_costs_no_order() -> Outcome {
    let damped = GeneralizedAlpha {
        spectral_radius: 0.8,
    };
    let errors = [100, 200, 400, 800]
        .map(|steps| Ok([error(Newmark::default(), steps)?, error(damped, steps)?]));
    let errors = errors.into_iter().collect::<Outcome<Vec<[f64; 2]>>>()?;
    for pair in errors.windows(2) {
        for scheme in 0..2 {
            let ratio = pair[0][scheme] / pair[1][scheme];
            assert!((3.5..4.5).contains(&ratio), "{errors:?}");
        }
    }
    Ok(())
}

/// A jump of the prescribed velocity at a stop leaves no acceleration, and waves in the body alone. Inside a step it rings
/// on by `2 V/dt`, as Newmark's scheme does.
#[test]
fn accelerations_of_what_is_moved_do_not_ring_behind_a_stop() -> Outcome {
    for jump in [0.05, 0.051, 0.055, 0.059] {
        check_jump(jump)?;
    }
    Ok(())
}

/// With a velocity that jumps from 0 to 1 m/s.
fn check_jump(jump: f64) -> Outcome {
    let space = P1::grid([1.0, 1.0], [4, 4])?;
    let (top, bottom) = (space.trace(|x| x[1] == 1.0)?, space.trace(|x| x[1] == 0.0)?);
    let vertex = top.vertices()[2];
    let body = || -> Outcome<_> {
        let scene = Scene::new(antiplane(&space, 1.0)?)
            .with_mass(mass(&space, 1.0)?)
            .fix(&bottom, Components::ALL)
            .prescribe_velocity(&top, Components::ALL, move |time| {
                [if time > jump { 1.0 } else { 0.0 }]
            });
        Ok(Simulation::new(
            scene,
            Newmark::default(),
            Condensed::new(),
        )?)
    };
    let plan = Steps::constant(0.01).until(0.4);
    let mut reactions = Vec::new();
    let mut outcome = Ok(());
    let mut stopping = body()?;
    stopping.run(&plan.clone().stopping_at([jump]), |at| {
        let moved = (at.time - jump).max(0.0);
        assert!((at.displacement[vertex][0] - moved).abs() < 1e-14);
        // The difference of equal velocities is zero, and so is what is left of it by the formula.
        let a = at.acceleration[vertex][0];
        assert!(a.abs() < 1e-12, "{}: {a}", at.time);
        if moved > 0.0 {
            match at.reaction(&top) {
                Ok(reaction) => reactions.push(reaction[0]),
                Err(error) => outcome = Err(error),
            }
        }
    })?;
    outcome?;
    let mut ringing = body()?;
    ringing.run(&plan, |at| {
        if at.time > jump + 0.01 {
            assert!((at.acceleration[vertex][0].abs() - 200.0).abs() < 1e-6);
        }
    })?;
    // The reaction follows the waves in the body: no part of it changes its sign with every step.
    let second = |k: usize| reactions[k + 1] - 2.0 * reactions[k] + reactions[k - 1];
    let largest = reactions.iter().fold(0.0, |most: f64, r| most.max(r.abs()));
    for k in 3..reactions.len() - 1 {
        // Of the highest frequency of the mesh, `sqrt(12 * 2) / h`, a step sees a fifth of a period.
        let alternating = second(k).signum() * second(k - 1).signum() < 0.0;
        assert!(
            !alternating || second(k).abs() < 0.5 * largest,
            "{reactions:?}"
        );
    }
    Ok(())
}

/// A block that slides out under Coulomb's friction stops. Under Newmark's scheme the acceleration with which it stops
/// changes its sign in every step from then on. What generalised-alpha with the radius `r` leaves of it is multiplied by
/// `(1 - 3 r)/(3 - r)` and `-r` in every step. In all of them the block stays where it is, and forces balance.
#[test]
fn the_acceleration_of_an_arrest_goes_with_the_damping_of_the_scheme() -> Outcome {
    slides_out(Newmark::default(), 1.0)?;
    for spectral_radius in [0.0, 0.5, 0.8, 0.9] {
        slides_out(GeneralizedAlpha { spectral_radius }, spectral_radius)?;
    }
    Ok(())
}

fn slides_out(scheme: impl RateScheme + 'static, radius: f64) -> Outcome {
    let (stiffness, weight, coefficient) = (2.0, 1.0, 0.5);
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_mass(SMatrix::<f64, 1, 1>::new(1.0))
        .with_contact(Contact::new(
            BoundaryPart::point(1.0),
            Tresca { coefficient },
            weight,
        ))
        .with_displacement(vec![Vector1::new(0.6)]);
    let mut block = Simulation::new(scene, scheme, Point)?;
    // At rest and pulled by more than the strength: it starts with what is left.
    let pull = stiffness * 0.6 - coefficient * weight;
    assert!((block.snapshot().acceleration[0][0] + pull).abs() < 1e-12);
    let (mut stopped, mut rests) = (Vec::new(), 0.0);
    block.run(&Steps::constant(0.01).count(400), |at| {
        if at.velocity[0][0] == 0.0 {
            let (u, a) = (at.displacement[0][0], at.acceleration[0][0]);
            let held = at.contact(0).traction(0)[0];
            assert!((held + stiffness * u + a).abs() < 1e-12);
            stopped.push(a);
            rests = u;
        }
    })?;
    // Half a period about the displaced rest position 0.25, to -0.1, where the spring is weaker than friction.
    assert!(stopped.len() > 100);
    // The scheme's phase and the step in which it stops, to second order and to first order of a small velocity.
    assert!((rests + 0.1).abs() < 1e-4);
    let first = stopped[0].abs().max(stopped[1].abs());
    let factors = [(1.0 - 3.0 * radius) / (3.0 - radius), -radius];
    for of in stopped[1..].windows(3) {
        let next = (factors[0] + factors[1]) * of[1] - factors[0] * factors[1] * of[0];
        assert!(
            (of[2] - next).abs() < 1e-12 * first.max(1.0),
            "{radius}: {of:?}"
        );
    }
    Ok(())
}

/// A soft body that slides out along its first axis, from 0.1 m/s.
fn pushed<const D: usize>(space: &P1<D>) -> Outcome<Scene<BlockMatrix<D>, D>> {
    let elastic = Elastic {
        young_modulus: 1e6,
        poisson_ratio: 0.3,
    };
    let push = SVector::from_fn(|c, _| if c == 0 { 0.1 } else { 0.0 });
    Ok(Scene::new(elasticity(space, &elastic)?)
        .with_mass(mass(space, 1e3)?)
        .with_velocity(vec![push; space.vertex_count()]))
}

/// A body that friction has arrested creeps: each step follows from the last one by its update formula, which damps the
/// acceleration that the arrest has left.
#[test]
fn what_creeps_is_left_to_a_scheme_that_damps_it() -> Outcome {
    for spectral_radius in [0.0, 0.5] {
        damps_by_its_rule(GeneralizedAlpha { spectral_radius })?;
    }
    Ok(())
}

fn damps_by_its_rule(scheme: GeneralizedAlpha) -> Outcome {
    let space = P1::grid([1.0, 1.0], [4, 4])?;
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let contact = Contact::new(&bottom, FRICTION, 1e3).with_state(AGING, LogTheta(0.0));
    let (dt, scene) = (0.01, pushed(&space)?.with_contact(contact));
    let mut body = Simulation::new(scene, scheme, Condensed::new())?;
    let formula = scheme.update_formula(dt);
    let mut creeping = 0;
    for step in 0..200 {
        let from = body.state().clone();
        body.step(dt)?;
        let at = body.snapshot();
        for (k, &i) in bottom.vertices().iter().enumerate() {
            let old = Motion {
                displacement: from.displacement[i][0],
                velocity: from.velocity[i][0],
                acceleration: from.acceleration[i][0],
                algorithmic: from.algorithmic[i][0],
            };
            let (a, expected) = (
                at.acceleration[i][0],
                formula.motion(old, at.velocity[i][0]),
            );
            let size = old.acceleration.abs() + a.abs() + dt * old.algorithmic.abs();
            assert!(
                (a - expected.acceleration).abs() <= 1e-12 * size,
                "{k}: {a:e}"
            );
            if at.contact(0).slip_rate(k) < 1e-5 {
                creeping += 1;
                // An arrest within a step leaves some ten.
                assert!(step < 199 || a.abs() < 1e-3, "{k}: {a:e}");
            }
        }
    }
    assert!(creeping > 100, "{creeping}");
    Ok(())
}

/// Newmark's scheme is its own inverse: with the velocity turned round a body goes back the way it came, in the
/// plane and in space.
fn returns<const D: usize>(space: &P1<D>) -> Outcome {
    let elastic = Elastic {
        young_modulus: 1.0,
        poisson_ratio: 0.3,
    };
    let bottom = space.trace(|x| x[D - 1] == 0.0)?;
    let bent = space.interpolate(|x| SVector::<f64, D>::from_fn(|c, _| x[D - 1] * (1.0 + x[c])));
    let scene = Scene::new(elasticity(space, &elastic)?)
        .with_mass(mass(space, 1.0)?)
        .fix(&bottom, [true; D])
        .with_displacement(bent.clone());
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let steps = Steps::constant(0.05).count(200);
    body.run(&steps, |_| ())?;
    let mut turned = body.state().clone();
    for velocity in &mut turned.velocity {
        *velocity *= -1.0;
    }
    body.restore(&turned)?;
    body.run(&steps, |_| ())?;
    for (now, before) in body.snapshot().displacement.iter().zip(&bent) {
        // 400 steps, each with some roundings of waves of this size.
        assert!((now - before).norm() < 1e-12, "{now} {before}");
    }
    Ok(())
}

#[test]
fn a_body_goes_back_the_way_it_came() -> Outcome {
    returns(&P1::grid([1.0, 1.0], [4, 4])?)?;
    returns(&P1::grid([1.0, 1.0, 1.0], [2, 2, 2])?)
}

/// A step that fails, or is refused, leaves the accelerations of the last one.
#[test]
fn a_step_that_fails_leaves_accelerations() -> Outcome {
    for scheme in [
        Box::new(Newmark::default()) as Box<dyn RateScheme>,
        Box::new(BackwardEuler),
    ] {
        let mut simulation = Simulation::new(FOLLOWER.scene(), scheme, Point)?;
        for _ in 0..3 {
            simulation.step(0.1)?;
            let before = simulation.state().clone();
            assert!(simulation.step(f64::NAN).is_err());
            assert_eq!(*simulation.state(), before);
        }
    }
    Ok(())
}
