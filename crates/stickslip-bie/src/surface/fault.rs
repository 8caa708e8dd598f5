//! A fault that is a surface of triangles.

use std::sync::{Arc, OnceLock};

use super::rock::Rock;
use super::{SurfaceError, Triangles};
use crate::error::positive;
use crate::hmatrix::Approximation;
use crate::interaction::{Interaction, Storage};
use crate::plane::cos_sin;
use crate::{KernelError, Medium};

/// A fault that is a surface of triangles in an elastic whole or half space, by boundary integrals, quasi-dynamic: of any
/// shape, of several sheets, with branches.
///
/// Slip is constant on each triangle and seen at centroids. It has two components, along strike and up dip of each cell
/// ([`CellAxes`](crate::CellAxes)), or one along a rake ([`with_rake`](Self::with_rake), [`with_rakes`](Self::with_rakes)).
/// Each cell stresses all others, and changes their normal stress
/// ([`normal_stiffness`](Self::normal_stiffness)).
///
/// **Correction.** Tractions of constant slip on triangles do not converge: they have an error in proportion to the
/// gradient of slip, for smooth slip on equilateral triangles 2.4 % of the peak at any size of cells. Four numbers per cell
/// and component correct them: the error becomes .7, .3 and .1 % at 2, 4 and 8 cells per length of slip. The correction is
/// on unless [`without_correction`](Self::without_correction). At a free surface it is that of a plane that goes on above:
/// cells at the surface keep .4 to .6 of their error at 6 cells per length of slip. Cells at other rims are not corrected.
///
/// **Averaging.** On a curved surface the normal stress has such an error, too: its mean over cells that share a vertex is
/// ten times more accurate; it is taken unless [`without_averaging`](Self::without_averaging). At a sharp bend the normal
/// stress grows as the cells get smaller: spread bends over many cells.
///
/// **Memory.** The interaction of up to 2000 cells is stored whole, with 48 bytes per pair of cells, or 24 with two
/// components on one plane in a whole space, and 16 or 8 with one. Beyond, it is an [`HMatrix`](crate::HMatrix) with a
/// tolerance of 1e-4: 7200 cells take 13 % of that, 20 000 take 6 %; [`with_tolerance`](Self::with_tolerance) and
/// [`with_approximation`](Self::with_approximation) set it for any number of cells, [`compression`](Self::compression) tells
/// what it takes. The limit is 8 GiB, or that of [`whole_space_within`](Self::whole_space_within).
///
/// ```
/// use nalgebra::Vector1;
/// use stickslip_bie::{Medium, SurfaceFault, Triangles};
/// use stickslip_solvers::{Matrix, Operator};
///
/// // A thrust that flattens downward, of 8 x 8 squares of 1 km.
/// let mut points = Vec::new();
/// for j in 0..=8 {
///     let depth = 2e3 + 500.0 * f64::from(j) * (1.0 - f64::from(j) / 20.0);
///     points.extend((0..=8).map(|i| [1e3 * f64::from(i), -800.0 * f64::from(j), -depth]));
/// }
/// let mut triangles = Vec::new();
/// for corner in (0..8).flat_map(|j| (0..8).map(move |i| 9 * j + i)) {
///     triangles.extend([[corner, corner + 1, corner + 10], [corner, corner + 10, corner + 9]]);
/// }
/// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
/// let cells = Triangles::new(&points, &triangles)?;
/// let fault = SurfaceFault::half_space(cells, rock, 0.25)?.with_rake(90.0)?;
/// // Slip of a cell is resisted there.
/// let mut slip = vec![Vector1::new(0.0); 128];
/// slip[60][0] = 1.0;
/// assert!(fault.stiffness().product_at(60, &slip)[0] > 0.0);
/// # Ok::<(), stickslip_bie::SurfaceError>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("nonplanar", "rough fault", "listric", "boundary element", "TDE"))]
pub struct SurfaceFault<const C: usize = 2> {
    pub(super) cells: Arc<Triangles>,
    pub(super) medium: Medium,
    pub(super) rock: Rock,
    /// Parts of the directions of slip along strike and up dip.
    pub(super) directions: Arc<Vec<[[f64; 2]; C]>>,
    pub(super) is_corrected: bool,
    pub(super) is_averaged: bool,
    pub(super) storage: Storage,
    /// Shared by clones; computed on first use.
    pub(super) interaction: Arc<OnceLock<Arc<Interaction<C>>>>,
}

impl SurfaceFault {
    /// A surface in a whole space, with two components of slip.
    ///
    /// # Errors
    /// [`SurfaceError`] for rock or Poisson's ratio out of their ranges, and for an interaction beyond 8 GiB.
    pub fn whole_space(
        cells: Triangles,
        rock: Medium,
        poisson_ratio: f64,
    ) -> Result<Self, SurfaceError> {
        let fault = Self::new(cells, rock, poisson_ratio, false)?;
        fault.stored(Storage::default())
    }

    /// [`whole_space`](Self::whole_space) with a limit of so many bytes for the interaction of two components.
    ///
    /// # Errors
    /// See [`whole_space`](Self::whole_space).
    pub fn whole_space_within(
        bytes: u64,
        cells: Triangles,
        rock: Medium,
        poisson_ratio: f64,
    ) -> Result<Self, SurfaceError> {
        Self::new(cells, rock, poisson_ratio, false)?.stored(Storage::within(bytes))
    }

