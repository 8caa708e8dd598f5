//! Vertices without faces as parts: pins, edges and lines of a mesh.

use nalgebra::SVector;
use stickslip_fem::P1;

use super::BoundaryPart;

/// Vertices of a mesh to fix or to drive; no surface belongs to them, and their weights are zero.
impl BoundaryPart {
    /// The vertex nearest to a point \[m\], of vertices at one place the first. Three of them hold a body in space
    /// against rigid motion: one in all components, one across the line to it, one across the plane of the three. In
    /// the plane two do.
    ///
    /// ```
    /// use stickslip::fem::{Elastic, P1, elasticity};
    /// use stickslip::{BoundaryPart, Components, Scene};
    ///
    /// let space = P1::grid([2.0, 1.0], [2, 1])?;
    /// let rock = Elastic { young_modulus: 60e9, poisson_ratio: 0.25 };
    /// let scene = Scene::new(elasticity(&space, &rock)?)
    ///     .fix(BoundaryPart::nearest_vertex(&space, [0.0, 0.0]), Components::ALL)
    ///     .fix(BoundaryPart::nearest_vertex(&space, [2.0, 0.0]), Components::Y);
    /// # let _: Scene<_, 2> = scene;
    /// # Ok::<(), stickslip::fem::FemError>(())
    /// ```
    #[doc(alias("pin", "Dirichlet", "rigid-body mode"))]
    pub fn nearest_vertex<const D: usize>(space: &P1<D>, point: [f64; D]) -> Self {
        let vertices = space.mesh().vertices().iter().enumerate();
        let far = |x: &SVector<f64, D>| (x - SVector::from(point)).norm_squared();
        let nearest = vertices.min_by(|a, b| far(a.1).total_cmp(&far(b.1)));
        Self::of_vertices(space, nearest.map(|(vertex, _)| vertex))
    }

    /// The vertices whose positions \[m\] satisfy the predicate, such as those of an edge; a scene refuses a part
    /// without vertices.
    pub fn vertices_where<const D: usize>(
        space: &P1<D>,
        on: impl Fn(&SVector<f64, D>) -> bool,
    ) -> Self {
        let vertices = space.mesh().vertices().iter().enumerate();
        Self::of_vertices(space, vertices.filter(|(_, x)| on(x)).map(|(k, _)| k))
    }

    fn of_vertices<const D: usize>(
        space: &P1<D>,
        vertices: impl IntoIterator<Item = usize>,
    ) -> Self {
        let vertices: Vec<usize> = vertices.into_iter().collect();
        let position = |&vertex: &usize| {
            let x = &space.mesh().vertices()[vertex];
            std::array::from_fn(|c| x.get(c).copied().unwrap_or(0.0))
        };
        Self {
            weights: vec![0.0; vertices.len()],
            points: vertices.iter().map(position).collect(),
            vertices,
            dimension: D,
            mesh: Some(space.mesh().identity().into()),
            ..Self::point(0.0)
        }
    }
}
