//! Linear geometric multigrid for `B + D` on the kept unknowns, where `D` and the set change often.
//!
//! Truncation and the slopes of friction change the frictional vertices alone. On each level a refresh therefore
//! recomputes only the rows of those vertices and their neighbours: a strip along the boundary instead of a Galerkin
//! product over the body.

mod coarse;
mod cycle;
mod galerkin;
mod level;
mod line_smoother;
mod linked_transfers;
mod slab_cycle;
mod smoother;
#[cfg(test)]
mod tests;
mod tied_cycle;
mod whole;

pub(crate) use level::Linearization;
pub(crate) use whole::LOOK;

use nalgebra::SVector;

use crate::colouring::Colouring;
use crate::energy::expect;
use crate::{Basis, BlockMatrix, MeshId, Prolongation, SolveError, Transfers};
use coarse::CoarseSolver;
use level::{Cut, Fields, Level, Transfer};
use whole::Whole;

/// A hierarchy of operators, coarsest first, and the cycle on it.
#[derive(Debug)]
pub(crate) struct Multigrid<const C: usize> {
    transfers: Vec<Transfer>,
    /// The defect of the transfers.
    refused: Option<SolveError>,
    /// The finest mesh, if known.
    pub(crate) mesh: Option<MeshId>,
    levels: Vec<Level<C>>,
    /// The fields of all levels but the finest, whose fields are the caller's.
    fields: Vec<Fields<C>>,
    /// Rows at the ends of wide slabs of the finest level.
    edges: Vec<SVector<f64, C>>,
    cut: Cut,
    /// The vertices whose rows can change; the strips of `levels` were made for them.
    frictional: Vec<usize>,
    coarse: Option<CoarseSolver<C>>,
    whole: Whole<C>,
    basis: Basis<C>,
    /// The transfers without links, if the basis has any.
    unlinked: Vec<Prolongation>,
    pub(crate) pre: usize,
    pub(crate) post: usize,
}

impl<const C: usize> Multigrid<C> {
    /// A hierarchy from its transfers, with `pre` and `post` smoothing sweeps.
    pub(crate) fn new(transfers: &Transfers, pre: usize, post: usize) -> Self {
        let prolongations = transfers.prolongations();
        Self::on(
            prolongations.iter().map(Transfer::new).collect(),
            Transfers::check(prolongations).err(),
            transfers.mesh(),
            (pre, post),
        )
    }

    fn on(
        transfers: Vec<Transfer>,
        refused: Option<SolveError>,
        mesh: Option<MeshId>,
        (pre, post): (usize, usize),
    ) -> Self {
        Self {
            transfers,
            refused,
            mesh,
            levels: Vec::new(),
            fields: Vec::new(),
            edges: Vec::new(),
            cut: Colouring::new,
            frictional: Vec::new(),
            coarse: None,
            whole: Whole::default(),
            basis: Basis::default(),
            unlinked: Vec::new(),
            pre,
            post,
        }
    }

    /// The same levels, without an operator on them.
    pub(crate) fn unprepared(&self) -> Self {
        let (transfers, refused) = (self.transfers.clone(), self.refused.clone());
        Self {
            cut: self.cut,
            basis: self.basis.clone(),
            unlinked: self.unlinked.clone(),
            ..Self::on(transfers, refused, self.mesh, (self.pre, self.post))
        }
    }

    pub(crate) fn basis(&self) -> &Basis<C> {
        &self.basis
    }

    /// Sets the basis of later operators. Coarser levels keep the coordinates, and have the links of the vertices that
    /// they share with the finest: with `L` those of two levels, a transfer is `L_f^-1 P L_c`.
    pub(crate) fn change_basis(&mut self, basis: &Basis<C>) {
        let given = if self.unlinked.is_empty() {
            let transfers = self.transfers.iter();
            transfers
                .map(|transfer| transfer.prolongation.clone())
                .collect()
        } else {
            std::mem::take(&mut self.unlinked)
        };
        let linked = linked_transfers::transfers(&given, &basis.links);
        self.transfers = linked.iter().map(Transfer::new).collect();
        if !basis.links.is_empty() {
            self.unlinked = given;
        }
        self.basis = basis.clone();
        self.levels.clear();
    }

