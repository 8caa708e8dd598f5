//! Rounds of bisection of the cells that exceed a size function.

use std::collections::HashMap;

use nalgebra::SVector;

use crate::bisection::Cell;
use crate::children::Children;
use crate::curve::{Curve, Onto};
use crate::simplex::Simplex;
use crate::twin_edges::TwinEdges;
use crate::weights::Weights;
use crate::{FemError, Hierarchy};

/// Least size of a cell over the largest coordinate. The coordinates of a midpoint are rounded to 2^-53 of that: 2^-21
/// of the smallest cell, too little to change its shape.
const LEAST: f64 = 1.0 / (1_u64 << 32) as f64;

/// Number of cells from which on the final number of vertices is predicted from the present sizes.
const FORETELLING: usize = 10_000;

/// A mesh that is being cut, from the last level on.
pub(crate) struct Grading<'a, const D: usize, F> {
    size: &'a F,
    onto: Option<Onto<'a, D>>,
    curve: Option<Curve<'a, D>>,
    least: f64,
    pub(crate) points: Vec<SVector<f64, D>>,
    /// The size function at the vertices.
    sizes: Vec<f64>,
    cells: Vec<Cell>,
    /// Diameter over size.
    pub(crate) excess: Vec<f64>,
    /// The parent on the last level.
    parents: Vec<usize>,
    /// The number of bisections from the cell of the last level.
    pub(crate) generations: Vec<u8>,
    weights: Weights,
    twins: TwinEdges<D>,
    /// The midpoints of the edges halved in this round.
    middles: HashMap<(u32, u32), u32>,
    /// Whether a vertex is the end of a halved edge.
    touched: Vec<bool>,
}

impl<'a, const D: usize, F: Fn(&SVector<f64, D>) -> f64> Grading<'a, D, F> {
    pub(crate) fn new(
        hierarchy: &Hierarchy<D>,
        size: &'a F,
        onto: Option<Onto<'a, D>>,
    ) -> Result<Self, FemError> {
        let vertices = &hierarchy.finest().vertices;
        let largest = (vertices.iter()).fold(0.0_f64, |largest, x| largest.max(x.amax()));
        let mut grading = Self {
            size,
            onto,
            curve: None,
            least: LEAST * largest,
            points: Vec::new(),
            sizes: Vec::new(),
            cells: Vec::new(),
            excess: Vec::new(),
            parents: Vec::new(),
            generations: Vec::new(),
            weights: Weights::new(0, 0),
            twins: TwinEdges::none(),
            middles: HashMap::new(),
            touched: Vec::new(),
        };
        grading.begin(hierarchy)?;
        Ok(grading)
    }

    /// Starts from the finest level.
    fn begin(&mut self, hierarchy: &Hierarchy<D>) -> Result<(), FemError> {
        let mesh = hierarchy.finest();
        let level = hierarchy.level_count() - 1;
        self.curve = match self.onto {
            Some(onto) => Some(Curve::new(mesh, level, onto)?),
            None => None,
        };
        self.points.clone_from(&mesh.vertices);
        self.sizes = (mesh.vertices.iter())
            .map(|x| self.size_at(x))
            .collect::<Result<_, _>>()?;
        self.cells = Cell::all(mesh);
        self.excess = (self.cells.iter())
            .map(|cell| self.excess_of(cell))
            .collect::<Result<_, _>>()?;
        self.parents = (0..self.cells.len()).collect();
        self.generations = vec![0; self.cells.len()];
        self.weights = Weights::new(mesh.vertex_count(), mesh.vertex_count());
        self.twins = TwinEdges::of(mesh);
        self.touched = vec![false; mesh.vertex_count()];
        Ok(())
    }

    /// Makes a level of the present cells.
    pub(crate) fn add_level(&mut self, hierarchy: &mut Hierarchy<D>) -> Result<(), FemError> {
        let offspring = Children {
            points: &self.points,
            weights: &self.weights,
            cells: &self.cells,
            parents: &self.parents,
            twins: &self.twins,
        };
        let finer = offspring.mesh(hierarchy.finest())?;
        hierarchy.push(finer);
        self.begin(hierarchy)
    }

    fn size_at(&self, x: &SVector<f64, D>) -> Result<f64, FemError> {
        let value = (self.size)(x);
        if value.is_finite() && value >= self.least {
            return Ok(value);
        }
        Err(FemError::CellSize {
            value,
            at: x.iter().copied().collect(),
            least: self.least,
        })
    }

    /// The longest edge over the least size at vertices and midpoint.
    fn excess_of(&self, cell: &Cell) -> Result<f64, FemError> {
        let corners = &cell.corners[..=D];
        let simplex = Simplex::new(&self.points, corners);
        let at_midpoint = self.size_at(&simplex.midpoint())?;
        let sizes = corners.iter().map(|&p| self.sizes[p as usize]);
        Ok(simplex.longest_edge() / sizes.fold(at_midpoint, f64::min))
    }

