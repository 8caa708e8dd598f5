//! Packed symmetric storage of dense matrices, in the order of the products.

use pulp::Simd;

/// Columns per panel: one pass over the rows multiplies so many.
pub(crate) const WIDTH: usize = 4;
/// Rows per chunk: the numbers in the widest SIMD register.
pub(crate) const ROWS: usize = 8;

/// Packed symmetric storage: the entries on and below the diagonal, four columns side by side, in chunks of eight rows.
///
/// A product reads the entries once, in order, for both triangles: every entry acts as itself and as its mirror image.
/// Diagonal entries, their own mirror images, are therefore stored by half. Rows end with a whole chunk, and panels
/// start with one; padding is zero.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct PackedSymmetric {
    /// The number of rows with the padding of the last chunk.
    rows: usize,
    entries: Vec<f64>,
    /// The row after the last nonzero chunk of each panel; later rows are skipped.
    ends: Vec<usize>,
}

/// The first row of a panel.
#[inline(always)]
fn start(panel: usize) -> usize {
    panel * WIDTH / ROWS * ROWS
}

/// The start of a panel: each is a chunk shorter than the last but one.
#[inline(always)]
fn offset(rows: usize, panel: usize) -> usize {
    let shorter = panel / 2 * (panel.saturating_sub(1) / 2);
    WIDTH * (panel * rows - ROWS * shorter)
}

impl PackedSymmetric {
    /// Zero, with so many rows.
    pub(crate) fn new(count: usize) -> Self {
        let rows = Self::padded(count);
        Self {
            rows,
            entries: vec![0.0; offset(rows, rows / WIDTH)],
            ends: vec![0; rows / WIDTH],
        }
    }

    /// The padded length of a vector of so many rows for products: values after the last row are zero.
    pub(crate) fn padded(count: usize) -> usize {
        count.next_multiple_of(ROWS)
    }

    /// The memory of so many rows \[byte\].
    pub(crate) fn bytes(count: usize) -> usize {
        let chunks = count.div_ceil(ROWS);
        let entries = chunks.saturating_mul(chunks + 1) / 2;
        entries.saturating_mul(ROWS * ROWS * size_of::<f64>())
    }

    /// The number of rows with the padding of the last chunk.
    pub(crate) fn rows(&self) -> usize {
        self.rows
    }

    /// The position of an entry on or below the diagonal.
    #[inline(always)]
    fn place(&self, row: usize, column: usize) -> usize {
        let panel = column / WIDTH;
        let chunk = (row - start(panel)) / ROWS;
        offset(self.rows, panel) + (chunk * WIDTH + column % WIDTH) * ROWS + row % ROWS
    }

    /// The entry of a row and a column.
    #[inline(always)]
    pub(crate) fn entry(&self, row: usize, column: usize) -> f64 {
        let entry = self.entries[self.place(row.max(column), row.min(column))];
        if row == column { 2.0 * entry } else { entry }
    }

    /// Sets the entry of a row and a column, and its mirror image.
    #[inline(always)]
    pub(crate) fn set(&mut self, row: usize, column: usize, value: f64) {
        let (row, column) = (row.max(column), row.min(column));
        let place = self.place(row, column);
        self.entries[place] = if row == column { 0.5 * value } else { value };
        if value != 0.0 {
            let end = &mut self.ends[column / WIDTH];
            *end = (*end).max(row / ROWS * ROWS + ROWS);
        }
    }

    /// Copies all entries from a matrix by columns.
    pub(crate) fn take(&mut self, columns: &[f64], count: usize) {
        for (j, column) in columns.chunks_exact(count.max(1)).enumerate() {
            let (panel, first) = (j / WIDTH, start(j / WIDTH));
            let begin = offset(self.rows, panel) + j % WIDTH * ROWS;
            let chunks = self.entries[begin..].chunks_mut(WIDTH * ROWS);
            for (chunk, rows) in chunks.zip(column[first..].chunks(ROWS)) {
                chunk[..rows.len()].copy_from_slice(rows);
            }
            // The first chunk begins at or above the diagonal.
            let (above, rest) = self.entries[begin..].split_at_mut(j - first);
            above.fill(0.0);
            rest[0] *= 0.5;
        }
        self.ends.fill(self.rows);
    }

