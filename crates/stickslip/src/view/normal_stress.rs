//! The normal stresses of a contact, as a view shows them.

use super::ContactView;

impl<const C: usize> ContactView<'_, C> {
    /// The normal stress of vertex number `k` \[Pa\], positive in compression; 0 where it is open. With
    /// [fields](crate::Contact::with_field) it is the total one.
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn normal_stress(&self, k: usize) -> f64 {
        self.at.total_normal_stress(k)
    }

    /// The normal stress of vertex number `k` as friction sees it, less the pore pressure \[Pa\]; 0 where it is open, and at
    /// least the [least one](crate::Contact::with_least_normal_stress), at most the
    /// [largest](crate::Contact::with_largest_normal_stress).
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn effective_normal_stress(&self, k: usize) -> f64 {
        self.at.normal_stress[k]
    }

    /// The pore pressure of all fields at vertex number `k` \[Pa\]; 0 without fields.
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn pore_pressure(&self, k: usize) -> f64 {
        assert!(k < self.len(), "vertex {k} of {}", self.len());
        self.at.pore_pressure.get(k).copied().unwrap_or_default()
    }

    /// The normal stress of the body at vertex number `k` \[Pa\], negative in tension, where friction follows it
    /// [with a delay](crate::NormalStress::with_relaxation_time); else the [normal stress](Self::normal_stress).
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn body_normal_stress(&self, k: usize) -> f64 {
        let relaxes = self.at.body_stress.get(k).copied();
        relaxes.unwrap_or_else(|| self.normal_stress(k))
    }
}
