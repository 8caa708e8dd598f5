//! A surface of triangles beside the planes of a system.

use std::sync::Arc;

use nalgebra::{SVector, Vector3};

use super::FaultSystem;
use super::between;
use crate::surface::SurfaceSection;
use crate::{KernelError, SurfaceError, SurfaceFault, Triangles};

impl<const C: usize> FaultSystem<C> {
    /// The same planes with a surface of triangles, of one or several sheets, in the same rock: slip on it stresses the
    /// planes, and slip on them stresses it.
    ///
    /// Triangles have coordinates to the east, to the north and up. The vertices of its cells follow those of the planes, which
    /// keep their products. What surface and planes do to each other has the approximation of the surface
    /// ([`SurfaceFault::with_approximation`]), and, for each of both ways, its limit of memory.
    ///
    /// ```
    /// use nalgebra::Vector1;
    /// use stickslip_bie::{Cells, FaultSystem, Medium, Placement, PlaneFault, Rectangles, SurfaceFault, Triangles};
    /// use stickslip_solvers::{Matrix, Operator};
    ///
    /// // A vertical strike-slip fault to the north, and a curved one 5 km east of it.
    /// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
    /// let cells = Rectangles::new(Cells::new([-10e3, 10e3], 20)?, Cells::new([0.0, 10e3], 10)?);
    /// let plane = PlaneFault::half_space(cells, 90.0, rock, 0.25)?.with_rake(180.0)?;
    /// let point = |i: i32, j: i32| {
    ///     let north = 1e3 * f64::from(i) - 10e3;
    ///     [5e3 + 1e-5 * north * north, north, -1e3 * f64::from(j)]
    /// };
    /// let points: Vec<_> = (0..=10).flat_map(|j| (0..=20).map(move |i| point(i, j))).collect();
    /// let corners = (0..10).flat_map(|j| (0..20).map(move |i| 21 * j + i));
    /// let triangles: Vec<_> = corners.flat_map(|k| [[k, k + 1, k + 22], [k, k + 22, k + 21]]).collect();
    /// let surface = SurfaceFault::half_space(Triangles::new(&points, &triangles)?, rock, 0.25)?;
    /// let system = FaultSystem::new([(plane, Placement { strike: 0.0, origin: [0.0, 0.0] })])?
    ///     .with_surface(surface.with_rake(180.0)?)?;
    /// // Slip on the plane changes the stress on the surface.
    /// let mut slip = vec![Vector1::new(0.0); system.vertex_count()];
    /// slip[system.vertices(0)].fill(Vector1::new(1.0));
    /// let beside = system.vertices_of_surface().start + 200;
    /// assert!(system.stiffness().product_at(beside, &slip)[0] != 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`SurfaceError`] for a second surface, a surface in a whole space or in other rock, triangles that cross or cover a plane,
    /// or whose centroids are nearer to its cells than a tenth of the smaller of both, and likewise centres of its cells
    /// to triangles, and for interactions beyond the limit of memory.
    pub fn with_surface(mut self, surface: SurfaceFault<C>) -> Result<Self, SurfaceError> {
        if self.surface.is_some() {
            let what = "number of surfaces in a system (one may have several sheets)";
            return Err(KernelError::new(what, "at most", 2.0).bound(1.0).into());
        }
        if !surface.has_surface() {
            let what = "number of free surfaces of triangles beside planes";
            return Err(KernelError::new(what, "at least", 0.0).bound(1.0).into());
        }
        let (medium, poisson_ratio) = surface.rock();
        for (what, value, expected) in [
            (
                "shear modulus of triangles beside planes",
                medium.shear_modulus,
                self.planes[0].rock.shear_modulus,
            ),
            (
                "shear wave speed of triangles beside planes",
                medium.shear_wave_speed,
                self.planes[0].rock.shear_wave_speed,
            ),
            (
                "Poisson's ratio of triangles beside planes",
                poisson_ratio,
                self.planes[0].poisson_ratio,
            ),
        ] {
            if value != expected {
                let error = KernelError::new(what, "that of the planes,", value);
                return Err(error.bound(expected).into());
            }
        }
        for plane in 0..self.planes.len() {
            self.check_apart(plane, surface.cells())?;
        }
        between::check(&self, &surface)?;
        self.surface = Some(surface);
        self.between = Arc::default();
        Ok(self)
    }

