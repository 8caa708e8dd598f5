//! Interpolation weights of vertices that halve edges, also of edges that end in such vertices.

use crate::simplex::MAX_CORNERS;
use crate::{FemError, Prolongation};

/// For each new vertex the coarse vertices it lies between, increasing, with its barycentric coordinates.
pub(crate) struct Weights {
    coarse: usize,
    starts: Vec<usize>,
    columns: Vec<u32>,
    weights: Vec<f64>,
}

impl Weights {
    /// The weights of the coarse vertices alone, with room for so many new ones.
    pub(crate) fn new(coarse: usize, room: usize) -> Self {
        let mut starts = Vec::with_capacity(room + 1);
        starts.push(0);
        Self {
            coarse,
            starts,
            columns: Vec::with_capacity(2 * room),
            weights: Vec::with_capacity(2 * room),
        }
    }

    fn row(&self, vertex: u32) -> (Option<u32>, std::ops::Range<usize>) {
        match (vertex as usize).checked_sub(self.coarse) {
            None => (Some(vertex), 0..0),
            Some(new) => (None, self.starts[new]..self.starts[new + 1]),
        }
    }

    /// Adds the midpoint of two vertices, coarse or new.
    pub(crate) fn halve(&mut self, p: u32, q: u32) {
        if (p.max(q) as usize) < self.coarse {
            self.columns.extend([p.min(q), p.max(q)]);
            self.weights.extend([0.5, 0.5]);
        } else {
            self.halve_between(p, q);
        }
        self.starts.push(self.columns.len());
    }

    fn halve_between(&mut self, p: u32, q: u32) {
        let mut sum = [(0, 0.0); MAX_CORNERS];
        let mut count = 0;
        for end in [p, q] {
            let (own, row) = self.row(end);
            let own = own.map(|vertex| (vertex, 1.0));
            let rest = self.columns[row.clone()].iter().zip(&self.weights[row]);
            for (column, weight) in own.into_iter().chain(rest.map(|(&c, &w)| (c, w))) {
                let at = sum[..count].partition_point(|&(c, _)| c < column);
                if at == count || sum[at].0 != column {
                    sum[at..=count].rotate_right(1);
                    sum[at] = (column, 0.0);
                    count += 1;
                }
                sum[at].1 += 0.5 * weight;
            }
        }
        self.columns
            .extend(sum[..count].iter().map(|&(column, _)| column));
        self.weights
            .extend(sum[..count].iter().map(|&(_, weight)| weight));
    }

    /// The coarse vertices between which two vertices lie, increasing, padded with `u32::MAX`; `None` if there are more
    /// than `N`.
    pub(crate) fn between<const N: usize>(&self, vertices: &[u32]) -> Option<[u32; N]> {
        let mut found = [u32::MAX; N];
        let mut count = 0;
        for &vertex in vertices {
            let (own, row) = self.row(vertex);
            for column in own.into_iter().chain(self.columns[row].iter().copied()) {
                let at = found[..count].partition_point(|&c| c < column);
                if at == count || found[at] != column {
                    if count == N {
                        return None;
                    }
                    found[at..=count].rotate_right(1);
                    found[at] = column;
                    count += 1;
                }
            }
        }
        Some(found)
    }

    /// The interpolation to the vertices in another order: `order[k]` comes k-th.
    pub(crate) fn prolongation(&self, order: &[u32]) -> Result<Prolongation, FemError> {
        let entries = self.coarse + self.columns.len();
        if u32::try_from(entries).is_err() {
            return Err(FemError::too_many("blocks of a matrix", entries as u64));
        }
        let mut starts = Vec::with_capacity(order.len() + 1);
        let mut columns = Vec::with_capacity(entries);
        let mut weights = Vec::with_capacity(entries);
        starts.push(0);
        for &old in order {
            let (own, row) = self.row(old);
            columns.extend(own);
            weights.extend(own.map(|_| 1.0));
            columns.extend_from_slice(&self.columns[row.clone()]);
            weights.extend_from_slice(&self.weights[row]);
            starts.push(columns.len() as u32);
        }
        let shape = (order.len(), self.coarse);
        Ok(Prolongation::new(shape, starts, columns, weights))
    }
}
