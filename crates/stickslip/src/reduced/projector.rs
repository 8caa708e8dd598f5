//! Between the fields of a body and the coordinates of its reduction.

use std::sync::{Mutex, MutexGuard, PoisonError};

use nalgebra::SVector;
use stickslip_tnnmg::{BlockMatrix, Mode, Operator, SolveError, StaticResponses};

/// The fields that a reduced body is a combination of: static responses to its boundary and to its moved parts, and
/// modes. All are in the frames of the vertices.
pub(super) struct Projector<const C: usize> {
    responses: Mutex<StaticResponses<C>>,
    pub(super) stiffness: BlockMatrix<C>,
    /// Moved parts by one, with what they do to the interior, then modes.
    pub(super) shapes: Vec<Vec<SVector<f64, C>>>,
    /// The shapes that are of moved parts.
    pub(super) handles: usize,
    /// `omega^2` of the modes.
    pub(super) squares: Vec<f64>,
    /// Boundary unknowns.
    pub(super) count: usize,
}

/// `sum of x . y` over the vertices.
pub(super) fn inner<const C: usize>(x: &[SVector<f64, C>], y: &[SVector<f64, C>]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x.dot(y)).sum()
}

impl<const C: usize> Projector<C> {
    pub(super) fn new(
        responses: StaticResponses<C>,
        stiffness: BlockMatrix<C>,
        handles: Vec<Vec<SVector<f64, C>>>,
    ) -> Self {
        Self {
            count: responses.owners().len(),
            handles: handles.len(),
            responses: Mutex::new(responses),
            stiffness,
            shapes: handles,
            squares: Vec::new(),
        }
    }

    /// Nothing is left half done by a panic elsewhere: a substitution overwrites its memory.
    pub(super) fn responses(&self) -> MutexGuard<'_, StaticResponses<C>> {
        self.responses
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn add_modes(&mut self, modes: Vec<Mode<C>>) {
        for mode in modes {
            self.squares.push(mode.angular_frequency.powi(2));
            self.shapes.push(mode.shape);
        }
    }

    pub(super) fn size(&self) -> usize {
        self.count + self.shapes.len()
    }

    /// The forces on the coordinates that do the work of forces on the body.
    pub(super) fn project(
        &self,
        forces: &[SVector<f64, C>],
        onto: &mut [f64],
    ) -> Result<(), SolveError> {
        let (boundary, others) = onto.split_at_mut(self.count);
        self.responses()
            .project(&self.stiffness, forces, boundary)?;
        for (other, shape) in others.iter_mut().zip(&self.shapes) {
            *other = inner(shape, forces);
        }
        Ok(())
    }

    /// The columns of an operator between the coordinates; `boundary` are its entries between those of the boundary.
    pub(super) fn reduce(
        &self,
        operator: &BlockMatrix<C>,
        boundary: &[f64],
    ) -> Result<Vec<Vec<f64>>, SolveError> {
        self.columns(operator, boundary, self.shapes.len())
    }

    /// Those of the stiffness, for which modes are orthogonal to one another and to all that is in equilibrium.
    pub(super) fn reduce_stiffness(&self, boundary: &[f64]) -> Result<Vec<Vec<f64>>, SolveError> {
        let mut columns = self.columns(&self.stiffness, boundary, self.handles)?;
        let first = columns.len();
        for (k, square) in self.squares.iter().enumerate() {
            let mut column = vec![0.0; self.size()];
            column[first + k] = *square;
            columns.push(column);
        }
        Ok(columns)
    }

    fn columns(
        &self,
        operator: &BlockMatrix<C>,
        boundary: &[f64],
        count: usize,
    ) -> Result<Vec<Vec<f64>>, SolveError> {
        let mut columns: Vec<Vec<f64>> = (boundary.chunks_exact(self.count.max(1)))
            .map(|column| column.to_vec())
            .collect();
        let mut forces = vec![SVector::zeros(); self.stiffness.rows()];
        for (k, shape) in self.shapes[..count].iter().enumerate() {
            forces.fill(SVector::zeros());
            operator.multiply_add(1.0, shape, &mut forces);
            let mut column = vec![0.0; self.size()];
            let (boundary, others) = column.split_at_mut(self.count);
            (self.responses()).project(&self.stiffness, &forces, boundary)?;
            // Half of a symmetric matrix is read.
            for (other, shape) in others.iter_mut().zip(&self.shapes[..=k]) {
                *other = inner(shape, &forces);
            }
            columns.push(column);
        }
        Ok(columns)
    }

    /// What the interior does under `forces` beyond what the coordinates know of it, with these at rest: it follows
    /// forces at once.
    pub(super) fn offset(
        &self,
        forces: &[SVector<f64, C>],
    ) -> Result<Vec<SVector<f64, C>>, SolveError> {
        let mut field = vec![SVector::zeros(); forces.len()];
        let at_rest = vec![0.0; self.count];
        (self.responses()).extend(&self.stiffness, Some(forces), &at_rest, &mut field)?;
        let modes = &self.shapes[self.handles..];
        for (shape, square) in modes.iter().zip(&self.squares) {
            let weight = inner(shape, forces) / square;
            add(&mut field, -weight, shape);
        }
        Ok(field)
    }

    /// The field of the body with these coordinates.
    pub(super) fn combine(&self, coordinates: &[f64]) -> Result<Vec<SVector<f64, C>>, SolveError> {
        let mut field = vec![SVector::zeros(); self.stiffness.rows()];
        let (boundary, others) = coordinates.split_at(self.count);
        (self.responses()).extend(&self.stiffness, None, boundary, &mut field)?;
        for (weight, shape) in others.iter().zip(&self.shapes) {
            add(&mut field, *weight, shape);
        }
        Ok(field)
    }
}

/// `field += weight * shape`.
pub(super) fn add<const C: usize>(
    field: &mut [SVector<f64, C>],
    weight: f64,
    shape: &[SVector<f64, C>],
) {
    for (field, shape) in field.iter_mut().zip(shape) {
        *field += shape * weight;
    }
}
