//! The normal stresses of a contact, as a view shows them.

use super::ContactView;

impl<const C: usize> ContactView<'_, C> {
    /// The normal stress of vertex number `k` \[Pa\], positive in compression; 0 where it is open. With
    /// [fields](crate::Contact::with_field) it is the total one, that of friction and the pore pressure.
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn normal_stress(&self, k: usize) -> f64 {
        self.effective_normal_stress(k) + self.pore_pressure(k)
    }

    /// The normal stress of vertex number `k` as friction sees it, less the pore pressure \[Pa\]; 0 where it is open.
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

    /// The memory of a field, in the order in which the contact was given them; none if there are fewer.
    pub fn field(&self, number: usize) -> Option<&[f64]> {
        self.at.fields.get(number).map(Vec::as_slice)
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
