//! Permeability that slip raises and time heals.

use super::error::{not_negative, positive};
use super::{Diffusion, DiffusionError};
use crate::PerVertex;

/// Permeability that rises with slip and heals with time (Zhu et al., Nat. Commun. 11, 4833, 2020):
///
/// ```text
/// k' = -(V/L_k) (k - k_max) - (k - k_min)/T_k
/// ```
///
/// It is exact at constant slip rates; diffusion takes it at the middle of a step.
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("permeability enhancement", "healing", "fault valving"))]
pub struct PermeabilityEvolution {
    /// The permeability `k_min` that healing tends to [m^2], at least 0.
    pub minimum: PerVertex,
    /// The permeability `k_max` that slip tends to [m^2], at least `k_min`.
    pub maximum: PerVertex,
    /// The slip `L_k` over which permeability rises \[m\], above 0.
    pub slip_distance: PerVertex,
    /// The time `T_k` over which permeability heals \[s\], above 0; infinite for none.
    pub healing_time: PerVertex,
}

/// The evolution in each cell: of `x = (k - k_min)/(k_max - k_min)`, `x' = -(V/L_k) (x - 1) - x/T_k`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Evolution {
    minimum: Vec<f64>,
    range: Vec<f64>,
    /// `1/L_k`.
    rise: Vec<f64>,
    /// `1/T_k`.
    heal: Vec<f64>,
    /// The initial `x`.
    pub initial: Vec<f64>,
}

impl Evolution {
    /// The permeability of a cell.
    pub(super) fn permeability(&self, cell: usize, excess: f64) -> f64 {
        self.minimum[cell] + self.range[cell] * excess
    }

    /// The excess after a time at a slip rate.
    pub(super) fn after(&self, cell: usize, excess: f64, slip_rate: f64, dt: f64) -> f64 {
        let (rise, heal) = (slip_rate.abs() * self.rise[cell], self.heal[cell]);
        let rate = rise + heal;
        if rate <= 0.0 {
            return excess;
        }
        // exp(-rate dt) to all digits of what it lacks to 1.
        excess - (rise / rate - excess) * (-rate * dt).exp_m1()
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
