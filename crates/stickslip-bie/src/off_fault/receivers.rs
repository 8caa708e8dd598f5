//! Displacement and stress at points off a fault.

use nalgebra::{Matrix3, SVector};

use super::{OffFault, ReceiverError, Sources};
use crate::KernelError;

/// The default limit of the memory of the matrix: 2 GiB.
const MEMORY: usize = 2 << 30;

/// Points off a fault, at which slip on its cells causes displacement and stress: geodetic stations, a grid of the surface,
/// another fault.
///
/// ```text
/// u(x, t) = sum over cells and components, G(x) D(t)        v(x, t) = sum, G(x) V(t)
/// ```
///
/// The matrix `G` of receivers and cells is made once, with 24 bytes per receiver, cell and component; a time costs one
/// product. Displacements `[x, y, z]` are those of a **quasi-dynamic** fault: elastic equilibrium at each instant, without
/// seismic waves. Receivers may be at the free surface, inside, and right beside the fault, where the displacement jumps by
/// the slip.
///
/// | fault | axes of points and displacements |
/// | --- | --- |
/// | [`Fault`](crate::Fault) | `x` across the fault, which is at `x = 0`; its positions are `-z`; slip of the side `x > 0` along `y`, or up in plane strain |
/// | [`DippingFault`](crate::DippingFault) | `x` horizontal from the trace towards the hanging wall, `z` up |
/// | [`SegmentFault`](crate::SegmentFault) | `x`, `z` of its points |
/// | [`PlaneFault`](crate::PlaneFault) | `x` along strike, `y` horizontal to the left of it, `z` up; in a whole space `y` up dip, `z` into the hanging wall |
/// | [`FaultSystem`](crate::FaultSystem), [`SurfaceFault`](crate::SurfaceFault) | east, north, up |
///
/// Faults along lines are the same at any `y`.
///
/// # What moves beyond the cells
///
/// Displacement is that of slip on the cells, zero far away. A fault that creeps beyond its cells, as
/// [plate loading](crate::Fault::plate_loading) says, moves the ground, too: [`creep`](Self::creep) adds the displacement of
/// all the rest of its plane, so that both sides move by one half of it far away, as in the benchmarks of SEAS.
///
/// ```
/// use nalgebra::Vector1;
/// use stickslip_bie::{Cells, Fault, Medium, Receivers};
///
/// // Locked to 15 km, and below creeping: u = (D/pi) atan(x/d).
/// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
/// let fault = Fault::half_space(Cells::new([0.0, 15e3], 150)?, rock)?;
/// let stations = Receivers::new(&fault, &[[10e3, 0.0, 0.0], [-10e3, 0.0, 0.0]])?;
/// let still = stations.displacement(&vec![Vector1::new(0.0); 150])?;
/// let moved = stations.creep(Vector1::new(2.0))?;
/// let exact = 2.0 / std::f64::consts::PI * (10.0_f64 / 15.0).atan();
/// assert_eq!(still[0][1], 0.0);
/// assert!((moved[0][1] - exact).abs() < 1e-12 && (moved[1][1] + exact).abs() < 1e-12);
/// # Ok::<(), stickslip_bie::ReceiverError>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias(
    "surface displacement",
    "geodesy",
    "GNSS",
    "InSAR",
    "station",
    "Green function",
    "Coulomb stress"
))]
pub struct Receivers<const C: usize> {
    points: Vec<[f64; 3]>,
    sources: Sources<C>,
    /// Of each receiver, component of displacement, cell and component of slip.
    matrix: Vec<f64>,
}

impl<const C: usize> Receivers<C> {
    /// At points `[x, y, z]` \[m\] off a fault.
    ///
    /// # Errors
    /// [`ReceiverError`] for a point that is not finite, above the free surface or on an edge of a cell, a periodic fault,
    /// and a matrix beyond 2 GiB.
    pub fn new(fault: &impl OffFault<C>, points: &[[f64; 3]]) -> Result<Self, ReceiverError> {
        Self::of_sources(fault.sources()?, points)
    }

    /// [`new`](Self::new) for sources.
    ///
    /// # Errors
    /// See [`new`](Self::new).
    pub fn of_sources(sources: Sources<C>, points: &[[f64; 3]]) -> Result<Self, ReceiverError> {
        Self::within(MEMORY, sources, points)
    }