    /// Computes the Galerkin products of `operator` without friction.
    pub(crate) fn prepare(
        &mut self,
        operator: &BlockMatrix<C>,
        fixed: &[[bool; C]],
        frictional: &[usize],
    ) -> Result<(), SolveError> {
        if let Some(error) = &self.refused {
            return Err(error.clone());
        }
        let expected = self
            .transfers
            .last()
            .map_or(operator.rows(), Transfer::fine_count);
        expect([(expected, operator.rows())])?;
        let reusable = self.frictional == frictional
            && self
                .levels
                .last()
                .is_some_and(|finest| finest.same_pattern(operator, fixed));
        if !reusable {
            self.frictional = frictional.to_vec();
            let finest = Level::finest(operator, self.cut, fixed, frictional, &self.basis.axes);
            let edges = slab_cycle::edge_count(&finest.slabs) * finest.slabs.wide_count();
            self.edges = vec![SVector::zeros(); edges];
            self.levels = vec![finest];
            for transfer in self.transfers.iter().rev() {
                let finer = &self.levels[self.levels.len() - 1];
                let coarser = Level::coarsened(finer, self.cut, transfer);
                self.levels.push(coarser);
            }
            self.levels.reverse();
            self.fields = self.levels[..self.levels.len() - 1]
                .iter()
                .map(Fields::of)
                .collect();
            self.coarse = Some(CoarseSolver::analyse(&self.levels[0].matrix)?);
            self.whole = Whole::default();
        }
        self.whole.in_use = false;
        let finest = self.levels.len() - 1;
        self.levels[finest].restore(operator);
        for l in (0..finest).rev() {
            let (coarser, finer) = self.levels.split_at_mut(l + 1);
            coarser[l].assemble(&finer[0], &self.transfers[l]);
        }
        for level in &mut self.levels[1..] {
            level.tie();
        }
        if let Some(coarse) = &mut self.coarse {
            // faer takes memory of a thread's own the first time. Whether the matrix is definite is asked
            // when friction has been added.
            let _ = coarse.factorize(&self.levels[0].matrix);
        }
        Ok(())
    }

    /// Updates the strips with the slopes of friction and the truncated components.
    pub(crate) fn refresh(
        &mut self,
        operator: &BlockMatrix<C>,
        linearization: &Linearization<'_, C>,
    ) -> Result<(), SolveError> {
        let finest = self.levels.len() - 1;
        self.levels[finest].linearize(operator, linearization)?;
        for l in (0..finest).rev() {
            let (coarser, finer) = self.levels.split_at_mut(l + 1);
            coarser[l].refresh(&finer[0], &self.transfers[l]);
        }
        if self.whole.in_use {
            self.whole.factorize(&self.levels[finest]);
        }
        let level = &self.levels[0];
        let Some(coarse) = &mut self.coarse else {
            return Ok(());
        };
        let factorized = coarse.factorize(&level.matrix);
        factorized.map_err(|error| match error {
            SolveError::RigidBodyMode { vertex } => SolveError::RigidBodyMode {
                vertex: self.on_finest(vertex),
            },
            other => other,
        })
    }

    /// The vertex of the finest level with a pivot of the coarsest matrix that rounding may have made.
    pub(crate) fn rounded_pivot(&self) -> Option<usize> {
        let vertex = self.coarse.as_ref()?.rounded_pivot()?;
        Some(self.on_finest(vertex))
    }

    /// The vertex of the finest level at a vertex of the coarsest.
    fn on_finest(&self, coarse: usize) -> usize {
        let transfers = self.transfers.iter();
        transfers.fold(coarse, |vertex, transfer| transfer.copy_of(vertex))
    }

    /// The matrix of the finest level as of the last refresh.
    pub(crate) fn matrix(&self) -> &BlockMatrix<C> {
        &self.levels[self.levels.len() - 1].matrix
    }

    /// The inverse of a diagonal block of the finest level on its kept components.
    pub(crate) fn inverse_block(&self, vertex: usize) -> &nalgebra::SMatrix<f64, C, C> {
        &self.levels[self.levels.len() - 1].inverses[vertex]
    }

    /// Whether a cycle is an exact solve of the finest level.
    pub(crate) fn is_exact(&self) -> bool {
        self.whole.in_use
    }

    /// Tries cycles first again.
    pub(crate) fn cycle_again(&mut self) {
        self.whole.in_use = false;
    }

    /// Replaces so many further cycles of a problem by an exact solve, until [`cycle_again`](Self::cycle_again); false
    /// if that costs more, or the cycle is exact already.
    pub(crate) fn replace_cycles(&mut self, ahead: f64) -> bool {
        let finest = &self.levels[self.levels.len() - 1];
        !self.transfers.is_empty() && !self.whole.in_use && self.whole.replace_cycles(ahead, finest)
    }

    /// One cycle from zero for the right-hand side `residual`, whose dropped components are zero; `image` becomes the
    /// product of the matrix and the correction.
    pub(crate) fn cycle(
        &mut self,
        residual: &[SVector<f64, C>],
        correction: &mut [SVector<f64, C>],
        image: &mut [SVector<f64, C>],
    ) {
        if self.whole.in_use {
            let level = &self.levels[self.levels.len() - 1];
            self.whole.solve(level, residual, correction);
            cycle::multiply(level, correction, image);
        } else {
            cycle::run(self, residual, correction, image);
        }
    }
}
