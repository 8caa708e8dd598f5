/// The two walls of a surface along which a mesh was split, vertex by vertex, without the tips that both have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct Walls {
    /// The name of the surface.
    pub surface: String,
    /// Pairs of vertices at one position, one on each wall.
    pub pairs: Vec<[usize; 2]>,
    /// The position of each pair \[m\].
    pub points: Vec<[f64; 3]>,
}

#[cfg(feature = "fem")]
impl From<&stickslip_fem::SplitSurface> for Walls {
    fn from(surface: &stickslip_fem::SplitSurface) -> Self {
        Self {
            surface: surface.name.clone(),
            pairs: surface.pairs.clone(),
            points: surface.points.clone(),
        }
    }
}
