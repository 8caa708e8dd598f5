//! Congruence of a quadratic form with the extension from the boundary into the interior.

use faer::linalg::matmul::{
    matmul,
    triangular::{BlockStructure, matmul as triangular_matmul},
};
use faer::linalg::triangular_solve::solve_upper_triangular_in_place;
use faer::reborrow::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par};

use crate::BlockMatrix;

use super::factor::Analysis;
use super::layout::{Layout, Pattern};

/// The update that the elimination of a supernode leaves of `N`: on these rows, the lower triangle by columns.
struct Update {
    rows: Vec<usize>,
    entries: Vec<f64>,
}

impl Update {
    /// Calls `add` with row, column and value of each entry.
    fn scatter(self, mut add: impl FnMut(usize, usize, f64)) {
        for (j, &column) in self.rows.iter().enumerate() {
            let entries = &self.entries[j * self.rows.len()..][..self.rows.len()];
            for (&row, &value) in self.rows[j..].iter().zip(&entries[j..]) {
                add(row, column, value);
            }
        }
    }
}

impl Analysis {
    /// The rows of a supernode outside its interior columns, and the number of these columns.
    fn border(
        &self,
        interior: usize,
        s: usize,
    ) -> (impl Iterator<Item = usize> + Clone + '_, usize) {
        let symbolic = &self.symbolic;
        let (begin, end) = (symbolic.supernode_begin()[s], symbolic.supernode_end()[s]);
        let columns = end.min(interior) - begin;
        let below = symbolic.supernode(s).pattern();
        ((begin + columns..end).chain(below.iter().copied()), columns)
    }

    /// The supernode that receives the update of another one; `None` if that update lies on the boundary.
    fn parent(&self, interior: usize, rows: impl Iterator<Item = usize>) -> Option<usize> {
        let first = rows.min().filter(|&first| first < interior)?;
        Some(
            self.symbolic
                .supernode_end()
                .partition_point(|&end| end <= first),
        )
    }

    /// The number of supernodes with interior columns.
    fn interior_supernodes(&self, interior: usize) -> usize {
        (self.symbolic.supernode_begin()).partition_point(|&begin| begin < interior)
    }

    /// The temporary memory of [`congruence`](Self::congruence) \[byte\].
    pub(crate) fn congruence_bytes(&self, interior: usize) -> usize {
        let count = self.interior_supernodes(interior);
        let mut waiting = vec![0; count];
        let (mut held, mut most, mut panel) = (0, 0, 0);
        for s in 0..count {
            let (rows, columns) = self.border(interior, s);
            let size = rows.clone().count();
            held += size * (size + 1);
            most = held.max(most);
            panel = panel.max(columns * (columns + 2 * size));
            held -= waiting[s];
            match self.parent(interior, rows) {
                Some(parent) => waiting[parent] += size * (size + 1),
                None => held -= size * (size + 1),
            }
        }
        size_of::<f64>() * (most + panel + self.symbolic.nrows())
    }

    /// `E^T N E`, with `E` the extension of boundary values by `L11^-T L21^T` and `N` of the pattern of the operator.
    ///
    /// The interior is eliminated supernode by supernode, as in the factorisation, at two to three times its cost:
    /// with `x_o = -V^T x_b`, `V = L_bo L_oo^-1`,
    ///
    /// ```text
    /// x . N x  =  x_b . (N_bb - Z V^T - V Z^T) x_b,   Z = N_bo - V N_oo / 2
    /// ```
    ///
    /// No difference of two Schur complements is formed, which would cancel.
    pub(crate) fn congruence<const C: usize>(
        &mut self,
        layout: &Layout<C>,
        norm: &BlockMatrix<C>,
        factor: &[f64],
        condensed: &mut [f64],
    ) {
        self.gather(layout, norm);
        self.condense(&layout.lower, layout.interior, factor, condensed);
    }

