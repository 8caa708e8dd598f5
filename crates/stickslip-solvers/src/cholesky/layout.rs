//! Positions of the components of a field in the factor, and their coupling to prescribed components.

use nalgebra::SVector;

use crate::block::FIXED;
use crate::block_matrix::Rows;
use crate::{BlockMatrix, SolveError};

use super::ordering::elimination_order;

/// The numbering of the free components in the order of elimination, for one pattern.
#[derive(Debug)]
pub(crate) struct Layout<const C: usize> {
    starts: Vec<u32>,
    columns: Vec<u32>,
    vertices: Vec<usize>,
    fixed: Vec<[bool; C]>,
    /// The row in the factor of each component of each vertex, or [`FIXED`].
    pub(crate) positions: Vec<[u32; C]>,
    /// The vertex of each row of the factor.
    pub(crate) owners: Vec<u32>,
    /// The number of rows that belong to vertices without friction; the others follow.
    pub(crate) interior: usize,
    /// The lower triangle by columns.
    pub(crate) lower: Pattern,
    /// For each entry of `lower`: the block, and the position in it.
    pub(crate) sources: Vec<(u32, u8, u8)>,
    couplings: Vec<Coupling>,
}

/// Compressed columns.
#[derive(Debug)]
pub(crate) struct Pattern {
    pub(crate) starts: Vec<usize>,
    pub(crate) rows: Vec<usize>,
}

impl Pattern {
    /// The number of columns.
    pub(super) fn columns(&self) -> usize {
        self.starts.len() - 1
    }
}

/// An entry of the operator between a free component and a prescribed one.
#[derive(Debug)]
struct Coupling {
    position: u32,
    block: u32,
    vertex: u32,
    row: u8,
    column: u8,
}

impl<const C: usize> Layout<C> {
    /// Orders the unknowns of an operator; second, the pattern of its upper triangle.
    pub(crate) fn new(
        operator: &BlockMatrix<C>,
        vertices: &[usize],
        fixed: &[[bool; C]],
    ) -> Result<(Self, Pattern), SolveError> {
        let order = elimination_order(&Rows::of(operator).graph(), vertices, C)?;
        Ok(Self::ordered(operator, vertices, fixed, &order))
    }

    /// The layout for a given order with the frictional vertices last.
    pub(super) fn ordered(
        operator: &BlockMatrix<C>,
        vertices: &[usize],
        fixed: &[[bool; C]],
        order: &[u32],
    ) -> (Self, Pattern) {
        let rows = Rows::of(operator);
        let mut positions = vec![[FIXED; C]; fixed.len()];
        let (mut owners, mut interior) = (Vec::new(), 0);
        for (place, &vertex) in order.iter().enumerate() {
            for c in (0..C).filter(|&c| !fixed[vertex as usize][c]) {
                positions[vertex as usize][c] = owners.len() as u32;
                owners.push(vertex);
            }
            if place + vertices.len() + 1 == order.len() {
                interior = owners.len();
            }
        }
        let empty = || Pattern {
            starts: vec![0],
            rows: Vec::new(),
        };
        let (mut lower, mut upper) = (empty(), empty());
        let (mut sources, mut couplings) = (Vec::new(), Vec::new());
        let mut column = Vec::new();
        for &vertex in order {
            for c in (0..C).filter(|&c| positions[vertex as usize][c] != FIXED) {
                let position = positions[vertex as usize][c];
                column.clear();
                // Row `vertex` of the symmetric matrix serves as its column.
                for block in rows.range(vertex as usize) {
                    let other = rows.columns[block];
                    for (r, &place) in positions[other as usize].iter().enumerate() {
                        if place == FIXED {
                            couplings.push(Coupling {
                                position,
                                block: block as u32,
                                vertex: other,
                                row: c as u8,
                                column: r as u8,
                            });
                        } else {
                            column.push((place, (block as u32, c as u8, r as u8)));
                        }
                    }
                }
                column.sort_unstable();
                for &(place, source) in &column {
                    if place >= position {
                        lower.rows.push(place as usize);
                        sources.push(source);
                    }
                    if place <= position {
                        upper.rows.push(place as usize);
                    }
                }
                lower.starts.push(lower.rows.len());
                upper.starts.push(upper.rows.len());
            }
        }
        let layout = Self {
            starts: rows.starts.to_vec(),
            columns: rows.columns.to_vec(),
            vertices: vertices.to_vec(),
            fixed: fixed.to_vec(),
            positions,
            owners,
            interior,
            lower,
            sources,
            couplings,
        };
        (layout, upper)
    }

