//! A matrix with its constraints, as PETSc takes it.

use std::ffi::c_int;
use std::sync::Arc;

use nalgebra::{SMatrix, SVector};
use stickslip::Operator;

use crate::ffi::{Multigrid, RowsOf};
use crate::hierarchy::Interpolation;
use crate::world::or_abort;
use crate::{DistributedMatrix, DistributedSpace};

/// The data of a space for multigrid.
#[derive(Debug, Clone)]
pub(crate) struct Shape {
    dimension: usize,
    points: Vec<f64>,
    interpolations: Arc<Vec<Interpolation>>,
}

impl Shape {
    pub(crate) fn of<const D: usize>(space: &DistributedSpace<D>) -> Self {
        let points = space.points();
        Self {
            dimension: D,
            points: points.iter().flat_map(|x| x.iter().copied()).collect(),
            interpolations: space.interpolations.clone(),
        }
    }

    /// Copies an operator to PETSc, the rows and columns of fixed components replaced by their diagonal entries, and sets
    /// multigrid up for it. A failure of PETSc ends all processes.
    pub(crate) fn multigrid<const C: usize>(
        &self,
        operator: &DistributedMatrix<C>,
        fixed: &[[bool; C]],
        vertices: &[usize],
    ) -> Option<Multigrid<C>> {
        let layout = &operator.layout;
        let mask = |fixed: &[bool; C]| SVector::from_fn(|c, _| f64::from(u8::from(!fixed[c])));
        let mut free: Vec<SVector<f64, C>> = fixed.iter().map(mask).collect();
        free.resize(layout.owned + layout.ghosts.len(), SVector::zeros());
        layout.update(&mut free);
        let mut values = Vec::with_capacity(operator.columns.len());
        for i in 0..operator.vertex_count() {
            for (j, block) in operator.row(i) {
                values.push(SMatrix::<f64, C, C>::from_fn(|r, c| {
                    let kept = (i, r) == (j, c) || free[i][r] * free[j][c] != 0.0;
                    if kept { block[(r, c)] } else { 0.0 }
                }));
            }
        }
        let number = |&column: &u32| match (column as usize).checked_sub(layout.owned) {
            None => (layout.first + u64::from(column)) as c_int,
            Some(ghost) => layout.ghosts[ghost] as c_int,
        };
        let columns: Vec<c_int> = operator.columns.iter().map(number).collect();
        let starts = operator.starts.iter().map(|&start| start as c_int);
        let starts: Vec<c_int> = starts.collect();
        let vertices = vertices.iter().map(|&vertex| vertex as c_int);
        let vertices: Vec<c_int> = vertices.collect();
        let rows = RowsOf {
            points: (C == self.dimension).then_some(&self.points[..]),
            free: &free[..layout.owned],
            starts: &starts,
            columns: &columns,
            first: layout.first as usize,
            values: &values,
            vertices: &vertices,
        };
        or_abort(Multigrid::new(&rows, &self.interpolations))
    }
}
