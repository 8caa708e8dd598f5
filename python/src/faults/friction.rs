//! Regularised rate- and state-dependent friction of cells.

use stickslip::friction::FrictionLaw;
use stickslip::nalgebra::Vector1;
use stickslip::state::{Dieterich, LogTheta, Ruina, StateLaw};
use stickslip::{BoundaryPart, Contact, Operator, Scene};

use super::function::CellFunction;
use super::laws::CellLaws;

/// Friction with parameters per cell.
pub(super) struct CellFriction {
    pub(super) laws: CellLaws,
    /// Initial states, `ln(theta / 1 s)`.
    pub(super) states: Vec<LogTheta>,
    /// \[Pa\].
    pub(super) normal_stress: Vec<f64>,
    /// At time 0 \[Pa\].
    pub(super) shear_stress: Vec<f64>,
    /// Whether cells under tension open.
    pub(super) opens: bool,
    /// The pressure of a fluid \[Pa\], which lowers the normal stress.
    pub(super) pressure: Option<CellFunction>,
}

impl CellFriction {
    /// The scene with this friction on a fault.
    pub(super) fn on<Op: Operator<1>>(
        mut self,
        scene: Scene<Op, 1>,
        part: BoundaryPart,
    ) -> Scene<Op, 1> {
        match std::mem::replace(&mut self.laws, CellLaws::Own(Vec::new(), Vec::new())) {
            CellLaws::Own(friction, evolution) => self.with(scene, part, friction, evolution),
            CellLaws::Named(friction, slip_law) => {
                let distances: Vec<_> = friction.iter().map(|law| law.slip_distance).collect();
                let distances = distances.into_iter();
                if slip_law {
                    let laws = distances.map(|slip_distance| Ruina { slip_distance });
                    self.with(scene, part, friction, laws.collect())
                } else {
                    let laws = distances.map(|slip_distance| Dieterich { slip_distance });
                    self.with(scene, part, friction, laws.collect())
                }
            }
        }
    }

    fn with<Op, L, S>(
        self,
        scene: Scene<Op, 1>,
        part: BoundaryPart,
        friction: Vec<L>,
        laws: Vec<S>,
    ) -> Scene<Op, 1>
    where
        Op: Operator<1>,
        L: FrictionLaw<State = LogTheta> + 'static,
        S: StateLaw<State = LogTheta> + 'static,
    {
        let total = self.normal_stress.clone();
        let shear: Vec<_> = self.shear_stress.into_iter().map(Vector1::new).collect();
        let contact = Contact::per_vertex(part, friction, self.normal_stress)
            .with_state_per_vertex(laws, self.states)
            .with_shear_stress(shear);
        let contact = if self.opens {
            contact.allow_opening()
        } else {
            contact
        };
        let Some(pressure) = self.pressure else {
            return scene.with_contact(contact);
        };
        scene.with_contact(contact.with_normal_stress_history(move |time, stress| {
            let pressures = pressure.at(time, stress.len());
            for ((stress, total), pressure) in stress.iter_mut().zip(&total).zip(pressures) {
                *stress = total - pressure;
            }
        }))
    }
}
