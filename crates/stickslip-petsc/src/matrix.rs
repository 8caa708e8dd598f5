//! Matrices whose rows are spread over processes.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::{SMatrix, SVector};
use stickslip::solvers::{Basis, Ranks};
use stickslip::{BlockMatrix, Matrix, Operator};

use crate::layout::Layout;
use crate::world::or_abort;

/// The rows of the vertices that this process owns, of a symmetric matrix with one `C x C` block a pair of neighbours.
///
/// Fields have one entry an owned vertex. Products and sums are those of the whole body, and all processes ask for them
/// together; [`product_at`](Matrix::product_at) is not a number where it needs a vertex of another process, and
/// [`products_at`](Matrix::products_at) is what to ask for instead.
pub struct DistributedMatrix<const C: usize> {
    pub(crate) layout: Arc<Layout>,
    pub(crate) starts: Arc<Vec<u32>>,
    /// Owned vertices, then ghosts.
    pub(crate) columns: Arc<Vec<u32>>,
    pub(crate) values: Vec<SMatrix<f64, C, C>>,
    /// A field with its ghost values; empty without ghosts, and where no process needs any.
    room: Mutex<Vec<SVector<f64, C>>>,
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
    pub(crate) fn new(
        layout: Arc<Layout>,
        starts: Arc<Vec<u32>>,
        columns: Arc<Vec<u32>>,
        values: Vec<SMatrix<f64, C, C>>,
    ) -> Self {
        // A lumped mass and dashpots need no vertex of another process: products with them send nothing.
        let reaches = columns.iter().any(|&j| j as usize >= layout.owned);
        let reaches = layout.ranks.any(reaches) && !layout.ghosts.is_empty();
        let size = if reaches {
            layout.owned + layout.ghosts.len()
        } else {
            0
        };
        let room = Mutex::new(vec![SVector::zeros(); size]);
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

    /// Shows a field of owned vertices together with its ghosts, if it has any. A process without ghosts is nobody's
    /// neighbour.
    fn extended<T>(
        &self,
        x: &[SVector<f64, C>],
        use_it: impl FnOnce(&[SVector<f64, C>]) -> T,
    ) -> T {
        let mut room = self.room.lock().unwrap_or_else(PoisonError::into_inner);
        if room.is_empty() {
            return use_it(x);
        }
        room[..self.layout.owned].copy_from_slice(x);
        self.layout.update(&mut room);
        use_it(&room)
    }

    /// `(A x)_i` of a field with its ghosts.
    #[inline]
    fn product_with(&self, i: usize, field: &[SVector<f64, C>]) -> SVector<f64, C> {
        let range = self.starts[i] as usize..self.starts[i + 1] as usize;
        let entries = self.columns[range.clone()].iter().zip(&self.values[range]);
        // A sum for each entry of a block: none has to wait for another.
        let mut sums = [[0.0; C]; C];
        for (&j, block) in entries {
            let x = &field[j as usize].data.0[0];
            for c in 0..C {
                for r in 0..C {
                    sums[c][r] += block.data.0[c][r] * x[c];
                }
            }
        }
        SMatrix::<f64, C, C>::from(sums).column_sum()
    }

    /// These vertices, then the owned ones next to them or to such of another process.
    pub(crate) fn rows_near(&self, vertices: &[usize]) -> Vec<usize> {
        let mut marks =
            vec![SVector::<f64, 1>::zeros(); self.layout.owned + self.layout.ghosts.len()];
        for &vertex in vertices {
            marks[vertex][0] = 1.0;
        }
        self.layout.update(&mut marks);
        let near = |&i: &usize| marks[i][0] == 0.0 && self.row(i).any(|(j, _)| marks[j][0] != 0.0);
        let others = (0..self.layout.owned).filter(near);
        vertices.iter().copied().chain(others).collect()
    }

    fn place(&self, i: usize) -> Option<usize> {
        let start = self.starts[i] as usize;
        let columns = &self.columns[start..self.starts[i + 1] as usize];
        columns.binary_search(&(i as u32)).ok().map(|k| start + k)
    }

    /// The product with every owned row.
    pub(crate) fn products(
        &self,
        x: &[SVector<f64, C>],
        mut each: impl FnMut(usize, SVector<f64, C>),
    ) {
        self.extended(x, |field| {
            for i in 0..self.layout.owned {
                each(i, self.product_with(i, field));
            }
        });
    }
}

impl<const C: usize> Matrix<C> for DistributedMatrix<C> {
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
        self.extended(x, |field| {
            for (product, &i) in products.iter_mut().zip(vertices) {
                *product = self.product_with(i, field);
            }
        });
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        self.place(i)
            .map_or(SMatrix::zeros(), |place| self.values[place])
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        self.products(x, |i, product| y[i] += product * scale);
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        let mut sum = 0.0;
        self.products(x, |i, product| sum += x[i].dot(&product));
        self.layout.world.sum(sum)
    }

    fn ranks(&self) -> Ranks {
        self.layout.ranks.clone()
    }
}

impl<const C: usize> Operator<C> for DistributedMatrix<C> {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        let all = terms.iter().copied().chain(mass);
        // An operator without terms is that of no vertex.
        let largest = all.clone().max_by_key(|(_, term)| term.columns.len());
        let Some((_, pattern)) = largest else {
            let nobody = Arc::new(Layout::empty());
            return Self::new(nobody, Arc::new(vec![0]), Arc::default(), Vec::new());
        };
        let mut columns = Vec::with_capacity(pattern.columns.len());
        let mut starts = vec![0];
        for i in 0..pattern.layout.owned {
            let begin = columns.len();
            for (_, term) in all.clone() {
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
        sum.set_combination_with(terms, mass);
        sum
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        self.values.fill(SMatrix::zeros());
        for (factor, term) in terms.iter().copied().chain(mass) {
            if term.columns == self.columns {
                for (value, block) in self.values.iter_mut().zip(&term.values) {
                    *value += block * factor;
                }
                continue;
            }
            for i in 0..self.layout.owned {
                let start = self.starts[i] as usize;
                let columns = &self.columns[start..self.starts[i + 1] as usize];
                for (j, block) in term.row(i) {
                    if let Ok(place) = columns.binary_search(&(j as u32)) {
                        self.values[start + place] += block * factor;
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

    /// All processes change the basis together, each for its own vertices; the copies of a vertex are in one of them.
    fn change_basis(&mut self, basis: &Basis<C>) -> bool {
        let Some(changed) = or_abort(self.congruent(basis)) else {
            return false;
        };
        *self = changed;
        true
    }
}
