//! Errors of receivers.

use stickslip_state::Number;
use thiserror::Error;

use crate::KernelError;

/// Displacement or stress off a fault cannot be had.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ReceiverError {
    /// A coordinate of a receiver is not finite.
    #[error("receiver {receiver} has a coordinate that is {}: it must be finite", Number(*.value))]
    NotFinite {
        /// The receiver, from 0.
        receiver: usize,
        /// The coordinate.
        value: f64,
    },
    /// A receiver is above the free surface.
    #[error("receiver {receiver} is {} m above the free surface: z points up, rock is at z <= 0", Number(*.height))]
    AboveSurface {
        /// The receiver, from 0.
        receiver: usize,
        /// Its height \[m\].
        height: f64,
    },
    /// A receiver is on an edge of a cell, where displacement is not defined and stress infinite.
    #[error(
        "receiver {receiver} is {} m from an edge of cell {cell}, nearer than {} m: move it to one side of the fault",
        Number(*.distance), Number(*.least)
    )]
    AtEdge {
        /// The receiver, from 0.
        receiver: usize,
        /// The cell.
        cell: usize,
        /// The distance \[m\].
        distance: f64,
        /// The least distance \[m\].
        least: f64,
    },
    /// The matrix of receivers and cells is too large.
    #[error(
        "{receivers} receivers of {cells} cells take {} bytes, more than {}: take fewer receivers, or a larger limit",
        Number(*.bytes), Number(*.limit)
    )]
    Memory {
        /// The number of receivers.
        receivers: usize,
        /// The number of cells.
        cells: usize,
        /// The bytes.
        bytes: f64,
        /// The limit \[bytes\].
        limit: f64,
    },
    /// The fault is repeated periodically.
    #[error(
        "a periodic fault has no displacement that vanishes far away: take a fault in a whole or half space"
    )]
    Periodic,
    /// There is no closed form for creep beyond the cells.
    #[error(
        "creep beyond the cells is known for one plane or straight line alone: add the motion of the plates to the displacement due to slip less that of the plates"
    )]
    NoPlane,
    /// A value out of its range.
    #[error(transparent)]
    Value(#[from] KernelError),
}
