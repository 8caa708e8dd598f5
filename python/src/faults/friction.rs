//! Regularised rate- and state-dependent friction of cells.

use stickslip::friction::RegularizedDieterichRuina;
use stickslip::nalgebra::Vector1;
use stickslip::state::{Dieterich, LogTheta, Ruina, StateLaw};
use stickslip::{BoundaryPart, Contact, Operator, Scene};

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
        let shear: Vec<_> = self.shear_stress.into_iter().map(Vector1::new).collect();
        let contact = Contact::per_vertex(part, self.laws, self.normal_stress)
            .with_state_per_vertex(laws, self.states)
            .with_shear_stress(shear);
        scene.with_contact(if self.opens {
            contact.allow_opening()
        } else {
            contact
        })
    }
}
