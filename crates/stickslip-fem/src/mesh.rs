use nalgebra::SVector;

use crate::boundary::boundary_faces;
use crate::fingerprint::fingerprint;
use crate::groups::Groups;
use crate::marks::Marks;
use crate::simplex::Simplex;
use crate::surfaces::Surfaces;
use crate::{FemError, MeshIdentity};

/// A conforming mesh of triangles (D = 2) or tetrahedra (D = 3).
///
/// Each cell lists its D + 1 vertices so that det(x_1 - x_0, ..., x_D - x_0) > 0. Parts of the boundary and groups of
/// cells may have names: [`Mesh::with_part`], [`Mesh::with_material`].
///
/// ```
/// use nalgebra::Vector2;
/// use stickslip_fem::{FemError, Mesh};
///
/// let corners = vec![Vector2::new(0.0, 0.0), Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0)];
/// let mesh = Mesh::new(corners.clone(), vec![0, 1, 2])?;
/// assert_eq!(mesh.volume(0), 0.5);
/// assert_eq!(mesh.boundary(), [[0, 1], [2, 0], [1, 2]]);
///
/// let clockwise = Mesh::new(corners, vec![0, 2, 1]);
/// assert_eq!(clockwise, Err(FemError::DegenerateCell { level: None, cell: 0, volume: -0.5 }));
/// # Ok::<(), FemError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh<const D: usize> {
    pub(crate) vertices: Vec<SVector<f64, D>>,
    pub(crate) cells: Vec<u32>,
    pub(crate) marks: Marks,
    pub(crate) boundary: Vec<[u32; D]>,
    pub(crate) fingerprint: u64,
    pub(crate) groups: Groups,
    pub(crate) surfaces: Surfaces<D>,
}

impl<const D: usize> Mesh<D> {
    /// A mesh of the given vertices \[m\] and cells, D + 1 consecutive vertex indices per cell. The numbering is kept.
    ///
    /// # Errors
    ///
    /// [`FemError`] if there are no cells or a fraction of one, coordinates are not finite, indices are out of range, a
    /// cell is inverted or flat, a vertex has no cell, a cell is repeated, or cells lie on the same side of their
    /// common face.
    ///
    /// Nonconforming meshes with duplicate or hanging nodes are accepted; [`Mesh::nonconforming_nodes`] finds these
    /// nodes.
    pub fn new(vertices: Vec<SVector<f64, D>>, cells: Vec<u32>) -> Result<Self, FemError> {
        let mirrored = vec![false; cells.len() / (D + 1)];
        Self::checked(vertices, cells, mirrored)
    }

    pub(crate) fn checked(
        vertices: Vec<SVector<f64, D>>,
        cells: Vec<u32>,
        mirrored: Vec<bool>,
    ) -> Result<Self, FemError> {
        const { assert!(D == 2 || D == 3, "meshes are two- or three-dimensional") };
        let corners = D + 1;
        if cells.is_empty() {
            return Err(FemError::empty("cells"));
        }
        if !cells.len().is_multiple_of(corners) {
            return Err(FemError::Length {
                what: "vertex indices, which are not those of whole cells",
                expected: cells.len().next_multiple_of(corners),
                found: cells.len(),
            });
        }
        if u32::try_from(vertices.len()).is_err() {
            return Err(FemError::too_many("vertices", vertices.len() as u64));
        }
        if let Some(vertex) = vertices
            .iter()
            .position(|x| !x.iter().all(|c| c.is_finite()))
        {
            return Err(FemError::Point {
                what: "vertex",
                index: vertex,
                requirement: "finite coordinates",
            });
        }
        let mut used = vec![false; vertices.len()];
        for (index, &vertex) in cells.iter().enumerate() {
            let Some(used) = used.get_mut(vertex as usize) else {
                return Err(FemError::OutOfRange {
                    what: "vertex",
                    index: vertex as usize,
                    count: vertices.len(),
                    by: format!("cell {}", index / corners),
                });
            };
            *used = true;
        }
        if let Some(vertex) = used.iter().position(|used| !used) {
            return Err(FemError::Point {
                what: "vertex",
                index: vertex,
                requirement: "a cell",
            });
        }
        for (cell, corners) in cells.chunks_exact(corners).enumerate() {
            let simplex = Simplex::new(&vertices, corners);
            let volume = simplex.volume;
            if !simplex.is_solid() {
                return Err(FemError::DegenerateCell {
                    level: None,
                    cell,
                    volume,
                });
            }
        }
        let boundary = boundary_faces(&cells)?;
        Ok(Self {
            fingerprint: fingerprint(&vertices, &cells),
            vertices,
            cells,
            marks: Marks::Reflected(mirrored),
            boundary,
            groups: Groups::default(),
            surfaces: Surfaces::default(),
        })
    }

    /// The vertices \[m\].
    pub fn vertices(&self) -> &[SVector<f64, D>] {
        &self.vertices
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.cells.len() / (D + 1)
    }

    /// The D + 1 vertices of a cell.
    ///
    /// # Panics
    /// Unless `index` is below [`cell_count`](Self::cell_count): `cells().nth(index)` is `None` then.
    pub fn cell(&self, index: usize) -> &[u32] {
        &self.cells[(D + 1) * index..(D + 1) * (index + 1)]
    }

    /// The cells in order.
    pub fn cells(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        self.cells.chunks_exact(D + 1)
    }

    /// The area (D = 2) or volume (D = 3) of a cell [m^D].
    ///
    /// # Panics
    /// Unless `index` is below [`cell_count`](Self::cell_count).
    pub fn volume(&self, index: usize) -> f64 {
        self.simplex(self.cell(index)).volume
    }

    /// The faces that belong to one cell only, each ordered so that its normal points outward: to the right of the edge
    /// (D = 2), by the right-hand rule (D = 3).
    pub fn boundary(&self) -> &[[u32; D]] {
        &self.boundary
    }

    /// The fingerprint by which data are matched with their mesh, a hash of vertices and cells: equal for equal meshes,
    /// and different, but for a chance of 2^-64, for others. Names are not included: they change neither vertices nor
    /// faces. It may change with the version of this crate, and is not meant to be stored.
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// The identity by which parts, matrices and solvers are matched with this mesh.
    pub fn identity(&self) -> MeshIdentity {
        MeshIdentity {
            vertices: self.vertex_count(),
            cells: self.cell_count(),
            fingerprint: self.fingerprint(),
        }
    }

    pub(crate) fn simplex(&self, cell: &[u32]) -> Simplex<D> {
        Simplex::new(&self.vertices, cell)
    }
}
