//! Stiffness without a matrix: products by elements.

mod at_vertex;
mod chains;
mod copies;
#[cfg(target_arch = "x86_64")]
mod eight;
mod group_forces;
mod groups;
mod kernel;
mod lame;
mod lanes;
mod local_steps;
mod product;

use std::ops::Mul;
use std::sync::{Arc, Mutex};

use nalgebra::SVector;
use stickslip_core::compiled;

use crate::assembly::by_cell;
use crate::identity::MeshIdentity;
use crate::{Elastic, FemError, Mesh, P1, SplitSurface, Viscous};
use copies::Copies;
use groups::Groups;
use lame::Materials;
use lanes::Row;
pub use product::{BeginPart, EndPart};
use product::{add_product, add_product_by_parts};

/// The stiffness of an elastic body without a matrix, for explicit steps of large bodies.
///
/// It stores positions, the corners of cells and Lamé's parameters. A product computes the constant strain of each cell,
///
/// ```text
/// H = sum over corners q of u_q g_q^T,    f_p = V (lambda tr H I + mu (H + H^T)) g_p
/// ```
///
/// and adds the forces `f_p` \[N\] at its corners, with the volume `V` and the gradients `g_p` found anew. It is that of
/// the matrix of [`elasticity`](crate::elasticity), up to rounding. In space it takes 0.25 kB a vertex in place of the
/// 1.1 kB of a matrix. Chains of three neighbouring cells are computed at once, four or eight chains at a time, in groups that
/// fit into the cache; with the feature `rayon` groups share the threads. Bits do not depend on the number of
/// threads; the last digits depend on the registers of the processor.
///
/// A multiple shares the memory of the cells: `&stiffness * eta` is the Kelvin-Voigt viscosity of the relaxation time
/// `eta` \[s\].
///
/// ```
/// use nalgebra::Vector3;
/// use stickslip_fem::{Elastic, P1, element_stiffness, elasticity};
///
/// let space = P1::grid([2.0, 1.0, 1.0], [4, 2, 2])?;
/// let rock = Elastic { young_modulus: 2.5, poisson_ratio: 0.25 };
/// let stiffness = element_stiffness(&space, &rock)?;
/// let shear = space.interpolate(|x| Vector3::new(x[2] * x[2], 0.0, 0.0));
/// let mut force = vec![Vector3::zeros(); space.vertex_count()];
/// stiffness.multiply_add(1.0, &shear, &mut force);
/// let matrix = elasticity(&space, &rock)?;
/// for (row, force) in matrix.outer_iterator().zip(&force) {
///     let expected: Vector3<f64> = row.iter().map(|(q, block)| block * shear[q]).sum();
///     assert!((force - expected).norm() < 1e-14);
/// }
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias = "matrix-free")]
pub struct ElementStiffness<const D: usize> {
    elements: Arc<Elements>,
    lame: Arc<Materials>,
    /// That multiplies Lamé's parameters.
    factor: f64,
}

/// The cells of a mesh, and memory for a product.
#[derive(Debug)]
struct Elements {
    groups: Groups,
    copies: Copies,
    /// The lowest level of the cells of each vertex; empty for a single level.
    lowest: Vec<u8>,
    /// The forces at the vertices of the groups; empty before the first product.
    forces: Mutex<Vec<Row>>,
    mesh: MeshIdentity,
    splits: Arc<[SplitSurface]>,
}

impl Elements {
    /// The cells of a mesh with their levels of local steps.
    fn of<const D: usize>(mesh: &Mesh<D>, level: impl Fn(u32) -> u8) -> Self {
        let groups = Groups::of(mesh, level);
        Self {
            copies: Copies::of(&groups, mesh.vertex_count()),
            lowest: groups.lowest_levels(mesh.vertex_count()),
            groups,
            forces: Mutex::default(),
            mesh: mesh.identity(),
            splits: mesh.split_surfaces().into(),
        }
    }
}

