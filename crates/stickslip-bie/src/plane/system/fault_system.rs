//! Several planar faults in one half space.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use super::between::between;
use super::blocks::Blocks;
use super::coupling::Coupling;
use super::placement::{Axes, Placement};
use super::{SystemKernel, SystemNormalKernel, separation};
use crate::{KernelError, PlaneFault, Rectangles, SurfaceFault};

/// The default limit of the memory of the blocks between planes: 2 GiB.
const MEMORY: usize = 2 << 30;

/// Several planar faults in one elastic half space by boundary integrals, quasi-dynamic: slip on each of them stresses
/// all others.
///
/// Each plane is a [`PlaneFault`] with its own cells, dip and directions of slip, at a [`Placement`] with a strike. Its
/// conventions hold for it as they are: slip of its own hanging wall, positions `[x, y]` along its strike and down its
/// dip. Vertices are numbered plane after plane.
///
/// The interaction of a plane with itself is that of the `PlaneFault`. The interaction between planes is dense, from
/// the stress of rectangular cells at the centres of the others (Okada, as of
/// [`RectangularDislocation`](crate::RectangularDislocation)): a product takes as many operations as there are pairs of
/// cells on different planes, times pairs of components. Memory is 8 bytes for each of them, and 8 bytes per pair of
/// cells and component for the normal stress. 3 planes of 4000 cells with one component take 1.5 GB; to make them takes
/// 0.2 microseconds per pair, 20 s, and as long again for the normal stress. The limit is 2 GiB, or that of
/// [`with_memory_limit`](Self::with_memory_limit).
///
/// The matrix is not symmetric, and no energy belongs to it, because cells of constant slip are seen at their centres.
/// Between cells that are small and far from each other it is symmetric to second order in their size by their
/// distance. Beside each other, planes should be further apart than their cells are long.
/// [`with_surface`](Self::with_surface) adds a surface of triangles to the planes.
/// The coupling of both components of slip is not corrected between cells of planes that continue each other.
///
/// ```
/// use nalgebra::Vector1;
/// use stickslip_bie::{Cells, FaultSystem, Medium, Placement, PlaneFault, Rectangles};
/// use stickslip_solvers::{Matrix, Operator};
///
/// // Two vertical strike-slip faults that strike to the north, 5 km apart.
/// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
/// let cells = Rectangles::new(Cells::new([-10e3, 10e3], 20)?, Cells::new([0.0, 10e3], 10)?);
/// let plane = PlaneFault::half_space(cells, 90.0, rock, 0.25)?.with_rake(180.0)?;
/// let system = FaultSystem::new([
///     (plane.clone(), Placement { strike: 0.0, origin: [0.0, 0.0] }),
///     (plane, Placement { strike: 0.0, origin: [5e3, 0.0] }),
/// ])?;
/// // Slip on the first relieves the second beside it: the force that resists slip grows.
/// let mut slip = vec![Vector1::new(0.0); system.vertex_count()];
/// slip[system.vertices(0)].fill(Vector1::new(1.0));
/// let beside = system.vertices(1).start + cells.index([10, 5]);
/// assert!(system.stiffness().product_at(beside, &slip)[0] > 0.0);
/// # Ok::<(), stickslip_bie::KernelError>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("fault network", "boundary element", "quasi-dynamic"))]
pub struct FaultSystem<const C: usize = 2> {
    pub(super) planes: Vec<PlaneFault<C>>,
    pub(super) placements: Vec<Placement>,
    pub(super) ranges: Vec<Range<usize>>,
    pub(super) surface: Option<SurfaceFault<C>>,
    /// The shear blocks, shared by clones; computed on first use.
    shear: Arc<OnceLock<Arc<Blocks<C, C>>>>,
    normal: Arc<OnceLock<Arc<Blocks<1, C>>>>,
    pub(super) between: Arc<OnceLock<Arc<Coupling<C>>>>,
}

