//! Adaptive steps in frames that move uniformly, and after the motion has come to rest.

use nalgebra::Vector1;
use stickslip::fem::{GridDiagonal, Mesh, P1, antiplane, mass};
use stickslip::friction::{RegularizedDieterichRuina, Tresca};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    Components, Condensed, Contact, GeneralizedAlpha, RateScheme, Scene, Sdirk2, Simulation, Steps,
};

use crate::Outcome;
use crate::random_block::Random;

const DENSITY: f64 = 2e3;
const HEIGHT: f64 = 0.5;
/// The shear strength of the contact \[Pa\].
const STRENGTH: f64 = 6e3;

/// An elastic block that slides on an elastic belt, in antiplane motion.
#[derive(Clone, Copy, Debug)]
struct Sliding {
    modulus: f64,
    /// The velocity of the block relative to the belt, and that of the belt [m/s].
    velocity: f64,
    belt: f64,
    damps: bool,
    /// Friction of rate and state, not of Coulomb.
    has_state: bool,
}

const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.012,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1.0,
    slip_distance: 1e-2,
};

impl Sliding {
    /// The time in which friction stops a rigid block \[s\].
    fn duration(&self) -> f64 {
        DENSITY * HEIGHT * self.velocity.abs() / STRENGTH
    }

    /// The velocity of the waves that friction excites over that of the block: `tau/(rho c V)`.
    fn waves(&self) -> f64 {
        STRENGTH / (DENSITY * self.modulus).sqrt() / self.velocity.abs()
    }

    fn block(&self) -> Outcome<Simulation<1>> {
        let mesh = Mesh::<2>::grid([1.0, 2.0 * HEIGHT], [2, 4], GridDiagonal::Rising)?
            .with_surface_where("fault", |x| x[1] == HEIGHT)?
            .split("fault")?;
        let heights: Vec<f64> = mesh.vertices().iter().map(|x| x[1]).collect();
        let space = P1::new(mesh);
        let (plus, minus) = (space.part("fault+")?, space.part("fault-")?);
        let Self { belt, velocity, .. } = *self;
        let start = heights.iter().enumerate().map(|(vertex, &height)| {
            let below = height < HEIGHT || minus.vertices().contains(&vertex);
            Vector1::new(if below { belt } else { belt + velocity })
        });
        let law = Tresca { coefficient: 0.6 };
        let scene = Scene::new(antiplane(&space, self.modulus)?)
            .with_mass(mass(&space, DENSITY)?)
            .with_velocity(start.collect())
            .prescribe_velocity(&space.trace(|x| x[1] == 0.0)?, Components::ALL, move |_| {
                [belt]
            });
        let scene = if self.has_state {
            let slip_distance = LAW.slip_distance;
            let steady = LogTheta((slip_distance / velocity.abs()).ln());
            let fault = Contact::between(&plus, &minus, LAW, STRENGTH / 0.6);
            scene.with_contact(fault.with_state(Dieterich { slip_distance }, steady))
        } else {
            scene.with_contact(Contact::between(&plus, &minus, law, STRENGTH / 0.6))
        };
        let scheme: Box<dyn RateScheme> = if self.damps {
            Box::new(Sdirk2)
        } else {
            Box::new(GeneralizedAlpha::default())
        };
        Ok(Simulation::new(scene, scheme, Condensed::new())?)
    }

    /// The steps of a run for so many times the duration of the slip, and the mean slip.
    fn run(&self, tolerance: f64, durations: f64) -> Outcome<(usize, f64)> {
        let mut block = self.block()?;
        let plan = Steps::adaptive(tolerance).until(durations * self.duration());
        let report = block.run(&plan, |_| ())?;
        let at = block.snapshot();
        let contact = at.contact(0);
        let slips = (0..contact.len()).map(|k| contact.slip(k));
        Ok((report.accepted, slips.sum::<f64>() / contact.len() as f64))
    }

