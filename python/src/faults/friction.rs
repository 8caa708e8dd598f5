//! Regularised rate- and state-dependent friction of cells.

use stickslip::friction::FrictionLaw;
use stickslip::nalgebra::{SVector, Vector1};
use stickslip::state::{Dieterich, LogTheta, Ruina, StateLaw};
use stickslip::{BoundaryPart, Contact, Operator, Scene};

use super::function::CellFunction;
use super::laws::CellLaws;
use crate::fields::Fields;

/// Friction with parameters per cell.
pub(super) struct CellFriction<const C: usize> {
    pub(super) laws: CellLaws,
    /// `alpha/b` of Linker and Dieterich.
    pub(super) effect: Option<Vec<f64>>,
    /// Initial states, `ln(theta / 1 s)`.
    pub(super) states: Vec<LogTheta>,
    /// \[Pa\].
    pub(super) normal_stress: Vec<f64>,
    /// At time 0 \[Pa\].
    pub(super) shear_stress: Vec<SVector<f64, C>>,
    /// Whether cells under tension open.
    pub(super) opens: bool,
    /// The pressure of a fluid \[Pa\], which lowers the normal stress.
    pub(super) pressure: Option<CellFunction>,
    /// Heat and fluids on the fault.
    pub(super) fields: Fields,
    /// The least normal stress that friction sees \[Pa\].
    pub(super) least_stress: Option<f64>,
}

impl<const C: usize> CellFriction<C> {
    /// The scene with this friction on a fault.
    pub(super) fn on<Op: Operator<C>>(
        mut self,
        scene: Scene<Op, C>,
        part: BoundaryPart,
    ) -> Scene<Op, C> {
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
        scene: Scene<Op, C>,
        part: BoundaryPart,
        friction: Vec<L>,
        laws: Vec<S>,
    ) -> Scene<Op, C>
    where
        Op: Operator<C>,
        L: FrictionLaw<State = LogTheta> + 'static,
        S: StateLaw<State = LogTheta> + 'static,
    {
        let total = self.normal_stress.clone();
        let contact = Contact::per_vertex(part, friction, self.normal_stress)
            .with_state_per_vertex(laws, self.states)
            .with_shear_stress(self.shear_stress);
        let contact = match self.effect {
            Some(kappa) => contact.with_normal_stress_effect(kappa),
            None => contact,
        };
        let contact = if self.opens {
            contact.allow_opening()
        } else {
            contact
        };
        let contact = match self.least_stress {
            Some(stress) => contact.with_least_normal_stress(stress),
            None => contact,
        };
        let contact = self.fields.in_contact(contact);
        let Some(pressure) = self.pressure else {
            return scene.with_contact(contact);
        };
        scene.with_contact(contact.with_normal_stress_history(move |time, stress| {
            let pressures: Vec<Vector1<f64>> = pressure.at(time);
            for ((stress, total), pressure) in stress.iter_mut().zip(&total).zip(pressures) {
                *stress = total - pressure[0];
            }
        }))
    }
}