impl<const C: usize> FaultSystem<C> {
    /// Planes in one half space at their places.
    ///
    /// Planes may touch, along an edge or where one ends on another.
    ///
    /// # Errors
    /// [`KernelError`] for no planes, a plane in a whole space, a placement that is not finite, planes in different
    /// rock, planes that cross or cover each other, a cell whose centre is nearer to another plane than a tenth of the
    /// shortest side of the cells of both, and blocks between planes beyond 2 GiB.
    pub fn new(
        planes: impl IntoIterator<Item = (PlaneFault<C>, Placement)>,
    ) -> Result<Self, KernelError> {
        Self::with_memory_limit(planes, MEMORY)
    }

    /// [`new`](Self::new) with a limit of so many bytes for the blocks between planes, those of shear and normal stress
    /// together.
    ///
    /// # Errors
    /// See [`new`](Self::new).
    pub fn with_memory_limit(
        planes: impl IntoIterator<Item = (PlaneFault<C>, Placement)>,
        bytes: usize,
    ) -> Result<Self, KernelError> {
        let (planes, placements): (Vec<_>, Vec<_>) = planes.into_iter().unzip();
        let mut ranges = Vec::with_capacity(planes.len());
        let mut count = 0;
        for plane in &planes {
            ranges.push(count..count + plane.cells().count());
            count += plane.cells().count();
        }
        let system = Self {
            planes,
            placements,
            ranges,
            surface: None,
            shear: Arc::default(),
            normal: Arc::default(),
            between: Arc::default(),
        };
        system.check_planes()?;
        separation::check(&system)?;
        let needed = system.memory_between_planes();
        if needed > bytes as f64 {
            let what = "memory [bytes] of the interaction between planes";
            let error = KernelError::new(what, "at most", needed);
            return Err(error.bound(bytes as f64));
        }
        Ok(system)
    }

    /// Refuses planes that are of no system.
    fn check_planes(&self) -> Result<(), KernelError> {
        let Some(first) = self.planes.first() else {
            let what = "number of planes of a system";
            return Err(KernelError::new(what, "at least", 0.0).bound(1.0));
        };
        for (number, (plane, placement)) in self.planes.iter().zip(&self.placements).enumerate() {
            let refused = |error: KernelError| error.of_plane(number);
            placement.check().map_err(refused)?;
            if plane.dip().is_none() {
                let what = "number of free surfaces";
                return Err(refused(KernelError::new(what, "at least", 0.0).bound(1.0)));
            }
            for (what, value, expected) in [
                (
                    "shear modulus",
                    plane.rock.shear_modulus,
                    first.rock.shear_modulus,
                ),
                (
                    "shear wave speed",
                    plane.rock.shear_wave_speed,
                    first.rock.shear_wave_speed,
                ),
                ("Poisson's ratio", plane.poisson_ratio, first.poisson_ratio),
            ] {
                if value != expected {
                    let requirement = "that of the first plane,";
                    let error = KernelError::new(what, requirement, value);
                    return Err(refused(error.bound(expected)));
                }
            }
        }
        Ok(())
    }

    /// The bytes of the blocks between planes, of shear and normal stress.
    fn memory_between_planes(&self) -> f64 {
        let count = self.vertices_of_planes() as f64;
        let pairs = (self.ranges.iter()).map(|plane| plane.len() as f64);
        let pairs: f64 = pairs.map(|cells| cells * (count - cells)).sum();
        pairs * (size_of::<f64>() * C * (C + 1)) as f64
    }

    /// The planes.
    pub fn planes(&self) -> &[PlaneFault<C>] {
        &self.planes
    }

    /// Their places.
    pub fn placements(&self) -> &[Placement] {
        &self.placements
    }

    /// The cells of a plane.
    pub fn cells(&self, plane: usize) -> &Rectangles {
        self.planes[plane].cells()
    }

    /// The number of cells of all planes, and of the surface if there is one.
    pub fn vertex_count(&self) -> usize {
        let of_surface = self
            .surface
            .as_ref()
            .map_or(0, |surface| surface.cells().count());
        self.vertices_of_planes() + of_surface
    }

    /// The vertices of a plane's cells.
    pub fn vertices(&self, plane: usize) -> Range<usize> {
        self.ranges[plane].clone()
    }

    /// The plane of a vertex, and the cell there; of a vertex of the surface the number of planes, and its cell.
    pub fn plane_and_cell(&self, vertex: usize) -> [usize; 2] {
        let plane = self.ranges.partition_point(|plane| plane.end <= vertex);
        let before = plane
            .checked_sub(1)
            .map_or(0, |before| self.ranges[before].end);
        [plane, vertex - before]
    }

