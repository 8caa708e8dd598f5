//! A planar fault: cells, rock, and the operators of its motion.

use stickslip::bie::{Cells, DippingFault, Fault, PlaneFault};
use stickslip::integrate::Stepper;
use stickslip::nalgebra::{Vector1, Vector2};
use stickslip::{BoundaryPart, Operator, RungeKutta, Scene, SceneError};

use super::friction::CellFriction;
use super::function::CellFunction;

/// A fault with one component of slip.
#[derive(Clone)]
pub(super) enum Geometry {
    /// A line in antiplane or plane strain.
    Line(Fault),
    /// A dipping line below a free surface.
    Dipping(DippingFault),
    /// A plane with a fixed rake.
    Plane(PlaneFault<1>),
}

/// The loading of a fault, and its initial slip rates.
pub(super) struct Loading {
    /// Of the plates beyond the fault, or of back slip on each cell [m/s].
    pub(super) plate_rate: Vec<Vector1<f64>>,
    /// Of shear stress on each cell [Pa/s].
    pub(super) stress_rate: Option<Vec<f64>>,
    /// Shear stress that adds to all others \[Pa\].
    pub(super) overstress: Option<CellFunction>,
    /// At time 0 [m/s]; that in balance with stress and state if there is none.
    pub(super) slip_rate: Option<Vec<f64>>,
}

impl Geometry {
    /// The number of cells.
    pub(super) fn count(&self) -> usize {
        match self {
            Self::Line(fault) => fault.cells().count(),
            Self::Dipping(fault) => fault.cells().count(),
            Self::Plane(fault) => fault.cells().count(),
        }
    }

    /// The centres of cells \[m\]: positions on a line and 0, or along strike and down dip.
    pub(super) fn centers(&self) -> Vec<Vector2<f64>> {
        let line = |cells: &Cells| cells.map(|x| Vector2::new(x, 0.0));
        match self {
            Self::Line(fault) => line(fault.cells()),
            Self::Dipping(fault) => line(fault.cells()),
            Self::Plane(fault) => fault.cells().map(Vector2::from),
        }
    }

    /// The direction of positive slip on a plane, along strike and up dip.
    pub(super) fn direction(&self) -> [f64; 2] {
        match self {
            Self::Line(_) | Self::Dipping(_) => [1.0, 0.0],
            Self::Plane(fault) => fault.directions()[0],
        }
    }

    /// Its motion by an explicit Runge-Kutta method.
    pub(super) fn stepper(
        &self,
        loading: Loading,
        friction: CellFriction,
    ) -> Result<Box<dyn Stepper<1>>, SceneError> {
        let plate = loading.plate_rate.clone();
        match self {
            Self::Line(fault) => {
                let scene = Scene::new(fault.stiffness())
                    .with_viscosity(fault.radiation_damping())
                    .with_load_history(fault.back_slip(&plate)?);
                let (part, size) = (fault.into(), fault.cells().length());
                moving(scene, loading, friction, (part, size))
            }
            Self::Dipping(fault) => {
                let scene = Scene::new(fault.stiffness())
                    .with_viscosity(fault.radiation_damping())
                    .with_load_history(fault.back_slip(&plate)?)
                    .with_normal_stress_change(fault.normal_stiffness(), plate);
                let (part, size) = (fault.into(), fault.cells().length());
                moving(scene, loading, friction, (part, size))
            }
            Self::Plane(fault) => {
                let mut scene = Scene::new(fault.stiffness())
                    .with_viscosity(fault.radiation_damping())
                    .with_load_history(fault.back_slip(&plate)?);
                let change = fault.normal_stiffness();
                if !change.is_zero() {
                    scene = scene.with_normal_stress_change(change, plate);
                }
                let (part, size) = (fault.into(), fault.cells().area());
                moving(scene, loading, friction, (part, size))
            }
        }
    }
}

/// Adds stress rates, friction and initial rates on cells of this size [m] or [m^2].
fn moving<Op: Operator<1> + 'static>(
    mut scene: Scene<Op, 1>,
    loading: Loading,
    friction: CellFriction,
    (part, size): (BoundaryPart, f64),
) -> Result<Box<dyn Stepper<1>>, SceneError> {
    if let Some(rates) = loading.stress_rate {
        scene = scene.with_load_history(move |time, load| {
            for (load, rate) in load.iter_mut().zip(&rates) {
                load[0] += size * rate * time;
            }
        });
    }
    if let Some(overstress) = loading.overstress {
        scene = scene.with_load_history(move |time, load| {
            let stresses = overstress.at(time, load.len());
            for (load, stress) in load.iter_mut().zip(stresses) {
                load[0] += size * stress;
            }
        });
    }
    let scene = friction.on(scene, part);
    let scene = match loading.slip_rate {
        Some(rates) => scene.with_velocity(rates.into_iter().map(Vector1::new).collect()),
        None => scene.with_balanced_rates(),
    };
    Ok(Box::new(RungeKutta::new(scene)?))
}
