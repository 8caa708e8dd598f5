//! Regularised rate- and state-dependent friction of cells.

use std::sync::Arc;

use pyo3::prelude::*;
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::nalgebra::Vector1;
use stickslip::state::{Dieterich, LogTheta, Ruina, StateLaw};
use stickslip::{BoundaryPart, Contact, Operator, Scene};

use crate::bodies::{PerVertex, Raised};
use crate::exit::attached;

/// The pressure of a fluid \[Pa\]: a function of time \[s\] that returns a number or one per cell, and the slot of its
/// exception.
pub(super) struct Fluid {
    pub(super) pressure: Py<PyAny>,
    pub(super) raised: Raised,
}

impl Fluid {
    /// The pressures of so many cells.
    fn at(&self, time: f64, cells: usize) -> PyResult<Vec<f64>> {
        attached(|py| {
            let value: PerVertex = self.pressure.bind(py).call1((time,))?.extract()?;
            value.checked("the value of pressure", cells, "finite", f64::is_finite)
        })
    }
}

/// Friction with parameters per cell.
pub(super) struct CellFriction {
    pub(super) laws: Vec<RegularizedDieterichRuina>,
    /// The slip law in the place of the aging law.
    pub(super) slip_law: bool,
    /// Initial states, `ln(theta / 1 s)`.
    pub(super) states: Vec<LogTheta>,
    /// \[Pa\].
    pub(super) normal_stress: Vec<f64>,
    /// At time 0 \[Pa\].
    pub(super) shear_stress: Vec<f64>,
    /// Whether cells under tension open.
    pub(super) opens: bool,
    /// A fluid, whose pressure lowers the normal stress.
    pub(super) fluid: Option<Fluid>,
}

impl CellFriction {
    /// The scene with this friction on a fault.
    pub(super) fn on<Op: Operator<1>>(
        self,
        scene: Scene<Op, 1>,
        part: BoundaryPart,
    ) -> Scene<Op, 1> {
        let distances = self.laws.iter().map(|law| law.slip_distance);
        if self.slip_law {
            let laws = distances.map(|slip_distance| Ruina { slip_distance });
            let laws = laws.collect();
            self.with(scene, part, laws)
        } else {
            let laws = distances.map(|slip_distance| Dieterich { slip_distance });
            let laws = laws.collect();
            self.with(scene, part, laws)
        }
    }

    fn with<Op: Operator<1>, S: StateLaw<State = LogTheta> + 'static>(
        self,
        scene: Scene<Op, 1>,
        part: BoundaryPart,
        laws: Vec<S>,
    ) -> Scene<Op, 1> {
        let total = self.normal_stress.clone();
        let shear: Vec<_> = self.shear_stress.into_iter().map(Vector1::new).collect();
        let contact = Contact::per_vertex(part, self.laws, self.normal_stress)
            .with_state_per_vertex(laws, self.states)
            .with_shear_stress(shear);
        let contact = if self.opens {
            contact.allow_opening()
        } else {
            contact
        };
        let Some(fluid) = self.fluid.map(Arc::new) else {
            return scene.with_contact(contact);
        };
        scene.with_contact(contact.with_normal_stress_history(move |time, stress| {
            let pressures = fluid.at(time, stress.len()).unwrap_or_else(|error| {
                if let Ok(mut raised) = fluid.raised.lock() {
                    raised.get_or_insert(error);
                }
                vec![f64::NAN; stress.len()]
            });
            for ((stress, total), pressure) in stress.iter_mut().zip(&total).zip(pressures) {
                *stress = total - pressure;
            }
        }))
    }
}
