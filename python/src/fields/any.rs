//! The fields of a contact.

use pyo3::prelude::*;
use stickslip::Contact;
use stickslip::fields::{
    Diffusion as Fluid, ShearHeating as Heating, ThermalPressurization as Pressurization,
};
use stickslip::state::StateLaw;

use super::on_planes::{OnPlane, OnPlanes};
use super::{Cells, Diffusion, ShearHeating, ThermalPressurization};
use crate::arguments::wrong_type;

/// A field of any kind, as an argument of Python.
#[derive(IntoPyObjectRef)]
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
#[derive(Clone)]
enum Field {
    Thermal(Pressurization),
    Heating(Heating),
    Diffusion(Box<Fluid>),
    OnPlanes(OnPlanes),
}

/// The fields on the cells of a fault, or at the vertices of a contact.
#[derive(Clone)]
pub(crate) struct Fields(Vec<Field>);

impl Fields {
    /// Those of Python.
    pub(crate) fn on(given: &[AnyField], cells: &Cells) -> PyResult<Self> {
        let (mut fields, mut on_planes) = (Vec::new(), Vec::new());
        for (n, field) in given.iter().enumerate() {
            let name = format!("fields[{n}]");
            fields.push(match field {
                AnyField::Thermal(field) => Field::Thermal(field.get().on(&name, cells)?),
                AnyField::Heating(field) => Field::Heating(field.get().on(&name, cells)?),
                AnyField::Diffusion(field) => {
                    let field = field.get();
                    if let Some((plane, cells)) = cells.of_plane(&name, field.plane())? {
                        let fluid = field.on(&name, &plane)?;
                        on_planes.push(OnPlane { fluid, cells });
                        continue;
                    }
                    Field::Diffusion(Box::new(field.on(&name, cells)?))
                }
            });
        }
        if !on_planes.is_empty() {
            fields.push(Field::OnPlanes(OnPlanes::new(
                on_planes,
                cells.layout.count,
            )));
        }
        Ok(Self(fields))
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
            Field::OnPlanes(field) => contact.with_field(field),
        })
    }
}
