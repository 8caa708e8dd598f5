//! Matrices whose rows are spread over processes.

use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use nalgebra::{SMatrix, SVector};
use stickslip::{BlockMatrix, Operator};

use crate::layout::Layout;

/// The rows of the vertices that this process owns, of a symmetric matrix with one `C x C` block a pair of neighbours.
///
/// Fields have one entry an owned vertex. Products and sums are those of the whole body, and all processes ask for them
/// together; [`product_at`](Operator::product_at) is not a number where it needs a vertex of another process, and
/// [`products_at`](Operator::products_at) is what to ask for instead.
pub struct DistributedMatrix<const C: usize> {
    pub(crate) layout: Arc<Layout>,
    pub(crate) starts: Arc<Vec<u32>>,
    /// Owned vertices, then ghosts.
    pub(crate) columns: Arc<Vec<u32>>,
    pub(crate) values: Vec<SMatrix<f64, C, C>>,
    /// A field with its ghosts.
    room: Mutex<Vec<f64>>,
}

impl<const C: usize> fmt::Debug for DistributedMatrix<C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("DistributedMatrix")
            .field("owned", &self.layout.owned)
            .field("entries", &self.columns.len())
            .finish_non_exhaustive()
    }
}

impl<const C: usize> DistributedMatrix<C> {
    fn new(
        layout: Arc<Layout>,
        starts: Arc<Vec<u32>>,
        columns: Arc<Vec<u32>>,
        values: Vec<SMatrix<f64, C, C>>,
    ) -> Self {
        let room = Mutex::new(vec![0.0; C * (layout.owned + layout.ghosts.len())]);
        Self {
            layout,
            starts,
            columns,
            values,
            room,
        }
    }

    /// The rows of owned vertices of a matrix on the mesh of this process, whose vertices have `numbers`.
    pub(crate) fn of_rows(
        layout: Arc<Layout>,
        local: &BlockMatrix<C>,
        owned: &[u32],
        numbers: &[u32],
    ) -> Self {
        let (mut starts, mut columns, mut values) = (vec![0], Vec::new(), Vec::new());
        for &vertex in owned {
            if let Some(row) = local.outer_view(vertex as usize) {
                let mut entries: Vec<_> =
                    row.iter().map(|(j, block)| (numbers[j], block)).collect();
                entries.sort_unstable_by_key(|&(column, _)| column);
                columns.extend(entries.iter().map(|&(column, _)| column));
                values.extend(entries.iter().map(|&(_, block)| *block));
            }
            starts.push(columns.len() as u32);
        }
        Self::new(layout, Arc::new(starts), Arc::new(columns), values)
    }

    /// The columns of a row, and its blocks.
    pub(crate) fn row(&self, i: usize) -> impl Iterator<Item = (usize, &SMatrix<f64, C, C>)> {
        let range = self.starts[i] as usize..self.starts[i + 1] as usize;
        let columns = self.columns[range.clone()].iter().map(|&j| j as usize);
        columns.zip(&self.values[range])
    }

    /// A field of owned vertices with its ghosts, `C` numbers a vertex.
    fn extended(&self, x: &[SVector<f64, C>]) -> MutexGuard<'_, Vec<f64>> {
        let mut room = self.room.lock().unwrap_or_else(PoisonError::into_inner);
        for (to, from) in room.chunks_exact_mut(C).zip(x) {
            to.copy_from_slice(from.as_slice());
        }
        self.layout.update(C, &mut room);
        room
    }

    /// `(A x)_i` of a field with its ghosts.
    pub(crate) fn product_with(&self, i: usize, field: &[f64]) -> SVector<f64, C> {
        let range = self.starts[i] as usize..self.starts[i + 1] as usize;
        let mut sum = SVector::zeros();
        for (&j, block) in self.columns[range.clone()].iter().zip(&self.values[range]) {
            let at = C * j as usize;
            for c in 0..C {
                sum += block.column(c) * field[at + c];
            }
        }
        sum
    }

    fn place(&self, i: usize) -> Option<usize> {
        let start = self.starts[i] as usize;
        let columns = &self.columns[start..self.starts[i + 1] as usize];
        columns.binary_search(&(i as u32)).ok().map(|k| start + k)
    }

    /// The product with every owned row.
    fn products(&self, x: &[SVector<f64, C>], mut each: impl FnMut(usize, SVector<f64, C>)) {
        let room = self.extended(x);
        for i in 0..self.layout.owned {
            each(i, self.product_with(i, &room));
        }
    }
}

