//! Multigrid on planes, as a preconditioner.

/// A symmetric cycle of cell-centred multigrid for `diag(a) + L` on a plane: a Gauss-Seidel sweep forwards before and
/// backwards after the correction from cells of twice the length, whose faces have half the sum of the conductances that
/// they cover.
#[derive(Debug, Clone)]
pub(super) struct Multigrid {
    /// From the finest to a single cell.
    levels: Vec<Level>,
}

#[derive(Debug, Clone)]
struct Level {
    columns: usize,
    rows: usize,
    /// `a`.
    alone: Vec<f64>,
    /// The conductance of each cell to the next one along strike and down dip; 0 at the ends.
    next: Vec<f64>,
    below: Vec<f64>,
    /// One over the diagonal.
    inverse: Vec<f64>,
    side: Vec<f64>,
    value: Vec<f64>,
}

impl Multigrid {
    pub(super) fn new([mut columns, mut rows]: [usize; 2]) -> Self {
        let mut levels = vec![Level::new(columns, rows)];
        while columns * rows > 1 {
            (columns, rows) = (columns.div_ceil(2), rows.div_ceil(2));
            levels.push(Level::new(columns, rows));
        }
        Self { levels }
    }

    /// Takes `q` times the conductances of faces, those across strike first.
    pub(super) fn factor(&mut self, diagonal: &[f64], faces: &[f64], q: f64) {
        let first = &mut self.levels[0];
        let (columns, rows) = (first.columns, first.rows);
        first.alone.copy_from_slice(diagonal);
        for row in 0..rows {
            let faces = &faces[row * (columns - 1)..(row + 1) * (columns - 1)];
            for (column, face) in faces.iter().enumerate() {
                first.next[row * columns + column] = q * face;
            }
        }
        let down = &faces[(columns - 1) * rows..];
        for (below, face) in first.below.iter_mut().zip(down) {
            *below = q * face;
        }
        first.invert();
        for number in 1..self.levels.len() {
            let (finer, coarser) = self.levels.split_at_mut(number);
            coarser[0].gather(&finer[number - 1]);
        }
    }

    /// Writes the approximate solution.
    pub(super) fn precondition(&mut self, side: &[f64], value: &mut [f64]) {
        self.levels[0].side.copy_from_slice(side);
        let last = self.levels.len() - 1;
        for number in 0..last {
            let (finer, coarser) = self.levels.split_at_mut(number + 1);
            let level = &mut finer[number];
            level.sweep_from_zero();
            level.restrict(&mut coarser[0]);
        }
        let coarsest = &mut self.levels[last];
        coarsest.value[0] = coarsest.side[0] * coarsest.inverse[0];
        for number in (0..last).rev() {
            let (finer, coarser) = self.levels.split_at_mut(number + 1);
            let level = &mut finer[number];
            level.prolong(&coarser[0]);
            level.sweep_back();
        }
        value.copy_from_slice(&self.levels[0].value);
    }
}

impl Level {
    fn new(columns: usize, rows: usize) -> Self {
        let vector = || vec![0.0; columns * rows];
        Self {
            columns,
            rows,
            alone: vector(),
            next: vector(),
            below: vector(),
            inverse: vector(),
            side: vector(),
            value: vector(),
        }
    }

    fn invert(&mut self) {
        for cell in 0..self.alone.len() {
            let before = if cell > 0 { self.next[cell - 1] } else { 0.0 };
            let above = cell
                .checked_sub(self.columns)
                .map_or(0.0, |above| self.below[above]);
            let sum = self.alone[cell] + before + self.next[cell] + above + self.below[cell];
            self.inverse[cell] = 1.0 / sum;
        }
    }

    /// The cell that holds a finer one.
    fn holder(&self, column: usize, row: usize) -> usize {
        row / 2 * self.columns + column / 2
    }

    /// Takes the coefficients of the finer level.
    fn gather(&mut self, finer: &Self) {
        self.alone.fill(0.0);
        self.next.fill(0.0);
        self.below.fill(0.0);
        for row in 0..finer.rows {
            for column in 0..finer.columns {
                let (cell, holder) = (row * finer.columns + column, self.holder(column, row));
                self.alone[holder] += finer.alone[cell];
                if column % 2 == 1 {
                    self.next[holder] += 0.5 * finer.next[cell];
                }
                if row % 2 == 1 {
                    self.below[holder] += 0.5 * finer.below[cell];
                }
            }
        }
        self.invert();
    }

    /// A sweep forwards, from 0.
    fn sweep_from_zero(&mut self) {
        let columns = self.columns;
        for row in 0..self.rows {
            let mut before = 0.0;
            for cell in row * columns..(row + 1) * columns {
                let mut sum = self.side[cell] + before;
                if row > 0 {
                    sum += self.below[cell - columns] * self.value[cell - columns];
                }
                let value = sum * self.inverse[cell];
                self.value[cell] = value;
                before = self.next[cell] * value;
            }
        }
    }

    /// The sum of the neighbours of a cell, times their conductances.
    fn neighbours(&self, cell: usize) -> f64 {
        let columns = self.columns;
        let mut sum = 0.0;
        if cell > 0 {
            sum += self.next[cell - 1] * self.value[cell - 1];
        }
        if cell + 1 < self.value.len() {
            sum += self.next[cell] * self.value[cell + 1];
        }
        if cell >= columns {
            sum += self.below[cell - columns] * self.value[cell - columns];
        }
        if cell + columns < self.value.len() {
            sum += self.below[cell] * self.value[cell + columns];
        }
        sum
    }

    /// Sums the residual in the coarser cells.
    fn restrict(&self, coarser: &mut Self) {
        coarser.side.fill(0.0);
        for row in 0..self.rows {
            for column in 0..self.columns {
                let cell = row * self.columns + column;
                let own = self.value[cell] / self.inverse[cell];
                let residual = self.side[cell] - own + self.neighbours(cell);
                let holder = coarser.holder(column, row);
                coarser.side[holder] += residual;
            }
        }
    }

    /// Adds the correction of the coarser cells.
    fn prolong(&mut self, coarser: &Self) {
        for row in 0..self.rows {
            for column in 0..self.columns {
                let cell = row * self.columns + column;
                self.value[cell] += coarser.value[coarser.holder(column, row)];
            }
        }
    }

    /// A sweep backwards.
    fn sweep_back(&mut self) {
        for cell in (0..self.value.len()).rev() {
            self.value[cell] = (self.side[cell] + self.neighbours(cell)) * self.inverse[cell];
        }
    }
}