    /// As many steps, within a factor of 1.5, and the same slip on belts of these velocities.
    fn agrees_on(&self, belts: [f64; 2], tolerance: f64, durations: f64) -> Outcome {
        let (steps, slip) = self.run(tolerance, durations)?;
        for belt in belts {
            let moving = Self { belt, ..*self };
            let (others, other) = moving.run(tolerance, durations)?;
            let ratio = others as f64 / steps as f64;
            assert!(
                (1.0 / 1.5..1.5).contains(&ratio),
                "{moving:?}: {others} steps, {steps} at rest"
            );
            let off = (other / slip - 1.0).abs();
            assert!(off < 20.0 * tolerance, "{moving:?}: {off:e}");
        }
        Ok(())
    }
}

/// A block of random velocity and material that friction stops, on a belt at rest, on one that the block is put on at rest, and
/// on one of any velocity: as many steps, and the slip that spends its energy.
#[test]
fn steps_do_not_depend_on_the_frame() -> Outcome {
    let random = &mut Random(1);
    for _ in 0..10 {
        let velocity = 10_f64.powf(random.between(-1.0, 1.0));
        let still = Sliding {
            modulus: 10_f64.powf(random.between(7.5, 9.0)),
            velocity: if random.below(2) == 0 {
                velocity
            } else {
                -velocity
            },
            belt: 0.0,
            damps: random.below(2) == 0,
            has_state: false,
        };
        let tolerance = 10_f64.powf(random.between(-4.0, -3.0));
        let (_, slip) = still.run(tolerance, 4.0)?;
        // The energy that waves keep, and the error of some steps.
        let way = DENSITY * HEIGHT * velocity * velocity / 2.0 / STRENGTH;
        let off = (slip / way - 1.0).abs();
        assert!(off < still.waves() + 20.0 * tolerance, "{still:?}: {off:e}");
        let belts = [-still.velocity, random.between(-3.0, 3.0) * velocity];
        still.agrees_on(belts, tolerance, 4.0)?;
    }
    Ok(())
}

/// Under friction of rate and state, too, whose slip rates have a floor beside the motion.
#[test]
fn steps_of_rate_and_state_do_not_depend_on_the_frame() -> Outcome {
    let random = &mut Random(2);
    for _ in 0..6 {
        let velocity = 10_f64.powf(random.between(-1.0, 1.0));
        let still = Sliding {
            modulus: 10_f64.powf(random.between(7.5, 9.0)),
            velocity,
            belt: 0.0,
            damps: random.below(2) == 0,
            has_state: true,
        };
        let tolerance = 10_f64.powf(random.between(-4.0, -3.0));
        let belts = [-velocity, random.between(-3.0, 3.0) * velocity];
        still.agrees_on(belts, tolerance, 2.0)?;
    }
    Ok(())
}

/// Waves that an arrest leaves count as a part of the motion that it ended: as much time after it takes as many steps at most as
/// the motion, where they carry less than the tolerance of it.
#[test]
fn rest_costs_less_than_the_motion_before() -> Outcome {
    for modulus in [1e8, 1e9] {
        for belt in [0.0, 1.0] {
            let sliding = Sliding {
                modulus,
                velocity: 3.0,
                belt,
                damps: true,
                has_state: false,
            };
            let [moving, resting] = [1.2, 12.0].map(|durations| sliding.run(1e-3, durations));
            let (moving, resting) = (moving?.0, resting?.0);
            assert!(resting < 2 * moving, "{sliding:?}: {moving}, {resting}");
        }
    }
    Ok(())
}

/// The scale of the motion is a part of the state: from a state after the arrest another simulation takes the same steps.
#[test]
fn a_continued_run_knows_the_motion_before() -> Outcome {
    let sliding = Sliding {
        modulus: 1e9,
        velocity: 1.0,
        belt: 0.0,
        damps: false,
        has_state: false,
    };
    let plan = Steps::adaptive(1e-3).until(3.0 * sliding.duration());
    let mut whole = sliding.block()?;
    whole.run(&plan, |_| ())?;
    let mut first = sliding.block()?;
    let still = |at: stickslip::Snapshot<'_, 1>| at.time < 2.0 * sliding.duration();
    first.run(&plan, |at| {
        if still(at) {
            std::ops::ControlFlow::Continue(())
        } else {
            std::ops::ControlFlow::Break(())
        }
    })?;
    assert!(first.state().control.largest_motion > 0.0);
    let mut second = sliding.block()?;
    second.restore(first.state())?;
    second.run(&plan, |_| ())?;
    assert_eq!(second.state(), whole.state());
    Ok(())
}
