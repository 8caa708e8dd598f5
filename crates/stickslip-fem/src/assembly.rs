//! Assembly of the sparse operator from a form on one cell.

use nalgebra::{SMatrix, SVector};

use crate::edges::Edges;
use crate::rows::for_rows;
use crate::simplex::Simplex;
use crate::{Assembled, BlockMatrix, FemError, P1};

/// The operator of a symmetric form. `data(cell)` is the data of a cell, and `form(data, cell, i, j)` the block of its
/// corners i <= j.
///
/// The block of (j, i) is the transpose, added in the same order: the operator is symmetric to the bit. In each row
/// cells add in the order of their indices.
pub(crate) fn assemble<const D: usize, const C: usize, T>(
    space: &P1<D>,
    data: impl Fn(usize) -> T + Sync,
    form: impl Fn(&T, &Simplex<D>, usize, usize) -> SMatrix<f64, C, C> + Sync,
) -> Result<Assembled<C>, FemError> {
    let mesh = space.mesh();
    let pattern = Pattern::of(&Edges::of(mesh), mesh.vertex_count())?;
    let mut blocks = vec![SMatrix::zeros(); pattern.columns.len()];
    for_rows(&pattern.starts, &mut blocks, &|rows, blocks| {
        let first = pattern.starts[rows.start as usize] as usize;
        for (index, corners) in mesh.cells().enumerate() {
            if !corners.iter().any(|p| rows.contains(p)) {
                continue;
            }
            let cell = mesh.simplex(corners);
            let data = data(index);
            for (i, &p) in corners.iter().enumerate() {
                let inside = rows.contains(&p);
                if inside {
                    blocks[pattern.find(p, p) - first] += form(&data, &cell, i, i);
                }
                for (j, &q) in corners.iter().enumerate().skip(i + 1) {
                    let block = form(&data, &cell, i, j);
                    if inside {
                        blocks[pattern.find(p, q) - first] += block;
                    }
                    if rows.contains(&q) {
                        blocks[pattern.find(q, p) - first] += block.transpose();
                    }
                }
            }
        }
    });
    let Pattern { starts, columns } = pattern;
    let shape = (mesh.vertex_count(), mesh.vertex_count());
    let matrix = BlockMatrix::new(shape, starts, columns, blocks);
    Ok(Assembled::on(mesh, matrix))
}

/// Data of a cell by a function of its midpoint and index, checked; errors name the cell.
pub(crate) fn by_cell<const D: usize, V, T: Copy + Sync>(
    space: &P1<D>,
    function: impl Fn(&SVector<f64, D>, usize) -> V,
    check: impl Fn(V) -> Result<T, FemError>,
) -> Result<impl Fn(usize) -> T + Sync, FemError> {
    let mesh = space.mesh();
    let data = (mesh.cells().enumerate()).map(|(cell, corners)| {
        let midpoint = mesh.simplex(corners).midpoint();
        check(function(&midpoint, cell)).map_err(|error| error.in_cell(cell))
    });
    let data = data.collect::<Result<Vec<_>, _>>()?;
    Ok(move |cell| data[cell])
}

/// The pairs of vertices that share a cell, in compressed rows with sorted columns.
struct Pattern {
    starts: Vec<u32>,
    columns: Vec<u32>,
}

impl Pattern {
    fn of(edges: &Edges, vertices: usize) -> Result<Self, FemError> {
        let entries = vertices + 2 * edges.count();
        if u32::try_from(entries).is_err() {
            return Err(FemError::too_many("blocks of a matrix", entries as u64));
        }
        let mut starts = vec![1; vertices + 1];
        starts[0] = 0;
        for (p, q) in edges.iter() {
            starts[p as usize + 1] += 1;
            starts[q as usize + 1] += 1;
        }
        for p in 1..=vertices {
            starts[p] += starts[p - 1];
        }
        // In increasing p: row p has its columns below p by the time p itself is appended.
        let mut next = starts.clone();
        let mut columns = vec![0; entries];
        let mut append = |row: usize, column: u32| {
            columns[next[row] as usize] = column;
            next[row] += 1;
        };
        for p in 0..vertices {
            append(p, p as u32);
            for &q in edges.above(p) {
                append(p, q);
                append(q as usize, p as u32);
            }
        }
        Ok(Self { starts, columns })
    }

    /// The position of a pair that shares a cell.
    fn find(&self, p: u32, q: u32) -> usize {
        let (start, end) = (
            self.starts[p as usize] as usize,
            self.starts[p as usize + 1] as usize,
        );
        start + self.columns[start..end].partition_point(|&column| column < q)
    }
}