/// The stiffness of an elastic body, element by element; the product is that of [`elasticity`](crate::elasticity).
///
/// # Errors
///
/// The errors of [`Elastic::lame`], and [`FemError::TooMany`] for cells whose corners are more than 2^32.
pub fn element_stiffness<const D: usize>(
    space: &P1<D>,
    material: &Elastic,
) -> Result<ElementStiffness<D>, FemError> {
    let lame = material.lame()?;
    build(space, &|_| lame)
}

/// [`element_stiffness`] with a material that depends on the cell: by a function of its midpoint \[m\] and index. The product
/// is that of [`elasticity_by_cell`](crate::elasticity_by_cell).
///
/// # Errors
///
/// [`FemError::Value`] for the first cell whose material is out of range, and [`FemError::TooMany`].
pub fn element_stiffness_by_cell<const D: usize>(
    space: &P1<D>,
    material: impl Fn(&SVector<f64, D>, usize) -> Elastic,
) -> Result<ElementStiffness<D>, FemError> {
    let materials = by_cell(space, material, |material| material.lame())?;
    build(space, &materials)
}

compiled! {
    fn build<D in 2, 3>(
        space: &P1<D>,
        lame: &(dyn Fn(usize) -> (f64, f64) + Sync),
    ) -> Result<ElementStiffness<D>, FemError> {
        let mesh = space.mesh();
        let corners = (D + 1) as u64 * mesh.cell_count() as u64;
        if u32::try_from(corners).is_err() {
            return Err(FemError::too_many("corners of cells", corners));
        }
        let elements = Elements::of(mesh, |_| 0);
        Ok(ElementStiffness {
            lame: Arc::new(Materials::of(&elements.groups, lame)),
            elements: Arc::new(elements),
            factor: 1.0,
        })
    }
}

impl<const D: usize> ElementStiffness<D> {
    /// The Kelvin-Voigt viscosity of the same cells with a material that depends on the cell, by its index; the product is
    /// that of [`viscosity_by_cell`](crate::viscosity_by_cell). The cells are stored once.
    ///
    /// # Errors
    ///
    /// [`FemError::Value`] for the first cell whose material is out of range.
    ///
    /// ```
    /// use stickslip_fem::{Elastic, P1, Viscous, element_stiffness};
    ///
    /// let space = P1::grid([2.0, 1.0], [4, 2])?;
    /// let stiffness = element_stiffness(&space, &Elastic { young_modulus: 2.5, poisson_ratio: 0.25 })?;
    /// let viscosity = stiffness.viscosity_by_cell(|cell| Viscous {
    ///     shear_viscosity: if cell < 8 { 0.1 } else { 0.0 },
    ///     bulk_viscosity: 0.0,
    /// })?;
    /// assert_eq!(viscosity.mesh(), stiffness.mesh());
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    pub fn viscosity_by_cell(&self, material: impl Fn(usize) -> Viscous) -> Result<Self, FemError> {
        let data = (0..self.elements.mesh.cells).map(|cell| {
            let lame = material(cell).lame();
            lame.map_err(|error| error.in_cell(cell))
        });
        let data = data.collect::<Result<Vec<_>, _>>()?;
        Ok(self.with(Materials::of(&self.elements.groups, &|cell| data[cell])))
    }

    fn with(&self, lame: Materials) -> Self {
        Self {
            elements: Arc::clone(&self.elements),
            lame: Arc::new(lame),
            factor: 1.0,
        }
    }

    /// `y += scale A x` for displacements x \[m\]; both fields have one vector per vertex.
    ///
    /// # Panics
    /// For fields of another length.
    pub fn multiply_add(&self, scale: f64, x: &[SVector<f64, D>], y: &mut [SVector<f64, D>]) {
        let vertices = self.vertex_count();
        assert_eq!([x.len(), y.len()], [vertices; 2], "vectors of two fields");
        add_product(self, None, scale, x, y);
    }

