//! Earthquake cycles and fluid-driven creep: the problems BP1-QD and BP6-QD-A.
//!
//! A planar fault by boundary integrals: the rock around it acts by its kernel, and its waves by radiation damping.
//! Displacements are slip across the fault, as published. `-- --problem bp6` is the injection.
//!
//! Parameters: B. Erickson et al., Seismol. Res. Lett. 91 (2020), and the descriptions of these SEAS benchmarks.

use super::{Arguments, Method, Problem, bp6, follow};
use crate::cli;
use stickslip::bie::{Cells, Fault, Mode};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::integrate::Stepper;
use stickslip::nalgebra::{DMatrix, Vector1};
use stickslip::problems::bp1;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{Contact, DenseNewton, Operator, RungeKutta, Scene, Sdirk2, Simulation};

type Friction = Contact<RegularizedDieterichRuina, Dieterich, 1>;

/// Friction: velocity weakening down to 15 km, and velocity strengthening below (BP1). Or uniform friction with the
/// pore pressure of a fluid, injected at the middle, that diffuses along the fault and reduces the normal stress (BP6).
fn friction(problem: Problem, fault: &Fault) -> Friction {
    let cells = *fault.cells();
    match problem {
        Problem::Bp1 => bp1::contact(fault),
        Problem::Bp6 => Contact::new(fault, bp6::law(), bp6::NORMAL)
            .with_state(bp6::AGING, LogTheta(bp6::state()))
            .with_shear_stress(Vector1::new(bp6::shear()))
            .with_normal_stress_history(move |time, stress| {
                for (cell, stress) in stress.iter_mut().enumerate() {
                    *stress -= bp6::pressure(cells.center(cell), time);
                }
            }),
    }
}

/// The scene: the fault starts with a uniform slip rate, and creeps at a constant rate beyond its cells.
fn scene<Op: Operator<1>>(
    (fault, [stiffness, damping]): (&Fault, [Op; 2]),
    (friction, [start, beyond]): (Friction, [f64; 2]),
) -> Scene<Op, 1> {
    Scene::new(stiffness)
        .with_viscosity(damping)
        .with_contact(friction)
        .with_load_history(fault.plate_loading(beyond))
        .with_velocity(fault.cells().map(|_| Vector1::new(start)))
}

/// Earthquake cycles and injection on a planar fault by boundary integrals.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), cli::Problem> {
    let cells = Cells::new(arguments.ends(), arguments.count())?;
    let (fault, rates) = match arguments.problem {
        Problem::Bp1 => (Fault::half_space(cells, bp1::MEDIUM)?, [bp1::PLATE_RATE; 2]),
        Problem::Bp6 => {
            let fault = Fault::whole_space(cells, bp6::MEDIUM, Mode::Antiplane)?;
            (fault, [bp6::INITIAL_RATE, 0.0])
        }
    };
    let contact = (friction(arguments.problem, &fault), rates);
    let operators = [fault.stiffness(), fault.radiation_damping()];
    let mut motion: Box<dyn Stepper<1>> = match arguments.method {
        Method::RungeKutta => Box::new(RungeKutta::new(scene((&fault, operators), contact))?),
        Method::Implicit => {
            let scene = scene((&fault, operators.each_ref().map(DMatrix::from)), contact);
            Box::new(Simulation::new(scene, Sdirk2, DenseNewton::new())?)
        }
    };
    follow(arguments, &fault, &mut *motion)
}
