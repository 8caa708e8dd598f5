//! A change of basis in several processes.

use std::collections::HashMap;

use nalgebra::SMatrix;
use stickslip::solvers::{Basis, BasisRows, Frames};

use crate::{Error, World};

/// A row of blocks, by the global numbers of vertices.
type Row<const C: usize> = Vec<(u64, SMatrix<f64, C, C>)>;

/// Adds a block to a row.
pub(crate) fn add<Number: Copy + PartialEq, const C: usize>(
    row: &mut Vec<(Number, SMatrix<f64, C, C>)>,
    column: Number,
    block: SMatrix<f64, C, C>,
) {
    match row.iter_mut().find(|(known, _)| *known == column) {
        Some((_, sum)) => *sum += block,
        None => row.push((column, block)),
    }
}

/// The change of basis `x = T x'`: the rows of all processes, by global numbers of vertices.
///
/// The copies of a vertex belong to one process, so a row of `T` has entries of the process that owns it alone. Others
/// need it for their columns. Rows that are not those of the identity are few: vertices of faults, and where axes are
/// turned.
#[derive(Debug)]
pub(crate) struct SharedBasis<const C: usize> {
    /// The rows of `T` that are not those of the identity, of all processes.
    rows: HashMap<u64, Row<C>>,
    /// The rows of `T^-1` in this process, by its own numbers.
    pub(crate) inverse: BasisRows<C>,
}

impl<const C: usize> SharedBasis<C> {
    /// Tells all processes the rows of the basis of each, whose vertices are numbered from `first` on.
    pub(crate) fn new(world: World, first: u64, basis: &Basis<C>) -> Result<Self, Error> {
        let global = |vertex: usize| first + vertex as u64;
        let mut words = Vec::new();
        for (vertex, row) in basis.rows() {
            words.extend([global(vertex), row.len() as u64]);
            for (unknown, block) in row {
                words.push(global(unknown));
                words.extend(block.iter().map(|x| x.to_bits()));
            }
        }
        let lists = world.all_to_all(&vec![words; world.size()])?;
        let mut rows = HashMap::new();
        for list in &lists {
            let mut words = list.iter().copied();
            while let (Some(vertex), Some(count)) = (words.next(), words.next()) {
                let row = (0..count).map(|_| {
                    let unknown = words.next().unwrap_or_default();
                    let entries = words.by_ref().take(C * C).map(f64::from_bits);
                    (unknown, SMatrix::from_iterator(entries))
                });
                rows.insert(vertex, row.collect());
            }
        }
        let inverse = basis.inverse_rows();
        Ok(Self { rows, inverse })
    }

    /// The row of `T` of a vertex, unless it is that of the identity.
    pub(crate) fn row(&self, vertex: u64) -> Option<&Row<C>> {
        self.rows.get(&vertex)
    }

    /// The vertices whose unknowns take part in the motion of these, as far as their rows are not those of the identity.
    pub(crate) fn unknowns_of(&self, vertices: &[u64]) -> impl Iterator<Item = u64> {
        let rows = vertices.iter().filter_map(|&vertex| self.row(vertex));
        rows.flatten().map(|&(unknown, _)| unknown)
    }
}

/// The basis of a coarser level, whose vertex `k` is at the place of vertex `copies[k]` of the finer one.
pub(crate) fn coarsened<const C: usize>(
    basis: &Basis<C>,
    copies: impl ExactSizeIterator<Item = usize>,
) -> Basis<C> {
    let mut axes = Frames::none(copies.len());
    let mut coarse = HashMap::new();
    for (k, fine) in copies.enumerate() {
        if let Some(own) = basis.axes.of(fine) {
            axes.set(k, *own);
        }
        coarse.insert(fine, k);
    }
    let links = basis.links.on_coarser(|fine| coarse.get(&fine).copied());
    Basis { axes, links }
}
