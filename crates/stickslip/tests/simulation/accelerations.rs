//! Accelerations agree with the forces: from the start, behind kinks of the boundary data, at rest.

use nalgebra::{SMatrix, SVector, Vector1, Vector2};
use stickslip::fem::{Elastic, P1, Trace, antiplane, elasticity, mass};
use stickslip::friction::{FrictionLaw, Tresca};
use stickslip::problems::{AGING, FRICTION};
use stickslip::state::{LogTheta, Reads, StateLaw};
use stickslip::time::Motion;
use stickslip::{
    BackwardEuler, BlockMatrix, Condensed, Contact, GeneralizedAlpha, Newmark, Part, Point,
    RateScheme, Scene, Simulation, Steps,
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
            .move_at(Part::point(1.0), [true, false], move |time| {
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

/// What `y` misses at the end.
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
    let recurrent = FOLLOWER.scene().with_recurrent_acceleration();
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

/// A jump of the prescribed velocity inside a step is seen for one step, forwards. A recurrence would ring on by
/// `2 V/dt`.
#[test]
fn accelerations_of_what_is_moved_do_not_ring() -> Outcome {
    for jump in [0.051, 0.055, 0.059] {
        check_jump(jump)?;
    }
    Ok(())
}

/// With a velocity that jumps from 0 to 1 m/s at a time in the sixth step.
fn check_jump(jump: f64) -> Outcome {
    let space = P1::grid([1.0, 1.0], [4, 4])?;
    let (top, bottom) = (space.trace(|x| x[1] == 1.0)?, space.trace(|x| x[1] == 0.0)?);
    let scene = |recurrent: bool| -> Outcome<_> {
        let scene = Scene::new(antiplane(&space, 1.0)?)
            .with_mass(mass(&space, 1.0)?)
            .hold(&bottom, [true])
            .move_at(&top, [true], move |time| {
                [if time > jump { 1.0 } else { 0.0 }]
            });
        let scene = if recurrent {
            scene.with_recurrent_acceleration()
        } else {
            scene
        };
        Ok(Simulation::new(
            scene,
            Newmark::default(),
            Condensed::new(),
        )?)
    };
    let (mut settled, mut ringing) = (scene(false)?, scene(true)?);
    let vertex = top.vertices()[2];
    let mut reactions = Vec::new();
    for n in 1..=40 {
        settled.step(0.01)?;
        ringing.step(0.01)?;
        let a = settled.snapshot().acceleration[vertex][0];
        if n == 6 {
            // The whole jump in one of its halves, or in the other.
            assert!([0.0, 200.0].contains(&a), "{jump}: {a}");
            assert!(settled.snapshot().reaction(&top)?[0] > 0.0, "{jump}");
        }
        if n > 6 {
            // The difference of equal velocities is zero, and so is what is left of it by the rule.
            assert!(a.abs() < 1e-12, "{n}: {a}");
            assert!(ringing.snapshot().acceleration[vertex][0].abs() > 100.0);
            reactions.push(settled.snapshot().reaction(&top)?[0]);
        }
    }
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

/// A block that slides out under Coulomb's friction stops and has no acceleration from then on; what holds it is
/// the spring's force.
#[test]
fn a_block_that_has_stopped_has_no_acceleration() -> Outcome {
    slides_out(Newmark::default())?;
    for spectral_radius in [0.0, 0.5, 0.9] {
        slides_out(GeneralizedAlpha { spectral_radius })?;
    }
    Ok(())
}

fn slides_out(scheme: impl RateScheme + 'static) -> Outcome {
    let (stiffness, weight, coefficient) = (2.0, 1.0, 0.5);
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_mass(SMatrix::<f64, 1, 1>::new(1.0))
        .with_contact(Contact::new(
            Part::point(1.0),
            Tresca { coefficient },
            weight,
        ))
        .with_displacement(vec![Vector1::new(0.6)]);
    let mut block = Simulation::new(scene, scheme, Point)?;
    // At rest and pulled by more than the strength: it starts with what is left.
    let pull = stiffness * 0.6 - coefficient * weight;
    assert!((block.snapshot().acceleration[0][0] + pull).abs() < 1e-12);
    let mut stopped = 0;
    block.run(&Steps::constant(0.01).count(400), |at| {
        if at.velocity[0][0] == 0.0 {
            assert_eq!(at.acceleration[0], Vector1::zeros());
            let held = at.contact(0).traction(0)[0];
            assert!((held + stiffness * at.displacement[0][0]).abs() < 1e-12);
            stopped += 1;
        }
    })?;
    // Half a period about the displaced rest position 0.25, to -0.1, where the spring is weaker than friction.
    assert!(stopped > 100);
    assert!(
        block
            .state()
            .carried
            .iter()
            .all(|carried| carried[0] == 0.0)
    );
    // The scheme's phase and the step in which it stops, to second order and to first order of a small velocity.
    assert!((block.snapshot().displacement[0][0] + 0.1).abs() < 1e-4);
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

/// Rate-dependent friction lets what it has stopped creep. At rates of at most `V` the mean acceleration of two steps is at
/// most `2 V/dt`. One that rings is told where both it and the one before are more than `4 V/dt`; else the later one is at
/// most `6 V/dt`. The velocity that a vertex has lost as it stopped, many orders of magnitude more, is not left in it.
fn creeps_without_ringing<L, S, const D: usize>(
    space: &P1<D>,
    contact: impl Fn(&Trace<D>) -> Contact<L, S, D>,
) -> Outcome
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    let (dt, creep) = (0.01, 1e-5);
    let bottom = space.trace(|x| x[D - 1] == 0.0)?;
    let scene = pushed(space)?.with_contact(contact(&bottom));
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let mut rates = vec![[f64::INFINITY; 3]; bottom.vertices().len()];
    let mut creeping = 0;
    body.run(&Steps::constant(dt).count(200), |at| {
        for (k, rates) in rates.iter_mut().enumerate() {
            rates.rotate_right(1);
            rates[0] = at.contact(0).slip_rate(k);
            let largest = rates.iter().copied().fold(0.0, f64::max);
            if largest < creep {
                let a = at.acceleration[bottom.vertices()[k]][0].abs();
                assert!(a <= 6.1 * largest / dt, "{k}: {a:e} at {rates:?}");
                creeping += 1;
            }
        }
    })?;
    assert!(creeping > 100, "{creeping}");
    Ok(())
}

#[test]
fn what_creeps_after_it_has_stopped_does_not_ring() -> Outcome {
    fn check<const D: usize>(space: &P1<D>) -> Outcome {
        creeps_without_ringing(space, |bottom| {
            Contact::new(bottom, FRICTION, 1e3).with_state(AGING, LogTheta(0.0))
        })?;
        creeps_without_ringing(space, |bottom| Contact::new(bottom, Ageless, 1e3))
    }
    check(&P1::grid([1.0, 1.0], [4, 4])?)?;
    check(&P1::grid([1.0, 1.0, 1.0], [2, 2, 2])?)
}

/// A scheme that damps what friction has stopped is left alone: each step follows from the last one by its rule.
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
    let rule = scheme.rule(dt);
    let mut creeping = 0;
    // The first one begins with what balances forces.
    body.step(dt)?;
    for _ in 1..200 {
        let from = body.state().clone();
        body.step(dt)?;
        let at = body.snapshot();
        for (k, &i) in bottom.vertices().iter().enumerate() {
            let old = Motion {
                displacement: from.displacement[i][0],
                velocity: from.velocity[i][0],
                acceleration: from.acceleration[i][0],
                carried: from.carried[i][0],
            };
            let (a, expected) = (at.acceleration[i][0], rule.motion(old, at.velocity[i][0]));
            let size = old.acceleration.abs() + a.abs() + dt * old.carried.abs();
            assert!(
                (a - expected.acceleration).abs() <= 1e-12 * size,
                "{k}: {a:e}"
            );
            creeping += usize::from(at.contact(0).slip_rate(k) < 1e-5);
        }
    }
    assert!(creeping > 100, "{creeping}");
    Ok(())
}

/// Friction of rate and state at an age that does not change.
struct Ageless;

impl FrictionLaw for Ageless {
    type State = ();

    fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
        FRICTION.coefficient(slip_rate, LogTheta(0.0))
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, (): ()) -> f64 {
        FRICTION.coefficient_rate_slope(slip_rate, LogTheta(0.0))
    }

    fn potential(&self, slip_rate: f64, (): ()) -> f64 {
        FRICTION.potential(slip_rate, LogTheta(0.0))
    }
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
        .hold(&bottom, [true; D])
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
