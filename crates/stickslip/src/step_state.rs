//! The state at the start and the end of a step.

use nalgebra::SVector;
use stickslip_time::Motion;

use crate::checks::finite;
use crate::{Clock, SceneError};

/// The complete state for the next step: motion, states, and the memory of scheme, coupling and step-size control.
///
/// It consists of plain numbers, without a law or a scheme in its type. [`Simulation::state`](crate::Simulation::state)
/// shows it, a clone stores it, and [`restore`](crate::Simulation::restore) returns to it: from there on a simulation
/// of the same scene takes the same steps, bit for bit.
///
/// On surfaces oblique to the axes the vectors are in the local frames of their vertices; a
/// [`Snapshot`](crate::Snapshot) shows them in coordinates.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
#[doc(alias = "restart")]
pub struct StepState<const C: usize> {
    /// Step number and time.
    pub clock: Clock,
    /// `u`, one vector per vertex \[m\].
    pub displacement: Vec<SVector<f64, C>>,
    /// `v`, one vector per vertex [m/s].
    pub velocity: Vec<SVector<f64, C>>,
    /// `a`, one vector per vertex [m/s^2]; empty without mass.
    pub acceleration: Vec<SVector<f64, C>>,
    /// The algorithmic acceleration of the scheme, one vector per vertex; empty if it has none.
    pub algorithmic: Vec<SVector<f64, C>>,
    /// The contacts, in the order in which the scene was given them.
    pub contacts: Vec<ContactState<C>>,
    /// The size of the last step \[s\]; 0 at the start.
    pub last_step: f64,
    /// The memory of the coupling, with a meaning of its own.
    pub coupling: [f64; 4],
    /// The memory of the step-size control.
    pub control: ControlState,
    /// The cost of the last step.
    pub report: StepReport,
}

/// The state at the vertices of one contact.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ContactState<const C: usize> {
    /// The state, in the state law's own variable; empty without state.
    pub states: Vec<f64>,
    /// The normal stress \[Pa\], its modulus.
    pub normal_stress: Vec<f64>,
    /// The path length of slip so far \[m\].
    pub slip: Vec<f64>,
    /// The displacement at zero slip \[m\].
    pub origin: Vec<SVector<f64, C>>,
    /// The velocity one step earlier [m/s]; empty where friction depends on neither state nor slip rate.
    pub earlier: Vec<SVector<f64, C>>,
    /// The normal stress one step earlier \[Pa\]; empty unless it comes from the body.
    pub earlier_normal_stress: Vec<f64>,
    /// The normal stress that friction sees, negative in tension \[Pa\]; empty unless it follows that of the body with a
    /// delay.
    pub relaxed_stress: Vec<f64>,
    /// The normal stress of the body \[Pa\]; likewise.
    pub body_stress: Vec<f64>,
    /// The memory of each field on the contact, see [`FaultField`](crate::fields::FaultField).
    pub fields: Vec<Vec<f64>>,
    /// The pore pressure of all fields \[Pa\]; empty without any. The normal stress is the effective one then.
    pub pore_pressure: Vec<f64>,
    /// The pore pressure that the opening of the contact takes up, or its least normal stress \[Pa\]; empty without fields.
    pub excess_pressure: Vec<f64>,
}

impl<const C: usize> ContactState<C> {
    /// The normal stress of a vertex, with the part that the fluid bears \[Pa\].
    pub(crate) fn total_normal_stress(&self, k: usize) -> f64 {
        let of = |field: &[f64]| field.get(k).copied().unwrap_or_default();
        self.normal_stress[k] + of(&self.pore_pressure) - of(&self.excess_pressure)
    }

    /// The normal stresses that the sides exert on each other, without the delay in friction \[Pa\].
    pub(crate) fn exerted_stress(&self) -> &[f64] {
        if self.body_stress.is_empty() {
            &self.normal_stress
        } else {
            &self.body_stress
        }
    }
}

/// The memory of a run with adaptive steps.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ControlState {
    /// The planned next step \[s\]; 0 without a plan.
    pub next_step: f64,
    /// The last accepted step \[s\]; 0 if there was none.
    pub last_step: f64,
    /// The error of that step over the tolerance; 0 if there was none.
    pub last_error: f64,
    /// The largest motion so far, `sqrt((u - u_0) . A (u - u_0) + (v - v_0) . M (v - v_0))`, of steps with inertia [J^(1/2)].
    pub largest_motion: f64,
}

/// The cost of the last step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct StepReport {
    /// Velocity problems solved.
    pub coupling_iterations: usize,
    /// Iterations of the velocity solver over all of these: multigrid cycles, or sweeps of a solver without cycles.
    pub solver_iterations: usize,
    /// The coupling failed, and its fallback took the step.
    pub fell_back: bool,
    /// Backward Euler replaced the scheme: without inertia by two half steps where rates are not resolved, see
    /// [`FirstOrderAlpha`](crate::time::FirstOrderAlpha); with inertia where a contact opens or closes.
    pub damped: bool,
    /// The number of nodes at which friction, with its state condensed, weakens with the slip rate at the end of the
    /// step: there the solution is unique only by the body's resistance. Counted after a
    /// [simultaneous](crate::Coupling::is_simultaneous) coupling, and in a scene without state for
    /// [`unchecked`](crate::Contact::unchecked) laws; other laws do not weaken.
    pub weakening_nodes: usize,
    /// Solutions with other normal stresses, where these come from the deformation, or with other forces of a stiffness matrix
    /// that is not symmetric; 0 elsewhere.
    pub reaction_iterations: usize,
    /// The contraction of these, without acceleration: how much of a change of the normal stress the next iterate
    /// keeps, the spectral radius as far as the iterates show it. 0 after one iteration.
    pub contraction: f64,
    /// The number of vertices at the [least normal stress](crate::Contact::with_least_normal_stress) of their contact at the
    /// end of the step, or opened by the pore pressure of fields.
    pub at_least_normal_stress: usize,
    /// The number of vertices at the [largest normal stress](crate::Contact::with_largest_normal_stress) of their contact at
    /// the end of the step.
    pub at_largest_normal_stress: usize,
}

