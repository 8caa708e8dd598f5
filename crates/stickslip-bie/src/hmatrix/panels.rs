//! A dense matrix in panels of rows, and its product.

/// Rows of a panel: independent sums, in the same order at any width of registers.
const LANES: usize = 8;

/// A number of a matrix.
pub(super) trait Real: Copy + Into<f64> + Send + Sync {
    fn of(value: f64) -> Self;
}

impl Real for f64 {
    fn of(value: f64) -> Self {
        value
    }
}

impl Real for f32 {
    fn of(value: f64) -> Self {
        value as f32
    }
}

/// A matrix: panels of [`LANES`] rows, the last of fewer, each column by column.
#[derive(Debug)]
pub(super) struct Panels<T> {
    size: [usize; 2],
    values: Vec<T>,
}

impl<T: Real> Panels<T> {
    pub(super) fn new([rows, columns]: [usize; 2], entry: impl Fn(usize, usize) -> f64) -> Self {
        let mut values = Vec::with_capacity(rows * columns);
        for first in (0..rows).step_by(LANES) {
            for column in 0..columns {
                let panel = first..rows.min(first + LANES);
                values.extend(panel.map(|row| T::of(entry(row, column))));
            }
        }
        let size = [rows, columns];
        Self { size, values }
    }

    fn place(&self, row: usize, column: usize) -> usize {
        let [rows, columns] = self.size;
        let first = row / LANES * LANES;
        first * columns + column * LANES.min(rows - first) + row - first
    }

    pub(super) fn entry(&self, row: usize, column: usize) -> f64 {
        self.values[self.place(row, column)].into()
    }

    pub(super) fn entry_mut(&mut self, row: usize, column: usize) -> &mut T {
        let place = self.place(row, column);
        &mut self.values[place]
    }

    pub(super) fn len(&self) -> usize {
        self.values.len()
    }

    pub(super) fn bytes(&self) -> u64 {
        size_of_val(self.values.as_slice()) as u64
    }

    /// `y += A x`.
    #[inline(always)]
    pub(super) fn multiply_add(&self, x: &[f64], y: &mut [f64]) {
        let [rows, columns] = self.size;
        let whole = rows / LANES * LANES;
        let (panels, last) = self.values.split_at(whole * columns);
        let (y, y_last) = y.split_at_mut(whole);
        let x = &x[..columns];
        if columns == 0 {
            return;
        }
        for (panel, y) in panels
            .chunks_exact(LANES * columns)
            .zip(y.as_chunks_mut::<LANES>().0)
        {
            let mut sums = [0.0; LANES];
            for (column, x) in panel.as_chunks::<LANES>().0.iter().zip(x) {
                for lane in 0..LANES {
                    let number: f64 = column[lane].into();
                    sums[lane] += number * x;
                }
            }
            for lane in 0..LANES {
                y[lane] += sums[lane];
            }
        }
        if y_last.is_empty() {
            return;
        }
        let mut sums = [0.0; LANES];
        for (column, x) in last.chunks_exact(rows - whole).zip(x) {
            for (sum, &number) in sums.iter_mut().zip(column) {
                let number: f64 = number.into();
                *sum += number * x;
            }
        }
        for (y, sum) in y_last.iter_mut().zip(sums) {
            *y += sum;
        }
    }
}

/// A factor of a far block, in either precision.
#[derive(Debug)]
pub(super) enum Factor {
    Double(Panels<f64>),
    Single(Panels<f32>),
}

impl Factor {
    pub(super) fn new(single: bool, size: [usize; 2], entry: impl Fn(usize, usize) -> f64) -> Self {
        if single {
            Self::Single(Panels::new(size, entry))
        } else {
            Self::Double(Panels::new(size, entry))
        }
    }

    pub(super) fn entry(&self, row: usize, column: usize) -> f64 {
        match self {
            Self::Double(panels) => panels.entry(row, column),
            Self::Single(panels) => panels.entry(row, column),
        }
    }

    pub(super) fn len(&self) -> usize {
        match self {
            Self::Double(panels) => panels.len(),
            Self::Single(panels) => panels.len(),
        }
    }

    pub(super) fn bytes(&self) -> u64 {
        match self {
            Self::Double(panels) => panels.bytes(),
            Self::Single(panels) => panels.bytes(),
        }
    }

    /// `y += A x`.
    #[inline(always)]
    pub(super) fn multiply_add(&self, x: &[f64], y: &mut [f64]) {
        match self {
            Self::Double(panels) => panels.multiply_add(x, y),
            Self::Single(panels) => panels.multiply_add(x, y),
        }
    }
}
