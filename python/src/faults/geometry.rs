//! A planar fault: cells, rock, and the operators of its motion.

use stickslip::bie::{
    Cells, DippingFault, Fault, FaultCells, FaultGeometry, FaultSystem, Mode, PlaneFault,
    Rectangles, SegmentFault, SurfaceFault,
};
use stickslip::integrate::Stepper;
use stickslip::nalgebra::Vector2;
use stickslip::{Operator, RungeKutta, Scene, SceneError};

use super::friction::CellFriction;
use super::loading::Loading;
use super::per_cell::Layout;
use crate::fields::{Cells as FieldCells, Ground};

/// A fault.
#[derive(Clone)]
pub(super) enum Geometry {
    /// A line in antiplane or plane strain.
    Line(Fault),
    /// A dipping line below a free surface.
    Dipping(DippingFault),
    /// A plane with a fixed rake.
    Plane(PlaneFault<1>),
    /// A plane with two components of slip.
    Free(PlaneFault<2>),
    /// Several planes with fixed rakes.
    Planes(FaultSystem<1>),
    /// Several planes with two components of slip.
    FreePlanes(FaultSystem<2>),
    /// Polylines.
    Segments(SegmentFault),
    /// Triangles with given rakes.
    Surface(SurfaceFault<1>),
    /// Triangles with two components of slip.
    FreeSurface(SurfaceFault<2>),
}

/// A motion, or the reason why there is none.
pub(super) type Built<const C: usize> = Result<Box<dyn Stepper<C>>, SceneError>;

impl Geometry {
    /// The number of cells.
    pub(super) fn count(&self) -> usize {
        match self {
            Self::Line(fault) => fault.cells().count(),
            Self::Dipping(fault) => fault.cells().count(),
            Self::Plane(fault) => fault.cells().count(),
            Self::Free(fault) => fault.cells().count(),
            Self::Planes(system) => system.vertex_count(),
            Self::FreePlanes(system) => system.vertex_count(),
            Self::Segments(fault) => fault.cells().count(),
            Self::Surface(fault) => fault.cells().count(),
            Self::FreeSurface(fault) => fault.cells().count(),
        }
    }

    /// The number of cells, and those of a plane down dip and along strike.
    fn layout(&self) -> Layout {
        let shape = match self {
            Self::Line(_) | Self::Dipping(_) => None,
            Self::Planes(_) | Self::FreePlanes(_) => None,
            Self::Segments(_) | Self::Surface(_) | Self::FreeSurface(_) => None,
            Self::Plane(fault) => Some(fault.cells()),
            Self::Free(fault) => Some(fault.cells()),
        };
        Layout {
            count: self.count(),
            shape: shape.map(|cells| [cells.down_dip().count(), cells.along_strike().count()]),
        }
    }

    /// The cells as fields need them.
    pub(super) fn cells(&self) -> FieldCells {
        let plane = |cells: &Rectangles| {
            let axes = [cells.along_strike(), cells.down_dip()];
            (axes.map(Cells::ends), axes.map(Cells::count))
        };
        let line = |cells: &Cells| Ground::Line(cells.ends(), cells.count());
        FieldCells {
            ground: match self {
                Self::Line(fault) => line(fault.cells()),
                Self::Dipping(fault) => line(fault.cells()),
                Self::Plane(fault) => Ground::Plane(plane(fault.cells())),
                Self::Free(fault) => Ground::Plane(plane(fault.cells())),
                Self::Planes(system) => {
                    let planes = system.planes().iter();
                    Ground::Planes(planes.map(|fault| plane(fault.cells())).collect())
                }
                Self::FreePlanes(system) => {
                    let planes = system.planes().iter();
                    Ground::Planes(planes.map(|fault| plane(fault.cells())).collect())
                }
                Self::Segments(_) => Ground::Apart("segments"),
                Self::Surface(_) | Self::FreeSurface(_) => Ground::Apart("triangles"),
            },
            layout: self.layout(),
        }
    }

    /// The centres of cells \[m\]: positions on a line and 0, x and z, or along strike and down dip.
    pub(super) fn centers(&self) -> Vec<Vector2<f64>> {
        let line = |cells: &Cells| cells.map(|x| Vector2::new(x, 0.0));
        match self {
            Self::Line(fault) => line(fault.cells()),
            Self::Dipping(fault) => line(fault.cells()),
            Self::Plane(fault) => fault.cells().map(Vector2::from),
            Self::Free(fault) => fault.cells().map(Vector2::from),
            Self::Segments(fault) => fault.cells().map(Vector2::from),
            // Those are in space.
            Self::Planes(_) | Self::FreePlanes(_) | Self::Surface(_) | Self::FreeSurface(_) => {
                Vec::new()
            }
        }
    }