    /// Sets the matrix to a linear combination of matrices of the same size.
    pub(crate) fn set_combination<'a>(&mut self, terms: impl IntoIterator<Item = (f64, &'a Self)>) {
        self.entries.fill(0.0);
        self.ends.fill(0);
        for (factor, term) in terms {
            for (end, other) in self.ends.iter_mut().zip(&term.ends) {
                *end = (*end).max(*other);
            }
            for (sum, entry) in self.entries.iter_mut().zip(&term.entries) {
                *sum += factor * entry;
            }
        }
    }

    /// The nonzero part of a panel in some rows, whole chunks, and the start of these rows among the given ones.
    #[inline(always)]
    fn part(&self, panel: usize, begin: usize, end: usize) -> (usize, &[f64]) {
        let start = start(panel);
        let (from, to) = (begin.max(start), end.min(self.ends[panel]));
        if from >= to {
            return (0, &[]);
        }
        let part = &self.entries[offset(self.rows, panel) + WIDTH * (from - start)..];
        (from - begin, &part[..WIDTH * (to - from)])
    }

    /// `y += S x` of the rows and columns from `begin` on, as many as there are values, whole chunks.
    #[inline(always)]
    pub(crate) fn add_product<S: Simd>(&self, simd: S, begin: usize, x: &[f64], y: &mut [f64]) {
        for (at, panel) in (0..x.len()).step_by(WIDTH).zip(begin / WIDTH..) {
            let (skipped, part) = self.part(panel, begin, begin + x.len());
            let sums = add_products(simd, part, four(x, at), &x[skipped..], &mut y[skipped..]);
            for (y, sum) in y[at..].iter_mut().zip(sums) {
                *y += sum;
            }
        }
    }

    /// The same for rows below the columns, and their mirror images.
    #[inline(always)]
    pub(crate) fn add_product_below<S: Simd>(
        &self,
        simd: S,
        (column, x, y): (usize, &[f64], &mut [f64]),
        (row, x_below, y_below): (usize, &[f64], &mut [f64]),
    ) {
        for (at, panel) in (0..x.len()).step_by(WIDTH).zip(column / WIDTH..) {
            let (skipped, part) = self.part(panel, row, row + x_below.len());
            let (x_below, y_below) = (&x_below[skipped..], &mut y_below[skipped..]);
            let sums = add_products(simd, part, four(x, at), x_below, y_below);
            for (y, sum) in y[at..].iter_mut().zip(sums) {
                *y += sum;
            }
        }
    }

    /// `y += S x` of the rows from `row` on, from the columns from `column` on that are stored for them.
    #[inline(always)]
    pub(crate) fn add_columns<S: Simd>(
        &self,
        simd: S,
        (column, x): (usize, &[f64]),
        (row, y): (usize, &mut [f64]),
    ) {
        for (at, panel) in (0..x.len()).step_by(WIDTH).zip(column / WIDTH..) {
            let (skipped, part) = self.part(panel, row, row + y.len());
            add_columns(simd, part, four(x, at), &mut y[skipped..]);
        }
    }

    /// The products of four columns with the values of the rows from `row` on.
    #[inline(always)]
    pub(crate) fn products<S: Simd>(
        &self,
        simd: S,
        panel: usize,
        (row, x): (usize, &[f64]),
    ) -> [f64; WIDTH] {
        let (skipped, part) = self.part(panel, row, row + x.len());
        products(simd, part, &x[skipped..])
    }
}

/// Four values.
#[inline(always)]
fn four(x: &[f64], at: usize) -> [f64; WIDTH] {
    [x[at], x[at + 1], x[at + 2], x[at + 3]]
}

// Loops, not closures: these would not be compiled for the wide registers.

/// `y += P known` of a part of a panel, and `P^T x`.
#[inline(always)]
fn add_products<S: Simd>(
    simd: S,
    part: &[f64],
    known: [f64; WIDTH],
    x: &[f64],
    y: &mut [f64],
) -> [f64; WIDTH] {
    let mut factors = [simd.splat_f64s(0.0); WIDTH];
    let mut sums = [simd.splat_f64s(0.0); WIDTH];
    for k in 0..WIDTH {
        factors[k] = simd.splat_f64s(known[k]);
    }
    let ((part, _), (x, _), (y, _)) = (
        S::as_simd_f64s(part),
        S::as_simd_f64s(x),
        S::as_mut_simd_f64s(y),
    );
    let wide = ROWS / S::F64_LANES;
    for ((chunk, x), y) in (part.chunks_exact(WIDTH * wide))
        .zip(x.chunks_exact(wide))
        .zip(y.chunks_exact_mut(wide))
    {
        for i in 0..wide {
            let (x, mut sum) = (x[i], y[i]);
            for k in 0..WIDTH {
                let entries = chunk[k * wide + i];
                sum = simd.mul_add_e_f64s(entries, factors[k], sum);
                sums[k] = simd.mul_add_e_f64s(entries, x, sums[k]);
            }
            y[i] = sum;
        }
    }
    reduced(simd, sums)
}

/// `y += P known` of a part of a panel.
#[inline(always)]
fn add_columns<S: Simd>(simd: S, part: &[f64], known: [f64; WIDTH], y: &mut [f64]) {
    let mut factors = [simd.splat_f64s(0.0); WIDTH];
    for k in 0..WIDTH {
        factors[k] = simd.splat_f64s(known[k]);
    }
    let ((part, _), (y, _)) = (S::as_simd_f64s(part), S::as_mut_simd_f64s(y));
    let wide = ROWS / S::F64_LANES;
    for (chunk, y) in part
        .chunks_exact(WIDTH * wide)
        .zip(y.chunks_exact_mut(wide))
    {
        for i in 0..wide {
            let mut sum = y[i];
            for k in 0..WIDTH {
                sum = simd.mul_add_e_f64s(chunk[k * wide + i], factors[k], sum);
            }
            y[i] = sum;
        }
    }
}

/// `P^T x` of a part of a panel.
#[inline(always)]
fn products<S: Simd>(simd: S, part: &[f64], x: &[f64]) -> [f64; WIDTH] {
    let mut sums = [simd.splat_f64s(0.0); WIDTH];
    let ((part, _), (x, _)) = (S::as_simd_f64s(part), S::as_simd_f64s(x));
    let wide = ROWS / S::F64_LANES;
    for (chunk, x) in part.chunks_exact(WIDTH * wide).zip(x.chunks_exact(wide)) {
        for i in 0..wide {
            for k in 0..WIDTH {
                sums[k] = simd.mul_add_e_f64s(chunk[k * wide + i], x[i], sums[k]);
            }
        }
    }
    reduced(simd, sums)
}

/// The sum of the lanes of each.
#[inline(always)]
fn reduced<S: Simd>(simd: S, sums: [S::f64s; WIDTH]) -> [f64; WIDTH] {
    let mut reduced = [0.0; WIDTH];
    for k in 0..WIDTH {
        reduced[k] = simd.reduce_sum_f64s(sums[k]);
    }
    reduced
}
