//! Earthquake cycles and fluid-driven creep: the benchmark problems BP1-QD to BP5-QD, BP6-QD-A and BP7-QD-A.
//!
//! Planar faults by boundary integrals: the rock around them acts by its kernel, and its waves by radiation damping.
//! Displacements are slip across the fault, as published. `-- --problem bp6` is the injection.
//!
//! Parameters: B. Erickson et al., Seismol. Res. Lett. 91 (2020), and the descriptions of these SEAS benchmarks.

use super::{Arguments, Method, Problem, bp1, bp2, bp3, bp4, bp5, bp6, bp7};
use crate::cli;
use stickslip::bie::{Fault, KernelError};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::integrate::Stepper;
use stickslip::nalgebra::{DMatrix, Vector1};
use stickslip::state::Dieterich;
use stickslip::{Contact, DenseNewton, Operator, RungeKutta, Scene, Sdirk2, Simulation};

pub(super) type Friction<const C: usize = 1> = Contact<RegularizedDieterichRuina, Dieterich, C>;

/// The scene: the fault starts with a uniform slip rate, and creeps at a constant rate beyond its cells.
fn scene<Op: Operator<1>>(
    (fault, [stiffness, damping]): (&Fault, [Op; 2]),
    (friction, [start, beyond]): (Friction, [f64; 2]),
) -> Result<Scene<Op, 1>, KernelError> {
    Ok(Scene::new(stiffness)
        .with_viscosity(damping)
        .with_contact(friction)
        .with_load_history(fault.plate_loading(beyond)?)
        .with_velocity(fault.cells().map(|_| Vector1::new(start))))
}

/// The motion of an antiplane fault with the requested method, from a slip rate on its cells and with another one
/// beyond [m/s].
pub(super) fn antiplane(
    arguments: &Arguments,
    fault: &Fault,
    friction: Friction,
    rates: [f64; 2],
) -> Result<Box<dyn Stepper<1>>, cli::Problem> {
    let operators = [fault.stiffness(), fault.radiation_damping()];
    let contact = (friction, rates);
    Ok(match arguments.method {
        Method::RungeKutta => Box::new(RungeKutta::new(scene((fault, operators), contact)?)?),
        Method::Implicit => {
            let scene = scene((fault, operators.each_ref().map(DMatrix::from)), contact)?;
            Box::new(Simulation::new(scene, Sdirk2, DenseNewton::new())?)
        }
    })
}

/// Earthquake cycles and injection on a planar fault by boundary integrals.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be written, and results that differ from the published
/// ones where they should agree.
pub fn run(arguments: &Arguments) -> Result<(), cli::Problem> {
    arguments.check()?;
    match arguments.problem {
        Problem::Bp1 => bp1::run(arguments),
        Problem::Bp2 => bp2::run(arguments),
        Problem::Bp3 => bp3::run(arguments),
        Problem::Bp4 => bp4::run(arguments),
        Problem::Bp5 => bp5::run(arguments),
        Problem::Bp6 => bp6::run(arguments),
        Problem::Bp7 => bp7::run(arguments),
    }
}
