use crate::auxiliary::auxiliary_levels;
use crate::refine::refine;
use crate::{FemError, Mesh, Prolongation};

/// A coarse mesh and its refinements, uniform or graded, each with the interpolation from the mesh before. If the
/// coarse mesh is fine, [auxiliary levels](Hierarchy::with_auxiliary_levels) without meshes can follow below it.
///
/// Every uniform refinement halves all edges. The vertices of each refined mesh are numbered anew along the shorter
/// extents of the bounding box first. The children of a tetrahedron have at most three shapes after any number of
/// refinements: angles stay bounded.
///
/// ```
/// use stickslip_fem::{GridDiagonal, Hierarchy, Mesh};
///
/// let strip = Mesh::<2>::grid([5.0, 1.0], [5, 1], GridDiagonal::Rising)?;
/// let hierarchy = Hierarchy::new(strip).refined(2)?;
/// assert_eq!(hierarchy.level_count(), 3);
/// assert_eq!(hierarchy.finest().vertex_count(), 21 * 5);
/// assert_eq!(hierarchy.prolongations()[1].shape(), (21 * 5, 11 * 3));
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Hierarchy<const D: usize> {
    coarsest: Mesh<D>,
    finer: Vec<Mesh<D>>,
    prolongations: Vec<Prolongation>,
}

impl<const D: usize> Hierarchy<D> {
    /// A hierarchy of one level.
    pub fn new(coarsest: Mesh<D>) -> Self {
        Self {
            coarsest,
            finer: Vec::new(),
            prolongations: Vec::new(),
        }
    }

    /// Adds uniform refinements of the finest mesh.
    ///
    /// # Errors
    ///
    /// [`FemError::TooMany`] if 32 bits do not number the mesh.
    pub fn refined(mut self, levels: usize) -> Result<Self, FemError> {
        self.expect_refinable(levels)?;
        for _ in 0..levels {
            let finer = refine(self.finest(), None)?;
            self.push(finer);
        }
        Ok(self)
    }

    /// Refuses refinements that 32 bits could not number, before any.
    pub(crate) fn expect_refinable(&self, levels: usize) -> Result<(), FemError> {
        let vertices = fewest_vertices(self.finest(), levels);
        if vertices > u64::from(u32::MAX) {
            return Err(FemError::too_many("vertices", vertices));
        }
        Ok(())
    }

    pub(crate) fn push(&mut self, (mesh, prolongation): (Mesh<D>, Prolongation)) {
        self.finer.push(mesh);
        self.prolongations.push(prolongation);
    }

    /// Adds auxiliary levels below the coarsest mesh, for multigrid on a mesh that is fine from the start, such as a
    /// file's.
    ///
    /// Each of these levels keeps some of the vertices of the one before, about a quarter (D = 2) or a sixth (D = 3),
    /// until about 100 are left. The others interpolate linearly between kept vertices around them, with weights that
    /// reproduce linear functions. The levels follow grading, curved boundaries and slits. A mesh of no more than 100
    /// vertices gets no levels, and a second call adds none.
    ///
    /// ```
    /// use stickslip_fem::{GridDiagonal, Hierarchy, Mesh};
    ///
    /// let mesh = Mesh::<2>::grid([5.0, 1.0], [80, 16], GridDiagonal::Rising)?;
    /// let hierarchy = Hierarchy::new(mesh).with_auxiliary_levels()?;
    /// assert_eq!(hierarchy.level_count(), 1);
    /// let sizes: Vec<usize> = hierarchy.prolongations().iter().map(|p| p.rows()).collect();
    /// assert_eq!(sizes.last(), Some(&(81 * 17)));
    /// assert!(hierarchy.prolongations()[0].cols() <= 100);
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`FemError::TooMany`] if 32 bits do not number the weights of an interpolation.
    pub fn with_auxiliary_levels(mut self) -> Result<Self, FemError> {
        if self.prolongations.len() == self.finer.len() {
            let coarser = auxiliary_levels(&self.coarsest)?;
            self.prolongations.splice(..0, coarser);
        }
        Ok(self)
    }

    /// Number of meshes, at least 1.
    pub fn level_count(&self) -> usize {
        self.finer.len() + 1
    }

    /// The mesh of a level, 0 the coarsest.
    pub fn mesh(&self, level: usize) -> Option<&Mesh<D>> {
        if level == 0 {
            Some(&self.coarsest)
        } else {
            self.finer.get(level - 1)
        }
    }

    /// The coarsest mesh.
    pub fn coarsest(&self) -> &Mesh<D> {
        &self.coarsest
    }

    /// The finest mesh.
    pub fn finest(&self) -> &Mesh<D> {
        self.finer.last().unwrap_or(&self.coarsest)
    }

    /// The interpolations between neighbouring levels, coarsest first: those of auxiliary levels, then those between
    /// the meshes. Without auxiliary levels the k-th maps level k to level k + 1.
    pub fn prolongations(&self) -> &[Prolongation] {
        &self.prolongations
    }
}

/// A lower bound for the number of vertices after some refinements: a cell cut into n pieces along each edge has
/// binom(n - 1, D) vertices in its interior.
fn fewest_vertices<const D: usize>(mesh: &Mesh<D>, levels: usize) -> u64 {
    let inner = (1_u128 << levels.min(32)) - 1;
    let interior = (0..D as u128).fold(1, |product, k| product * inner.saturating_sub(k) / (k + 1));
    u64::try_from(interior.saturating_mul(mesh.cell_count() as u128)).unwrap_or(u64::MAX)
}
