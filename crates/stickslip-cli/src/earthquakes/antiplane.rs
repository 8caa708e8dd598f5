//! An antiplane fault by boundary integrals: its scene, and its motion with a method.

use super::line::EVENT;
use super::off_fault::{OWN, Plan};
use super::{Arguments, Method};
use crate::cli;
use stickslip::bie::{Fault, OffFault};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::integrate::Stepper;
use stickslip::nalgebra::{DMatrix, Vector1};
use stickslip::problems::bp1::PLATE_RATE;
use stickslip::state::{Dieterich, LogTheta, StateLaw};
use stickslip::{Contact, DenseNewton, Operator, RungeKutta, Scene, Sdirk2, Simulation};

pub(super) type Friction<const C: usize = 1> = Contact<RegularizedDieterichRuina, Dieterich, C>;

/// The scene: the fault starts with a uniform slip rate, and creeps at a constant rate beyond its cells.
fn scene<Op: Operator<1>, S: StateLaw<State = LogTheta> + 'static>(
    (fault, [stiffness, damping]): (&Fault, [Op; 2]),
    (friction, [start, beyond]): (Contact<RegularizedDieterichRuina, S, 1>, [f64; 2]),
) -> Scene<Op, 1> {
    Scene::new(stiffness)
        .with_viscosity(damping)
        .with_contact(friction)
        .with_load_history(fault.plate_loading(beyond))
        .with_velocity(fault.cells().map(|_| Vector1::new(start)))
}

/// What is off the fault.
pub(super) fn off_fault(fault: &Fault) -> Result<Plan<1>, cli::Problem> {
    Ok(Plan {
        sources: fault.sources()?,
        plate: Some(Vector1::new(PLATE_RATE)),
        stations: Vec::new(),
        axes: OWN,
        event: EVENT,
        extent: None,
    })
}

/// The motion of an antiplane fault with the requested method, from a slip rate on its cells and with another one
/// beyond [m/s].
pub(super) fn antiplane<S: StateLaw<State = LogTheta> + 'static>(
    arguments: &Arguments,
    fault: &Fault,
    friction: Contact<RegularizedDieterichRuina, S, 1>,
    rates: [f64; 2],
) -> Result<Box<dyn Stepper<1>>, cli::Problem> {
    let operators = [fault.stiffness(), fault.radiation_damping()];
    let contact = (friction, rates);
    Ok(match arguments.method {
        Method::RungeKutta => Box::new(RungeKutta::new(scene((fault, operators), contact))?),
        Method::Implicit => {
            let scene = scene((fault, operators.each_ref().map(DMatrix::from)), contact);
            Box::new(Simulation::new(scene, Sdirk2, DenseNewton::new())?)
        }
    })
}
