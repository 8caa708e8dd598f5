//! The convex functional that one velocity problem minimises.

use nalgebra::SVector;
use stickslip_friction::ConvexPotential;

use crate::Operator;

/// `J(v) = v.Bv/2 - r.v + sum_p phi_p(v_p)` on the fields with given fixed components.
///
/// | field | shape | meaning |
/// | --- | --- | --- |
/// | `operator` | vertices x vertices | `B`, symmetric, positive definite on the free components [N s/m] |
/// | `load` | one vector a vertex | `r` \[N\] |
/// | `potentials` | one a frictional vertex | `phi_p`, convex |
/// | `vertices` | one index a frictional vertex, increasing | where the potentials act |
/// | `fixed` | one mask a vertex | components that keep the value of the start vector |
///
/// A component that is fixed at a frictional vertex (the normal one of bilateral contact) has the
/// value zero there.
#[derive(Debug)]
pub struct Energy<'a, Op, P, const C: usize> {
    /// `B`.
    pub operator: &'a Op,
    /// `r`.
    pub load: &'a [SVector<f64, C>],
    /// `phi_p` of every frictional vertex.
    pub potentials: &'a [P],
    /// The frictional vertices, increasing.
    pub vertices: &'a [usize],
    /// The components that are not unknowns.
    pub fixed: &'a [[bool; C]],
}

impl<Op: Operator<C>, P: ConvexPotential<C>, const C: usize> Energy<'_, Op, P, C> {
    /// `J(v)` [N m/s].
    pub fn value(&self, v: &[SVector<f64, C>]) -> f64 {
        let linear: f64 = self.load.iter().zip(v).map(|(r, v)| r.dot(v)).sum();
        let nonlinear: f64 = self
            .potentials
            .iter()
            .zip(self.vertices)
            .map(|(potential, &vertex)| potential.value(&v[vertex]))
            .sum();
        0.5 * self.operator.quadratic(v) - linear + nonlinear
    }
}
