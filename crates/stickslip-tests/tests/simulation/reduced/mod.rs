//! Bodies reduced to their surface: what they keep, what they leave out, what they refuse.

mod frames;
mod motions;
mod quasi_static;
mod refusals;
mod saved;
mod slider;
mod starts;

use nalgebra::SVector;
use stickslip::fem::{P1, body_force, elasticity, mass};
use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::reduced::{Reduced, ReducedBody};
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, Components, Condensed, Contact, DenseNewton, Newmark, Scene, Simulation,
};

use crate::Outcome;
use crate::common::{body, distance};

type Full<const C: usize> = Scene<BlockMatrix<C>, C>;

/// The paper's slider.
fn slider(slider: &PippingSlider, space: &P1<2>) -> Outcome<Full<2>> {
    let seam = Contact::new(&PippingSlider::bottom(space)?, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    Ok(slider.scene(space)?.with_contact(seam))
}

fn gravity(slider: &PippingSlider, space: &P1<2>) -> Vec<SVector<f64, 2>> {
    let weight = SVector::from([0.0, -slider.density * slider.gravity]);
    body_force(space, |_| weight)
}

/// A block of two squares with inertia on its bottom, moved along x at its right side.
struct Block {
    space: P1<2>,
    /// The rate of its right side at the start and its growth [m/s, m/s^2].
    rate: [f64; 2],
    law: DieterichRuina,
    refinements: usize,
}

impl Block {
    fn new(refinements: usize) -> Outcome<Self> {
        Ok(Self {
            space: P1::grid([2.0, 1.0], [2, 1])?.refined(refinements)?,
            rate: [0.0, 1e-3],
            law: FRICTION,
            refinements,
        })
    }

    fn with_inertia(&self) -> Outcome<Full<2>> {
        let PippingSlider {
            elastic, density, ..
        } = body(self.refinements);
        let side = self.space.trace(|x| x[0] == 2.0)?;
        let bottom = self.space.trace(|x| x[1] == 0.0)?;
        let [start, growth] = self.rate;
        Ok(Scene::new(elasticity(&self.space, &elastic)?)
            .with_mass(mass(&self.space, density)?)
            .with_contact(
                Contact::new(&bottom, self.law, NORMAL_STRESS).with_state(AGING, LogTheta(0.0)),
            )
            .prescribe_velocity(&side, Components::X, move |time| {
                [start + growth * time, 0.0]
            }))
    }
}

/// A body in full and reduced, side by side.
struct Pair<const C: usize> {
    body: ReducedBody<C>,
    full: Simulation<C>,
    reduced: Simulation<C>,
}

impl<const C: usize> Pair<C> {
    /// By a reduction up to so many hertz.
    fn new(scene: &dyn Fn() -> Outcome<Full<C>>, frequency: f64) -> Outcome<Self> {
        Self::by(scene, Reduced::new(&scene()?).up_to_frequency(frequency)?)
    }

    fn by(scene: &dyn Fn() -> Outcome<Full<C>>, body: ReducedBody<C>) -> Outcome<Self> {
        let scheme = Newmark::default();
        let full = Simulation::new(scene()?, scheme, Condensed::new())?;
        let reduced = Simulation::new(body.reduce(scene()?)?, scheme, DenseNewton::new())?;
        Ok(Self {
            body,
            full: full.with_absolute_tolerance(1e-14)?,
            reduced: reduced.with_absolute_tolerance(1e-14)?,
        })
    }

    fn step(&mut self, dt: f64) -> Outcome {
        self.full.step(dt)?;
        self.reduced.step(dt)?;
        Ok(())
    }

    /// The distance of displacements and velocities of the whole bodies under a load, as shares of the largest, and of
    /// states and tractions of the contacts, as shares of what they are.
    fn apart(&self, load: Option<&[SVector<f64, C>]>) -> Outcome<f64> {
        let (full, reduced) = (self.full.snapshot(), self.reduced.snapshot());
        let displacement = match load {
            None => self.body.displacement(&reduced)?,
            Some(load) => self.body.displacement_under(load, &reduced)?,
        };
        let velocity = self.body.velocity(&reduced)?;
        let mut apart = 0.0_f64;
        for (found, expected) in [
            (&displacement, full.displacement),
            (&velocity, full.velocity),
        ] {
            let size = distance(expected, &vec![SVector::zeros(); expected.len()]);
            apart = apart.max(distance(found, expected) / size);
        }
        assert_eq!(full.contact_count(), reduced.contact_count());
        for (full, reduced) in full.contacts().zip(reduced.contacts()) {
            assert_eq!(full.len(), reduced.len());
            for k in 0..full.len() {
                assert_eq!(self.body.vertex(full.vertex(k)), Some(reduced.vertex(k)));
                assert_eq!(full.point(k), reduced.point(k));
                let stress = full.normal_stress(k);
                apart = apart
                    .max((full.state(k) - reduced.state(k)).abs() / full.state(k).abs().max(1.0))
                    .max((full.traction(k) - reduced.traction(k)).amax() / stress);
            }
        }
        Ok(apart)
    }
}
