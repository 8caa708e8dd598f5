//! The normal motion of vertices that can open.

use stickslip_friction::{ConvexPotential, Unilateral};

/// The normal motion of a vertex that can open, in a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gap {
    /// The normal component.
    pub(crate) axis: usize,
    /// The outward normal along it, 1 or -1.
    pub(crate) outward: f64,
    /// The normal velocity at which the gap is closed at the end of the step [m/s].
    pub(crate) bound: f64,
    /// The force of the given normal stress, which is in balance with none of the body \[N\].
    pub(crate) pull: f64,
}

/// The vertices of a contact that can open.
#[derive(Debug, Clone)]
pub(crate) struct Opening {
    /// The normal component of each; none of one that cannot.
    pub(crate) released: Vec<Option<usize>>,
    /// The normal velocities at which their gaps are closed in the step [m/s].
    pub(crate) bounds: Vec<f64>,
}

impl Opening {
    /// A contact of so many vertices, of which none can open so far.
    pub(crate) fn new(count: usize) -> Self {
        Self {
            released: vec![None; count],
            bounds: vec![0.0; count],
        }
    }
}

impl Gap {
    /// The potential of a vertex with this gap.
    pub(crate) fn with<P: ConvexPotential<C>, const C: usize>(
        &self,
        potential: P,
    ) -> Unilateral<P, C> {
        Unilateral {
            potential,
            axis: self.axis,
            outward: self.outward,
            bound: self.bound,
            pull: self.pull,
        }
    }
}
