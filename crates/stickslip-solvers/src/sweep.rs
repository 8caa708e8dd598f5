//! The nonlinear block Gauss-Seidel sweep: every local problem is solved exactly, one slab of vertices after the other.

#[cfg(all(test, feature = "multigrid"))]
mod tests;

use std::ops::Range;

use nalgebra::{SMatrix, SVector};

use crate::block::{decouple, inverse_at};
#[cfg(feature = "multigrid")]
use crate::block_matrix::partial_product;
use crate::block_matrix::{Rows, row_product_behind};
use crate::colouring::Colouring;
use crate::field::clear_masked;
use crate::frictional_vertices::FrictionalVertices;
use crate::{BlockMatrix, Energy, Matrix, SolveError};

/// The number of roundings of its terms in a force.
pub(crate) const ROUNDINGS: f64 = 16.0;

/// The diagonal blocks of the operator, inverted at vertices without friction.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sweep<const C: usize> {
    /// Inverse on the free components, for every vertex.
    inverses: Vec<SMatrix<f64, C, C>>,
    /// Decoupled block, for every frictional vertex.
    blocks: Vec<SMatrix<f64, C, C>>,
    /// Largest diagonal entry, for every frictional vertex.
    scales: Vec<f64>,
    /// The start of the entries after the diagonal, for every row.
    behind: Vec<u32>,
    /// The order of the rows: wide slabs first.
    slabs: Colouring,
}

/// The fields that a sweep updates, from vertex `first` on.
struct Part<'a, const C: usize> {
    first: usize,
    v: &'a mut [SVector<f64, C>],
    moved: &'a mut [SVector<f64, C>],
}

impl<const C: usize> Sweep<C> {
    /// Checks the shapes of `energy` and takes the diagonal blocks of its operator.
    pub(crate) fn prepare(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
    ) -> Result<(), SolveError> {
        energy.check()?;
        let size = energy.operator.rows();
        self.inverses.clear();
        self.inverses.reserve(size);
        for vertex in 0..size {
            let inverse = inverse_at(energy.operator, energy.fixed, vertex)?;
            self.inverses.push(inverse);
        }
        self.blocks.clear();
        self.blocks.extend(energy.vertices.iter().map(|&vertex| {
            decouple(
                &energy.operator.diagonal_block(vertex),
                &energy.fixed[vertex],
            )
        }));
        let rows = Rows::of(energy.operator);
        self.behind.clear();
        self.behind.extend((0..size).map(|i| {
            let range = rows.range(i);
            let upto = rows.columns[range.clone()].partition_point(|&j| j as usize <= i);
            (range.start + upto) as u32
        }));
        let bandwidth = rows.bandwidth();
        if !self.slabs.are_of(size, bandwidth) {
            self.slabs = Colouring::new(size, bandwidth);
        }
        self.scales.clear();
        self.scales.extend(
            energy
                .vertices
                .iter()
                .map(|&vertex| energy.operator.diagonal_block(vertex).diagonal().amax()),
        );
        Ok(())
    }

    /// Checks that energy, norm and start have the sizes of the preparation.
    pub(crate) fn check(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        norm: &BlockMatrix<C>,
        v: &[SVector<f64, C>],
    ) -> Result<(), SolveError> {
        energy.check_sizes(self.inverses.len(), self.blocks.len(), norm, v)?;
        // A law with a threshold returns rest even for a NaN load: test the load first.
        if !energy.load.iter().flatten().all(|load| load.is_finite()) {
            let change = f64::NAN;
            return Err(SolveError::NotFinite {
                iteration: 1,
                change,
            });
        }
        Ok(())
    }

    /// The size of the diagonal block of a frictional vertex: its largest diagonal entry.
    pub(crate) fn scale(&self, position: usize) -> f64 {
        self.scales[position]
    }

    /// One pass over all vertices, in the order of the slabs; the energy does not grow. `moved` becomes the values
    /// before minus those after.
    pub(crate) fn forward(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        v: &mut [SVector<f64, C>],
        moved: &mut [SVector<f64, C>],
    ) {
        let slabs = &self.slabs;
        slabs.for_wide((&mut *v, &mut *moved), |k, first, (v, moved)| {
            let part = Part { first, v, moved };
            self.pass(energy, slabs.wide(k), part, |_, _| ());
        });
        if slabs.is_whole() {
            return;
        }
        slabs.for_narrow((v, moved), |k, first, (v, moved)| {
            let part = Part { first, v, moved };
            self.pass(energy, slabs.narrow(k), part, |_, _| ());
        });
    }

