//! A diagonal operator: every vertex is a separate problem, or every pair across a fault.

mod pair;

use std::ops::Range;

use nalgebra::{SMatrix, SVector};

use stickslip_core::compiled;

use crate::block::{decouple, inverse, is_definite_with};
use crate::block_matrix::Rows;
use crate::field::clear_masked;
use crate::parts::{for_contact, sum_parts};
use crate::{BlockMatrix, Energy, NonsmoothSolver, SolveError, SolveReport, Stopping};
use pair::Pair;

/// Solves a block diagonal problem exactly, one vertex after the other. An explicit scheme with a lumped mass has such
/// a problem. Between two sides of a fault the blocks are those of pairs: with the masses `m_+` and `m_-`
///
/// ```text
/// [[m_+, m_+ Q], [m_+ Q^T, m_+ + m_-]]      for the jump, along axes Q of its own, and the minus side
/// ```
#[derive(Debug, Clone, Default)]
pub struct Diagonal<const C: usize> {
    /// The diagonals of the inverse blocks; of vertices with other entries, those are in `coupled`.
    inverses: Vec<SVector<f64, C>>,
    /// The vertices whose inverse block is not diagonal, increasing, and it.
    coupled: Vec<(usize, SMatrix<f64, C, C>)>,
    /// The blocks of the frictional vertices, and their fixed components.
    blocks: Vec<SMatrix<f64, C, C>>,
    fixed: Vec<[bool; C]>,
    /// The vertices of `blocks` that are no part of a pair, and their velocities.
    single: Vec<usize>,
    minimizers: Vec<SVector<f64, C>>,
    pairs: Vec<Pair<C>>,
    /// The velocities of pairs.
    paired: Vec<[SVector<f64, C>; 2]>,
    /// The vertices with a fixed component, and the fixed part of the velocity there.
    held: Vec<usize>,
    prescribed: Vec<SVector<f64, C>>,
    /// The vertices with friction, a fixed component, an inverse that is not diagonal, or a partner, increasing.
    others: Vec<usize>,
}

impl<const C: usize> Diagonal<C> {
    /// A solver without an operator so far.
    pub fn new() -> Self {
        Self::default()
    }

    /// The diagonals of the inverse blocks.
    #[cfg(feature = "fem")]
    pub(crate) fn inverses(&self) -> &[SVector<f64, C>] {
        &self.inverses
    }

    /// The vertices whose velocity is not the diagonal of the inverse times the load, increasing.
    #[cfg(feature = "fem")]
    pub(crate) fn others(&self) -> &[usize] {
        &self.others
    }

    /// Whether all blocks stay positive definite with a number added on the diagonal of each frictional vertex: a matrix of
    /// blocks is if each of them is.
    pub(crate) fn is_definite(&self, slopes: &[f64]) -> bool {
        let mut single = self.single.iter();
        let mut pairs = self.pairs.iter();
        slopes.len() == self.blocks.len()
            && single.all(|&k| is_definite_with(slopes[k], &self.blocks[k], &self.fixed[k]))
            && pairs.all(|pair| pair.is_definite(slopes, &self.fixed))
    }

    /// The minimiser; with `all` at all vertices, without at those that are not free.
    pub(crate) fn solve(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        norm: &BlockMatrix<C>,
        v: &mut [SVector<f64, C>],
        all: bool,
    ) -> Result<SolveReport, SolveError> {
        let (size, frictional) = (self.inverses.len(), self.blocks.len());
        energy.check_sizes(size, frictional, norm, v)?;
        for (paired, pair) in self.paired.iter_mut().zip(&self.pairs) {
            *paired = pair.solve(energy, v);
        }
        let (matrix, values) = (Rows::of(energy.operator), energy.operator.data());
        let own = |i: usize| values[matrix.starts[i] as usize];
        let prescribed = |i: usize, v: &SVector<f64, C>| {
            SVector::<f64, C>::from_fn(|c, _| if energy.fixed[i][c] { v[c] } else { 0.0 })
        };
        let (single, blocks, velocity) = (&self.single, &self.blocks, &*v);
        let minimize = |part: Range<usize>, minimizers: &mut [SVector<f64, C>]| {
            for (minimizer, &k) in minimizers.iter_mut().zip(&single[part]) {
                let i = energy.vertices[k];
                let held = prescribed(i, &velocity[i]);
                let mut force = energy.load[i] - own(i) * held;
                clear_masked(&mut force, &energy.fixed[i]);
                *minimizer = energy.potentials.minimize(k, &blocks[k], &force) + held;
            }
        };
        for_contact(single.len(), &mut self.minimizers[..], &minimize);
        for (held, &i) in self.prescribed.iter_mut().zip(&self.held) {
            *held = prescribed(i, &v[i]);
        }
        let own_part = |part: Range<usize>, v: &mut [SVector<f64, C>]| {
            let mut sum = SVector::<f64, C>::zeros();
            let (inverses, load) = (&self.inverses[part.clone()], &energy.load[part]);
            for ((v, inverse), load) in v.iter_mut().zip(inverses).zip(load) {
                *v = inverse.component_mul(load);
                sum += *v;
            }
            sum.sum()
        };
        let mut sum = match all {
            true => sum_parts(0..v.len(), &mut *v, &own_part),
            false => (self.others.iter())
                .map(|&i| own_part(i..i + 1, &mut v[i..=i]))
                .sum(),
        };
        for (i, inverse) in &self.coupled {
            v[*i] = inverse * energy.load[*i];
            sum += v[*i].sum();
        }
        // The inverse is zero where a component is fixed.
        for (held, &i) in self.prescribed.iter().zip(&self.held) {
            let pull = own(i) * held;
            let place = self.coupled.binary_search_by_key(&i, |(vertex, _)| *vertex);
            v[i] += held
                - match place {
                    Ok(place) => self.coupled[place].1 * pull,
                    Err(_) => self.inverses[i].component_mul(&pull),
                };
        }
        for (minimizer, &k) in self.minimizers.iter().zip(&self.single) {
            v[energy.vertices[k]] = *minimizer;
            sum += minimizer.sum();
        }
        for (paired, pair) in self.paired.iter().zip(&self.pairs) {
            for (&i, velocity) in pair.vertices.iter().zip(paired) {
                v[i] = *velocity;
                sum += velocity.sum();
            }
        }
        // A sum of finite numbers that overflows is no velocity either.
        if sum.is_finite() {
            Ok(SolveReport {
                iterations: 1,
                cycles: 0,
                error: 0.0,
            })
        } else {
            Err(SolveError::NotFinite {
                iteration: 1,
                change: sum,
            })
        }
    }
}