    /// A surface in a half space `z <= 0` with a free surface, with two components of slip. It may reach the surface.
    ///
    /// # Errors
    /// [`SurfaceError`] for vertices above the surface, and for those below it by less than a thousandth of a side from a
    /// vertex on it; the errors of [`whole_space`](Self::whole_space).
    pub fn half_space(
        cells: Triangles,
        rock: Medium,
        poisson_ratio: f64,
    ) -> Result<Self, SurfaceError> {
        let fault = Self::new(cells.below_surface()?, rock, poisson_ratio, true)?;
        fault.stored(Storage::default())
    }

    /// [`half_space`](Self::half_space) with a limit of so many bytes for the interaction of two components.
    ///
    /// # Errors
    /// See [`half_space`](Self::half_space).
    pub fn half_space_within(
        bytes: u64,
        cells: Triangles,
        rock: Medium,
        poisson_ratio: f64,
    ) -> Result<Self, SurfaceError> {
        let fault = Self::new(cells.below_surface()?, rock, poisson_ratio, true)?;
        fault.stored(Storage::within(bytes))
    }

    fn new(
        cells: Triangles,
        medium: Medium,
        poisson_ratio: f64,
        has_surface: bool,
    ) -> Result<Self, SurfaceError> {
        positive("shear wave speed", medium.shear_wave_speed)?;
        Ok(Self {
            rock: Rock::new(medium.shear_modulus, poisson_ratio, has_surface)?,
            medium,
            directions: Arc::new(vec![[[1.0, 0.0], [0.0, 1.0]]; cells.count()]),
            cells: Arc::new(cells),
            is_corrected: true,
            is_averaged: true,
            storage: Storage::default(),
            interaction: Arc::default(),
        })
    }

    /// The same fault with slip along a fixed rake \[degrees\]: 0 along strike (left-lateral), 90 up dip (thrust), -90
    /// down dip (normal), 180 right-lateral.
    ///
    /// # Errors
    /// [`KernelError`] for a rake that is not finite.
    pub fn with_rake(self, rake: f64) -> Result<SurfaceFault<1>, KernelError> {
        let rakes = vec![rake; self.cells.count()];
        self.with_rakes(&rakes)
    }

    /// The same fault with slip along one rake per cell \[degrees\], see [`with_rake`](Self::with_rake): on a surface that
    /// turns, those of a plate vector ([`rakes_along`](Self::rakes_along)).
    ///
    /// # Errors
    /// [`KernelError`] for another number of rakes than cells, and for a rake that is not finite.
    pub fn with_rakes(self, rakes: &[f64]) -> Result<SurfaceFault<1>, KernelError> {
        let count = self.cells.count();
        if rakes.len() != count {
            let wrong =
                KernelError::new("number of rakes", "that of the cells,", rakes.len() as f64);
            return Err(wrong.bound(count as f64));
        }
        if let Some(cell) = (0..count).find(|&cell| !rakes[cell].is_finite()) {
            let wrong = KernelError::new("rake [degrees] of cell", "finite", rakes[cell]);
            return Err(wrong.of_cell(cell));
        }
        Ok(SurfaceFault {
            cells: self.cells,
            medium: self.medium,
            rock: self.rock,
            directions: Arc::new(rakes.iter().map(|&rake| [cos_sin(rake)]).collect()),
            is_corrected: self.is_corrected,
            is_averaged: self.is_averaged,
            storage: self.storage,
            interaction: Arc::default(),
        })
    }
}

impl<const C: usize> SurfaceFault<C> {
    /// The same fault with tractions as they are, for comparisons: they do not converge.
    pub fn without_correction(self) -> Self {
        Self {
            is_corrected: false,
            interaction: Arc::default(),
            ..self
        }
    }

    /// The same fault with normal stress at centroids as it is, for comparisons: it does not converge on curved surfaces.
    pub fn without_averaging(self) -> Self {
        Self {
            is_averaged: false,
            ..self
        }
    }

    /// Its cells.
    pub fn cells(&self) -> &Triangles {
        &self.cells
    }

    /// The rock around it, and its Poisson's ratio.
    pub fn rock(&self) -> (Medium, f64) {
        (self.medium, self.rock.poisson_ratio())
    }

    /// True in a half space.
    pub fn has_surface(&self) -> bool {
        self.rock.has_surface()
    }

    /// The parts of each cell's directions of slip along strike and up dip.
    pub fn directions(&self) -> &[[[f64; 2]; C]] {
        &self.directions
    }

    /// The same fault with an interaction that differs from the exact one by so much, relative, in far blocks: 1e-4 by default.
    ///
    /// # Errors
    /// [`SurfaceError`] for a tolerance that is not positive, or above 0.1, and for an interaction beyond the limit of
    /// memory.
    pub fn with_tolerance(self, tolerance: f64) -> Result<Self, SurfaceError> {
        let approximation = Approximation::default().with_tolerance(tolerance)?;
        self.with_approximation(approximation)
    }

    /// The same fault with an [`Approximation`] of its interaction: none, of a tolerance, in single precision, or with another
    /// limit of memory.
    ///
    /// # Errors
    /// [`SurfaceError`] for an interaction beyond the limit of memory.
    pub fn with_approximation(self, approximation: Approximation) -> Result<Self, SurfaceError> {
        self.stored(Storage::of(approximation))
    }

    fn stored(self, storage: Storage) -> Result<Self, SurfaceError> {
        storage.check(&self.pairs())?;
        Ok(Self {
            storage,
            interaction: Arc::default(),
            ..self
        })
    }
}
