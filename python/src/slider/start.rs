//! The start of a block on a spring, and its arguments.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::integrate::Stepper;
use stickslip::problems::spring_slider::steady_state;
use stickslip::{Point, RungeKutta, Sdirk2, Simulation};

use super::SpringSlider;
use crate::errors;
use crate::plain::fields;
use crate::raised::Raised;

impl SpringSlider {
    /// The arguments.
    pub(super) fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let given = fields!(py, self; stiffness, normal_stress, a, b, Dc, mu0, V0, friction, law, damping, mass, V, theta, Vc, c);
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
        let made = || -> Result<Box<dyn Stepper<1>>, _> {
            let friction = self.laws.0.law(raised);
            let scene = self.slider.scene(friction, evolution, self.V, state)?;
            Ok(if self.slider.mass == 0.0 {
                Box::new(RungeKutta::new(scene)?)
            } else {
                Box::new(Simulation::new(scene, Sdirk2, Point)?)
            })
        };
        made().map_err(|error| raised.take().unwrap_or_else(|| errors::scene(py, &error)))
    }
}
