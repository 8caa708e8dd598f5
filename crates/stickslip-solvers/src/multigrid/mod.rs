//! Linear geometric multigrid for `B + D` on the kept unknowns, where `D` and the set change often.
//!
//! Truncation and the slopes of friction change the frictional vertices alone. On each level a refresh therefore
//! recomputes only the rows of those vertices and their neighbours: a strip along the boundary instead of a Galerkin
//! product over the body.

mod coarse;
mod couplings;
mod cycle;
mod entries;
mod fields;
mod galerkin;
mod inverses;
mod level;
mod line_smoother;
mod linearization;
mod linked_transfers;
mod packed;
mod preparation;
mod slab_cycle;
mod smoother;
#[cfg(test)]
mod tests;
mod tied_cycle;
mod transfer;
mod whole;

pub(crate) use linearization::Linearization;
pub(crate) use whole::LOOK;

use nalgebra::{SMatrix, SVector};

use crate::colouring::Colouring;
use crate::{Basis, BlockMatrix, MeshId, Prolongation, SolveError, Transfers};
use coarse::CoarseSolver;
use fields::Fields;
use level::{Cut, Level};
use transfer::Transfer;
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
    /// Whether the couplings are in single precision.
    pub(crate) single: bool,
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
            single: false,
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
            single: self.single,
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

    /// `x . H x` by the matrix of the finest level as of the last refresh, of a field without dropped components.
    pub(crate) fn quadratic(&self, operator: &BlockMatrix<C>, x: &[SVector<f64, C>]) -> f64 {
        let finest = &self.levels[self.levels.len() - 1];
        finest.of_operator(operator).quadratic(x)
    }

    /// A bound on the part of `x . H x` that the rounding of couplings changes, if a cycle reads them.
    pub(crate) fn rounding(&self, x: &[SVector<f64, C>]) -> f64 {
        let finest = &self.levels[self.levels.len() - 1];
        if self.whole.in_use || self.levels.len() == 1 || !finest.sets.is_empty() {
            return 0.0;
        }
        finest.couplings.rounding(x)
    }

    /// The step of one vertex of the finest level, on its kept components, that balances a force.
    pub(crate) fn balanced(&self, vertex: usize, force: &SVector<f64, C>) -> SVector<f64, C> {
        self.levels[self.levels.len() - 1]
            .couplings
            .balanced(vertex, force)
    }

    /// The inverses of the diagonal blocks of the finest level on its kept components; at vertices without friction they
    /// are those of the operator. `None` if the couplings are rounded, since the diagonal blocks take up the errors.
    pub(crate) fn inverses(&self) -> Option<&[SMatrix<f64, C, C>]> {
        self.levels[self.levels.len() - 1].couplings.inverses()
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
    pub(crate) fn replace_cycles(&mut self, operator: &BlockMatrix<C>, ahead: f64) -> bool {
        let last = self.levels.len() - 1;
        let finest = &mut self.levels[last];
        !self.transfers.is_empty()
            && !self.whole.in_use
            && self.whole.replace_cycles(ahead, finest, operator)
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
