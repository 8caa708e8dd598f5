//! Parameters that no shear zone has.

use thiserror::Error;

/// A parameter of a shear zone that is refused.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ThermalError {
    /// The contact has no vertex.
    #[error("a shear zone has at least 1 vertex: pass the number of vertices of the contact")]
    NoVertices,
    /// A parameter has neither one value nor one per vertex.
    #[error("{what} has {values} values for {vertices} vertices: pass one, or one per vertex")]
    Count {
        /// The parameter.
        what: &'static str,
        /// The number of its values.
        values: usize,
        /// The number of vertices.
        vertices: usize,
    },
    /// A value is out of its range.
    #[error("{what} is {value:e} {unit} at vertex {vertex}, must be {requirement}: {advice}")]
    Value {
        /// The parameter.
        what: &'static str,
        /// Its unit.
        unit: &'static str,
        /// The vertex; 0 for a value of all vertices.
        vertex: usize,
        /// The value.
        value: f64,
        /// The requirement of a legal value.
        requirement: &'static str,
        /// One thing to try.
        advice: &'static str,
    },
    /// The number of modes is out of its range.
    #[error("{modes} modes, must be from 2 to {largest}: 24 suffice for earthquake cycles")]
    Modes {
        /// The number.
        modes: usize,
        /// The largest.
        largest: usize,
    },
}
