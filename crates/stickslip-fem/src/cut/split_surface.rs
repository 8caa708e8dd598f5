//! Split surfaces as scenes see them.

use crate::Mesh;

/// The two sides of a surface along which a mesh was split, vertex by vertex, without the tips that both have in common.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SplitSurface {
    /// The name of the surface; its sides are the parts `name+` and `name-`.
    pub name: String,
    /// Pairs of vertices at one position: on the plus side, and on the minus side.
    pub pairs: Vec<[usize; 2]>,
    /// The position of each pair \[m\], in the plane with 0 as the third coordinate.
    pub points: Vec<[f64; 3]>,
}

impl<const D: usize> Mesh<D> {
    /// The surfaces along which the mesh was [split](Mesh::split).
    pub fn split_surfaces(&self) -> Vec<SplitSurface> {
        let cuts = self.surfaces.cuts.iter();
        cuts.map(|cut| {
            let open = cut.pairs.iter().filter(|[plus, minus]| plus != minus);
            let point = |&[plus, _]: &[u32; 2]| {
                let vertex = &self.vertices[plus as usize];
                std::array::from_fn(|c| vertex.get(c).copied().unwrap_or(0.0))
            };
            SplitSurface {
                name: cut.name.clone(),
                pairs: (open.clone())
                    .map(|pair| pair.map(|p| p as usize))
                    .collect(),
                points: open.map(point).collect(),
            }
        })
        .collect()
    }
}