    /// The congruence of the gathered entries. Code that is independent of the dimension is compiled once.
    fn condense(&self, lower: &Pattern, interior: usize, factor: &[f64], condensed: &mut [f64]) {
        let unknowns = lower.columns();
        let count = unknowns - interior;
        let supernodes = self.interior_supernodes(interior);
        let mut waiting: Vec<Vec<Update>> = (0..supernodes).map(|_| Vec::new()).collect();
        let mut places = vec![0; unknowns];
        let (mut own, mut elimination) = (Vec::new(), Vec::new());
        condensed.fill(0.0);
        for column in interior..unknowns {
            let entries = lower.starts[column]..lower.starts[column + 1];
            for (&row, value) in lower.rows[entries.clone()]
                .iter()
                .zip(&self.values[entries])
            {
                condensed[(column - interior) * count + row - interior] = *value;
            }
        }
        for s in 0..supernodes {
            let begin = self.symbolic.supernode_begin()[s];
            let (border, columns) = self.border(interior, s);
            let rows: Vec<usize> = border.collect();
            let size = rows.len();
            let height = columns + size;
            for (place, row) in (begin..begin + columns)
                .chain(rows.iter().copied())
                .enumerate()
            {
                places[row] = place;
            }
            // The columns of `N` that are eliminated, and what is left on the border.
            own.clear();
            own.resize(height * columns, 0.0);
            let mut left = vec![0.0; size * size];
            for column in 0..columns {
                let entries = lower.starts[begin + column]..lower.starts[begin + column + 1];
                for (&row, value) in lower.rows[entries.clone()]
                    .iter()
                    .zip(&self.values[entries])
                {
                    own[column * height + places[row]] = *value;
                }
            }
            for update in waiting[s].drain(..) {
                update.scatter(|row, column, value| {
                    // The rows of supernodes need not increase.
                    let (row, column) = (places[row], places[column]);
                    let (row, column) = (row.max(column), row.min(column));
                    match column.checked_sub(columns) {
                        None => own[column * height + row] += value,
                        Some(column) => left[column * size + row - columns] += value,
                    }
                });
            }
            let panel = &factor[self.symbolic.col_ptr_for_val()[s]..][..height * columns];
            eliminate((panel, columns), &mut own, &mut left, &mut elimination);
            let parent = self.parent(interior, rows.iter().copied());
            let update = Update {
                rows,
                entries: left,
            };
            match parent {
                Some(parent) => waiting[parent].push(update),
                None => update.scatter(|row, column, value| {
                    let (row, column) = (row.max(column), row.min(column));
                    condensed[(column - interior) * count + row - interior] += value;
                }),
            }
        }
        for i in 0..count {
            for j in 0..i {
                condensed[i * count + j] = condensed[j * count + i];
            }
        }
    }
}

/// Subtracts `columns` columns of `N` from the rows below them, by those of the factor; `left` gets the lower triangle.
fn eliminate(
    (panel, columns): (&[f64], usize),
    own: &mut [f64],
    left: &mut [f64],
    elimination: &mut Vec<f64>,
) {
    let height = own.len() / columns;
    let size = height - columns;
    if size == 0 {
        return;
    }
    for j in 0..columns {
        for i in 0..j {
            own[j * height + i] = own[i * height + j];
        }
    }
    elimination.clear();
    for column in panel.chunks_exact(height) {
        elimination.extend_from_slice(&column[columns..]);
    }
    let (pivots, _) = MatRef::from_column_major_slice(panel, height, columns).split_at_row(columns);
    // V L_oo = L_bo
    solve_upper_triangular_in_place(
        pivots.transpose(),
        MatMut::from_column_major_slice_mut(elimination, size, columns).transpose_mut(),
        Par::Seq,
    );
    let v = MatRef::from_column_major_slice(&*elimination, size, columns);
    let own = MatMut::from_column_major_slice_mut(own, height, columns);
    let (eliminated, mut z) = own.split_at_row_mut(columns);
    matmul(z.rb_mut(), Accum::Add, v, eliminated.rb(), -0.5, Par::Seq);
    let mut left = MatMut::from_column_major_slice_mut(left, size, size);
    for (a, b) in [(z.rb(), v), (v, z.rb())] {
        triangular_matmul(
            left.rb_mut(),
            BlockStructure::TriangularLower,
            Accum::Add,
            a,
            BlockStructure::Rectangular,
            b.transpose(),
            BlockStructure::Rectangular,
            -1.0,
            Par::Seq,
        );
    }
}
