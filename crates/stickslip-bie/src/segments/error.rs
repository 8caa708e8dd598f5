//! Errors of segments.

use stickslip_state::Number;
use thiserror::Error;

use crate::KernelError;
use crate::hmatrix::HMatrixError;

/// Segments that are no fault, or values of a fault of segments that are out of their ranges. Cells, faults, and points
/// are counted from 0.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SegmentsError {
    /// There is no polyline.
    #[error("segments need at least one polyline")]
    NoFault,
    /// A polyline of less than two points.
    #[error("polyline {fault} has {found} points, and needs at least 2")]
    TooFewPoints {
        /// The polyline.
        fault: usize,
        /// Its number of points.
        found: usize,
    },
    /// A coordinate that is not finite.
    #[error("point {point} of polyline {fault} must be finite, is ({}, {}) m", Number(.position[0]), Number(.position[1]))]
    NotFinite {
        /// The polyline.
        fault: usize,
        /// The point.
        point: usize,
        /// `[x, z]` \[m\].
        position: [f64; 2],
    },
    /// A cell between two points at one place.
    #[error("cell {cell} at ({}, {}) m has no length: remove one of its two points", Number(.position[0]), Number(.position[1]))]
    ZeroLength {
        /// The cell.
        cell: usize,
        /// `[x, z]` \[m\].
        position: [f64; 2],
    },
    /// Two cells are the same.
    #[error("cells {} and {} are the same segment: remove one of them", .cells[0], .cells[1])]
    Duplicate {
        /// The cells.
        cells: [usize; 2],
    },
    /// Two cells cross.
    #[error("cells {} and {} cross at ({}, {}) m: let one fault end half a cell before the other, or divide both at that point",
        .cells[0], .cells[1], Number(.position[0]), Number(.position[1]))]
    Crossing {
        /// The cells.
        cells: [usize; 2],
        /// `[x, z]` \[m\].
        position: [f64; 2],
    },
    /// The centre of a cell is too near to another cell.
    #[error("the centre of cell {} must be at least {} m away from cell {}, is at {} m: take shorter cells, or let the faults meet at ends of cells",
        .cells[0], Number(*.least), .cells[1], Number(*.distance))]
    TooNear {
        /// The cell of the centre, and the other one.
        cells: [usize; 2],
        /// The distance \[m\].
        distance: f64,
        /// The least distance \[m\].
        least: f64,
    },
    /// Depths are given as positive numbers.
    #[error("all segments have z >= 0, up to {} m: z is the height above the free surface, depths are negative", Number(*.highest))]
    PositiveDepths {
        /// The largest `z` \[m\].
        highest: f64,
    },
    /// A cell reaches above the free surface.
    #[error("cell {cell} reaches {} m above the free surface at z = 0", Number(*.height))]
    AboveSurface {
        /// The cell.
        cell: usize,
        /// The height \[m\].
        height: f64,
    },
    /// A cell lies along the free surface.
    #[error(
        "cell {cell} lies along the free surface at z = 0, where it causes no stress: remove it"
    )]
    AlongSurface {
        /// The cell.
        cell: usize,
    },
    /// A fault ends right below the free surface: the gap would lock it.
    #[error("cell {cell} ends {} m below the free surface, less than {} m: move its end to z = 0", Number(*.depth), Number(*.least))]
    NearSurface {
        /// The cell.
        cell: usize,
        /// The depth of its end \[m\].
        depth: f64,
        /// The least depth other than 0 \[m\].
        least: f64,
    },
    /// A bend is spread over more than the pieces beside it.
    #[error("bend {bend} is spread over {} m, and must be over at most {} m: the next bend or end begins there", Number(*.length), Number(*.most))]
    Spread {
        /// The bend.
        bend: usize,
        /// The length \[m\].
        length: f64,
        /// The longest length \[m\].
        most: f64,
    },
    /// There are too many cells.
    #[error("{} cells are more than {most}: take longer cells", Number(*.cells))]
    TooManyCells {
        /// The number of cells.
        cells: f64,
        /// The largest number.
        most: usize,
    },
    /// The interaction takes more memory than it may.
    #[error(transparent)]
    Interaction(#[from] HMatrixError),
    /// A line of a table.
    #[error("line {line} of the table of segments: {problem}")]
    Table {
        /// The line, from 1.
        line: u64,
        /// What is wrong.
        problem: String,
    },
    /// A receiver is at the end of a cell, where stress is infinite.
    #[error("point {point} is at an end of cell {cell}, {} m away, where the stress of slip is not finite: move it aside", Number(*.distance))]
    ReceiverAtEnd {
        /// The point.
        point: usize,
        /// The cell.
        cell: usize,
        /// The distance \[m\].
        distance: f64,
    },
    /// A receiver is above the free surface, or not finite.
    #[error("point {point} must be finite, and at z <= 0, is ({}, {}) m", Number(.position[0]), Number(.position[1]))]
    Receiver {
        /// The point.
        point: usize,
        /// `[x, z]` \[m\].
        position: [f64; 2],
    },
    /// A value out of its range.
    #[error(transparent)]
    Value(#[from] KernelError),
}
