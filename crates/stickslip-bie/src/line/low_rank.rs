//! A smooth dense matrix as a sum of products of columns and rows.

use nalgebra::SVector;

use crate::pivots::{largest, subtract};

/// The largest sum of errors in a row, as a share of the scale of the matrix.
const TOLERANCE: f64 = 1e-11;
/// Independent sums in one product, for registers of several numbers.
const CHAINS: usize = 8;

/// `A_ij`, dense or of low rank, whichever is smaller.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum LowRank {
    /// Row after row.
    Dense { count: usize, rows: Vec<f64> },
    /// `sum_k u_k v_k^T`: pairs of a column and a row.
    Pairs {
        count: usize,
        pairs: Vec<[Vec<f64>; 2]>,
    },
}

/// A matrix that is computed row by row and column by column.
pub(crate) trait Entries {
    /// The number of rows and of columns.
    fn count(&self) -> usize;
    /// The size of an entry that counts, positive.
    fn scale(&self) -> f64;
    /// The distance of rows that differ as functions, as a share of their number, positive.
    fn spacing(&self) -> f64;
    /// Overwrites `row` by row `i`.
    fn row(&self, i: usize, row: &mut [f64]);
    /// Overwrites `column` by column `j`.
    fn column(&self, j: usize, column: &mut [f64]);
}

impl LowRank {
    /// Rows that are checked are within [`TOLERANCE`] of the scale, in the sum of all errors of the row.
    pub(crate) fn of(entries: &impl Entries) -> Self {
        let count = entries.count();
        if let Some(pairs) = cross_approximation(entries) {
            return Self::Pairs { count, pairs };
        }
        let mut rows = vec![0.0; count * count];
        for (i, row) in rows.chunks_exact_mut(count).enumerate() {
            entries.row(i, row);
        }
        Self::Dense { count, rows }
    }

    /// The number of rows and of columns.
    pub(crate) fn count(&self) -> usize {
        match self {
            Self::Dense { count, .. } | Self::Pairs { count, .. } => *count,
        }
    }

    /// `A_ij`.
    pub(crate) fn entry(&self, i: usize, j: usize) -> f64 {
        match self {
            Self::Dense { count, rows } => rows[i * count + j],
            Self::Pairs { pairs, .. } => pairs.iter().map(|[u, v]| u[i] * v[j]).sum(),
        }
    }

    /// `(A x)_i`.
    pub(crate) fn product_at(&self, i: usize, x: &[SVector<f64, 1>]) -> f64 {
        match self {
            Self::Dense { count, rows } => product(&rows[i * count..(i + 1) * count], x),
            Self::Pairs { pairs, .. } => pairs.iter().map(|[u, v]| u[i] * product(v, x)).sum(),
        }
    }

    /// Passes on summands of `scale A x`, each with the number of its row. Allocates nothing.
    #[inline]
    pub(crate) fn product(
        &self,
        scale: f64,
        x: &[SVector<f64, 1>],
        mut add: impl FnMut(usize, f64),
    ) {
        match self {
            Self::Dense { count, rows } => {
                for (i, row) in rows.chunks_exact(*count).enumerate() {
                    add(i, scale * product(row, x));
                }
            }
            Self::Pairs { count, pairs } => {
                for [u, v] in pairs {
                    let factor = scale * product(v, x);
                    for (i, u) in u[..*count].iter().enumerate() {
                        add(i, factor * u);
                    }
                }
            }
        }
    }

    /// `x . A x`.
    pub(crate) fn quadratic(&self, x: &[SVector<f64, 1>]) -> f64 {
        match self {
            Self::Dense { count, rows } => {
                let rows = x.iter().zip(rows.chunks_exact(*count));
                rows.map(|(x_i, row)| x_i[0] * product(row, x)).sum()
            }
            Self::Pairs { pairs, .. } => {
                let terms = pairs.iter();
                terms.map(|[u, v]| product(u, x) * product(v, x)).sum()
            }
        }
    }
}

fn product(a: &[f64], x: &[SVector<f64, 1>]) -> f64 {
    let (a_parts, a_rest) = a.as_chunks::<CHAINS>();
    let (x_parts, x_rest) = x.as_chunks::<CHAINS>();
    let mut sums = [0.0; CHAINS];
    for (a, x) in a_parts.iter().zip(x_parts) {
        for k in 0..CHAINS {
            sums[k] += a[k] * x[k][0];
        }
    }
    let rest: f64 = a_rest.iter().zip(x_rest).map(|(a, x)| a * x[0]).sum();
    sums.iter().sum::<f64>() + rest
}

/// Adaptive cross approximation with partial pivoting; none if it takes as many numbers as the dense matrix.
///
/// A row of what is left gives its largest entry as a pivot, the pivot's column the next row. A pivot row within the
/// tolerance is no proof: rows at distances that grow with their number are then checked, until all of them pass after the
/// last pivot; one that fails is a pivot.
///
/// Source: M. Bebendorf, Numer. Math. 86 (2000), doi:10.1007/PL00005410, Sec. 4.
fn cross_approximation(entries: &impl Entries) -> Option<Vec<[Vec<f64>; 2]>> {
    let count = entries.count();
    let bound = TOLERANCE * entries.scale();
    let checked = checked_rows(count, entries.spacing());
    let mut pairs: Vec<[Vec<f64>; 2]> = Vec::new();
    let mut pivots = Vec::new();
    let (mut next, mut at, mut passed) = (0, 0, 0);
    let mut row = vec![0.0; count];
    while passed <= checked.len() {
        entries.row(next, &mut row);
        for [u, v] in &pairs {
            subtract(&mut row, u[next], v);
        }
        let error: f64 = row.iter().map(|entry| entry.abs()).sum();
        if error <= bound {
            next = checked[at];
            at = (at + 1) % checked.len();
            passed += 1;
            continue;
        }
        if 2 * (pairs.len() + 1) >= count {
            return None;
        }
        let pivot = largest(&row, |_| true)?;
        let mut column = vec![0.0; count];
        entries.column(pivot, &mut column);
        for [u, v] in &pairs {
            subtract(&mut column, v[pivot], u);
        }
        let share = row[pivot].recip();
        column.iter_mut().for_each(|entry| *entry *= share);
        pivots.push(next);
        next = largest(&column, |i| !pivots.contains(&i))?;
        passed = 0;
        pairs.push([column, row.clone()]);
    }
    Some(pairs)
}

/// Rows up to the last, denser towards the surface, where images are near.
fn checked_rows(count: usize, spacing: f64) -> Vec<usize> {
    let next = |row: &usize| Some(row + 1 + (*row as f64 * spacing) as usize);
    let rows = std::iter::successors(Some(0), next);
    let mut rows: Vec<_> = rows.take_while(|&row| row < count - 1).collect();
    rows.push(count - 1);
    rows
}
