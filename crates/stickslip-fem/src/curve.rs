//! A curved part of the boundary.

use nalgebra::SVector;

use crate::simplex::Simplex;
use crate::weights::Weights;
use crate::{FemError, Mesh};

/// A named part of the boundary, and the map of a midpoint on it to its new position.
pub(crate) type Onto<'a, const D: usize> =
    (&'a str, &'a dyn Fn(&SVector<f64, D>) -> SVector<f64, D>);

/// A curved part of the boundary of one level.
pub(crate) struct Curve<'a, const D: usize> {
    level: usize,
    /// The faces of the part and, in space, their edges: increasing vertices, padded with `u32::MAX`.
    faces: Vec<[u32; D]>,
    onto: &'a dyn Fn(&SVector<f64, D>) -> SVector<f64, D>,
}

impl<'a, const D: usize> Curve<'a, D> {
    pub(crate) fn new(
        mesh: &Mesh<D>,
        level: usize,
        (part, onto): Onto<'a, D>,
    ) -> Result<Self, FemError> {
        let (mut faces, mut twins) = (Vec::new(), Vec::new());
        let mut places = mesh.faces_of(part)?.to_vec();
        // Both sides of a fault are moved alike.
        for twin in mesh.surfaces.cuts.iter().flat_map(|cut| &cut.twins) {
            let named = |place: &usize| places.binary_search(place).is_ok();
            match twin.iter().position(named) {
                Some(own) if !named(&twin[1 - own]) => twins.push(twin[1 - own]),
                _ => {}
            }
        }
        places.append(&mut twins);
        for place in places {
            let mut face = mesh.boundary[place];
            face.sort_unstable();
            faces.push(face);
            if D == 3 {
                faces.extend((0..D).map(|left_out| {
                    let mut edge = face;
                    edge[left_out..].rotate_left(1);
                    edge[D - 1] = u32::MAX;
                    edge
                }));
            }
        }
        faces.sort_unstable();
        faces.dedup();
        Ok(Self { level, faces, onto })
    }

    /// Whether an edge lies on the part. Vertices may have been added to the level.
    pub(crate) fn holds(&self, weights: &Weights, p: u32, q: u32) -> bool {
        (weights.between::<D>(&[p, q])).is_some_and(|face| self.faces.binary_search(&face).is_ok())
    }

    /// The new position of the midpoint of an edge on the part.
    pub(crate) fn middle(&self, ends: [&SVector<f64, D>; 2]) -> Result<SVector<f64, D>, FemError> {
        let x = 0.5 * (ends[0] + ends[1]);
        let moved = (self.onto)(&x);
        let (by, edge) = ((moved - x).norm(), (ends[1] - ends[0]).norm());
        if by <= 0.5 * edge {
            return Ok(moved);
        }
        Err(FemError::MovedAway {
            level: self.level,
            at: x.iter().copied().collect(),
            edge,
            by,
        })
    }

    /// Refuses a child that moved vertices have inverted or flattened.
    pub(crate) fn check(
        &self,
        vertices: &[SVector<f64, D>],
        part: &[u32],
        cell: usize,
    ) -> Result<(), FemError> {
        let simplex = Simplex::new(vertices, part);
        if simplex.is_solid() {
            return Ok(());
        }
        Err(FemError::DegenerateCell {
            level: Some(self.level),
            cell,
            volume: simplex.volume,
        })
    }
}
