//! A fault of segments.

use std::sync::{Arc, OnceLock};

use nalgebra::SMatrix;

use super::influence::Influence;
use super::pairs::SegmentPairs;
use super::potentials::Space;
use super::{Segments, SegmentsError, separation, surface};
use crate::fault::{check_medium, check_poisson_ratio};
use crate::hmatrix::{Approximation, Compression};
use crate::interaction::{Interaction, Storage};
use crate::{CellKernel, CellNormalKernel, KernelError, Medium, Mode, Section, Sense};

/// Faults along polylines in a half space or a whole space, quasi-dynamic: bent, listric, rough, branched, or several.
///
/// ```text
/// tau = tau0 - (K D)/h,   sigma = sigma0 + N D          h the length of each cell
/// ```
///
/// with the slip `D` across the fault, `tau` positive in the direction of slip, `sigma` positive in compression, `K` the
/// [`stiffness`](Self::stiffness) and `N` the [`normal_stiffness`](Self::normal_stiffness). Forces are those on a cell,
/// stress times its length [N/m]. For slip that is constant on cells, both are exact at their centres.
///
/// | | in plane strain | antiplane |
/// | --- | --- | --- |
/// | positive slip | hanging wall up dip; down dip with [`Sense::Normal`] | side towards `x` along `y` |
/// | normal stress | follows slip | constant |
///
/// `x` points to the right, `z` up, and `y` away from who sees them so. The hanging wall of a fault is the side above it, in
/// the mean of its cells; of a vertical fault it is the side towards `x`, and of a closed one the side to the left of its
/// points. A straight fault is a [`DippingFault`](crate::DippingFault), and vertical, antiplane, a [`Fault`](crate::Fault).
///
/// # Bends
///
/// At a sharp bend the normal stress due to slip grows as 1/h, without limit as cells become shorter. Bends are to be spread
/// over many cells ([`DipProfile::spread`](crate::DipProfile::spread)); [`Segments::quality`] reports the largest. A run
/// in which the normal stress vanishes ends with the cell, its time and the bend there ([`Segments::bend_at`]).
///
/// # Errors of cells
///
/// On a straight line of equal cells stress is of second order in their length, on a curved one of first.
///
/// # Memory
///
/// The interaction of up to 2000 cells is stored whole, with 16 bytes per pair of cells, or 8 in antiplane. Beyond, it is an
/// [`HMatrix`](crate::HMatrix) with a tolerance of 1e-4; [`with_tolerance`](Self::with_tolerance) and
/// [`with_approximation`](Self::with_approximation) set it for any number of cells, [`compression`](Self::compression)
/// tells what it takes. The limit is 8 GiB.
///
/// ```
/// use nalgebra::Vector1;
/// use stickslip_bie::{Medium, Mode, SegmentFault, Segments};
///
/// // Two thrusts, 5 km apart at the surface.
/// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
/// let first = Segments::down([(60.0, 10e3)], 500.0)?;
/// let second = first.map_points(|[x, z]| [x + 5e3, z])?;
/// let mode = Mode::InPlane { poisson_ratio: 0.25 };
/// let faults = SegmentFault::half_space(first.with(&second)?, rock, mode)?;
/// // Slip of the first unclamps the middle of the second.
/// let mut slip = vec![Vector1::new(0.0); 40];
/// slip[..20].fill(Vector1::new(1.0));
/// let mut stress = vec![0.0; 40];
/// faults.normal_stiffness().multiply_add(1.0, &slip, &mut stress);
/// assert!(stress[31] < 0.0);
/// # Ok::<(), stickslip_bie::SegmentsError>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias(
    "nonplanar fault",
    "bent fault",
    "listric",
    "rough fault",
    "quasi-dynamic",
    "boundary element"
))]
pub struct SegmentFault {
    pub(super) segments: Segments,
    pub(super) rock: Medium,
    pub(super) mode: Mode,
    pub(super) free_surface: bool,
    sense: Sense,
    storage: Storage,
    /// Computed on first use, shared by clones.
    interaction: Arc<OnceLock<Arc<Interaction<1>>>>,
}

impl SegmentFault {
    /// Faults in a half space whose free surface is at `z = 0`. Ends within 1e-9 of the extent of all cells from it are set
    /// to 0.
    ///
    /// # Errors
    /// [`SegmentsError`] for rock or mode out of their ranges, cells above the surface or along it, ends right below it,
    /// centres of cells that are too near to other cells, and an interaction beyond 8 GiB.
    pub fn half_space(segments: Segments, rock: Medium, mode: Mode) -> Result<Self, SegmentsError> {
        Self::new(surface::below(segments)?, rock, mode, true)
    }

    /// Faults in a whole space.
    ///
    /// # Errors
    /// [`SegmentsError`] for rock or mode out of their ranges, centres of cells that are too near to other cells, and
    /// an interaction beyond 8 GiB.
    pub fn whole_space(
        segments: Segments,
        rock: Medium,
        mode: Mode,
    ) -> Result<Self, SegmentsError> {
        Self::new(segments, rock, mode, false)
    }

    fn new(
        segments: Segments,
        rock: Medium,
        mode: Mode,
        free_surface: bool,
    ) -> Result<Self, SegmentsError> {
        check_medium(rock)?;
        if let Mode::InPlane { poisson_ratio } = mode {
            check_poisson_ratio(poisson_ratio)?;
        }
        separation::check(&segments)?;
        let fault = Self {
            segments,
            rock,
            mode,
            free_surface,
            sense: Sense::Thrust,
            storage: Storage::default(),
            interaction: Arc::default(),
        };
        fault.stored(Storage::default())
    }

