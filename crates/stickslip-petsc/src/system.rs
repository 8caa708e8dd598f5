//! A matrix with its constraints, as PETSc takes it.

use std::ffi::c_int;
use std::sync::Arc;

use nalgebra::{SMatrix, SVector};
use stickslip::Matrix;
use stickslip::solvers::Basis;

use crate::basis::{SharedBasis, coarsened};
use crate::ffi::{Multigrid, RowsOf};
use crate::hierarchy::Interpolation;
use crate::layout::Layout;
use crate::world::or_abort;
use crate::{DistributedMatrix, DistributedSpace, Error};

/// The data of a space for multigrid.
#[derive(Debug)]
pub(crate) struct Shape<const C: usize> {
    dimension: usize,
    points: Vec<f64>,
    interpolations: Arc<Vec<Interpolation>>,
    layout: Arc<Layout>,
    /// The bases of the levels, finest first; none for coordinates and no faults.
    bases: Vec<SharedBasis<C>>,
}

impl<const C: usize> Shape<C> {
    pub(crate) fn of<const D: usize>(space: &DistributedSpace<D>) -> Self {
        let points = space.points();
        Self {
            dimension: D,
            points: points.iter().flat_map(|x| x.iter().copied()).collect(),
            interpolations: space.interpolations.clone(),
            layout: space.layout().clone(),
            bases: Vec::new(),
        }
    }

    /// Sets the basis of later operators. A coarser level has the axes and links of the vertices that it shares with the
    /// finest one. A failure of MPI ends all processes.
    pub(crate) fn change_basis(&mut self, basis: &Basis<C>) {
        self.bases = or_abort(self.levels(basis)).unwrap_or_default();
    }

    fn levels(&self, basis: &Basis<C>) -> Result<Vec<SharedBasis<C>>, Error> {
        let (world, mut own) = (self.layout.world, basis.clone());
        let mut levels = vec![SharedBasis::new(world, self.layout.first, basis)?];
        for level in self.interpolations.iter() {
            let copies = level.copies.iter().map(|&copy| copy as usize);
            own = coarsened(&own, copies);
            levels.push(SharedBasis::new(world, level.first as u64, &own)?);
        }
        Ok(levels)
    }

    /// Copies an operator to PETSc, the rows and columns of fixed components replaced by their diagonal entries, and sets
    /// multigrid up for it. A failure of PETSc ends all processes.
    pub(crate) fn multigrid(
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
        let columns = operator.columns.iter();
        let columns: Vec<c_int> = columns.map(|&j| layout.global(j) as c_int).collect();
        let starts = operator.starts.iter().map(|&start| start as c_int);
        let starts: Vec<c_int> = starts.collect();
        let vertices = vertices.iter().map(|&vertex| vertex as c_int);
        let vertices: Vec<c_int> = vertices.collect();
        let rows = RowsOf {
            // Rigid motions are told in coordinates.
            points: (C == self.dimension && self.bases.is_empty()).then_some(&self.points[..]),
            free: &free[..layout.owned],
            starts: &starts,
            columns: &columns,
            first: layout.first as usize,
            values: &values,
            vertices: &vertices,
        };
        let pairs = (0..self.interpolations.len()).map(|level| match &self.bases[..] {
            [] => None,
            bases => Some([&bases[level], &bases[level + 1]]),
        });
        let transfers = self.interpolations.iter().zip(pairs);
        let transfers = transfers.map(|(level, bases)| level.by_components(bases));
        or_abort(Multigrid::new(&rows, transfers))
    }
}
