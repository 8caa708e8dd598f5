//! Leak-off, and permeability that slip raises, as options of diffusion.

use super::error::{finite, not_negative, positive};
use super::leak_off::Leak;
use super::permeability::Evolution;
use super::{Diffusion, DiffusionError, LeakOff, PermeabilityEvolution};
use crate::PerVertex;

impl Diffusion {
    /// Adds leak-off.
    ///
    /// # Errors
    /// [`DiffusionError`] for drainage times that are not above 0 and pressures that are not finite, with their cell.
    pub fn with_leak_off(mut self, leak_off: &LeakOff) -> Result<Self, DiffusionError> {
        let vertices = self.cells.vertices();
        let count = vertices.len();
        let time = leak_off
            .drainage_time
            .values("drainage time [s]", count, positive)?;
        let far = leak_off
            .far_pressure
            .values("far pressure [Pa]", count, finite)?;
        let of_cells = vertices.iter().zip(&self.capacity);
        self.leak = Some(Leak {
            conductance: of_cells
                .map(|(&vertex, capacity)| capacity / time[vertex])
                .collect(),
            far: vertices.iter().map(|&vertex| far[vertex]).collect(),
        });
        self.changed();
        Ok(self)
    }
}

impl Diffusion {
    /// Lets permeability change with slip and time, from that of [`Hydraulics`](super::Hydraulics).
    ///
    /// # Errors
    /// [`DiffusionError`] for parameters out of their ranges, and an initial permeability outside of that from `k_min` to
    /// `k_max`, with their cell.
    pub fn with_permeability_evolution(
        mut self,
        evolution: &PermeabilityEvolution,
    ) -> Result<Self, DiffusionError> {
        let vertices = self.cells.vertices();
        let values = |of: &PerVertex, what, check: Check| -> Result<Vec<f64>, DiffusionError> {
            let values = of.values(what, vertices.len(), check)?;
            Ok(vertices.iter().map(|&vertex| values[vertex]).collect())
        };
        let minimum = values(&evolution.minimum, "least permeability [m^2]", not_negative)?;
        let maximum = values(
            &evolution.maximum,
            "greatest permeability [m^2]",
            not_negative,
        )?;
        let slip = values(
            &evolution.slip_distance,
            "slip distance of permeability [m]",
            positive,
        )?;
        let heal = values(
            &evolution.healing_time,
            "healing time of permeability [s]",
            above_zero,
        )?;
        let mut initial = Vec::with_capacity(vertices.len());
        for (cell, &vertex) in vertices.iter().enumerate() {
            let (now, [least, greatest]) = (
                self.properties.permeability[cell],
                [minimum[cell], maximum[cell]],
            );
            let refuse = |what, requirement, value| DiffusionError::Value {
                what,
                cell: Some(vertex),
                requirement,
                value,
            };
            if greatest < least {
                let what = "greatest permeability [m^2]";
                return Err(refuse(what, "at least the least permeability", greatest));
            }
            if now < least || now > greatest {
                let what = "initial permeability [m^2]";
                return Err(refuse(what, "from the least to the greatest", now));
            }
            initial.push(if greatest > least {
                (now - least) / (greatest - least)
            } else {
                0.0
            });
        }
        self.evolution = Some(Evolution {
            range: maximum.iter().zip(&minimum).map(|(a, b)| a - b).collect(),
            minimum,
            rise: slip.iter().map(|slip| 1.0 / slip).collect(),
            heal: heal.iter().map(|time| 1.0 / time).collect(),
            initial,
        });
        self.changed();
        Ok(self)
    }

    /// The greatest permeability that a cell can have.
    pub(super) fn greatest_permeability(&self, cell: usize) -> f64 {
        let evolution = self.evolution.as_ref();
        evolution.map_or(self.properties.permeability[cell], |evolution| {
            evolution.permeability(cell, 1.0)
        })
    }
}

type Check = fn(&'static str, Option<usize>, f64) -> Result<(), DiffusionError>;

fn above_zero(what: &'static str, cell: Option<usize>, value: f64) -> Result<(), DiffusionError> {
    if value > 0.0 {
        return Ok(());
    }
    Err(DiffusionError::Value {
        what,
        cell,
        requirement: "above 0",
        value,
    })
}
