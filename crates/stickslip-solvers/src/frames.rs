//! Local frames of vertices: the axes of their components.

use nalgebra::{SMatrix, SVector};

/// Rotated frames: at some vertices the components of vectors are not along the coordinates but along axes of the
/// vertex, the columns of an orthogonal matrix `R`.
///
/// With `x` in coordinates and `x'` in frames `x = R x'`, and an operator becomes `R^T A R`. A rotated operator
/// ([`Operator::change_basis`](crate::Operator::change_basis)) has a component to fix, and one to slide, wherever a
/// surface is oblique. A solver needs no knowledge of frames except for transfers to coarser meshes, whose vertices
/// keep the coordinates ([`NonsmoothSolver::change_basis`](crate::NonsmoothSolver::change_basis)).
///
/// ```
/// use nalgebra::{Matrix2, Vector2};
/// use stickslip_solvers::Frames;
///
/// // The second of three vertices has its first axis along y.
/// let mut frames = Frames::none(3);
/// frames.set(1, Matrix2::new(0.0, -1.0, 1.0, 0.0));
/// let up = Vector2::new(0.0, 1.0);
/// assert_eq!(frames.to_frame(0, up), up);
/// assert_eq!(frames.to_frame(1, up), Vector2::new(1.0, 0.0));
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Frames<const C: usize> {
    vertices: usize,
    /// The position of a vertex' axes, or [`NONE`]; empty if no vertex has any.
    places: Vec<u32>,
    axes: Vec<SMatrix<f64, C, C>>,
}

const NONE: u32 = u32::MAX;

impl<const C: usize> Frames<C> {
    /// No frames: all of so many vertices keep the coordinates.
    pub fn none(vertices: usize) -> Self {
        Self {
            vertices,
            places: Vec::new(),
            axes: Vec::new(),
        }
    }

    /// Sets the axes of a vertex, the columns of an orthogonal matrix.
    pub fn set(&mut self, vertex: usize, axes: SMatrix<f64, C, C>) {
        if self.places.is_empty() {
            self.places = vec![NONE; self.vertices];
        }
        match self.places[vertex] {
            NONE => {
                self.places[vertex] = self.axes.len() as u32;
                self.axes.push(axes);
            }
            place => self.axes[place as usize] = axes,
        }
    }

    /// Whether all vertices keep the coordinates.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// The axes of a vertex, if it has any.
    #[inline]
    pub fn of(&self, vertex: usize) -> Option<&SMatrix<f64, C, C>> {
        match self.places.get(vertex) {
            None | Some(&NONE) => None,
            Some(&place) => Some(&self.axes[place as usize]),
        }
    }

    /// The vertices with axes, increasing, and their axes.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &SMatrix<f64, C, C>)> {
        let places = self.places.iter().enumerate();
        places
            .filter(|&(_, &place)| place != NONE)
            .map(|(vertex, &place)| (vertex, &self.axes[place as usize]))
    }

    /// Rotates a vector at a vertex from coordinates to its frame, `R^T x`.
    #[inline]
    pub fn to_frame(&self, vertex: usize, vector: SVector<f64, C>) -> SVector<f64, C> {
        match self.of(vertex) {
            None => vector,
            Some(axes) => axes.tr_mul(&vector),
        }
    }

    /// Rotates a vector at a vertex from its frame to coordinates, `R x'`.
    #[inline]
    pub fn to_coordinates(&self, vertex: usize, vector: SVector<f64, C>) -> SVector<f64, C> {
        match self.of(vertex) {
            None => vector,
            Some(axes) => axes * vector,
        }
    }

    /// Orthonormal directions, in coordinates, in which a translation of the body moves no `fixed` component:
    /// coordinate axes, as far as these are among them. Returns the directions and their number.
    pub fn free_translations(&self, fixed: &[[bool; C]]) -> ([SVector<f64, C>; C], usize) {
        let unit = |c: usize| SVector::from_fn(|row, _| f64::from(u8::from(row == c)));
        let mut blocked = Orthonormal::default();
        for (vertex, fixed) in fixed.iter().enumerate() {
            for c in (0..C).filter(|&c| fixed[c]) {
                if blocked.count < C {
                    blocked.add(self.to_coordinates(vertex, unit(c)));
                }
            }
        }
        let (mut all, mut free) = (blocked, Orthonormal::default());
        for c in 0..C {
            if let Some(direction) = all.add(unit(c)) {
                free.add(direction);
            }
        }
        (free.directions, free.count)
    }

    /// Rotates a field, one vector per vertex, from coordinates to frames.
    pub fn field_to_frames(&self, field: &mut [SVector<f64, C>]) {
        for (vertex, axes) in self.iter() {
            field[vertex] = axes.tr_mul(&field[vertex]);
        }
    }

    /// Rotates a field, one vector per vertex, from frames to coordinates.
    pub fn field_to_coordinates(&self, field: &mut [SVector<f64, C>]) {
        for (vertex, axes) in self.iter() {
            field[vertex] = axes * field[vertex];
        }
    }

    /// Rotates the block of vertices `i` and `j` of an operator from coordinates to frames, `R_i^T A_ij R_j`.
    #[inline]
    pub fn block_to_frames(
        &self,
        (i, j): (usize, usize),
        block: SMatrix<f64, C, C>,
    ) -> SMatrix<f64, C, C> {
        let rows = match self.of(i) {
            None => block,
            Some(axes) => axes.tr_mul(&block),
        };
        match self.of(j) {
            None => rows,
            Some(axes) => rows * axes,
        }
    }

    /// Rotates the block of vertices `i` and `j` of an operator from frames to coordinates, `R_i A'_ij R_j^T`.
    #[inline]
    pub fn block_to_coordinates(
        &self,
        (i, j): (usize, usize),
        block: SMatrix<f64, C, C>,
    ) -> SMatrix<f64, C, C> {
        let rows = match self.of(i) {
            None => block,
            Some(axes) => axes * block,
        };
        match self.of(j) {
            None => rows,
            Some(axes) => rows * axes.transpose(),
        }
    }
}

/// Orthonormal directions.
struct Orthonormal<const C: usize> {
    directions: [SVector<f64, C>; C],
    count: usize,
}

impl<const C: usize> Default for Orthonormal<C> {
    fn default() -> Self {
        Self {
            directions: [SVector::zeros(); C],
            count: 0,
        }
    }
}

impl<const C: usize> Orthonormal<C> {
    /// Adds the new part of a direction of length 1, and returns it; `None` if the direction is dependent.
    fn add(&mut self, direction: SVector<f64, C>) -> Option<SVector<f64, C>> {
        // The normals of a surface that is plane but for rounding are one direction.
        const NEW: f64 = 1e-6;
        let mut rest = direction;
        for known in &self.directions[..self.count] {
            rest -= known * known.dot(&rest);
        }
        let length = rest.norm();
        if length <= NEW {
            return None;
        }
        rest /= length;
        self.directions[self.count] = rest;
        self.count += 1;
        Some(rest)
    }
}
