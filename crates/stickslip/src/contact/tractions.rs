//! The tractions of a contact beside friction.

use nalgebra::SVector;

use super::DiscreteContact;

impl<const C: usize> DiscreteContact<C> {
    /// Whether the contact exerts tractions beside friction.
    pub(crate) fn loads(&self) -> bool {
        !self.bilateral || self.strength.shear.is_some() || self.opening.is_some()
    }

    /// The normal stress in force at vertex number `k`, with the part that the fluid bears \[Pa\].
    pub(crate) fn total_normal_stress(&self, k: usize) -> f64 {
        let fluid = (self.fields.as_ref()).map_or(0.0, |own| own.pressure[k] - own.excess[k]);
        self.normal_stress[k] + fluid
    }

    /// Adds the tractions beside friction: a prescribed normal traction by the total normal stress of a vertex \[Pa\],
    /// and the initial shear stress.
    pub(crate) fn add_tractions(
        &self,
        normal_stress: impl Fn(usize) -> f64,
        with_shear: bool,
        load: &mut [SVector<f64, C>],
    ) {
        let shear = self.strength.shear.as_ref().filter(|_| with_shear);
        if self.bilateral && shear.is_none() {
            return;
        }
        for (k, (&vertex, weight)) in (self.part.vertices.iter())
            .zip(&self.part.weights)
            .enumerate()
        {
            if let Some(shear) = shear {
                load[vertex] += self.tangential(k, shear.at(k)) * *weight;
            }
            if !self.bilateral {
                load[vertex] -= self.outward[k] * (weight * normal_stress(k));
            }
        }
    }
}