    /// The directions of the components of slip on a plane, along strike and up dip.
    pub(super) fn directions(&self) -> Vec<[f64; 2]> {
        match self {
            Self::Line(_) | Self::Dipping(_) | Self::Segments(_) | Self::Surface(_) => {
                vec![[1.0, 0.0]]
            }
            Self::FreeSurface(_) => vec![[1.0, 0.0], [0.0, 1.0]],
            Self::Plane(fault) => fault.directions().to_vec(),
            Self::Free(fault) => fault.directions().to_vec(),
            Self::Planes(system) => of_first(system.planes()),
            Self::FreePlanes(system) => of_first(system.planes()),
        }
    }
}

/// The directions of slip of the first of several planes.
fn of_first<const C: usize>(planes: &[PlaneFault<C>]) -> Vec<[f64; 2]> {
    let first = planes.first();
    first.map_or(Vec::new(), |plane| plane.directions().to_vec())
}

/// The motion of several planes.
pub(super) fn system<const C: usize>(
    system: &FaultSystem<C>,
    loading: Loading<C>,
    friction: CellFriction<C>,
) -> Built<C> {
    let scene = Scene::new(system.stiffness())
        .with_viscosity(system.radiation_damping())
        .with_load_history(system.back_slip(&loading.plate_rate)?)
        .with_normal_stress_change(system.normal_stiffness(), loading.plate_rate.clone());
    moving(scene, loading, friction, FaultGeometry::cells(system))
}

/// The motion of polylines.
pub(super) fn segments(
    fault: &SegmentFault,
    loading: Loading<1>,
    friction: CellFriction<1>,
) -> Built<1> {
    let mut scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_load_history(fault.back_slip(&loading.plate_rate)?);
    if fault.mode() != Mode::Antiplane {
        let change = fault.normal_stiffness();
        scene = scene.with_normal_stress_change(change, loading.plate_rate.clone());
    }
    moving(scene, loading, friction, FaultGeometry::cells(fault))
}

/// That of triangles.
pub(super) fn surface<const C: usize>(
    fault: &SurfaceFault<C>,
    loading: Loading<C>,
    friction: CellFriction<C>,
) -> Built<C> {
    let mut scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_load_history(fault.back_slip(&loading.plate_rate)?);
    let change = fault.normal_stiffness();
    if !change.is_zero() {
        scene = scene.with_normal_stress_change(change, loading.plate_rate.clone());
    }
    moving(scene, loading, friction, FaultGeometry::cells(fault))
}

/// The motion of a line by an explicit Runge-Kutta method.
pub(super) fn line(fault: &Fault, loading: Loading<1>, friction: CellFriction<1>) -> Built<1> {
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_load_history(fault.back_slip(&loading.plate_rate)?);
    moving(scene, loading, friction, FaultGeometry::cells(fault))
}

/// That of a dipping line.
pub(super) fn dipping(
    fault: &DippingFault,
    loading: Loading<1>,
    friction: CellFriction<1>,
) -> Built<1> {
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_load_history(fault.back_slip(&loading.plate_rate)?)
        .with_normal_stress_change(fault.normal_stiffness(), loading.plate_rate.clone());
    moving(scene, loading, friction, FaultGeometry::cells(fault))
}

/// That of a plane.
pub(super) fn plane<const C: usize>(
    fault: &PlaneFault<C>,
    loading: Loading<C>,
    friction: CellFriction<C>,
) -> Built<C> {
    let mut scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_load_history(fault.back_slip(&loading.plate_rate)?);
    let change = fault.normal_stiffness();
    if !change.is_zero() {
        scene = scene.with_normal_stress_change(change, loading.plate_rate.clone());
    }
    moving(scene, loading, friction, FaultGeometry::cells(fault))
}

/// Adds loads, friction and initial rates on these cells.
fn moving<Op: Operator<C> + 'static, const C: usize>(
    scene: Scene<Op, C>,
    loading: Loading<C>,
    friction: CellFriction<C>,
    cells: FaultCells,
) -> Built<C> {
    let scene = friction.on(loading.on(scene, &cells.areas), cells.into());
    Ok(Box::new(RungeKutta::new(scene)?))
}
