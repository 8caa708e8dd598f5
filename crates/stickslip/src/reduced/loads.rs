//! Loads on a reduced body.

use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::SVector;

use super::body::ReducedBody;
use super::support::Support;
use crate::SceneError;
use crate::scene::Load;

impl<const C: usize> ReducedBody<C> {
    /// Loads on the coordinates, those on the boundary along the coordinate axes, as loads are given.
    pub(super) fn loads(&self, given: Vec<Load<C>>) -> Result<Vec<Load<C>>, SceneError> {
        let mut reduced = Vec::new();
        for load in given {
            reduced.push(match load {
                Load::Constant(load) => Load::Constant(self.projected(load)?),
                Load::Scaled(load, factor) => Load::Scaled(self.projected(load)?, factor),
                Load::History(history) => {
                    let size = self.support.fixed.len();
                    let memory = (
                        vec![SVector::zeros(); size],
                        vec![0.0; self.projector.size()],
                    );
                    let memory = Mutex::new(memory);
                    let (support, projector) = (self.support.clone(), self.projector.clone());
                    let moves = self.moves.clone();
                    Load::History(Arc::new(move |time, into: &mut [SVector<f64, C>]| {
                        let mut memory = memory.lock().unwrap_or_else(PoisonError::into_inner);
                        let (load, forces) = &mut *memory;
                        load.fill(SVector::zeros());
                        history(time, load);
                        support.basis.forces_to_basis(load);
                        if projector.project(load, forces).is_err() {
                            // A step with it is refused with the place.
                            forces.fill(f64::NAN);
                        }
                        spread(&moves, forces, into);
                        to_coordinates(&support, into);
                    }))
                }
            });
        }
        Ok(reduced)
    }

    /// A load on the coordinates.
    fn projected(
        &self,
        mut load: Vec<SVector<f64, C>>,
    ) -> Result<Vec<SVector<f64, C>>, SceneError> {
        self.support.basis.forces_to_basis(&mut load);
        let mut forces = vec![0.0; self.projector.size()];
        self.projector.project(&load, &mut forces)?;
        Ok(self.field(&forces))
    }
}

/// Writes coordinates to their components.
pub(super) fn spread<const C: usize>(
    moves: &[[bool; C]],
    coordinates: &[f64],
    field: &mut [SVector<f64, C>],
) {
    let mut coordinates = coordinates.iter();
    for (field, moves) in field.iter_mut().zip(moves) {
        for c in (0..C).filter(|&c| moves[c]) {
            field[c] = coordinates.next().copied().unwrap_or(0.0);
        }
    }
}

/// Rotates the vectors of the boundary to the coordinate axes.
pub(super) fn to_coordinates<const C: usize>(support: &Support<C>, field: &mut [SVector<f64, C>]) {
    if !support.basis.is_empty() {
        for (value, &vertex) in field.iter_mut().zip(&support.boundary) {
            *value = support.basis.axes.to_coordinates(vertex, *value);
        }
    }
}