    /// [`forward`](Self::forward) in the reverse order: from the last vertex to the first.
    pub(crate) fn backward(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        v: &mut [SVector<f64, C>],
        moved: &mut [SVector<f64, C>],
    ) {
        let slabs = &self.slabs;
        if !slabs.is_whole() {
            slabs.for_narrow((&mut *v, &mut *moved), |k, first, (v, moved)| {
                self.pass_back(energy, slabs.narrow(k), Part { first, v, moved });
            });
        }
        slabs.for_wide((v, moved), |k, first, (v, moved)| {
            self.pass_back(energy, slabs.wide(k), Part { first, v, moved });
        });
    }

    /// [`forward`](Self::forward), and the negative gradient of the energy after it, zero on fixed
    /// components.
    ///
    /// Each vertex was balanced in its turn. Its residual is due to the vertices after it: half a product, of changes
    /// instead of values. It follows the sweep at the distance of the bandwidth, while the rows are in cache.
    /// Contributions of wide slabs to a narrow one are added when its rows are read.
    #[cfg(feature = "multigrid")]
    pub(crate) fn forward_with_residual(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        v: &mut [SVector<f64, C>],
        moved: &mut [SVector<f64, C>],
        residual: &mut [SVector<f64, C>],
    ) {
        let slabs = &self.slabs;
        let fields = (&mut *v, &mut *moved, &mut *residual);
        slabs.for_wide(fields, |k, first, (v, moved, residual)| {
            let part = Part { first, v, moved };
            self.pass_with_residual(energy, slabs.wide(k), part, residual);
        });
        if slabs.is_whole() {
            return;
        }
        slabs.for_narrow((v, moved, residual), |k, first, (v, moved, residual)| {
            let rows = slabs.narrow(k);
            let part = Part {
                first,
                v,
                moved: &mut *moved,
            };
            self.pass_with_residual(energy, rows.clone(), part, residual);
            let matrix = Rows::of(energy.operator);
            for i in rows.clone() {
                let beside = matrix.row(i).filter(|(j, _)| !rows.contains(j));
                for (j, block) in beside {
                    residual[j - first] += block.tr_mul(&moved[i - first]);
                    clear_masked(&mut residual[j - first], &energy.fixed[j]);
                }
            }
        });
    }

    /// A pass over some rows, and the residual at earlier rows due to later ones among them.
    #[cfg(feature = "multigrid")]
    fn pass_with_residual(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        range: Range<usize>,
        part: Part<'_, C>,
        residual: &mut [SVector<f64, C>],
    ) {
        let rows = Rows::of(energy.operator);
        let (first, lag) = (part.first, self.slabs.bandwidth() + 1);
        let mut balance = |i: usize, moved: &[SVector<f64, C>]| {
            let mut upper = self.behind[i] as usize..rows.range(i).end;
            if i + lag > range.end {
                let own = &rows.columns[upper.clone()];
                upper.end = upper.start + own.partition_point(|&j| (j as usize) < range.end);
            }
            let left = &mut residual[i - first];
            let (columns, blocks) = (&rows.columns[upper.clone()], &rows.values[upper]);
            *left = partial_product(columns, blocks, first, moved);
            clear_masked(left, &energy.fixed[i]);
        };
        let moved = self.pass(energy, range.clone(), part, |i, moved| {
            if let Some(i) = i.checked_sub(lag).filter(|&i| i >= range.start) {
                balance(i, moved);
            }
        });
        for i in range.end.saturating_sub(lag).max(range.start)..range.end {
            balance(i, moved);
        }
    }

