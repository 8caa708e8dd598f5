//! Surfaces that continue one another, to be split as one.

use super::joints::Joints;
use crate::surfaces::Surface;
use crate::{FemError, Mesh};

/// The faces of some surfaces, increasing, and the surface of each.
pub(super) struct Union<const D: usize> {
    pub(super) names: Vec<String>,
    pub(super) faces: Vec<[u32; D]>,
    /// For each face the position of its surface in the names.
    pub(super) owners: Vec<usize>,
}

impl<const D: usize> Union<D> {
    pub(super) fn new(surfaces: impl IntoIterator<Item = Surface<D>>) -> Self {
        let (mut names, mut all) = (Vec::new(), Vec::new());
        for (owner, surface) in surfaces.into_iter().enumerate() {
            names.push(surface.name);
            all.extend(surface.faces.into_iter().map(|face| (face, owner)));
        }
        all.sort_unstable();
        let (faces, owners) = all.into_iter().unzip();
        Self {
            names,
            faces,
            owners,
        }
    }
}

impl<const D: usize> Mesh<D> {
    /// The surfaces of some names, which are known and differ, and where they continue one another.
    pub(super) fn joined(&self, names: &[impl AsRef<str>]) -> Result<Joints<D>, FemError> {
        let mut surfaces = Vec::with_capacity(names.len());
        for (k, name) in names.iter().enumerate() {
            let name = name.as_ref();
            let earlier = |own: &str| names[..k].iter().any(|earlier| earlier.as_ref() == own);
            let mut left = (self.surfaces.inner.iter()).filter(|own| !earlier(&own.name));
            let Some(surface) = left.clone().find(|own| own.name == name) else {
                return Err(FemError::Unknown {
                    what: "surface inside the body",
                    name: name.to_owned(),
                    known: left.by_ref().map(|own| own.name.clone()).collect(),
                });
            };
            surfaces.push(surface);
        }
        let each = surfaces.iter().enumerate();
        let mut all: Vec<([u32; D], usize)> = each
            .flat_map(|(k, surface)| surface.faces.iter().map(move |&face| (face, k)))
            .collect();
        all.sort_unstable();
        if let Some(same) = all.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            let corners = same[0].0.map(|p| self.vertices[p as usize]);
            let middle = corners.iter().sum::<nalgebra::SVector<f64, D>>() / D as f64;
            return Err(FemError::Overlap {
                surfaces: [same[0].1, same[1].1].map(|k| surfaces[k].name.clone()),
                face: same[0].0.to_vec(),
                at: middle.iter().copied().collect(),
            });
        }
        Joints::new(self, &surfaces)
    }
}
