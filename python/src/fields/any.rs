//! The fields of a contact.

use pyo3::prelude::*;
use stickslip::Contact;
use stickslip::fields::{
    Diffusion as Fluid, ShearHeating as Heating, ThermalPressurization as Pressurization,
};
use stickslip::state::StateLaw;

use super::{Cells, Diffusion, ShearHeating, ThermalPressurization};
use crate::arguments::wrong_type;

/// A field of any kind, as an argument of Python.
pub(crate) enum AnyField {
    Thermal(Py<ThermalPressurization>),
    Heating(Py<ShearHeating>),
    Diffusion(Py<Diffusion>),
}

impl<'a, 'py> FromPyObject<'a, 'py> for AnyField {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(field) = given.extract() {
            return Ok(Self::Thermal(field));
        }
        if let Ok(field) = given.extract() {
            return Ok(Self::Heating(field));
        }
        let field = given.extract().map(Self::Diffusion);
        let kinds = "a list of ThermalPressurization, ShearHeating or Diffusion";
        field.map_err(|_| wrong_type(kinds, &given))
    }
}

/// A field on the cells of a fault.
enum Field {
    Thermal(Pressurization),
    Heating(Heating),
    Diffusion(Box<Fluid>),
}

/// The fields on the cells of a fault.
pub(crate) struct Fields(Vec<Field>);

impl Fields {
    /// Those of Python.
    pub(crate) fn on(given: Vec<AnyField>, cells: Cells) -> PyResult<Self> {
        let fields = given.into_iter().enumerate().map(|(n, field)| {
            let name = format!("fields[{n}]");
            Ok(match field {
                AnyField::Thermal(field) => Field::Thermal(field.get().on(&name, cells)?),
                AnyField::Heating(field) => Field::Heating(field.get().on(&name, cells)?),
                AnyField::Diffusion(field) => {
                    Field::Diffusion(Box::new(field.get().on(&name, cells)?))
                }
            })
        });
        fields.collect::<PyResult<_>>().map(Self)
    }

    /// The contact with these fields.
    pub(crate) fn in_contact<L, S: StateLaw, const C: usize>(
        self,
        contact: Contact<L, S, C>,
    ) -> Contact<L, S, C> {
        let fields = self.0.into_iter();
        fields.fold(contact, |contact, field| match field {
            Field::Thermal(field) => contact.with_field(field),
            Field::Heating(field) => contact.with_field(field),
            Field::Diffusion(field) => contact.with_field(*field),
        })
    }
}