    /// The same faults with another sense of positive slip, by default [`Sense::Thrust`]. Antiplane slip has none.
    #[must_use]
    pub fn with_sense(self, sense: Sense) -> Self {
        Self {
            sense,
            interaction: Arc::default(),
            ..self
        }
    }

    /// The same faults with an interaction that differs from the exact one by so much, relative, in far blocks: 1e-4 by
    /// default.
    ///
    /// # Errors
    /// [`SegmentsError`] for a tolerance that is not positive, or above 0.1, and for an interaction beyond the limit of memory.
    pub fn with_tolerance(self, tolerance: f64) -> Result<Self, SegmentsError> {
        let approximation = Approximation::default().with_tolerance(tolerance)?;
        self.with_approximation(approximation)
    }

    /// The same faults with an [`Approximation`] of their interaction: none, of a tolerance, in single precision, or with
    /// another limit of memory.
    ///
    /// # Errors
    /// [`SegmentsError`] for an interaction beyond the limit of memory.
    pub fn with_approximation(self, approximation: Approximation) -> Result<Self, SegmentsError> {
        self.stored(Storage::of(approximation))
    }

    fn stored(self, storage: Storage) -> Result<Self, SegmentsError> {
        storage.check(&self.pairs())?;
        Ok(Self {
            storage,
            interaction: Arc::default(),
            ..self
        })
    }

    /// The cells.
    pub fn cells(&self) -> &Segments {
        &self.segments
    }

    /// The rock around it.
    pub fn rock(&self) -> Medium {
        self.rock
    }

    /// The direction of slip.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// The sense of positive slip in plane strain.
    pub fn sense(&self) -> Sense {
        self.sense
    }

    /// The unit vectors of a cell, `[x, z]`: normal into the hanging wall, and up dip.
    ///
    /// # Panics
    /// For a cell that does not exist.
    pub fn axes(&self, cell: usize) -> [[f64; 2]; 2] {
        let cell = self.influence().cells[cell];
        cell.side
            .axes(cell.direction)
            .map(|axis| [axis.re, axis.im])
    }

    fn interaction(&self) -> Arc<Interaction<1>> {
        let interaction = (self.interaction)
            .get_or_init(|| Arc::new(Interaction::new(&self.pairs(), &self.storage)));
        Arc::clone(interaction)
    }

    /// The stiffness matrix `K` \[Pa\]: forces on cells that resist their slip. It is made when it is first asked for, with
    /// that of the normal stress, and shared by all.
    pub fn stiffness(&self) -> CellKernel<1> {
        CellKernel::of_interaction(self.interaction(), self.segments.identity())
    }

    /// The change of normal stress per slip [Pa/m], compression positive; zero for antiplane slip.
    pub fn normal_stiffness(&self) -> CellNormalKernel<1> {
        let cells = 0..self.segments.count();
        let bends = cells.map(|cell| self.segments.bend_at(cell)).collect();
        CellNormalKernel::new(self.interaction(), bends, self.segments.identity())
    }

    /// What the interaction takes, and how it is approximated. It is made if it is not there yet.
    pub fn compression(&self) -> Compression {
        self.interaction().compression()
    }

    /// The radiation damping as a viscosity matrix, for shear waves along the normal of each cell [Pa s/m times a length]:
    /// `eta = mu/(2 c_s)`.
    #[doc(alias = "quasi-dynamic")]
    pub fn radiation_damping(&self) -> CellKernel<1> {
        self.damping(1.0)
    }

    /// [`radiation_damping`](Self::radiation_damping) times a factor, finite and not negative.
    ///
    /// # Errors
    /// [`KernelError`] for a factor out of its range.
    pub fn radiation_damping_times(&self, factor: f64) -> Result<CellKernel<1>, KernelError> {
        crate::error::check_factor(factor)?;
        Ok(self.damping(factor))
    }

    fn damping(&self, factor: f64) -> CellKernel<1> {
        let damping = 0.5 * factor * self.rock.shear_modulus / self.rock.shear_wave_speed;
        let lengths = self.lengths().into_iter();
        let each = lengths
            .map(|length| SMatrix::from([[damping * length]]))
            .collect();
        CellKernel::of_diagonal(each, self.segments.identity())
    }

    /// The cells whose centres `[x, z]` \[m\] are inside, as a contact.
    ///
    /// # Errors
    /// [`KernelError`] if no centre is inside.
    pub fn section(
        &self,
        inside: impl FnMut([f64; 2]) -> bool,
    ) -> Result<Section<Segments>, KernelError> {
        self.segments.section(inside)
    }

    pub(super) fn lengths(&self) -> Vec<f64> {
        let cells = 0..self.segments.count();
        cells.map(|cell| self.segments.length(cell)).collect()
    }

    fn pairs(&self) -> SegmentPairs<'_> {
        SegmentPairs {
            segments: &self.segments,
            influence: self.influence(),
            mode: self.mode,
        }
    }

    pub(super) fn influence(&self) -> Influence {
        let space = Space::new(self.rock, self.mode, self.free_surface);
        Influence::new(&self.segments, space, self.mode, self.sign())
    }

    /// 1 for positive slip up dip.
    pub(super) fn sign(&self) -> f64 {
        match self.sense {
            Sense::Thrust => 1.0,
            Sense::Normal => -1.0,
        }
    }
}
