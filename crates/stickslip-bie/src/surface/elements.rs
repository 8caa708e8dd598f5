//! The cells of a fault as sources and receivers of stress.

use nalgebra::{SMatrix, SVector, Vector3};

use super::Triangles;
use super::edges::Loop;
use super::rock::Rock;
use crate::interaction::Pair;

/// Triangles with `C` directions of slip each.
#[derive(Debug)]
pub(crate) struct Elements<const C: usize> {
    pub(super) rock: Rock,
    pub(super) loops: Vec<Loop>,
    pub(super) centroids: Vec<Vector3<f64>>,
    pub(super) areas: Vec<f64>,
    /// Strike, up dip and normal.
    pub(super) axes: Vec<[Vector3<f64>; 3]>,
    /// The directions of slip.
    pub(super) slips: Vec<[Vector3<f64>; C]>,
}

impl<const C: usize> Elements<C> {
    /// From the parts of the directions of slip along strike and up dip.
    pub(crate) fn new(cells: &Triangles, rock: Rock, directions: &[[[f64; 2]; C]]) -> Self {
        let all = 0..cells.count();
        let axes: Vec<_> = (all.clone())
            .map(|cell| {
                let axes = cells.axes(cell);
                [axes.strike, axes.up_dip, axes.normal].map(Vector3::from)
            })
            .collect();
        let slips = axes.iter().zip(directions).map(|([s, d, _], directions)| {
            directions.map(|[strike, up_dip]| s * strike + d * up_dip)
        });
        Self {
            rock,
            loops: (all.clone())
                .map(|cell| Loop::new(cells.corners(cell).map(Vector3::from)))
                .collect(),
            centroids: (all.clone())
                .map(|cell| cells.centroid(cell).into())
                .collect(),
            areas: all.map(|cell| cells.area(cell)).collect(),
            slips: slips.collect(),
            axes,
        }
    }

    /// What slip of a cell does at the centroid of another.
    #[inline]
    pub(crate) fn pair(&self, receiver: usize, source: usize) -> Pair<C> {
        let normal = &self.axes[receiver][2];
        let at = &self.centroids[receiver];
        let (edges, slips) = (&self.loops[source], &self.slips[source]);
        let tractions = self.rock.tractions(edges, at, normal, slips);
        let along = &self.slips[receiver];
        (
            SMatrix::from_fn(|r, c| tractions[c].dot(&along[r])),
            SVector::from_fn(|c, _| -tractions[c].dot(normal)),
        )
    }

    /// The tractions at the centroid of a cell of slips of a triangle, as if in a whole space.
    pub(super) fn without_surface<const S: usize>(
        &self,
        receiver: usize,
        source: &Loop,
        slips: &[Vector3<f64>; S],
    ) -> [Vector3<f64>; S] {
        let (at, normal) = (&self.centroids[receiver], &self.axes[receiver][2]);
        self.rock.without_surface(source, at, normal, slips)
    }
}
