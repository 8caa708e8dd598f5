//! Cells along a line.

use super::DiffusionError;
use super::error::finite;

/// The distance of a side from a vertex on it, in lengths of its cell.
const RIM: f64 = 1e-3;

/// Cells along a line, of any lengths: the cells of a fault in two dimensions, or the trace of one.
///
/// ```
/// use stickslip_fields::Line;
///
/// let line = Line::uniform([-20e3, 20e3], 400)?;
/// assert_eq!((line.count(), line.positions()[0]), (400, -19_950.0));
/// // The vertices of a trace, in any order, by their position along it.
/// let trace = Line::trace(&[0.0, 10.0, 2.0, 5.0])?;
/// assert_eq!(trace.positions(), [0.0, 2.0, 5.0, 10.0]);
/// assert_eq!(trace.lengths(), [1.0, 2.5, 4.0, 2.5]);
/// # Ok::<(), stickslip_fields::DiffusionError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// The positions of the pressures, increasing \[m\].
    positions: Vec<f64>,
    /// The edges of the cells, one more \[m\].
    edges: Vec<f64>,
    lengths: Vec<f64>,
    /// The vertex of each cell.
    vertices: Vec<usize>,
}

impl Line {
    /// So many equal cells from one end to the other \[m\].
    ///
    /// # Errors
    /// [`DiffusionError`] for no cells, and for ends that are not finite or do not increase.
    pub fn uniform([begin, end]: [f64; 2], count: usize) -> Result<Self, DiffusionError> {
        let share = |i: usize| i as f64 / count as f64;
        // Both ends are met exactly.
        let edges: Vec<f64> = (0..=count)
            .map(|i| begin * (1.0 - share(i)) + end * share(i))
            .collect();
        Self::between(&edges)
    }

    /// The cells between these edges, which increase \[m\].
    ///
    /// # Errors
    /// [`DiffusionError`] for fewer than two edges, edges that are not finite and edges that do not increase.
    pub fn between(edges: &[f64]) -> Result<Self, DiffusionError> {
        require_cells(edges.len().saturating_sub(1))?;
        require_increasing("edge of a cell [m]", edges, |at| at)?;
        let positions: Vec<f64> = edges
            .windows(2)
            .map(|edge| 0.5 * (edge[0] + edge[1]))
            .collect();
        let vertices = (0..positions.len()).collect();
        Ok(Self::new(positions, edges.to_vec(), vertices))
    }

    /// The vertices of a trace by their position along it \[m\], in any order. A cell reaches half way to the
    /// neighbours of its vertex, those at the ends to their vertex.
    ///
    /// # Errors
    /// [`DiffusionError`] for fewer than two vertices, positions that are not finite and equal positions.
    pub fn trace(positions: &[f64]) -> Result<Self, DiffusionError> {
        require_cells(positions.len().saturating_sub(1))?;
        let mut vertices: Vec<usize> = (0..positions.len()).collect();
        vertices.sort_by(|&a, &b| positions[a].total_cmp(&positions[b]));
        let sorted: Vec<f64> = vertices.iter().map(|&vertex| positions[vertex]).collect();
        require_increasing("position of a vertex [m]", &sorted, |at| vertices[at])?;
        let inner = sorted.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let mut edges = vec![sorted[0]];
        edges.extend(inner);
        edges.push(sorted[sorted.len() - 1]);
        Ok(Self::new(sorted, edges, vertices))
    }

    fn new(positions: Vec<f64>, edges: Vec<f64>, vertices: Vec<usize>) -> Self {
        let lengths = edges.windows(2).map(|edge| edge[1] - edge[0]).collect();
        Self {
            positions,
            edges,
            lengths,
            vertices,
        }
    }

    /// The number of cells.
    pub fn count(&self) -> usize {
        self.positions.len()
    }

    /// The positions of the pressures along the line, increasing \[m\]: the centres of cells, or the vertices of a trace.
    pub fn positions(&self) -> &[f64] {
        &self.positions
    }

    /// The lengths of the cells, along the line \[m\].
    pub fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    /// The vertex of each cell, along the line.
    pub fn vertices(&self) -> &[usize] {
        &self.vertices
    }

    /// The ends \[m\].
    pub(super) fn ends(&self) -> [f64; 2] {
        [self.edges[0], self.edges[self.count()]]
    }

    /// The edges of a cell \[m\].
    pub(super) fn edges_of(&self, cell: usize) -> [f64; 2] {
        [self.edges[cell], self.edges[cell + 1]]
    }

    /// The cell that holds a position, the first at an edge; none outside.
    pub(super) fn cell_at(&self, position: f64) -> Option<usize> {
        let [begin, end] = self.ends();
        let inside = position >= begin && position <= end;
        inside.then(|| self.edges[1..self.count()].partition_point(|&edge| edge < position))
    }

    /// The distances between pressure and face on both sides of each inner face \[m\].
    fn distances(&self) -> impl Iterator<Item = [f64; 2]> {
        let pairs = self.positions.windows(2).zip(&self.edges[1..]);
        pairs.map(|(at, face)| [face - at[0], at[1] - face])
    }

    /// The conductances of the inner faces, from the mobility of each cell.
    pub(super) fn conductances(&self, mobility: &[f64], faces: &mut [f64]) {
        let pairs = mobility.windows(2).zip(self.distances());
        for (face, (mobility, distance)) in faces.iter_mut().zip(pairs) {
            *face = super::faces::conductance([mobility[0], mobility[1]], distance);
        }
    }

    /// Conductance over mobility from the first or last cell to the side there [1/m].
    pub(super) fn to_side(&self, last: bool) -> (usize, f64) {
        let cell = if last { self.count() - 1 } else { 0 };
        let distance = (self.ends()[usize::from(last)] - self.positions[cell]).abs();
        (cell, 1.0 / distance.max(RIM * self.lengths[cell]))
    }

    /// Adds the volume rates that flow into each cell.
    pub(super) fn add_flow(faces: &[f64], pressure: &[f64], into: &mut [f64]) {
        let mut before = 0.0;
        for (i, &face) in faces.iter().enumerate() {
            let flow = face * (pressure[i + 1] - pressure[i]);
            into[i] += flow - before;
            before = flow;
        }
        into[faces.len()] -= before;
    }
}

impl Line {
    /// Adds half the volume rate along the line through each face to both of its cells.
    pub(super) fn add_half_flow(faces: &[f64], pressure: &[f64], rates: &mut [f64]) {
        for (i, &face) in faces.iter().enumerate() {
            let half = 0.5 * face * (pressure[i] - pressure[i + 1]);
            rates[i] += half;
            rates[i + 1] += half;
        }
    }
}

fn require_cells(count: usize) -> Result<(), DiffusionError> {
    if count > 0 {
        return Ok(());
    }
    Err(DiffusionError::Count {
        what: "cells of a line",
        expected: 1,
        found: 0,
    })
}

fn require_increasing(
    what: &'static str,
    values: &[f64],
    cell: impl Fn(usize) -> usize,
) -> Result<(), DiffusionError> {
    for (at, &value) in values.iter().enumerate() {
        finite(what, Some(cell(at)), value)?;
        if at > 0 && value <= values[at - 1] {
            let requirement = "beyond the one before";
            return Err(DiffusionError::Value {
                what,
                cell: Some(cell(at)),
                requirement,
                value,
            });
        }
    }
    Ok(())
}
