//! A slider that keeps sticking and slipping under slow loading.

use nalgebra::SVector;
use stickslip::fem::{P1, body_force, elasticity, mass};
use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::problems::spring_slider::LoadPath;
use stickslip::state::LogTheta;
use stickslip::{BlockMatrix, Cholesky, Components, Contact, Scene, SceneError};

/// The paper's slider with a friction that weakens more, loaded as faults are.
///
/// With `b = 0.019` instead of 0.015 the shear modulus of the body over its height, `G/H` = 1.9e7
/// Pa/m, is 0.44 times the critical stiffness `(b - a) sigma_n/L` = 4.4e7 Pa/m: the body does not
/// come to slide steadily. Slip begins on `G L/((b - a) sigma_n)` = 0.44 m, and the traction falls
/// behind its front within `G L/(b sigma_n)` = 0.21 m; a cell of two refinements has 0.25 m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CyclingSlider {
    /// Uniform refinements of the five unit squares.
    pub(crate) refinements: usize,
    /// By how much friction falls with the logarithm of the rate in steady sliding, plus `a`.
    pub(crate) b: f64,
    /// The velocity of the loaded side [m/s].
    pub(crate) load_velocity: f64,
    /// The time in which it grows to that, linearly \[s\].
    pub(crate) ramp: f64,
    /// Kelvin-Voigt viscosity over elasticity \[s\].
    pub(crate) relaxation: f64,
}

impl CyclingSlider {
    /// Its mesh.
    pub(crate) fn space(&self) -> Result<P1<2>, SceneError> {
        self.slider().space()
    }

    /// The body with its contact, in equilibrium.
    pub(crate) fn scene(&self, space: &P1<2>) -> Result<Scene<BlockMatrix<2>, 2>, SceneError> {
        let slider = self.slider();
        let stiffness = elasticity(space, &slider.elastic)?;
        let viscosity =
            (self.relaxation > 0.0).then(|| stiffness.clone().map(|block| block * self.relaxation));
        let weight = SVector::from([0.0, -slider.density * slider.gravity]);
        let friction = DieterichRuina {
            b: self.b,
            ..FRICTION
        };
        let contact = Contact::new(&PippingSlider::bottom(space)?, friction, NORMAL_STRESS)
            .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
        let path = LoadPath::steady(0.0).ramp(0.0, self.ramp, self.load_velocity);
        let mut scene = Scene::new(stiffness);
        if let Some(viscosity) = viscosity {
            scene = scene.with_viscosity(viscosity);
        }
        Ok(scene
            .on(space)
            .with_mass(mass(space, slider.density)?)
            .with_load(body_force(space, |_| weight))
            .with_contact(contact)
            .prescribe_velocity(&PippingSlider::top(space)?, Components::ALL, move |time| {
                [path.velocity(time), 0.0]
            })
            .in_equilibrium(Cholesky::new()))
    }

    fn slider(&self) -> PippingSlider {
        PippingSlider {
            refinements: self.refinements,
            ..PippingSlider::default()
        }
    }
}