    /// The surface and its cell at a vertex.
    fn on_surface(&self, vertex: usize) -> Option<(&SurfaceFault<C>, usize)> {
        let cell = vertex.checked_sub(self.vertices_of_planes())?;
        Some((self.surface.as_ref()?, cell))
    }

    /// The centre of a cell, east, north and up from the surface \[m\].
    pub fn center(&self, vertex: usize) -> [f64; 3] {
        if let Some((surface, cell)) = self.on_surface(vertex) {
            return surface.cells().centroid(cell);
        }
        let [plane, cell] = self.plane_and_cell(vertex);
        let center = self.cells(plane).center(cell);
        self.axes(plane).point(center).into()
    }

    /// The area of a cell [m^2].
    pub fn area(&self, vertex: usize) -> f64 {
        if let Some((surface, cell)) = self.on_surface(vertex) {
            return surface.cells().area(cell);
        }
        let [plane, _] = self.plane_and_cell(vertex);
        self.cells(plane).area()
    }

    pub(super) fn dip(&self, plane: usize) -> f64 {
        // There is one in a half space.
        self.planes[plane].dip().unwrap_or(90.0)
    }

    pub(crate) fn axes(&self, plane: usize) -> Axes {
        self.placements[plane].axes(self.dip(plane))
    }

    /// The stiffness matrix \[N/m\]: forces on cells due to slip on all planes, positive against it. It is made when it
    /// is first asked for, and shared by all.
    pub fn stiffness(&self) -> SystemKernel<C> {
        let blocks = (self.shear).get_or_init(|| Arc::new(self.shear_blocks()));
        let planes = self.planes.iter().map(PlaneFault::stiffness);
        let kernel = SystemKernel::of_interaction(planes.collect(), Arc::clone(blocks));
        let kernel = kernel.on(self.identity());
        match &self.surface {
            Some(surface) => kernel.with_surface(surface.stiffness(), Some(self.between(surface))),
            None => kernel,
        }
    }

    fn between(&self, surface: &SurfaceFault<C>) -> Arc<Coupling<C>> {
        let made = || Arc::new(between(self, surface));
        Arc::clone(self.between.get_or_init(made))
    }

    /// The change of normal stress per slip on all planes [Pa/m], compression positive. Its blocks between planes are
    /// made when it is first asked for, and shared by all.
    pub fn normal_stiffness(&self) -> SystemNormalKernel<C> {
        let blocks = (self.normal).get_or_init(|| Arc::new(self.normal_blocks()));
        let planes = self.planes.iter().map(PlaneFault::normal_stiffness);
        let normal = SystemNormalKernel::new(planes.collect(), Arc::clone(blocks), self.identity());
        match &self.surface {
            Some(surface) => normal.with_surface(surface.normal_stiffness(), self.between(surface)),
            None => normal,
        }
    }

    /// The radiation damping as a viscosity matrix, see [`PlaneFault::radiation_damping`] \[N s/m\].
    #[doc(alias = "quasi-dynamic")]
    pub fn radiation_damping(&self) -> SystemKernel<C> {
        let planes = self.planes.iter().map(PlaneFault::radiation_damping);
        let kernel = SystemKernel::of_planes(planes.collect()).on(self.identity());
        match &self.surface {
            Some(surface) => kernel.with_surface(surface.radiation_damping(), None),
            None => kernel,
        }
    }

    /// [`radiation_damping`](Self::radiation_damping) times a factor, finite and not negative.
    ///
    /// # Errors
    /// [`KernelError`] for a factor out of its range.
    pub fn radiation_damping_times(&self, factor: f64) -> Result<SystemKernel<C>, KernelError> {
        let planes = self.planes.iter();
        let planes = planes.map(|plane| plane.radiation_damping_times(factor));
        let planes = planes.collect::<Result<_, _>>()?;
        let kernel = SystemKernel::of_planes(planes).on(self.identity());
        Ok(match &self.surface {
            Some(surface) => kernel.with_surface(surface.radiation_damping_times(factor)?, None),
            None => kernel,
        })
    }
}