impl<const C: usize> StepState<C> {
    /// The motion of component `c` of vertex `i`.
    #[inline]
    pub(crate) fn motion(&self, i: usize, c: usize) -> Motion {
        let or_zero = |field: &[SVector<f64, C>]| field.get(i).map_or(0.0, |value| value[c]);
        Motion {
            displacement: self.displacement[i][c],
            velocity: self.velocity[i][c],
            acceleration: or_zero(&self.acceleration),
            algorithmic: or_zero(&self.algorithmic),
        }
    }

    /// Copies another step of the same scene, without allocation.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.copy_all_but_memories(other);
        for (contact, other) in self.contacts.iter_mut().zip(&other.contacts) {
            for (memory, other) in contact.fields.iter_mut().zip(&other.fields) {
                memory.copy_from_slice(other);
            }
        }
    }

    /// Copies another step of the same scene, but for the memories of its fields.
    pub(crate) fn copy_all_but_memories(&mut self, other: &Self) {
        self.clock = other.clock;
        self.displacement.copy_from_slice(&other.displacement);
        self.velocity.copy_from_slice(&other.velocity);
        self.acceleration.copy_from_slice(&other.acceleration);
        self.algorithmic.copy_from_slice(&other.algorithmic);
        for (contact, other) in self.contacts.iter_mut().zip(&other.contacts) {
            contact.states.copy_from_slice(&other.states);
            contact.normal_stress.copy_from_slice(&other.normal_stress);
            contact.slip.copy_from_slice(&other.slip);
            contact.origin.copy_from_slice(&other.origin);
            contact.earlier.copy_from_slice(&other.earlier);
            let stress = &other.earlier_normal_stress;
            contact.earlier_normal_stress.copy_from_slice(stress);
            (contact.relaxed_stress).copy_from_slice(&other.relaxed_stress);
            contact.body_stress.copy_from_slice(&other.body_stress);
            (contact.pore_pressure).copy_from_slice(&other.pore_pressure);
            (contact.excess_pressure).copy_from_slice(&other.excess_pressure);
        }
        self.last_step = other.last_step;
        self.coupling = other.coupling;
        self.control = other.control;
        self.report = other.report;
    }

    /// The named lengths of all fields: equal for two states of one scene.
    fn lengths(&self) -> impl Iterator<Item = (&'static str, usize)> {
        let fields = [
            ("displacements", self.displacement.len()),
            ("velocities", self.velocity.len()),
            ("accelerations", self.acceleration.len()),
            ("algorithmic numbers", self.algorithmic.len()),
            ("contacts", self.contacts.len()),
        ];
        let contacts = self.contacts.iter().flat_map(|contact| {
            [
                ("states", contact.states.len()),
                ("normal stresses", contact.normal_stress.len()),
                ("slips", contact.slip.len()),
                ("origins", contact.origin.len()),
                ("earlier velocities", contact.earlier.len()),
                (
                    "earlier normal stresses",
                    contact.earlier_normal_stress.len(),
                ),
                ("relaxed normal stresses", contact.relaxed_stress.len()),
                ("normal stresses of the body", contact.body_stress.len()),
                ("fields", contact.fields.len()),
                (
                    "memory of fields",
                    contact.fields.iter().map(Vec::len).sum(),
                ),
                ("pore pressures", contact.pore_pressure.len()),
                ("excess pressures", contact.excess_pressure.len()),
            ]
        });
        fields.into_iter().chain(contacts)
    }

    /// Refuses a state whose fields differ in length from those of `expected`, or whose time or motion is not finite.
    pub(crate) fn check_fits(&self, expected: &Self) -> Result<(), SceneError> {
        for ((what, found), (_, expected)) in self.lengths().zip(expected.lengths()) {
            if found != expected {
                return Err(SceneError::Length {
                    what,
                    expected,
                    found,
                });
            }
        }
        finite("time of the state", 0, self.clock.time())?;
        for (what, field) in [
            ("displacement of the state", &self.displacement),
            ("velocity of the state", &self.velocity),
            ("acceleration of the state", &self.acceleration),
        ] {
            for (vertex, vector) in field.iter().enumerate() {
                (vector.iter()).try_for_each(|&value| finite(what, vertex, value))?;
            }
        }
        Ok(())
    }

    /// `old + lead (self - old)` for displacement, velocity, states and relaxed normal stresses.
    pub(crate) fn lead(&mut self, old: &Self, lead: f64) {
        for (now, old) in [
            (&mut self.displacement, &old.displacement),
            (&mut self.velocity, &old.velocity),
        ] {
            for (now, old) in now.iter_mut().zip(old) {
                *now = old + (*now - old) * lead;
            }
        }
        for (now, old) in self.contacts.iter_mut().zip(&old.contacts) {
            for (now, old) in [
                (&mut now.states, &old.states),
                (&mut now.relaxed_stress, &old.relaxed_stress),
            ] {
                for (now, old) in now.iter_mut().zip(old) {
                    *now = old + lead * (*now - old);
                }
            }
        }
    }
}
