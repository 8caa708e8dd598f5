//! The numbers of a matrix, pair by pair of a receiver and a source.

use super::error::HMatrixError;

/// The numbers of pairs of a receiver and a source.
///
/// Implement both methods; the numbers must depend smoothly on the places of receiver and source, except for those near to
/// each other.
///
/// ```
/// use stickslip_bie::hmatrix::Entries;
///
/// /// The potential of charges at points.
/// struct Charges(Vec<[f64; 3]>);
///
/// impl Entries for Charges {
///     fn shape(&self) -> [usize; 2] {
///         [1, 1]
///     }
///
///     fn block(&self, receiver: usize, source: usize, block: &mut [f64]) {
///         let [a, b] = [receiver, source].map(|k| self.0[k]);
///         let squared: f64 = (0..3).map(|i| (a[i] - b[i]).powi(2)).sum();
///         block[0] = if receiver == source { 0.0 } else { squared.sqrt().recip() };
///     }
/// }
/// ```
pub trait Entries: Sync {
    /// The number of rows of a receiver, and of columns of a source; both positive.
    fn shape(&self) -> [usize; 2];

    /// Overwrites `block` by the numbers of a receiver due to a source, row by row.
    fn block(&self, receiver: usize, source: usize, block: &mut [f64]);
}

/// Rows and columns of the block of two clusters, which are kept once they are known.
pub(super) struct Lines<'a, E> {
    entries: &'a E,
    shape: [usize; 2],
    cells: [&'a [usize]; 2],
    /// All rows of each receiver that has been asked for.
    rows: Vec<Option<Vec<f64>>>,
    /// All columns of each source that has been asked for.
    columns: Vec<Option<Vec<f64>>>,
    /// Receivers in the order in which they have been asked for.
    pub(super) receivers: Vec<usize>,
    /// Pairs of receiver and source evaluated.
    pub(super) pairs: usize,
    pair: Vec<f64>,
}

impl<'a, E: Entries> Lines<'a, E> {
    pub(super) fn new(entries: &'a E, cells: [&'a [usize]; 2]) -> Self {
        let shape = entries.shape();
        Self {
            entries,
            shape,
            cells,
            rows: vec![None; cells[0].len()],
            columns: vec![None; cells[1].len()],
            receivers: Vec::new(),
            pairs: 0,
            pair: vec![0.0; shape[0] * shape[1]],
        }
    }

    /// The numbers of rows and of columns.
    pub(super) fn size(&self) -> [usize; 2] {
        [0, 1].map(|side| self.shape[side] * self.cells[side].len())
    }

    /// The number of rows of a receiver, and of columns of a source.
    pub(super) fn shape(&self) -> [usize; 2] {
        self.shape
    }

    pub(super) fn knows_row(&self, i: usize) -> bool {
        self.rows[i / self.shape[0]].is_some()
    }

    pub(super) fn knows_column(&self, j: usize) -> bool {
        self.columns[j / self.shape[1]].is_some()
    }

    /// Evaluates a pair, or copies it from a row or a column that is known.
    fn evaluate(&mut self, receiver: usize, source: usize) -> Result<(), HMatrixError> {
        let ([of_receiver, of_source], [height, width]) = (self.shape, self.size());
        if let Some(rows) = &self.rows[receiver] {
            for (row, numbers) in self.pair.chunks_exact_mut(of_source).enumerate() {
                let first = row * width + source * of_source;
                numbers.copy_from_slice(&rows[first..first + of_source]);
            }
            return Ok(());
        }
        if let Some(columns) = &self.columns[source] {
            for (n, number) in self.pair.iter_mut().enumerate() {
                let (row, column) = (n / of_source, n % of_source);
                *number = columns[column * height + receiver * of_receiver + row];
            }
            return Ok(());
        }
        let [receiver, source] = [self.cells[0][receiver], self.cells[1][source]];
        self.entries.block(receiver, source, &mut self.pair);
        self.pairs += 1;
        finite(&self.pair, receiver, source)
    }

    /// All rows of a receiver, one after the other.
    fn rows_of(&mut self, receiver: usize) -> Result<&[f64], HMatrixError> {
        let ([of_receiver, of_source], [_, width]) = (self.shape, self.size());
        if self.rows[receiver].is_none() {
            let mut rows = vec![0.0; of_receiver * width];
            for source in 0..self.cells[1].len() {
                self.evaluate(receiver, source)?;
                for (row, numbers) in self.pair.chunks_exact(of_source).enumerate() {
                    let first = row * width + source * of_source;
                    rows[first..first + of_source].copy_from_slice(numbers);
                }
            }
            self.rows[receiver] = Some(rows);
            self.receivers.push(receiver);
        }
        Ok(self.rows[receiver].as_deref().unwrap_or_default())
    }

    /// Row `i`.
    pub(super) fn row(&mut self, i: usize) -> Result<&[f64], HMatrixError> {
        let (of_receiver, [_, width]) = (self.shape[0], self.size());
        let rows = self.rows_of(i / of_receiver)?;
        let own = i % of_receiver;
        Ok(&rows[own * width..(own + 1) * width])
    }

    /// Column `j`.
    pub(super) fn column(&mut self, j: usize) -> Result<&[f64], HMatrixError> {
        let ([of_receiver, of_source], [height, _]) = (self.shape, self.size());
        let (source, own) = (j / of_source, j % of_source);
        if self.columns[source].is_none() {
            let mut columns = vec![0.0; of_source * height];
            for receiver in 0..self.cells[0].len() {
                self.evaluate(receiver, source)?;
                for (n, &number) in self.pair.iter().enumerate() {
                    let (row, column) = (n / of_source, n % of_source);
                    columns[column * height + receiver * of_receiver + row] = number;
                }
            }
            self.columns[source] = Some(columns);
        }
        let columns = self.columns[source].as_deref().unwrap_or_default();
        Ok(&columns[own * height..(own + 1) * height])
    }

    /// The whole block, row by row.
    pub(super) fn dense(&mut self) -> Result<Vec<f64>, HMatrixError> {
        let [height, width] = self.size();
        let mut dense = Vec::with_capacity(height * width);
        for receiver in 0..self.cells[0].len() {
            dense.extend_from_slice(self.rows_of(receiver)?);
        }
        Ok(dense)
    }
}

/// Refuses numbers of a pair that are not finite.
pub(super) fn finite(pair: &[f64], receiver: usize, source: usize) -> Result<(), HMatrixError> {
    match pair.iter().find(|number| !number.is_finite()) {
        Some(&value) => Err(HMatrixError::Entry {
            receiver,
            source_cell: source,
            value,
        }),
        None => Ok(()),
    }
}