    /// Whether this is the layout of a problem of the same pattern, masks and frictional vertices.
    pub(crate) fn fits(
        &self,
        operator: &BlockMatrix<C>,
        vertices: &[usize],
        fixed: &[[bool; C]],
    ) -> bool {
        let rows = Rows::of(operator);
        self.vertices == vertices
            && self.fixed == fixed
            && self.starts == rows.starts
            && self.columns == rows.columns
    }

    /// The fixed components.
    pub(crate) fn fixed(&self) -> &[[bool; C]] {
        &self.fixed
    }

    /// The number of vertices.
    pub(crate) fn size(&self) -> usize {
        self.positions.len()
    }

    /// The number of blocks of the operator.
    pub(crate) fn blocks(&self) -> usize {
        self.columns.len()
    }

    /// The frictional vertices.
    pub(crate) fn vertices(&self) -> &[usize] {
        &self.vertices
    }

    /// The number of free components.
    pub(crate) fn unknowns(&self) -> usize {
        self.owners.len()
    }

    /// The memory of the layout \[byte\].
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.starts[..])
            + size_of_val(&self.columns[..])
            + size_of_val(&self.positions[..])
            + size_of_val(&self.owners[..])
            + size_of_val(&self.lower.rows[..])
            + size_of_val(&self.lower.starts[..])
            + size_of_val(&self.sources[..])
            + size_of_val(&self.couplings[..])
    }

    /// The load on the free components minus the forces of the prescribed ones of `v`.
    ///
    /// `None` if a component of the load is not finite.
    pub(crate) fn gather(
        &self,
        operator: &BlockMatrix<C>,
        load: &[SVector<f64, C>],
        v: &[SVector<f64, C>],
        into: &mut [f64],
    ) -> Option<()> {
        // Zero, or NaN once a load is not finite.
        let mut spoiled = 0.0;
        for (load, positions) in load.iter().zip(&self.positions) {
            for c in 0..C {
                spoiled += 0.0 * load[c];
                if positions[c] != FIXED {
                    into[positions[c] as usize] = load[c];
                }
            }
        }
        let blocks = operator.data();
        for entry in &self.couplings {
            let weight = blocks[entry.block as usize][(entry.row as usize, entry.column as usize)];
            into[entry.position as usize] -=
                weight * v[entry.vertex as usize][entry.column as usize];
        }
        (spoiled == 0.0).then_some(())
    }

    /// The values of a field at the unknowns.
    #[cfg(feature = "condensed")]
    pub(crate) fn gather_free(&self, field: &[SVector<f64, C>], into: &mut [f64]) {
        for (value, positions) in field.iter().zip(&self.positions) {
            for c in (0..C).filter(|&c| positions[c] != FIXED) {
                into[positions[c] as usize] = value[c];
            }
        }
    }

    /// Writes unknowns back to a field and leaves its fixed components alone.
    pub(crate) fn scatter(&self, x: &[f64], v: &mut [SVector<f64, C>]) {
        for (v, positions) in v.iter_mut().zip(&self.positions) {
            for c in 0..C {
                if positions[c] != FIXED {
                    v[c] = x[positions[c] as usize];
                }
            }
        }
    }

    /// Writes velocities of the frictional vertices to their unknowns.
    pub(crate) fn scatter_boundary(&self, y: &[SVector<f64, C>], x: &mut [f64]) {
        for (y, &vertex) in y.iter().zip(&self.vertices) {
            for (c, &place) in self.positions[vertex].iter().enumerate() {
                if place != FIXED {
                    x[place as usize] = y[c];
                }
            }
        }
    }
}