    /// [`of_sources`](Self::of_sources) with a limit of so many bytes for the matrix.
    ///
    /// # Errors
    /// See [`new`](Self::new).
    pub fn within(
        limit: usize,
        sources: Sources<C>,
        points: &[[f64; 3]],
    ) -> Result<Self, ReceiverError> {
        let (receivers, cells) = (points.len(), sources.count());
        let bytes = (3 * C * size_of::<f64>()) as f64 * receivers as f64 * cells as f64;
        if bytes > limit as f64 {
            return Err(ReceiverError::Memory {
                receivers,
                cells,
                bytes,
                limit: limit as f64,
            });
        }
        let mut matrix = vec![0.0; 3 * C * receivers * cells];
        for (receiver, &point) in points.iter().enumerate() {
            sources.check(receiver, point)?;
            let begin = 3 * receiver * cells * C;
            for cell in 0..cells {
                for (c, moved) in sources.displacements(cell, point).into_iter().enumerate() {
                    for (axis, moved) in moved.into_iter().enumerate() {
                        matrix[begin + axis * cells * C + cell * C + c] = moved;
                    }
                }
            }
        }
        Ok(Self {
            points: points.to_vec(),
            sources,
            matrix,
        })
    }

    /// The points \[m\].
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// The number of cells.
    pub fn cell_count(&self) -> usize {
        self.sources.count()
    }

    /// The memory of the matrix \[bytes\].
    pub fn memory(&self) -> usize {
        size_of_val(&self.matrix[..])
    }

    /// The displacement \[m\] of each receiver due to slip on the cells \[m\]; velocity due to slip rates.
    ///
    /// # Errors
    /// [`ReceiverError::Value`] for another number of slips than cells.
    pub fn displacement(&self, slip: &[SVector<f64, C>]) -> Result<Vec<[f64; 3]>, ReceiverError> {
        self.check_slips(slip)?;
        // No cells, no displacement.
        let row = (self.sources.count() * C).max(1);
        let sum = |row: &[f64]| {
            let terms = row.chunks_exact(C).zip(slip);
            terms
                .map(|(g, d)| d.iter().zip(g).map(|(d, g)| d * g).sum::<f64>())
                .sum::<f64>()
        };
        let mut sums = self.matrix.chunks_exact(row).map(sum);
        let mut next = || sums.next().unwrap_or(0.0);
        Ok(self
            .points
            .iter()
            .map(|_| [next(), next(), next()])
            .collect())
    }

    /// The stress tensor \[Pa\] at each receiver due to slip on the cells \[m\], tension positive. It is computed anew each
    /// time.
    ///
    /// # Errors
    /// [`ReceiverError::Value`] for another number of slips than cells.
    pub fn stress(&self, slip: &[SVector<f64, C>]) -> Result<Vec<Matrix3<f64>>, ReceiverError> {
        self.check_slips(slip)?;
        let of_point = |&point: &[f64; 3]| {
            let mut sum = Matrix3::zeros();
            for (cell, slip) in slip.iter().enumerate() {
                let stresses = self.sources.stresses(cell, point);
                for (stress, slip) in stresses.iter().zip(slip.iter()) {
                    sum += stress * *slip;
                }
            }
            sum
        };
        Ok(self.points.iter().map(of_point).collect())
    }

    /// The displacement \[m\] of each receiver due to slip of the fault's plane everywhere but on its cells, by the same slip
    /// \[m\]: plate loading at the rate `V_p` until the time `t` slips by `V_p t`. A receiver on the plane itself, beyond the
    /// cells, is on the side that slip moves.
    ///
    /// Slip of a whole plane moves both sides by one half of it, as rigid bodies, in a whole space and, if the plane reaches
    /// the free surface, in a half space: creep beyond the cells is this less slip of the cells.
    ///
    /// # Errors
    /// [`ReceiverError::NoPlane`] for a fault that is not one plane or straight line, [`ReceiverError::Value`] for slip that is
    /// not finite.
    #[doc(alias("deep creep", "interseismic", "plate rate"))]
    pub fn creep(&self, slip: SVector<f64, C>) -> Result<Vec<[f64; 3]>, ReceiverError> {
        if let Some(&value) = slip.iter().find(|value| !value.is_finite()) {
            return Err(KernelError::new("slip [m] beyond the cells", "finite", value).into());
        }
        let mut moved = self.displacement(&vec![-slip; self.sources.count()])?;
        for (moved, &point) in moved.iter_mut().zip(&self.points) {
            let plane = self.sources.displacements_of_plane(point);
            let plane = plane.ok_or(ReceiverError::NoPlane)?;
            for (unit, slip) in plane.iter().zip(slip.iter()) {
                for (moved, unit) in moved.iter_mut().zip(unit) {
                    *moved += unit * slip;
                }
            }
        }
        Ok(moved)
    }

    fn check_slips(&self, slip: &[SVector<f64, C>]) -> Result<(), KernelError> {
        let count = self.sources.count();
        if slip.len() == count {
            return Ok(());
        }
        let (what, requirement) = ("number of slips", "that of the cells,");
        Err(KernelError::new(what, requirement, slip.len() as f64).bound(count as f64))
    }
}
