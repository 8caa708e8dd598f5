//! Faults as scenes see them.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_solvers::{MeshId, NormalStressChange, Operator};

use crate::loading::{PLATE_RATES, check_rates, relieving};
use crate::{
    CellKernel, DippingFault, DippingKernel, Fault, FaultSystem, Kernel, KernelError, PlaneFault,
    PlaneKernel, Rectangles, SegmentFault, SurfaceFault, SystemKernel,
};

/// The cells of a fault, each a vertex of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct FaultCells {
    /// The centres \[m\]: along a line, along strike and down dip of a plane, `x` and `z` of segments, or east, north and up
    /// in space.
    pub centers: Vec<[f64; 3]>,
    /// The areas [m^2], per metre of thickness along a line \[m\].
    pub areas: Vec<f64>,
    /// The number of coordinates of a centre that count, 1 to 3.
    pub dimension: usize,
    /// The identity of the cells; parts and matrices of others are refused. `None` if unknown.
    pub identity: Option<MeshId>,
}

/// A load history: it adds the forces on all cells \[N\] at a time \[s\].
pub type LoadHistory<const C: usize> = Box<dyn Fn(f64, &mut [SVector<f64, C>]) + Send + Sync>;

/// A fault by boundary integrals with `C` components of slip: what a scene of it consists of.
///
/// Implement cells, stiffness and radiation damping. Override the change of the normal stress for a fault whose slip
/// changes it, and the plate loading if back slip of all cells is not what loads it. [`Fault`], [`DippingFault`],
/// [`SegmentFault`], [`PlaneFault`], [`FaultSystem`] and [`SurfaceFault`] are such faults.
///
/// ```
/// use nalgebra::{DMatrix, Vector1};
/// use stickslip_bie::{FaultCells, FaultGeometry};
///
/// /// Cells of 1 m on springs to the ground, and to each other.
/// struct Springs {
///     count: usize,
///     own: f64,
///     between: f64,
///     damping: f64,
/// }
///
/// impl FaultGeometry<1> for Springs {
///     type Kernel = DMatrix<f64>;
///
///     fn cells(&self) -> FaultCells {
///         FaultCells {
///             centers: (0..self.count).map(|k| [k as f64, 0.0, 0.0]).collect(),
///             areas: vec![1.0; self.count],
///             dimension: 1,
///             identity: None,
///         }
///     }
///
///     fn stiffness(&self) -> DMatrix<f64> {
///         DMatrix::from_fn(self.count, self.count, |i, j| match i.abs_diff(j) {
///             0 => self.own + 2.0 * self.between,
///             1 => -self.between,
///             _ => 0.0,
///         })
///     }
///
///     fn radiation_damping(&self) -> DMatrix<f64> {
///         DMatrix::from_diagonal_element(self.count, self.count, self.damping)
///     }
/// }
///
/// let springs = Springs { count: 3, own: 2.0, between: 1.0, damping: 0.1 };
/// let mut load = vec![Vector1::new(0.0); 3];
/// springs.plate_loading(Vector1::new(1e-9))?(1.0, &mut load);
/// // The ends have one neighbour: the other spring is fixed.
/// assert!((load[1][0] - 2e-9).abs() < 1e-20 && (load[0][0] - 3e-9).abs() < 1e-20);
/// # Ok::<(), stickslip_bie::KernelError>(())
/// ```
#[doc(alias("boundary element", "fault kernel"))]
pub trait FaultGeometry<const C: usize> {
    /// The format of its matrices.
    type Kernel: Operator<C>;

    /// The cells.
    fn cells(&self) -> FaultCells;

    /// The stiffness matrix [N/m]: forces on cells that resist their slip.
    fn stiffness(&self) -> Self::Kernel;

    /// The radiation damping as a viscosity matrix, block diagonal [N s/m].
    fn radiation_damping(&self) -> Self::Kernel;

    /// The change of normal stress per slip [Pa/m], compression positive; `None`, as by default, if slip changes none.
    fn normal_stress_change(&self) -> Option<Arc<dyn NormalStressChange<C>>> {
        None
    }

    /// Plate loading: beyond its cells the fault creeps at a velocity [m/s], and so the cells are not stressed that do so,
    /// too. By default the force `K V_p t` of back slip.
    ///
    /// # Errors
    /// [`KernelError`] for a velocity that is not finite.
    fn plate_loading(&self, velocity: SVector<f64, C>) -> Result<LoadHistory<C>, KernelError> {
        let stiffness = self.stiffness();
        let count = stickslip_solvers::Matrix::vertex_count(&stiffness);
        let rates = vec![velocity; count];
        check_rates(count, PLATE_RATES, &rates)?;
        Ok(Box::new(relieving(&stiffness, &rates)))
    }
}