    /// [`multiply_add_levels`](Self::multiply_add_levels) part by part, for `y` as the first of three fields: for parts of the
    /// vertices, each in one part, `begin(first, y)` before the sums of the part, from the vertex `first` on, and `end(first,
    /// [y, p, q])` behind them, while the part is in the cache. Parts share the threads. What precedes and follows the product
    /// at each vertex hence needs no passes over memory of its own.
    ///
    /// ```
    /// use nalgebra::Vector2;
    /// use stickslip_fem::{Elastic, P1, element_stiffness, lumped_mass};
    ///
    /// let space = P1::grid([2.0, 1.0], [4, 2])?;
    /// let stiffness = element_stiffness(&space, &Elastic { young_modulus: 2.5, poisson_ratio: 0.25 })?;
    /// let mass: Vec<f64> = lumped_mass::<2, 2>(&space, 1.0)?.data().iter().map(|block| block[(0, 0)]).collect();
    /// let u = space.interpolate(|x| Vector2::new(x[1] * x[1], 0.0));
    /// let [mut force, mut acceleration, mut doubled] = [(); 3].map(|()| vec![Vector2::zeros(); space.vertex_count()]);
    /// stiffness.multiply_add_by_parts(
    ///     &[1.0],
    ///     -1.0,
    ///     &u,
    ///     [&mut force, &mut acceleration, &mut doubled],
    ///     &|_, force| force.fill(Vector2::zeros()),
    ///     &|first, [force, acceleration, doubled]| {
    ///         for (i, force) in force.iter().enumerate() {
    ///             acceleration[i] = force / mass[first + i];
    ///             doubled[i] = 2.0 * acceleration[i];
    ///         }
    ///     },
    /// );
    /// let mut expected = vec![Vector2::zeros(); space.vertex_count()];
    /// stiffness.multiply_add(-1.0, &u, &mut expected);
    /// assert_eq!(force, expected);
    /// assert_eq!(acceleration[7], expected[7] / mass[7]);
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    ///
    /// # Panics
    /// For fields of another length.
    pub fn multiply_add_by_parts(
        &self,
        weights: &[f64],
        scale: f64,
        x: &[SVector<f64, D>],
        fields: [&mut [SVector<f64, D>]; 3],
        begin: BeginPart<'_, D>,
        end: EndPart<'_, D>,
    ) {
        let lengths = fields.each_ref().map(|field| field.len());
        let vertices = self.vertex_count();
        assert_eq!(
            (x.len(), lengths),
            (vertices, [vertices; 3]),
            "vectors of four fields"
        );
        add_product_by_parts(self, weights, scale, x, fields, begin, end);
    }

    /// The factor of a multiple of another stiffness, which shares its memory: `self = factor other`.
    ///
    /// ```
    /// use stickslip_fem::{Elastic, P1, element_stiffness};
    ///
    /// let space = P1::grid([2.0, 1.0], [4, 2])?;
    /// let rock = Elastic { young_modulus: 2.5, poisson_ratio: 0.25 };
    /// let stiffness = element_stiffness(&space, &rock)?;
    /// assert_eq!((&stiffness * 0.5).multiple_of(&stiffness), Some(0.5));
    /// assert_eq!(element_stiffness(&space, &rock)?.multiple_of(&stiffness), None);
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    pub fn multiple_of(&self, other: &Self) -> Option<f64> {
        let shared =
            Arc::ptr_eq(&self.elements, &other.elements) && Arc::ptr_eq(&self.lame, &other.lame);
        shared.then_some(self.factor / other.factor)
    }

    /// The number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.elements.copies.vertex_count()
    }

    /// The [identity](crate::Mesh::identity) of its mesh.
    pub fn mesh(&self) -> MeshIdentity {
        self.elements.mesh
    }

    /// The surfaces along which the mesh was split.
    pub fn split_surfaces(&self) -> &[SplitSurface] {
        &self.elements.splits
    }
}

/// The multiple, which shares the memory of the cells.
impl<const D: usize> Mul<f64> for &ElementStiffness<D> {
    type Output = ElementStiffness<D>;

    fn mul(self, factor: f64) -> ElementStiffness<D> {
        ElementStiffness {
            factor: self.factor * factor,
            ..self.clone()
        }
    }
}
