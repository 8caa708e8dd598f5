//! A dense matrix, row after row.

use nalgebra::SVector;

/// Independent sums in one product, for registers of several numbers.
const CHAINS: usize = 8;

/// `A_ij`, square.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rows {
    count: usize,
    entries: Vec<f64>,
}

impl Rows {
    pub(super) fn new(count: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let places = (0..count).flat_map(|i| (0..count).map(move |j| (i, j)));
        Self {
            count,
            entries: places.map(|(i, j)| entry(i, j)).collect(),
        }
    }

    pub(super) fn count(&self) -> usize {
        self.count
    }

    pub(super) fn entry(&self, i: usize, j: usize) -> f64 {
        self.entries[i * self.count + j]
    }

    /// `(A x)_i`.
    pub(super) fn product_at(&self, i: usize, x: &[SVector<f64, 1>]) -> f64 {
        let row = &self.entries[i * self.count..(i + 1) * self.count];
        let (row_parts, row_rest) = row.as_chunks::<CHAINS>();
        let (x_parts, x_rest) = x.as_chunks::<CHAINS>();
        let mut sums = [0.0; CHAINS];
        for (row, x) in row_parts.iter().zip(x_parts) {
            for k in 0..CHAINS {
                sums[k] += row[k] * x[k][0];
            }
        }
        let rest = row_rest.iter().zip(x_rest);
        sums.iter().sum::<f64>() + rest.map(|(a, x)| a * x[0]).sum::<f64>()
    }
}
