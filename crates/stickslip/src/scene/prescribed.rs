//! Parts with prescribed velocities.

use std::sync::Arc;

use nalgebra::{SMatrix, SVector};
use stickslip_solvers::Frames;

use super::components::components_of;
use crate::{BoundaryCondition, BoundaryPart, StepError};

/// A velocity of a part as a function of time.
type Velocity<const C: usize> = Arc<dyn Fn(f64) -> [f64; C] + Send + Sync>;

/// Components with a prescribed velocity; fixed at zero without a function of time.
#[derive(Clone)]
pub(crate) struct Prescribed<const C: usize> {
    pub(crate) part: BoundaryPart,
    /// The opposite vertices, if the velocity is that relative to them.
    pub(crate) minus: Option<Vec<usize>>,
    pub(crate) components: [bool; C],
    pub(crate) velocity: Option<Velocity<C>>,
    /// Rotated components, in the order of the part's vertices; empty if no vertex has them.
    pub(crate) turned: Vec<Option<Turned<C>>>,
}

/// A vertex of a part whose local axes differ from the part's.
#[derive(Clone, PartialEq)]
pub(crate) struct Turned<const C: usize> {
    /// The map from the part's prescribed components to those of the vertex.
    map: SMatrix<f64, C, C>,
    /// The components of the vertex that are prescribed.
    components: [bool; C],
}

impl<const C: usize> Prescribed<C> {
    /// The velocity at a time [m/s]; zero for a fixed part.
    pub(crate) fn velocity_at(&self, time: f64) -> Result<SVector<f64, C>, StepError> {
        let Some(velocity) = &self.velocity else {
            return Ok(SVector::zeros());
        };
        let velocity = velocity(time);
        for c in (0..C).filter(|&c| self.components[c]) {
            if !velocity[c].is_finite() {
                return Err(StepError::Data {
                    what: "prescribed velocity",
                    vertex: self.part.vertices[0],
                    value: velocity[c],
                });
            }
        }
        Ok(SVector::from(velocity))
    }

    /// The name of the part's boundary condition in messages.
    pub(crate) fn what(&self) -> &'static str {
        if self.minus.is_some() {
            "prescribed slip rate"
        } else if self.velocity.is_some() {
            "moved boundary"
        } else {
            "held boundary"
        }
    }

    /// Finds the vertices with rotated components.
    pub(crate) fn turn(&mut self, frames: &Frames<C>) {
        let of_part = self.part.vertices.iter().enumerate();
        let is_turned = |(_, &vertex): (usize, &usize)| frames.of(vertex).is_some();
        if self.part.axes.is_empty() && !of_part.clone().any(is_turned) {
            return;
        }
        let turned = of_part.map(|(position, &vertex)| {
            if self.part.axes.is_empty() && frames.of(vertex).is_none() {
                return None;
            }
            let mut axes = self.part.axes_at::<C>(position);
            for c in (0..C).filter(|&c| !self.components[c]) {
                axes.column_mut(c).fill(0.0);
            }
            let map = match frames.of(vertex) {
                None => axes,
                Some(frame) => frame.tr_mul(&axes),
            };
            let used = |row: usize| components_of(&map.row(row).transpose()).contains(&true);
            Some(Turned {
                map,
                components: std::array::from_fn(used),
            })
        });
        self.turned = turned.collect();
    }

    /// The prescribed components of the vertex at a position, and their values by `value`.
    #[inline]
    pub(crate) fn at(
        &self,
        position: usize,
        value: &SVector<f64, C>,
    ) -> (SVector<f64, C>, [bool; C]) {
        match self.turned.get(position) {
            None | Some(None) => (*value, self.components),
            Some(Some(turned)) => {
                let own = |c: usize| if self.components[c] { value[c] } else { 0.0 };
                let value = turned.map * SVector::from_fn(|c, _| own(c));
                (value, turned.components)
            }
        }
    }

    /// Writes the components that are prescribed.
    pub(crate) fn set(&self, value: &SVector<f64, C>, field: &mut [SVector<f64, C>]) {
        for (position, &vertex) in self.part.vertices.iter().enumerate() {
            let (value, components) = self.at(position, value);
            for c in (0..C).filter(|&c| components[c]) {
                field[vertex][c] = value[c];
            }
        }
    }
}

/// The boundary conditions of fixed and driven parts.
pub(crate) fn conditions_of<const C: usize>(
    prescribed: &[Prescribed<C>],
) -> impl Iterator<Item = BoundaryCondition> {
    let mut count = [0, 0, 0];
    prescribed.iter().map(move |part| {
        let (kind, condition): (_, fn(usize) -> BoundaryCondition) =
            match (&part.minus, &part.velocity) {
                (Some(_), _) => (2, BoundaryCondition::SlipRate),
                (None, Some(_)) => (1, BoundaryCondition::Prescribed),
                (None, None) => (0, BoundaryCondition::Fixed),
            };
        count[kind] += 1;
        condition(count[kind])
    })
}
