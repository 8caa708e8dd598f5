//! The interaction between planes, from the stresses of corners.

use nalgebra::{Matrix3, Vector3};

use super::FaultSystem;
use super::blocks::Blocks;
use super::placement::Axes;
use crate::plane::dislocation::Rock;
use crate::plane::okada::{self, Gradient};
use crate::{Cells, PlaneFault};

impl<const C: usize> FaultSystem<C> {
    /// The forces on cells per slip of cells of other planes.
    pub(super) fn shear_blocks(&self) -> Blocks<C, C> {
        self.blocks(|receiver, axes| {
            let area = receiver.cells().area();
            receiver.directions().map(|[strike, dip]| {
                let direction = axes.strike * strike + axes.up_dip * dip;
                direction * axes.normal.transpose() * -area
            })
        })
    }

    /// The compression of cells per slip of cells of other planes.
    pub(super) fn normal_blocks(&self) -> Blocks<1, C> {
        self.blocks(|_, axes| [-axes.normal * axes.normal.transpose()])
    }

    /// From the weights of the stress at cells of a plane.
    fn blocks<const R: usize>(
        &self,
        weights: impl Fn(&PlaneFault<C>, &Axes) -> [Matrix3<f64>; R],
    ) -> Blocks<R, C> {
        let mut blocks = Blocks::new(self.ranges.clone());
        for source in 0..self.planes.len() {
            let mut of_cells = StressOfCells::new(&self.planes[source]);
            for receiver in (0..self.planes.len()).filter(|&receiver| receiver != source) {
                let plane = &self.planes[receiver];
                let from = &self.placements[source];
                let axes = self.placements[receiver].axes_from(from, self.dip(receiver));
                let weights = weights(plane, &axes).map(|of| of_cells.rock.of_gradient(&of));
                for cell in 0..plane.cells().count() {
                    let at = axes.point(plane.cells().center(cell));
                    of_cells.add_to(&mut blocks, [receiver, cell], source, &weights, &at);
                }
            }
        }
        blocks
    }
}

/// Stresses of all cells of a plane at a point. Neighbours share their corners.
struct StressOfCells<'a, const R: usize, const C: usize> {
    plane: &'a PlaneFault<C>,
    rock: Rock,
    columns: Vec<Edge>,
    rows: Vec<Edge>,
    /// Corners `[row][column]` of edges.
    corners: Vec<[[f64; C]; R]>,
}

/// An edge between cells, and whether it counts for those that are behind the point ([`okada::source`]).
#[derive(Clone, Copy)]
struct Edge {
    at: f64,
    behind: bool,
}

impl<'a, const R: usize, const C: usize> StressOfCells<'a, R, C> {
    fn new(plane: &'a PlaneFault<C>) -> Self {
        Self {
            plane,
            rock: plane.dipping(),
            columns: Vec::new(),
            rows: Vec::new(),
            corners: Vec::new(),
        }
    }

    /// Sets the numbers of a cell of another plane due to all cells, from weights of gradients, at a point that is seen
    /// from the plane.
    fn add_to(
        &mut self,
        blocks: &mut Blocks<R, C>,
        receiver: [usize; 2],
        source: usize,
        weights: &[Gradient; R],
        at: &Vector3<f64>,
    ) {
        let [cos, sin] = [self.rock.dip.cos, self.rock.dip.sin];
        let (x, y, z) = (at.x, at.y, at.z);
        // Okada's point and its image: up dip from the surface, and along the normal.
        let (up, q) = (y * cos + z * sin, y * sin - z * cos);
        let (up_image, q_image) = (y * cos - z * sin, y * sin + z * cos);
        let (along, down) = (
            self.plane.cells().along_strike(),
            self.plane.cells().down_dip(),
        );
        // Columns from the first on are behind the point, and so are rows before the last.
        let columns = 0..along.count();
        let first = columns.take_while(|&cell| edge(along, cell) <= x).count();
        set_edges(&mut self.columns, along, first, [false, true]);
        let rows = 0..down.count();
        let last = rows.take_while(|&cell| edge(down, cell + 1) < -up).count();
        set_edges(&mut self.rows, down, last, [true, false]);
        self.corners.clear();
        for row in &self.rows {
            for column in &self.columns {
                let xi = x - column.at;
                let behind = [column.behind, row.behind];
                let source = okada::source(&self.rock.dip, [xi, up + row.at, q], behind);
                let at_image = [xi, up_image + row.at, q_image];
                let image = okada::image(&self.rock.dip, at_image, behind[0], z);
                let sum = |weights: &Gradient| {
                    [0, 1].map(|slip| {
                        let gradient = source[slip].as_flattened().iter();
                        let gradient = gradient.zip(image[slip].as_flattened());
                        let terms = gradient.zip(weights.as_flattened());
                        terms.map(|((a, b), weight)| (a + b) * weight).sum::<f64>()
                    })
                };
                let of_slip = weights.each_ref().map(sum);
                self.corners.push(of_slip.map(|[strike, dip]| {
                    (self.plane.directions()).map(|[a, b]| a * strike + b * dip)
                }));
            }
        }
        let width = self.columns.len();
        for component in 0..C {
            for number in 0..R {
                let entries = blocks.entries_mut(receiver, number, source, component);
                let value = |corner: usize| self.corners[corner][number][component];
                for (row, entries) in entries.chunks_exact_mut(along.count()).enumerate() {
                    let upper = (row + twice(row, last)) * width;
                    for (column, entry) in entries.iter_mut().enumerate() {
                        let left = upper + column + twice(column, first);
                        let (near, far) = (left, left + 1);
                        *entry =
                            (value(near + width) - value(far + width)) - (value(near) - value(far));
                    }
                }
            }
        }
    }
}

/// The edge before a cell.
fn edge(cells: &Cells, cell: usize) -> f64 {
    cells.ends()[0] + cell as f64 * cells.length()
}

/// The edges of the cells before `middle`, then those of the others: the one between them comes twice.
fn set_edges(edges: &mut Vec<Edge>, cells: &Cells, middle: usize, behind: [bool; 2]) {
    edges.clear();
    let count = cells.count();
    for (begin, end, behind) in [(0, middle, behind[0]), (middle, count, behind[1])] {
        if begin < end {
            let of_cells = (begin..=end).map(|cell| edge(cells, cell));
            edges.extend(of_cells.map(|at| Edge { at, behind }));
        }
    }
}

/// The edges before that of a cell that come twice.
fn twice(cell: usize, middle: usize) -> usize {
    usize::from(middle > 0 && cell >= middle)
}
