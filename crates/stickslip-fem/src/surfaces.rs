//! The surfaces inside a mesh by name, and its cuts.

use crate::cut::Cut;

/// The inner surfaces of a mesh, and the ones along which it has been split.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Surfaces<const D: usize> {
    pub(crate) inner: Vec<Surface<D>>,
    pub(crate) cuts: Vec<Cut>,
}

impl<const D: usize> Default for Surfaces<D> {
    fn default() -> Self {
        let (inner, cuts) = (Vec::new(), Vec::new());
        Self { inner, cuts }
    }
}

/// Faces between two cells: their vertices increasing, and themselves in increasing order.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Surface<const D: usize> {
    pub(crate) name: String,
    pub(crate) faces: Vec<[u32; D]>,
}

pub(crate) fn sorted<const D: usize, T: Ord>(mut face: [T; D]) -> [T; D] {
    face.sort_unstable();
    face
}
