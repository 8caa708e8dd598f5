//! Hydraulic properties of a fault zone.

use super::DiffusionError;
use super::error::{not_negative, positive};
use crate::PerVertex;

impl PerVertex {
    /// The values of so many cells; `check` sees each with its number.
    pub(super) fn values(
        &self,
        what: &'static str,
        count: usize,
        check: impl Fn(&'static str, Option<usize>, f64) -> Result<(), DiffusionError>,
    ) -> Result<Vec<f64>, DiffusionError> {
        match self {
            Self::Uniform(value) => {
                check(what, None, *value)?;
                Ok(vec![*value; count])
            }
            Self::Each(values) if values.len() == count => {
                for (cell, &value) in values.iter().enumerate() {
                    check(what, Some(cell), value)?;
                }
                Ok(values.clone())
            }
            Self::Each(values) => Err(DiffusionError::Count {
                what,
                expected: count,
                found: values.len(),
            }),
        }
    }
}

/// The hydraulic properties of a fault zone, uniform or per cell.
///
/// The hydraulic diffusivity is `k/(eta_f beta phi)` [m^2/s].
#[derive(Debug, Clone, PartialEq)]
pub struct Hydraulics {
    /// The permeability `k` [m^2], at least 0; a cell of permeability 0 is sealed.
    pub permeability: PerVertex,
    /// The viscosity of the fluid `eta_f` [Pa s], above 0.
    pub viscosity: PerVertex,
    /// The storage `beta phi` [1/Pa], above 0: the porosity times the compressibility of fluid and pores.
    pub storage: PerVertex,
    /// The hydraulic thickness of the zone `w_h` \[m\], above 0.
    pub thickness: PerVertex,
}

/// The properties of each cell, in the order of the cells.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Properties {
    /// The permeability [m^2].
    pub permeability: Vec<f64>,
    /// Thickness over viscosity [m/(Pa s)]: times permeability, the mobility.
    pub per_permeability: Vec<f64>,
    /// The viscosity [Pa s].
    pub viscosity: Vec<f64>,
    /// The storage times the thickness [m/Pa].
    pub storage: Vec<f64>,
    /// The thickness \[m\].
    pub thickness: Vec<f64>,
}

impl Hydraulics {
    /// The properties in the order of cells, from the vertex of each.
    pub(super) fn properties(&self, vertices: &[usize]) -> Result<Properties, DiffusionError> {
        let count = vertices.len();
        let sorted = |values: Vec<f64>| -> Vec<f64> {
            vertices.iter().map(|&vertex| values[vertex]).collect()
        };
        let permeability = self
            .permeability
            .values("permeability [m^2]", count, not_negative)?;
        let viscosity = self.viscosity.values("viscosity [Pa s]", count, positive)?;
        let storage = self
            .storage
            .values("storage beta phi [1/Pa]", count, positive)?;
        let thickness = self
            .thickness
            .values("hydraulic thickness [m]", count, positive)?;
        let of = |values: &[f64], others: &[f64], join: fn(f64, f64) -> f64| -> Vec<f64> {
            values
                .iter()
                .zip(others)
                .map(|(&a, &b)| join(a, b))
                .collect()
        };
        Ok(Properties {
            per_permeability: sorted(of(&thickness, &viscosity, |w, eta| w / eta)),
            storage: sorted(of(&storage, &thickness, |beta, w| beta * w)),
            permeability: sorted(permeability),
            viscosity: sorted(viscosity),
            thickness: sorted(thickness),
        })
    }
}