    /// One pass over some rows; `then` is called after each row with its change.
    #[inline(always)]
    fn pass<'a>(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        range: Range<usize>,
        part: Part<'a, C>,
        mut then: impl FnMut(usize, &[SVector<f64, C>]),
    ) -> &'a [SVector<f64, C>] {
        let Part { first, v, moved } = part;
        let rows = Rows::of(energy.operator);
        let begin = (energy.vertices).partition_point(|&vertex| vertex < range.start);
        let mut frictional = FrictionalVertices::along(&energy.vertices[begin..]);
        for i in range {
            let position = frictional.at(i).map(|position| begin + position);
            let new = self.renewed(energy, &rows, (i, position), first, v);
            moved[i - first] = v[i - first] - new;
            v[i - first] = new;
            then(i, moved);
        }
        moved
    }

    /// One pass over some rows from the last to the first.
    fn pass_back(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        range: Range<usize>,
        Part { first, v, moved }: Part<'_, C>,
    ) {
        let rows = Rows::of(energy.operator);
        for i in range.rev() {
            let position = energy.vertices.binary_search(&i).ok();
            let new = self.renewed(energy, &rows, (i, position), first, v);
            moved[i - first] = v[i - first] - new;
            v[i - first] = new;
        }
    }

    /// The minimiser over vertex `i` alone, with its position among the frictional ones; `v` begins at vertex `first`.
    #[inline(always)]
    fn renewed(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        rows: &Rows<'_, SMatrix<f64, C, C>>,
        (i, position): (usize, Option<usize>),
        first: usize,
        v: &[SVector<f64, C>],
    ) -> SVector<f64, C> {
        match position {
            Some(position) => self.minimizer(energy, rows, position, first, v),
            None => {
                let rest = energy.load[i] - row_product_behind(rows, i, first, v);
                v[i - first] + self.inverses[i] * rest
            }
        }
    }

    /// The minimiser over the frictional vertex number `position` alone; `v` begins at vertex `first`.
    #[inline]
    fn minimizer(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        rows: &Rows<'_, SMatrix<f64, C, C>>,
        position: usize,
        first: usize,
        v: &[SVector<f64, C>],
    ) -> SVector<f64, C> {
        let vertex = energy.vertices[position];
        let (block, fixed, own) = (
            &self.blocks[position],
            &energy.fixed[vertex],
            &v[vertex - first],
        );
        let product = row_product_behind(rows, vertex, first, v);
        let mut force = energy.load[vertex] - product + block * own;
        clear_masked(&mut force, fixed);
        let minimizer = energy.potentials.minimize(position, block, &force);
        SVector::from_fn(|c, _| if fixed[c] { own[c] } else { minimizer[c] })
    }

    /// The squared distance, in the norm of the operator, between a frictional vertex and its local
    /// minimum.
    #[cfg(feature = "multigrid")]
    pub(crate) fn local_error(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        position: usize,
        v: &[SVector<f64, C>],
    ) -> f64 {
        let rows = Rows::of(energy.operator);
        let change = self.minimizer(energy, &rows, position, 0, v) - v[energy.vertices[position]];
        change.dot(&(self.blocks[position] * change))
    }

    /// Whether the forces that drive another sweep are at the level of the rounding errors of their terms.
    pub(crate) fn is_rounded(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        v: &[SVector<f64, C>],
    ) -> bool {
        let rows = Rows::of(energy.operator);
        let mut frictional = FrictionalVertices::along(energy.vertices);
        (0..v.len()).all(|i| {
            let (mut left, terms) = force_and_terms(energy, &rows, i, v);
            clear_masked(&mut left, &energy.fixed[i]);
            let force = match frictional.at(i) {
                Some(k) => self.local_force(energy, k, v),
                None => left.amax(),
            };
            force <= ROUNDINGS * f64::EPSILON * terms.amax()
        })
    }

    /// The largest component of the force that moves a frictional vertex to its local minimum.
    pub(crate) fn local_force(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        position: usize,
        v: &[SVector<f64, C>],
    ) -> f64 {
        let rows = Rows::of(energy.operator);
        let change = self.minimizer(energy, &rows, position, 0, v) - v[energy.vertices[position]];
        (self.blocks[position] * change).amax()
    }
}

/// The force of load and operator at vertex `i`, and the sum of the moduli of its terms.
pub(crate) fn force_and_terms<const C: usize>(
    energy: &Energy<'_, BlockMatrix<C>, C>,
    rows: &Rows<'_, SMatrix<f64, C, C>>,
    i: usize,
    v: &[SVector<f64, C>],
) -> (SVector<f64, C>, SVector<f64, C>) {
    let (mut force, mut terms) = (energy.load[i], energy.load[i].abs());
    for (j, block) in rows.row(i) {
        force -= block * v[j];
        terms += block.abs() * v[j].abs();
    }
    (force, terms)
}