impl<const C: usize> NonsmoothSolver<BlockMatrix<C>, C> for Diagonal<C> {
    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        Box::new(self.clone())
    }

    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<C>, C>) -> Result<(), SolveError> {
        energy.check()?;
        let rows = Rows::of(energy.operator);
        let mut pairs: Vec<([usize; 2], SMatrix<f64, C, C>)> = Vec::new();
        self.inverses.clear();
        self.coupled.clear();
        self.held.clear();
        for (vertex, fixed) in energy.fixed.iter().enumerate() {
            let refused = SolveError::NotDiagonal { vertex };
            let mut row = rows.row(vertex);
            let (first, second, None) = (row.next(), row.next(), row.next()) else {
                return Err(refused);
            };
            let both = [first, second];
            let other = both
                .into_iter()
                .flatten()
                .find(|&(column, _)| column != vertex);
            if let Some((partner, coupling)) = other {
                let has = |i: usize, j: usize| rows.row(i).any(|(column, _)| column == j);
                let closed = rows.row(partner).count() == 2;
                if !closed || !has(vertex, vertex) || !has(partner, vertex) {
                    return Err(refused);
                }
                let frictional =
                    [vertex, partner].map(|i| energy.vertices.binary_search(&i).is_ok());
                match frictional {
                    [true, true] => return Err(refused),
                    [true, false] => pairs.push(([vertex, partner], *coupling)),
                    [false, false] if vertex < partner => {
                        pairs.push(([vertex, partner], *coupling))
                    }
                    _ => {}
                }
                self.inverses.push(SVector::zeros());
                continue;
            }
            let Some((_, block)) = first else {
                return Err(refused);
            };
            let inverse = inverse(block, fixed).ok_or(SolveError::IndefiniteBlock { vertex })?;
            let diagonal = inverse.diagonal();
            if inverse != SMatrix::from_diagonal(&diagonal) {
                self.coupled.push((vertex, inverse));
            }
            self.inverses.push(diagonal);
            if fixed.iter().any(|&fixed| fixed) {
                self.held.push(vertex);
            }
        }
        self.pairs.clear();
        for (vertices, coupling) in pairs {
            self.pairs.push(Pair::new(energy, vertices, coupling)?);
        }
        self.paired.resize(self.pairs.len(), [SVector::zeros(); 2]);
        self.blocks.clear();
        self.fixed.clear();
        self.single.clear();
        for (k, &vertex) in energy.vertices.iter().enumerate() {
            let row = rows.range(vertex);
            if row.len() == 1 {
                self.single.push(k);
            }
            let block = &rows.values[row.start];
            self.blocks.push(decouple(block, &energy.fixed[vertex]));
            self.fixed.push(energy.fixed[vertex]);
        }
        self.minimizers.resize(self.single.len(), SVector::zeros());
        self.prescribed.resize(self.held.len(), SVector::zeros());
        self.others.clear();
        self.others.extend_from_slice(energy.vertices);
        self.others.extend_from_slice(&self.held);
        self.others
            .extend(self.coupled.iter().map(|(vertex, _)| vertex));
        self.others
            .extend(self.pairs.iter().flat_map(|pair| pair.vertices));
        self.others.sort_unstable();
        self.others.dedup();
        Ok(())
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        self.solve(energy, stopping.norm, v, true)
    }

    fn is_definite_with(&mut self, slopes: &[f64]) -> Option<bool> {
        Some(self.is_definite(slopes))
    }

    fn into_object(self) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        object(self)
    }
}

compiled! {
    fn object<C>(solver: Diagonal<C>) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        Box::new(solver)
    }
}
