//! Cells in any arrangement.

use super::DiffusionError;
use super::error::{finite, not_negative, positive};
use super::faces::conductance;

const EDGE: &str = "edge";

/// Two cells that exchange fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// The cells.
    pub cells: [usize; 2],
    /// The length of their common face \[m\], at least 0.
    pub length: f64,
    /// The distance of the pressure of each from the face \[m\], above 0.
    pub distances: [f64; 2],
}

/// Cells in any arrangement, such as the vertices of a surface in space.
///
/// The pressure of a cell is that of the vertex of its number. Rims are sealed, but for open faces
/// ([`Diffusion::with_open_face`](super::Diffusion::with_open_face)).
///
/// ```
/// use stickslip_fields::Network;
///
/// // A square of two triangles.
/// let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let network = Network::triangles(&points, &[[0, 1, 2], [0, 2, 3]])?;
/// assert_eq!(network.count(), 4);
/// assert!((network.areas().iter().sum::<f64>() - 1.0).abs() < 1e-15);
/// # Ok::<(), stickslip_fields::DiffusionError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Network {
    areas: Vec<f64>,
    edges: Vec<Edge>,
}

impl Network {
    /// Cells of these areas [m^2], above 0, and their edges.
    ///
    /// # Errors
    /// [`DiffusionError`] for no cells, for lengths, distances and areas out of their ranges, and for edges from a cell to
    /// itself or to one that does not exist, with their number.
    pub fn new(areas: Vec<f64>, edges: Vec<Edge>) -> Result<Self, DiffusionError> {
        if areas.is_empty() {
            let what = "cells of a network";
            return Err(DiffusionError::Count {
                what,
                expected: 1,
                found: 0,
            });
        }
        for (cell, &area) in areas.iter().enumerate() {
            positive("area [m^2]", Some(cell), area)?;
        }
        for (number, edge) in edges.iter().enumerate() {
            let refuse = |requirement, cell: usize| {
                let value = cell as f64;
                DiffusionError::Value {
                    what: EDGE,
                    cell: Some(number),
                    requirement,
                    value,
                }
            };
            if let Some(&cell) = edge.cells.iter().find(|&&cell| cell >= areas.len()) {
                return Err(refuse("between cells that exist", cell));
            }
            if edge.cells[0] == edge.cells[1] {
                return Err(refuse("between two cells", edge.cells[0]));
            }
            not_negative("length of edge [m]", Some(number), edge.length)?;
            for distance in edge.distances {
                positive("distance of edge [m]", Some(number), distance)?;
            }
        }
        Ok(Self { areas, edges })
    }

    /// The vertices of a triangulated surface. Each has a third of the area of its triangles; an edge of length `d` has a
    /// face of length `d (cot a + cot b)/2`, with the angles opposite to it: linear finite elements, with harmonic means.
    ///
    /// Where these angles add to more than 180 degrees, the edge does not conduct: take Delaunay triangles.
    ///
    /// # Errors
    /// [`DiffusionError`] for triangles without area and vertices that do not exist, with their number, for points that
    /// are not finite, and for vertices without a triangle.
    pub fn triangles(
        points: &[[f64; 3]],
        triangles: &[[usize; 3]],
    ) -> Result<Self, DiffusionError> {
        for (vertex, &coordinate) in points
            .iter()
            .enumerate()
            .flat_map(|(i, p)| p.iter().map(move |x| (i, x)))
        {
            finite("coordinate of a vertex [m]", Some(vertex), coordinate)?;
        }
        let mut areas = vec![0.0; points.len()];
        let mut faces: Vec<([usize; 2], f64)> = Vec::with_capacity(3 * triangles.len());
        for (number, &corners) in triangles.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&vertex| vertex >= points.len()) {
                let (requirement, value) = ("of vertices that exist", vertex as f64);
                return Err(DiffusionError::Value {
                    what: "triangle",
                    cell: Some(number),
                    requirement,
                    value,
                });
            }
            let side = |from: usize, to: usize| {
                let [from, to] = [from % 3, to % 3].map(|corner| points[corners[corner]]);
                [0, 1, 2].map(|axis| to[axis] - from[axis])
            };
            let area = 0.5 * norm(cross(side(0, 1), side(0, 2)));
            positive("area of triangle [m^2]", Some(number), area)?;
            for corner in 0..3 {
                areas[corners[corner]] += area / 3.0;
                // The cotangent at this corner, for the edge opposite to it.
                let cotangent =
                    dot(side(corner, corner + 1), side(corner, corner + 2)) / (2.0 * area);
                let mut cells = [corners[(corner + 1) % 3], corners[(corner + 2) % 3]];
                cells.sort_unstable();
                faces.push((cells, 0.5 * cotangent));
            }
        }
        faces.sort_by_key(|&(cells, _)| cells);
        let edges = faces.chunk_by(|a, b| a.0 == b.0).map(|parts| {
            let cells = parts[0].0;
            let share: f64 = parts.iter().map(|&(_, share)| share).sum();
            let [a, b] = cells.map(|cell| points[cell]);
            let distance = norm([0, 1, 2].map(|axis| b[axis] - a[axis]));
            Edge {
                cells,
                length: share.max(0.0) * distance,
                distances: [0.5 * distance; 2],
            }
        });
        Self::new(areas, edges.collect())
    }

    /// The number of cells.
    pub fn count(&self) -> usize {
        self.areas.len()
    }

    /// The areas of cells [m^2].
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// The edges.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The conductances of the edges, from the mobility of each cell.
    pub(super) fn conductances(&self, mobility: &[f64], faces: &mut [f64]) {
        for (face, edge) in faces.iter_mut().zip(&self.edges) {
            let mobility = edge.cells.map(|cell| mobility[cell]);
            *face = edge.length * conductance(mobility, edge.distances);
        }
    }

    /// Adds `weight` times the volume rates that flow into each cell from the others.
    pub(super) fn add_flow(&self, faces: &[f64], pressure: &[f64], weight: f64, into: &mut [f64]) {
        for (face, edge) in faces.iter().zip(&self.edges) {
            let [a, b] = edge.cells;
            let flow = weight * face * (pressure[b] - pressure[a]);
            into[a] += flow;
            into[b] -= flow;
        }
    }

    /// Whether edges that conduct join all cells.
    pub(super) fn is_connected(&self, faces: &[f64]) -> bool {
        let mut leader: Vec<usize> = (0..self.count()).collect();
        let mut parts = self.count();
        for (edge, _) in self
            .edges
            .iter()
            .zip(faces)
            .filter(|&(_, &face)| face > 0.0)
        {
            let [a, b] = edge.cells.map(|cell| find(&mut leader, cell));
            if a != b {
                leader[a.max(b)] = a.min(b);
                parts -= 1;
            }
        }
        parts == 1
    }
}

/// The leader of a cell; paths are halved.
fn find(leader: &mut [usize], mut cell: usize) -> usize {
    while leader[cell] != cell {
        leader[cell] = leader[leader[cell]];
        cell = leader[cell];
    }
    cell
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}
