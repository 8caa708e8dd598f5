//! Products whose parts are used while they are in the cache.

use nalgebra::SVector;

/// `begin(first, y)`: writes a part of `y` from the vertex `first` on.
pub type BeginPart<'a, const C: usize> = &'a (dyn Fn(usize, &mut [SVector<f64, C>]) + Sync);

/// `end(first, [y, p, q])`: reads and writes a part of three fields from the vertex `first` on.
pub type EndPart<'a, const C: usize> = &'a (dyn Fn(usize, [&mut [SVector<f64, C>]; 3]) + Sync);

/// A product that hands over its parts one after the other: what precedes and follows it at a vertex needs no passes over
/// memory of its own.
///
/// A [`Matrix`](crate::Matrix) has it as [`by_parts`](crate::Matrix::by_parts).
pub trait ProductByParts<const C: usize>: Send + Sync {
    /// The lowest level of the parts of `A` at each vertex, on which nothing acts in steps without weights up to it; empty, as by
    /// default, for a single level.
    fn lowest_levels(&self) -> &[u8] {
        &[]
    }

    /// `y += scale (sum over levels l of weights[l] A_l) x` as
    /// [`multiply_add_levels`](crate::Matrix::multiply_add_levels), with `y` the first of three fields of one entry per vertex:
    /// for parts of the vertices, each in one part, `begin` before the sums of the part and `end` behind them, in several
    /// threads. The bits of `y` do not depend on the parts.
    ///
    /// # Panics
    /// For fields of another length than the number of vertices.
    fn multiply_add_by_parts(
        &self,
        weights: &[f64],
        scale: f64,
        x: &[SVector<f64, C>],
        fields: [&mut [SVector<f64, C>]; 3],
        begin: BeginPart<'_, C>,
        end: EndPart<'_, C>,
    );
}
