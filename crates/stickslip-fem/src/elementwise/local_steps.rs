//! Cells in levels of local steps: those of level `l` act every `2^l`-th step.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_core::MOST_LEVELS;

use super::product::add_product;
use super::{ElementStiffness, Elements, Materials};
use crate::{Assembled, FemError, Mesh, P1};

/// The slack of ratios of frequencies, which are equal up to rounding in regular parts of a mesh.
const ROUNDING: f64 = 1e-9;

/// The rings of cells around the vertices of a level, of which no cell is of a higher one. By measurement: arrivals of TPV102
/// change by up to 0.17 steps without them, 0.14 with one and 0.08 with two.
const RINGS: usize = 2;

impl<const D: usize> ElementStiffness<D> {
    /// The same stiffness with cells in at most so many levels of local steps: in explicit steps of `dt` those of level `l` act
    /// every `2^l`-th step alone, with `2^l` times their force.
    ///
    /// ```text
    /// M a = sum over l of w_l A_l u,    w_l = 2^l if 2^l divides the number of the step, else 0
    /// ```
    ///
    /// A vertex has the frequency `omega_i^2 = max diag(A_ii)/m_i` by itself. It is of level `l` if its frequency is `2^l` times
    /// lower than the highest one, and of level 0 if it is among the `finest`. A cell is of the lowest level of its corners and of
    /// the vertices within two rings of cells around them. Every vertex that a cell of level `l` accelerates hence vibrates `2^l`
    /// times slower than the fastest one, and waves pass two rings of cells before they meet longer steps. The scheme is the
    /// reversible multiple-time-step scheme r-RESPA (M. Tuckerman, B. Berne, G. Martyna, J. Chem. Phys. 97 (1992)), an
    /// asynchronous variational integrator (A. Lew, J. Marsden, M. Ortiz, M. West, Arch. Ration. Mech. Anal. 167 (2003)) with
    /// nested steps: of second order, symmetric in time, and it conserves momentum.
    ///
    /// Accelerations and reactions of a step hold these impulses; their means over a cycle of `2^(levels - 1)` steps are the
    /// acceleration and the reaction.
    ///
    /// Vertices with friction must be among the `finest`; a scene refuses others. Multiples and
    /// [viscosities](Self::viscosity_by_cell) are made of the result, to have its levels. One level is the stiffness as it was.
    ///
    /// ```
    /// use stickslip_fem::{Elastic, P1, element_stiffness, lumped_mass};
    ///
    /// let rock = Elastic { young_modulus: 2.5, poisson_ratio: 0.25 };
    /// let space = P1::<2>::grid([16.0, 4.0], [16, 4])?.graded(|x| 0.125 + 0.25 * x.norm())?;
    /// let mass = lumped_mass(&space, 1.0)?;
    /// let base = space.trace(|x| x[1] == 0.0 && x[0] < 1.0)?;
    /// let stiffness = element_stiffness(&space, &rock)?.with_local_steps(&space, &mass, base.vertices(), 4)?;
    /// assert_eq!(stiffness.levels(), 4);
    /// assert_eq!(stiffness.cells_of_levels().iter().sum::<usize>(), space.mesh().cell_count());
    /// assert!(base.vertices().iter().all(|&vertex| stiffness.level_at(vertex) == 0));
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`FemError::Mesh`] for a space or a mass of another mesh, [`FemError::OutOfRange`] for a vertex that the mesh has not, and
    /// [`FemError::Value`] for no level or more than [`MOST_LEVELS`].
    #[doc(alias("multirate", "subcycling", "LTS"))]
    pub fn with_local_steps(
        &self,
        space: &P1<D>,
        mass: &Assembled<D>,
        finest: &[usize],
        levels: usize,
    ) -> Result<Self, FemError> {
        let (mesh, vertices) = (space.mesh(), self.vertex_count());
        for (what, found) in [("space", mesh.identity()), ("mass", mass.mesh())] {
            if found != self.mesh() {
                let expected = self.mesh();
                return Err(FemError::Mesh {
                    what,
                    expected,
                    found,
                });
            }
        }
        if !(1..=MOST_LEVELS).contains(&levels) {
            return Err(FemError::Value {
                what: "number of levels of local steps",
                requirement: "from 1 to MOST_LEVELS",
                value: levels as f64,
                cell: None,
            });
        }
        let mut of_vertices = self.levels_of_vertices(mass, levels);
        for &vertex in finest {
            let Some(level) = of_vertices.get_mut(vertex) else {
                return Err(FemError::OutOfRange {
                    what: "vertex",
                    index: vertex,
                    count: vertices,
                    by: "the finest level of local steps".into(),
                });
            };
            *level = 0;
        }
        for _ in 0..RINGS {
            of_vertices = lowest_around(mesh, &of_vertices);
        }
        let level = |cell: u32| {
            let corners = mesh.cell(cell as usize).iter();
            corners
                .map(|&p| of_vertices[p as usize])
                .min()
                .unwrap_or_default()
        };
        let elements = Elements::of(mesh, level);
        Ok(Self {
            lame: Arc::new(self.reordered(&elements)),
            elements: Arc::new(elements),
            factor: self.factor,
        })
    }

    /// The levels of vertices by their frequencies.
    fn levels_of_vertices(&self, mass: &Assembled<D>, levels: usize) -> Vec<u8> {
        let squares = mass.outer_iterator().enumerate().map(|(i, row)| {
            let mass: f64 = row.iter().map(|(_, block)| block[(0, 0)]).sum();
            self.diagonal_block(i).diagonal().max() / mass
        });
        let squares: Vec<f64> = squares.collect();
        let highest = squares.iter().copied().fold(0.0, f64::max);
        let level = |square: f64| {
            let halvings = 0.5 * (highest / square).log2() + ROUNDING;
            (halvings as usize).min(levels - 1) as u8
        };
        squares.into_iter().map(level).collect()
    }

    /// The materials of the same cells in another order.
    fn reordered(&self, elements: &Elements) -> Materials {
        let own = &self.elements.groups;
        let mut places = vec![(0, 0); self.elements.mesh.cells];
        for (row, cells) in own.cells.iter().enumerate() {
            for (place, &cell) in cells.iter().enumerate() {
                places[cell as usize] = (row, place);
            }
        }
        Materials::of(&elements.groups, &|cell| {
            let (row, place) = places[cell];
            self.lame.of_cell(row, place)
        })
    }

    /// The number of levels of local steps: 1 without.
    pub fn levels(&self) -> usize {
        self.elements.groups.levels()
    }

    /// The number of cells of each level.
    pub fn cells_of_levels(&self) -> Vec<usize> {
        let groups = &self.elements.groups;
        let mut counts = vec![0; groups.levels()];
        for group in 0..groups.count() {
            counts[groups.level[group]] += groups.cell_count(group);
        }
        counts
    }

    /// The highest level of the cells of a vertex.
    ///
    /// # Panics
    /// Unless the vertex is below [`vertex_count`](Self::vertex_count).
    pub fn level_at(&self, vertex: usize) -> usize {
        let groups = &self.elements.groups;
        let cells = self.elements.copies.cells(vertex);
        let levels = cells.map(|(row, _)| groups.level[groups.group_of(row)]);
        levels.max().unwrap_or(0)
    }

    /// The lowest level of the cells of each vertex: in steps whose weights above 0 are those of lower levels, no force acts
    /// there. Empty for a single level.
    pub fn lowest_levels(&self) -> &[u8] {
        &self.elements.lowest
    }

    /// `y += scale (sum over levels l of weights[l] A_l) x`, with the weight 0 for those that are not given. Cells without weight
    /// are not computed, unless they are of a level between others.
    ///
    /// # Panics
    /// For fields of another length.
    pub fn multiply_add_levels(
        &self,
        weights: &[f64],
        scale: f64,
        x: &[SVector<f64, D>],
        y: &mut [SVector<f64, D>],
    ) {
        let vertices = self.vertex_count();
        assert_eq!([x.len(), y.len()], [vertices; 2], "vectors of two fields");
        add_product(self, Some(weights), scale, x, y);
    }
}

/// The lowest level of the vertices of the cells of each vertex.
fn lowest_around<const D: usize>(mesh: &Mesh<D>, levels: &[u8]) -> Vec<u8> {
    let mut lowest = levels.to_vec();
    for cell in 0..mesh.cell_count() {
        let corners = mesh.cell(cell);
        let of_corners = corners.iter().map(|&p| levels[p as usize]);
        let least = of_corners.min().unwrap_or_default();
        for &p in corners {
            let own = &mut lowest[p as usize];
            *own = least.min(*own);
        }
    }
    lowest
}
