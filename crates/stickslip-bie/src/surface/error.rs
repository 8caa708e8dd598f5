//! Errors of surfaces of triangles.

use stickslip_state::Number;
use thiserror::Error;

use crate::KernelError;
use crate::hmatrix::HMatrixError;

/// Triangles are no surface of a fault.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// There is no triangle.
    #[error("the surface has no triangle: choose another group or file")]
    Empty,
    /// A triangle names a point that does not exist.
    #[error("triangle {triangle} has point {point} of {count}: points are counted from 0")]
    Index {
        /// The triangle.
        triangle: usize,
        /// The point.
        point: usize,
        /// The number of points.
        count: usize,
    },
    /// A coordinate is not finite.
    #[error("point {point} has a coordinate that is {}: it must be finite", Number(*.value))]
    NotFinite {
        /// The point.
        point: usize,
        /// The coordinate.
        value: f64,
    },
    /// A triangle has an area below 1e-6 of its longest side squared.
    #[error(
        "triangle {triangle} is degenerate: its area {} m^2 is below 1e-6 of its longest side {} m squared; mesh anew",
        Number(*.area), Number(*.longest)
    )]
    Degenerate {
        /// The triangle.
        triangle: usize,
        /// Its area [m^2].
        area: f64,
        /// Its longest side \[m\].
        longest: f64,
    },
    /// Two triangles have the same corners.
    #[error("triangles {} and {} have the same corners: remove one of them", .triangles[0], .triangles[1])]
    Duplicate {
        /// Both.
        triangles: [usize; 2],
    },
    /// A sheet has one side only.
    #[error(
        "the surface has one side only (Moebius): orientations of triangles {} and {} disagree across the edge from {} to {}; \
         cut the surface there",
        .triangles[0], .triangles[1], position(&.edge[0]), position(&.edge[1])
    )]
    NotOrientable {
        /// The triangles beside the edge.
        triangles: [usize; 2],
        /// The ends of the edge \[m\].
        edge: [[f64; 3]; 2],
    },
    /// An edge of one triangle passes through another.
    #[error(
        "triangles {} and {} cross at {}: mesh the intersection into both sheets",
        .triangles[0], .triangles[1], position(.at)
    )]
    Crossing {
        /// Both.
        triangles: [usize; 2],
        /// The crossing \[m\].
        at: [f64; 3],
    },
    /// The centroid of a triangle is too near to another.
    #[error(
        "the centroid of triangle {} is {} m from triangle {}, which must be at least {} m: stress is singular at edges; \
         separate the sheets or mesh their intersection",
        .triangles[0], Number(*.distance), .triangles[1], Number(*.least)
    )]
    TooNear {
        /// Both.
        triangles: [usize; 2],
        /// Their distance \[m\].
        distance: f64,
        /// The least distance \[m\], a tenth of the root of the smaller area.
        least: f64,
    },
    /// A triangle and a cell of a plane are too near to each other.
    #[error(
        "triangle {triangle} and cell {cell} of plane {plane} cross or cover each other, or are nearer than a tenth of the \
         smaller one: separate them, or mesh the plane into the surface"
    )]
    NearPlane {
        /// The triangle.
        triangle: usize,
        /// The plane.
        plane: usize,
        /// Its cell.
        cell: usize,
    },
    /// A vertex is above the free surface.
    #[error("the vertex at {} is above the free surface: rock is at z <= 0", position(.at))]
    AboveSurface {
        /// The vertex \[m\].
        at: [f64; 3],
    },
    /// No vertex is below the free surface.
    #[error("all vertices are at z >= 0, up to {} m: z is up, depth must be negative z", Number(*.highest))]
    DepthPositive {
        /// The largest z \[m\].
        highest: f64,
    },
    /// A vertex is hardly below the free surface, beside one that is on it.
    #[error(
        "the vertex at {} is {} m below the free surface, beside vertices on it: such a gap locks the fault; set z = 0",
        position(.at), Number(-.at[2])
    )]
    Gap {
        /// The vertex \[m\].
        at: [f64; 3],
    },
    /// A file cannot be read.
    #[error("{path} cannot be read: {place}")]
    File {
        /// The file.
        path: String,
        /// Where, and why.
        place: String,
    },
    /// A value is out of its range.
    #[error(transparent)]
    Value(#[from] KernelError),
    /// The interaction takes more memory than it may.
    #[error(transparent)]
    Interaction(#[from] HMatrixError),
}

fn position(at: &[f64; 3]) -> String {
    let [x, y, z] = at.map(Number);
    format!("({x}, {y}, {z}) m")
}
