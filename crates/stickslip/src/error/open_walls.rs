//! Walls without a contact between them.

use thiserror::Error;

/// A surface along which the mesh was split, whose walls have no contact between them: they would pass through one
/// another.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "the walls of the split surface `{surface}` have no contact between them at {count} of {of} pairs of vertices, first \
     at {at:?} m: they would pass through one another; {}",
    super::scene_hint::OPEN_WALLS
)]
#[non_exhaustive]
pub struct OpenWalls {
    /// The name of the surface.
    pub surface: String,
    /// The number of pairs of vertices without a contact.
    pub count: usize,
    /// The number of pairs of vertices of the surface.
    pub of: usize,
    /// The first pair without a contact.
    pub vertices: [usize; 2],
    /// Its position \[m\].
    pub at: [f64; 3],
}
