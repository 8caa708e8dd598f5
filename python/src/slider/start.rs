//! The start of a block on a spring, and its arguments.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::friction::FrictionLaw;
use stickslip::integrate::Stepper;
use stickslip::nalgebra::{Matrix1, Vector1};
use stickslip::problems::spring_slider::{SpringScene, SpringSlider as Slider, steady_state};
use stickslip::state::{LogTheta, StateLaw};
use stickslip::{BoundaryPart, Contact, Point, RungeKutta, Scene, Sdirk2, Simulation};

use super::SpringSlider;
use crate::errors;
use crate::fields::{Cells, Fields};
use crate::plain::fields;
use crate::raised::Raised;

type AnyFriction = Box<dyn FrictionLaw<State = LogTheta>>;
type AnyState = Box<dyn StateLaw<State = LogTheta>>;

impl SpringSlider {
    /// The arguments.
    pub(super) fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let given = fields!(py, self; stiffness, normal_stress, a, b, Dc, mu0, V0, friction, law, damping, mass, V, theta, Vc, c, fields);
        given.set_item("load", self.load.clone())?;
        Ok(given)
    }

    /// The block at time 0, with an explicit method if it has no mass.
    pub(super) fn stepper(&self, py: Python<'_>, raised: &Raised) -> PyResult<Box<dyn Stepper<1>>> {
        let evolution = self.laws.1.law(raised);
        let state = match self.theta {
            Some(theta) => self.laws.1.state(theta, self.V),
            None => steady_state(&evolution, self.slider.load.velocity(0.0))
                .map_err(|error| raised.take().unwrap_or_else(|| errors::state(py, &error)))?,
        };
        let fields = Fields::on(&self.fields, &Cells::apart("a slider", 1))?;
        let made = move || -> Result<Box<dyn Stepper<1>>, _> {
            let friction = self.laws.0.law(raised);
            let scene = if self.fields.is_empty() {
                self.slider.scene(friction, evolution, self.V, state)?
            } else {
                self.with_fields((friction, evolution), state, fields)
            };
            Ok(if self.slider.mass == 0.0 {
                Box::new(RungeKutta::new(scene)?)
            } else {
                Box::new(Simulation::new(scene, Sdirk2, Point)?)
            })
        };
        made().map_err(|error| raised.take().unwrap_or_else(|| errors::scene(py, &error)))
    }
    /// The scene of the block with fields, in balance at the start, where they have no pressure.
    fn with_fields(
        &self,
        (friction, evolution): (AnyFriction, AnyState),
        state: LogTheta,
        fields: Fields,
    ) -> SpringScene {
        let Slider {
            stiffness,
            normal_stress,
            mass,
            damping,
            load,
        } = self.slider.clone();
        let traction = normal_stress * friction.coefficient(self.V, state);
        let stretch = (traction + damping * self.V) / stiffness;
        let contact = Contact::new(BoundaryPart::point(1.0), friction, normal_stress);
        let contact = fields.in_contact(contact.with_state(evolution, state));
        let scene = Scene::new(Matrix1::new(stiffness))
            .with_contact(contact)
            .with_load_history(move |time, force| force[0][0] = stiffness * load.position(time))
            .with_displacement(vec![Vector1::new(-stretch)])
            .with_velocity(vec![Vector1::new(self.V)]);
        let scene = if mass > 0.0 {
            scene.with_mass(Matrix1::new(mass))
        } else {
            scene
        };
        if damping > 0.0 {
            scene.with_viscosity(Matrix1::new(damping))
        } else {
            scene
        }
    }
}
