//! Adaptive cross approximation with partial pivoting, of a block of any size, to a relative tolerance.

use super::entries::{Entries, Lines};
use super::error::HMatrixError;
use crate::pivots::{largest, subtract};

/// Small crosses in a row that end the approximation.
const SMALL_CROSSES: usize = 2;
/// A line that is known is a pivot if its entry is at least this share of the largest.
const KNOWN: f64 = 0.5;

/// `sum_k columns_k rows_k^T`, with the square of its Frobenius norm.
#[derive(Default)]
pub(super) struct Crosses {
    pub(super) columns: Vec<Vec<f64>>,
    pub(super) rows: Vec<Vec<f64>>,
    norm: f64,
}

/// Crosses whose error is about the tolerance times the block, in the Frobenius norm; none if they take as many numbers as the
/// block.
///
/// A row of what is left gives its largest entry as a pivot, the pivot's column the next row. A cross is small if it is within
/// the tolerance of the sum so far; two of them in a row end the approximation, if all rows of the receivers that are known then
/// are within the tolerance, and the columns of one more source: a block whose rows do not feel each other's columns has crosses in
/// each of its parts, and so have receivers apart from the others. A block of zeros has none.
///
/// Source: M. Bebendorf, Numer. Math. 86 (2000), doi:10.1007/PL00005410, Sec. 4.
pub(super) fn crosses<E: Entries>(
    lines: &mut Lines<'_, E>,
    tolerance: f64,
) -> Result<Option<Crosses>, HMatrixError> {
    let [height, width] = lines.size();
    let mut sum = Crosses::default();
    let mut is_pivot = vec![false; height];
    let mut small = 0;
    let mut next = first_row(lines)?;
    while let Some(i) = next {
        if (sum.rows.len() + 1) * (height + width) >= height * width {
            return Ok(None);
        }
        is_pivot[i] = true;
        let mut row = sum.rest_of_row(lines, i)?;
        let pivot = pivot_of(&row, |_| true, |j| lines.knows_column(j)).unwrap_or(0);
        if row[pivot].abs() < f64::MIN_POSITIVE {
            next = sum.suspect(lines, &is_pivot, tolerance)?;
            continue;
        }
        let share = row[pivot].recip();
        row.iter_mut().for_each(|entry| *entry *= share);
        let column = sum.rest_of_column(lines, pivot)?;
        next = pivot_of(&column, |i| !is_pivot[i], |i| lines.knows_row(i));
        small = if sum.add(column, row, tolerance) {
            small + 1
        } else {
            0
        };
        if small >= SMALL_CROSSES || next.is_none() {
            next = sum.suspect(lines, &is_pivot, tolerance)?;
            small = 0;
        }
    }
    Ok(Some(sum))
}

/// The place of a large entry among those allowed: the largest, or the largest of a known line if that is not much smaller.
fn pivot_of(
    values: &[f64],
    allowed: impl Fn(usize) -> bool,
    known: impl Fn(usize) -> bool,
) -> Option<usize> {
    let any = largest(values, &allowed)?;
    let of_known = largest(values, |place| allowed(place) && known(place));
    of_known
        .filter(|&place| values[place].abs() >= KNOWN * values[any].abs())
        .or(Some(any))
}

/// A row that is not zero, of the first, the middle or the last receiver; none if all are.
fn first_row<E: Entries>(lines: &mut Lines<'_, E>) -> Result<Option<usize>, HMatrixError> {
    let [of_receiver, _] = lines.shape();
    let count = lines.size()[0] / of_receiver;
    for receiver in [0, count / 2, count - 1] {
        for i in receiver * of_receiver..(receiver + 1) * of_receiver {
            if lines.row(i)?.iter().any(|x| x.abs() >= f64::MIN_POSITIVE) {
                return Ok(Some(i));
            }
        }
    }
    Ok(None)
}

impl Crosses {
    /// Row `i` less this sum.
    fn rest_of_row<E: Entries>(
        &self,
        lines: &mut Lines<'_, E>,
        i: usize,
    ) -> Result<Vec<f64>, HMatrixError> {
        let mut row = lines.row(i)?.to_vec();
        for (u, v) in self.columns.iter().zip(&self.rows) {
            subtract(&mut row, u[i], v);
        }
        Ok(row)
    }

    /// Column `j` less this sum.
    fn rest_of_column<E: Entries>(
        &self,
        lines: &mut Lines<'_, E>,
        j: usize,
    ) -> Result<Vec<f64>, HMatrixError> {
        let mut column = lines.column(j)?.to_vec();
        for (u, v) in self.columns.iter().zip(&self.rows) {
            subtract(&mut column, v[j], u);
        }
        Ok(column)
    }

    /// Adds a cross; whether it is small.
    fn add(&mut self, column: Vec<f64>, row: Vec<f64>, tolerance: f64) -> bool {
        let own = squared(&column) * squared(&row);
        let with = |(u, v): (&Vec<f64>, &Vec<f64>)| dot(u, &column) * dot(v, &row);
        let mixed: f64 = self.columns.iter().zip(&self.rows).map(with).sum();
        self.norm += own + 2.0 * mixed;
        self.columns.push(column);
        self.rows.push(row);
        own <= tolerance * tolerance * self.norm
    }

    /// A row that has not been a pivot, and that differs by more than the tolerance, as all known receivers and one more source tell.
    fn suspect<E: Entries>(
        &self,
        lines: &mut Lines<'_, E>,
        is_pivot: &[bool],
        tolerance: f64,
    ) -> Result<Option<usize>, HMatrixError> {
        let [height, width] = lines.size();
        let [of_receiver, of_source] = lines.shape();
        let bound = tolerance * tolerance * self.norm;
        for place in 0..lines.receivers.len() {
            let first = lines.receivers[place] * of_receiver;
            for i in first..first + of_receiver {
                let error = squared(&self.rest_of_row(lines, i)?);
                if !is_pivot[i] && error * height as f64 > bound {
                    return Ok(Some(i));
                }
            }
        }
        let unknown = (0..width / of_source).map(|source| source * of_source);
        let unknown: Vec<_> = unknown.filter(|&j| !lines.knows_column(j)).collect();
        let Some(&first) = unknown.get(unknown.len() / 2) else {
            return Ok(None);
        };
        for j in first..first + of_source {
            let column = self.rest_of_column(lines, j)?;
            if squared(&column) * width as f64 > bound {
                return Ok(largest(&column, |i| !is_pivot[i]));
            }
        }
        Ok(None)
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn squared(a: &[f64]) -> f64 {
    dot(a, a)
}
