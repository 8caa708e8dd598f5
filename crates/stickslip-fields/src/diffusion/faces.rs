//! Conductances of faces.

/// The conductance of a face of unit length between two cells, from their mobilities and their distances to the face: the
/// harmonic mean. A cell without mobility has none.
pub(super) fn conductance(mobility: [f64; 2], distance: [f64; 2]) -> f64 {
    if mobility[0] <= 0.0 || mobility[1] <= 0.0 {
        return 0.0;
    }
    1.0 / (distance[0] / mobility[0] + distance[1] / mobility[1])
}