impl<const C: usize> Operator<C> for DistributedMatrix<C> {
    fn vertex_count(&self) -> usize {
        self.layout.owned
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        let missing = SVector::repeat(f64::NAN);
        self.row(i)
            .map(|(j, block)| block * x.get(j).unwrap_or(&missing))
            .sum()
    }

    fn products_at(
        &self,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        let room = self.extended(x);
        for (product, &i) in products.iter_mut().zip(vertices) {
            *product = self.product_with(i, &room);
        }
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        self.place(i)
            .map_or(SMatrix::zeros(), |place| self.values[place])
    }

    fn combination(terms: &[(f64, &Self)]) -> Self {
        // An operator without terms is that of no vertex.
        let Some((_, pattern)) = terms.iter().max_by_key(|(_, term)| term.columns.len()) else {
            let nobody = Arc::new(Layout::empty());
            return Self::new(nobody, Arc::new(vec![0]), Arc::default(), Vec::new());
        };
        let mut columns = Vec::with_capacity(pattern.columns.len());
        let mut starts = vec![0];
        for i in 0..pattern.layout.owned {
            let begin = columns.len();
            for (_, term) in terms {
                columns.extend(term.row(i).map(|(j, _)| j as u32));
            }
            columns[begin..].sort_unstable();
            let mut kept = begin;
            for k in begin..columns.len() {
                if k == begin || columns[k] != columns[kept - 1] {
                    columns[kept] = columns[k];
                    kept += 1;
                }
            }
            columns.truncate(kept);
            starts.push(kept as u32);
        }
        // Operators of one pattern share it.
        let (starts, columns) = if columns == *pattern.columns {
            (pattern.starts.clone(), pattern.columns.clone())
        } else {
            (Arc::new(starts), Arc::new(columns))
        };
        let values = vec![SMatrix::zeros(); columns.len()];
        let mut sum = Self::new(pattern.layout.clone(), starts, columns, values);
        sum.set_combination(terms);
        sum
    }

    fn set_combination(&mut self, terms: &[(f64, &Self)]) {
        self.values.fill(SMatrix::zeros());
        for (factor, term) in terms {
            if term.columns == self.columns {
                for (value, block) in self.values.iter_mut().zip(&term.values) {
                    *value += block * *factor;
                }
                continue;
            }
            for i in 0..self.layout.owned {
                let start = self.starts[i] as usize;
                let columns = &self.columns[start..self.starts[i + 1] as usize];
                for (j, block) in term.row(i) {
                    if let Ok(place) = columns.binary_search(&(j as u32)) {
                        self.values[start + place] += block * *factor;
                    }
                }
            }
        }
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>) {
        if let Some(place) = self.place(i) {
            self.values[place] += block;
        }
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        self.products(x, |i, product| y[i] += product * scale);
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        let mut sum = 0.0;
        self.products(x, |i, product| sum += x[i].dot(&product));
        self.total(sum)
    }

    fn is_partial(&self) -> bool {
        true
    }

    fn total(&self, part: f64) -> f64 {
        self.layout.world.sum(part)
    }

    fn largest(&self, part: f64) -> f64 {
        self.layout.world.largest(part)
    }

    fn all(&self, holds: bool) -> bool {
        self.layout.world.all(holds)
    }
}