    /// Refuses triangles that meet a plane, as two triangles of each of its cells.
    fn check_apart(&self, plane: usize, triangles: &Triangles) -> Result<(), SurfaceError> {
        let (axes, cells) = (self.axes(plane), self.cells(plane));
        let (along, down) = (cells.along_strike(), cells.down_dip());
        let ends = |cells: &crate::Cells| {
            let ([begin, end], count) = (cells.ends(), cells.count());
            let share = (end - begin) / count as f64;
            (0..=count).map(move |k| begin + share * k as f64)
        };
        let mut points = triangles.points().to_vec();
        let mut corners = triangles.triangles().to_vec();
        let (first, width) = (points.len(), along.count() + 1);
        for y in ends(down) {
            points.extend(ends(along).map(|x| <[f64; 3]>::from(axes.point([x, y]))));
        }
        let of_surface = corners.len();
        for row in 0..down.count() {
            for column in 0..along.count() {
                let a = first + row * width + column;
                corners.extend([[a, a + 1, a + width + 1], [a, a + width + 1, a + width]]);
            }
        }
        let Err(error) = Triangles::new(&points, &corners) else {
            return Ok(());
        };
        let pair = match error {
            SurfaceError::Crossing { triangles, .. }
            | SurfaceError::TooNear { triangles, .. }
            | SurfaceError::Duplicate { triangles } => triangles,
            // Orientations, and sheets of both.
            _ => return Ok(()),
        };
        let [triangle, other] = [pair[0].min(pair[1]), pair[0].max(pair[1])];
        if triangle >= of_surface || other < of_surface {
            return Ok(());
        }
        Err(SurfaceError::NearPlane {
            triangle,
            plane,
            cell: (other - of_surface) / 2,
        })
    }

    /// The surface of triangles beside the planes, if there is one.
    pub fn surface(&self) -> Option<&SurfaceFault<C>> {
        self.surface.as_ref()
    }

    /// The vertices of the cells of the surface, behind those of the planes; none without a surface.
    pub fn vertices_of_surface(&self) -> std::ops::Range<usize> {
        self.vertices_of_planes()..self.vertex_count()
    }

    /// The number of cells of all planes.
    pub(super) fn vertices_of_planes(&self) -> usize {
        self.ranges.last().map_or(0, |plane| plane.end)
    }

    /// The cells of the surface whose centroids \[m\] are inside, as a contact of the system.
    ///
    /// # Errors
    /// [`KernelError`] if no centroid is inside, and without a surface.
    pub fn section_of_surface(
        &self,
        inside: impl FnMut([f64; 3]) -> bool,
    ) -> Result<SurfaceSection, KernelError> {
        let Some(surface) = &self.surface else {
            let what = "number of surfaces in a system";
            return Err(KernelError::new(what, "at least", 0.0).bound(1.0));
        };
        let section = surface.section(inside)?;
        Ok(section.within(self.vertices_of_planes(), self.identity()))
    }

    /// The parts of a vector along the directions of slip of all cells, those of planes first: of one plate velocity [m/s], the
    /// rates that [`back_slip`](Self::back_slip) takes.
    pub fn along(&self, vector: [f64; 3]) -> Vec<SVector<f64, C>> {
        let planes = self.planes.iter().enumerate();
        let mut rates: Vec<_> = planes
            .flat_map(|(number, plane)| {
                let axes = self.axes(number);
                let part = |axis: Vector3<f64>| axis.dot(&Vector3::from(vector));
                let rate = plane
                    .directions()
                    .map(|[strike, dip]| part(axes.strike) * strike + part(axes.up_dip) * dip);
                vec![SVector::from(rate); plane.cells().count()]
            })
            .collect();
        if let Some(surface) = &self.surface {
            rates.extend(surface.along(vector));
        }
        rates
    }
}
