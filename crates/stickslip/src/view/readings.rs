//! The readings of the fields of a contact.

use super::ContactView;
use crate::fields::{FaultField, Reading};

impl<'a, const C: usize> ContactView<'a, C> {
    /// The memory of a field, in the order in which the contact was given them; none if there are fewer.
    pub fn field(&self, number: usize) -> Option<&'a [f64]> {
        self.at.fields.get(number).map(Vec::as_slice)
    }

    /// The readings of all fields, in the order in which the contact was given these.
    pub fn readings(&self) -> Vec<Reading> {
        self.fields()
            .flat_map(|(law, _)| law.readings().iter().copied())
            .collect()
    }

    /// The reading of this name at each vertex, such as `temperature` \[K\], of the first field that has it; none if no
    /// field has it.
    pub fn reading(&self, name: &str) -> Option<Vec<f64>> {
        self.fields().find_map(|(law, memory)| {
            let number = law.readings().iter().position(|own| own.name == name)?;
            let mut values = vec![0.0; self.len()];
            law.read(number, memory, &mut values);
            Some(values)
        })
    }

    /// The totals of all fields, such as an injected volume, with their values.
    pub fn totals(&self) -> Vec<(Reading, f64)> {
        self.fields()
            .flat_map(|(law, memory)| {
                let totals = law.totals().iter().enumerate();
                totals.map(move |(number, total)| (*total, law.total(number, memory)))
            })
            .collect()
    }

    /// Each field with its memory.
    fn fields(&self) -> impl Iterator<Item = (&'a dyn FaultField, &'a [f64])> {
        let laws = self.contact.fields.iter().flat_map(|own| own.laws());
        laws.zip(self.at.fields.iter().map(Vec::as_slice))
    }
}