    /// Bisects the cells of larger excess, and those with hanging nodes, until the mesh is conforming.
    pub(crate) fn round(&mut self, threshold: f64) -> Result<(), FemError> {
        for k in 0..self.cells.len() {
            if self.excess[k] > threshold {
                self.bisect(k)?;
            }
        }
        let mut conforming = false;
        while !conforming {
            conforming = true;
            let mut k = 0;
            while k < self.cells.len() {
                if self.has_hanging_vertices(k) {
                    self.bisect(k)?;
                    conforming = false;
                } else {
                    k += 1;
                }
            }
        }
        for (p, q) in self.middles.drain().map(|(ends, _)| ends) {
            self.touched[p as usize] = false;
            self.touched[q as usize] = false;
        }
        Ok(())
    }

    fn has_hanging_vertices(&self, k: usize) -> bool {
        let corners = &self.cells[k].corners[..=D];
        let touched = |p: u32| self.touched[p as usize];
        (0..D).any(|i| {
            touched(corners[i])
                && (i + 1..=D).any(|j| {
                    touched(corners[j]) && self.middles.contains_key(&ends(corners[i], corners[j]))
                })
        })
    }

    /// Replaces a cell by its halves, one in its place and one at the end of the list.
    fn bisect(&mut self, k: usize) -> Result<(), FemError> {
        let cell = self.cells[k];
        let edge = ends(cell.corners[0], cell.corners[1]);
        let middle = match self.middles.get(&edge) {
            Some(&middle) => middle,
            None => self.halve_all(edge)?,
        };
        let [first, second] = cell.halves::<D>(middle);
        if let Some(curve) = &self.curve {
            for half in [&first, &second] {
                curve.check(&self.points, &half.corners[..=D], self.parents[k])?;
            }
        }
        self.excess[k] = self.excess_of(&first)?;
        self.excess.push(self.excess_of(&second)?);
        self.cells[k] = first;
        self.cells.push(second);
        self.parents.push(self.parents[k]);
        self.generations[k] += 1;
        self.generations.push(self.generations[k]);
        Ok(())
    }

    /// The midpoint of an edge as a new vertex; those of edges that coincide with it on other sides of faults, too.
    fn halve_all(&mut self, edge: (u32, u32)) -> Result<u32, FemError> {
        if self.twins.is_empty() {
            return self.halve(edge);
        }
        let edges = self.twins.coinciding(&self.weights, edge);
        let middles = (edges.iter())
            .map(|&edge| self.halve(edge))
            .collect::<Result<Vec<_>, _>>()?;
        self.twins.halved(&self.weights, &edges, &middles);
        Ok(middles[0])
    }

    /// The midpoint of an edge as a new vertex.
    fn halve(&mut self, (p, q): (u32, u32)) -> Result<u32, FemError> {
        let vertices = self.points.len() as u64 + 1;
        let Ok(middle) = u32::try_from(self.points.len()) else {
            return Err(FemError::too_many("vertices", vertices));
        };
        let ends = [p, q].map(|end| &self.points[end as usize]);
        let x = match &self.curve {
            Some(curve) if curve.holds(&self.weights, p, q) => curve.middle(ends)?,
            _ => 0.5 * (ends[0] + ends[1]),
        };
        self.sizes.push(self.size_at(&x)?);
        self.points.push(x);
        self.weights.halve(p, q);
        self.middles.insert((p, q), middle);
        self.touched[p as usize] = true;
        self.touched[q as usize] = true;
        self.touched.push(false);
        Ok(middle)
    }

    /// Refuses a mesh of more vertices, or one whose numbering would exceed 32 bits. Of simplices of diameter h the regular one has most volume,
    /// and large meshes have about two triangles or six tetrahedra per vertex.
    pub(crate) fn foretell(&self, most: u32) -> Result<(), FemError> {
        if self.cells.len() < FORETELLING {
            return Ok(());
        }
        let (regular, cells_a_vertex) = if D == 2 {
            (0.75_f64.sqrt() / 2.0, 2.0)
        } else {
            (0.5_f64.sqrt() / 6.0, 6.0)
        };
        let cells: f64 = (self.cells.iter())
            .map(|cell| {
                let corners = &cell.corners[..=D];
                let sizes = corners.iter().map(|&p| self.sizes[p as usize]);
                let largest = regular * sizes.fold(0.0, f64::max).powi(D as i32);
                (Simplex::new(&self.points, corners).volume / largest).max(1.0)
            })
            .sum();
        let vertices = (cells / cells_a_vertex) as u64;
        if vertices > u64::from(u32::MAX) {
            return Err(FemError::too_many("vertices", vertices));
        }
        if vertices > u64::from(most) {
            return Err(FemError::AboveLimit {
                count: vertices,
                most,
            });
        }
        Ok(())
    }
}

fn ends(p: u32, q: u32) -> (u32, u32) {
    (p.min(q), p.max(q))
}
