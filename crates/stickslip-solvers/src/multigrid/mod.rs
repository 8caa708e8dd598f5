//! Linear geometric multigrid for `B + D` on the kept unknowns, where `D` and the set change often.
//!
//! Truncation and the slopes of friction touch the frictional vertices alone. A refresh therefore
//! recomputes, on each level, only the rows that those vertices and their neighbours reach: a strip
//! along the boundary instead of a Galerkin product over the body.

mod coarse;
mod cycle;
mod galerkin;
mod level;
mod line_smoother;
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
use crate::{BlockMatrix, Frames, SolveError, Transfers};
use coarse::CoarseSolver;
use level::{Cut, Fields, Level, Transfer};
use whole::Whole;

/// A hierarchy of operators, coarsest first, and the cycle on it.
#[derive(Debug)]
pub(crate) struct Multigrid<const C: usize> {
    transfers: Vec<Transfer>,
    /// What is wrong with the transfers.
    refused: Option<SolveError>,
    /// The finest mesh, if it is known.
    pub(crate) mesh: Option<u64>,
    levels: Vec<Level<C>>,
    /// Of all levels but the finest, whose fields are the caller's.
    fields: Vec<Fields<C>>,
    /// Rows at the ends of wide slabs of the finest level.
    edges: Vec<SVector<f64, C>>,
    cut: Cut,
    /// The vertices whose rows may change, which the strips of `levels` were made for.
    frictional: Vec<usize>,
    coarse: Option<CoarseSolver<C>>,
    whole: Whole<C>,
    frames: Frames<C>,
    pub(crate) pre: usize,
    pub(crate) post: usize,
}

impl<const C: usize> Multigrid<C> {
    /// Takes the transfers, and `pre` and `post` smoothing sweeps.
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
        mesh: Option<u64>,
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
            frames: Frames::default(),
            pre,
            post,
        }
    }

    /// The same levels, without an operator on them.
    pub(crate) fn unprepared(&self) -> Self {
        let (transfers, refused) = (self.transfers.clone(), self.refused.clone());
        Self {
            cut: self.cut,
            frames: self.frames.clone(),
            ..Self::on(transfers, refused, self.mesh, (self.pre, self.post))
        }
    }

    pub(crate) fn frames(&self) -> &Frames<C> {
        &self.frames
    }

    /// The operators to come are in these frames.
    pub(crate) fn turn(&mut self, frames: &Frames<C>) {
        self.frames = frames.clone();
        self.levels.clear();
    }

    /// Galerkin products of `operator` without friction.
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
            let finest = Level::finest(operator, self.cut, fixed, frictional, &self.frames);
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

    /// Brings the strips up to date with the slopes of friction and the truncated components.
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

    /// The vertex of the finest level at which the coarsest matrix has a pivot so small that rounding may have made
    /// it.
    pub(crate) fn rounded_pivot(&self) -> Option<usize> {
        let vertex = self.coarse.as_ref()?.rounded_pivot()?;
        Some(self.on_finest(vertex))
    }

    /// The vertex of the finest level that is one of the coarsest.
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

    /// Cycles are tried first from here on.
    pub(crate) fn cycle_again(&mut self) {
        self.whole.in_use = false;
    }

    /// Puts an exact solve in the place of so many cycles that a problem still needs, until they are tried
    /// [again](Self::cycle_again); false where it would cost more, or is one already.
    pub(crate) fn replace_cycles(&mut self, ahead: f64) -> bool {
        let finest = &self.levels[self.levels.len() - 1];
        !self.transfers.is_empty() && !self.whole.in_use && self.whole.replace_cycles(ahead, finest)
    }

    /// One cycle from zero for the right-hand side `residual`, whose dropped components are zero;
    /// `image` becomes the product of the matrix and the correction.
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
