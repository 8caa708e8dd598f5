//! The boundary conditions that errors name.

use std::fmt;

/// The boundary condition of a part. Fixed parts, parts with a prescribed velocity, prescribed slip rates,
/// contacts and periodic boundaries are each numbered from 1, in the order in which they were given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum BoundaryCondition {
    /// [Fixed](crate::Scene::fix): zero velocity.
    Fixed(usize),
    /// A [prescribed velocity](crate::Scene::prescribe_velocity).
    Prescribed(usize),
    /// A [prescribed slip rate](crate::Scene::prescribe_slip_rate).
    SlipRate(usize),
    /// A contact: zero normal velocity.
    Contact(usize),
    /// A [periodic boundary](crate::Scene::with_periodic): the velocity of the other side.
    Periodic(usize),
}

impl fmt::Display for BoundaryCondition {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(number) => write!(formatter, "fixed part {number}"),
            Self::Prescribed(number) => write!(formatter, "driven part {number}"),
            Self::SlipRate(number) => write!(formatter, "prescribed slip rate {number}"),
            Self::Contact(number) => write!(formatter, "contact {number}"),
            Self::Periodic(number) => write!(formatter, "periodic boundary {number}"),
        }
    }
}
