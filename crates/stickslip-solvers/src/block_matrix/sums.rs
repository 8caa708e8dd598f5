//! Sums of block matrices on the union of their patterns.

use nalgebra::SMatrix;

use super::rows::{BlockMatrix, Rows};

/// A zero matrix on the union of the patterns, given by row starts and columns.
pub(crate) fn on_patterns<'a, const C: usize>(
    patterns: impl Iterator<Item = (&'a [u32], &'a [u32])>,
) -> BlockMatrix<C> {
    let patterns: Vec<_> = patterns.collect();
    let size = patterns.first().map_or(0, |(starts, _)| starts.len() - 1);
    let mut starts = vec![0_u32];
    let mut columns: Vec<u32> = Vec::new();
    for i in 0..size {
        let begin = columns.len();
        for (starts, all) in &patterns {
            columns.extend_from_slice(&all[starts[i] as usize..starts[i + 1] as usize]);
        }
        columns[begin..].sort_unstable();
        let mut end = begin;
        for k in begin..columns.len() {
            if end == begin || columns[end - 1] != columns[k] {
                columns[end] = columns[k];
                end += 1;
            }
        }
        columns.truncate(end);
        starts.push(end as u32);
    }
    let values = vec![SMatrix::zeros(); columns.len()];
    BlockMatrix::new((size, size), starts, columns, values)
}

/// Adds `each` entry of a term to a sum whose pattern contains that of the term.
pub(crate) fn add<T, const C: usize>(
    sum: &mut BlockMatrix<C>,
    term: &sprs::CsMatI<T, u32>,
    mut each: impl FnMut(&mut SMatrix<f64, C, C>, &T),
) {
    if sum.indices().len() == term.indices().len() {
        // A pattern is contained in the union, so equal counts are equal patterns.
        for (sum, value) in sum.data_mut().iter_mut().zip(term.data()) {
            each(sum, value);
        }
        return;
    }
    let source = Rows::of(term);
    for i in 0..term.rows() {
        let mut position = sum.indptr().outer_inds_sz(i).start;
        for (j, value) in source.row(i) {
            while sum.indices()[position] as usize != j {
                position += 1;
            }
            each(&mut sum.data_mut()[position], value);
        }
    }
}
