//! What the strength of a contact depends on beside its laws.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_friction::Nodal;

use super::Source;

/// Sets the normal stress of the vertices of a contact \[Pa\] for a time \[s\].
pub(crate) type StressHistory = Arc<dyn Fn(f64, &mut [f64]) + Send + Sync>;

/// The normal stress and the other tractions of a contact.
#[derive(Clone)]
pub(crate) struct Strength<const C: usize> {
    pub(crate) normal_stress: Nodal<f64>,
    pub(crate) source: Source,
    pub(crate) history: Option<StressHistory>,
    /// A tension opens the contact.
    pub(crate) opens: bool,
    pub(crate) cohesion: Nodal<f64>,
    pub(crate) shear: Option<Nodal<SVector<f64, C>>>,
}