fn of_line(cells: &crate::Cells) -> FaultCells {
    FaultCells {
        centers: cells.map(|x| [x, 0.0, 0.0]),
        areas: vec![cells.length(); cells.count()],
        dimension: 1,
        identity: Some(cells.identity()),
    }
}

fn of_plane(cells: &Rectangles) -> FaultCells {
    FaultCells {
        centers: cells.map(|[x, y]| [x, y, 0.0]),
        areas: vec![cells.area(); cells.count()],
        dimension: 2,
        identity: Some(cells.identity()),
    }
}

impl FaultGeometry<1> for Fault {
    type Kernel = Kernel;

    fn cells(&self) -> FaultCells {
        of_line(self.cells())
    }

    fn stiffness(&self) -> Kernel {
        self.stiffness()
    }

    fn radiation_damping(&self) -> Kernel {
        self.radiation_damping()
    }
}

impl FaultGeometry<1> for DippingFault {
    type Kernel = DippingKernel;

    fn cells(&self) -> FaultCells {
        of_line(self.cells())
    }

    fn stiffness(&self) -> DippingKernel {
        self.stiffness()
    }

    fn radiation_damping(&self) -> DippingKernel {
        self.radiation_damping()
    }

    fn normal_stress_change(&self) -> Option<Arc<dyn NormalStressChange<1>>> {
        Some(Arc::new(self.normal_stiffness()))
    }
}

impl<const C: usize> FaultGeometry<C> for PlaneFault<C> {
    type Kernel = PlaneKernel<C>;

    fn cells(&self) -> FaultCells {
        of_plane(self.cells())
    }

    fn stiffness(&self) -> PlaneKernel<C> {
        self.stiffness()
    }

    fn radiation_damping(&self) -> PlaneKernel<C> {
        self.radiation_damping()
    }

    fn normal_stress_change(&self) -> Option<Arc<dyn NormalStressChange<C>>> {
        let change = self.normal_stiffness();
        if change.is_zero() {
            return None;
        }
        Some(Arc::new(change))
    }
}

impl<const C: usize> FaultGeometry<C> for FaultSystem<C> {
    type Kernel = SystemKernel<C>;

    fn cells(&self) -> FaultCells {
        let vertices = || 0..self.vertex_count();
        FaultCells {
            centers: vertices().map(|vertex| self.center(vertex)).collect(),
            areas: vertices().map(|vertex| self.area(vertex)).collect(),
            dimension: 3,
            identity: Some(self.identity()),
        }
    }

    fn stiffness(&self) -> SystemKernel<C> {
        self.stiffness()
    }

    fn radiation_damping(&self) -> SystemKernel<C> {
        self.radiation_damping()
    }

    fn normal_stress_change(&self) -> Option<Arc<dyn NormalStressChange<C>>> {
        Some(Arc::new(self.normal_stiffness()))
    }
}

impl FaultGeometry<1> for SegmentFault {
    type Kernel = CellKernel<1>;

    fn cells(&self) -> FaultCells {
        let cells = self.cells();
        FaultCells {
            centers: cells.map(|[x, z]| [x, z, 0.0]),
            areas: (0..cells.count()).map(|cell| cells.length(cell)).collect(),
            dimension: 2,
            identity: Some(cells.identity()),
        }
    }

    fn stiffness(&self) -> CellKernel<1> {
        self.stiffness()
    }

    fn radiation_damping(&self) -> CellKernel<1> {
        self.radiation_damping()
    }

    fn normal_stress_change(&self) -> Option<Arc<dyn NormalStressChange<1>>> {
        let change = self.normal_stiffness();
        if change.is_zero() {
            return None;
        }
        Some(Arc::new(change))
    }
}

impl<const C: usize> FaultGeometry<C> for SurfaceFault<C> {
    type Kernel = CellKernel<C>;

    fn cells(&self) -> FaultCells {
        let cells = self.cells();
        FaultCells {
            centers: cells.map(|center| center),
            areas: (0..cells.count()).map(|cell| cells.area(cell)).collect(),
            dimension: 3,
            identity: Some(cells.identity()),
        }
    }

    fn stiffness(&self) -> CellKernel<C> {
        self.stiffness()
    }

    fn radiation_damping(&self) -> CellKernel<C> {
        self.radiation_damping()
    }

    fn normal_stress_change(&self) -> Option<Arc<dyn NormalStressChange<C>>> {
        let change = self.normal_stiffness();
        if change.is_zero() {
            return None;
        }
        Some(Arc::new(change))
    }
}
