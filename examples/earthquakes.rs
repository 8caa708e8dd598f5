//! When do earthquakes come, and how far does a fluid make a fault creep? The problems BP1-QD and BP6-QD-A.
//!
//! A fault without a mesh: the rock around it acts by its kernel, and its waves by radiation damping. Displacements are
//! slip across the fault, as published.
//!
//! ```text
//! cargo run --release --example earthquakes -- --problem bp6 --method implicit --cell 50 --adaptive 1e-3
//! ```
//!
//! Parameters: B. Erickson et al., Seismol. Res. Lett. 91 (2020), and the descriptions of these SEAS benchmarks.

use std::process::ExitCode;

use stickslip::kernel::{Cells, Fault, Kernel, Mode};
use stickslip::nalgebra::{DMatrix, Vector1};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    Contact, DenseNewton, Operator, RungeKutta, Scene, SceneError, Sdirk2, Simulation, Stepper,
};
use support::cli;
use support::earthquakes::{Arguments, Method, Problem, bp1, bp6};

/// A plate creeps below 40 km; the fault above takes friction that weakens down to 15 km, and strengthens below.
fn cycles<Op: Operator<1>>(fault: &Fault, [stiffness, damping]: [Op; 2]) -> Scene<Op, 1> {
    let aging = Dieterich {
        slip_distance: bp1::SLIP_DISTANCE,
    };
    let states = fault.cells().map(|z| LogTheta(bp1::state(z)));
    let contact = Contact::per_vertex(fault, fault.cells().map(bp1::law), bp1::NORMAL)
        .with_state(aging, states)
        .with_shear_stress(Vector1::new(bp1::shear()));
    Scene::new(stiffness)
        .with_viscosity(damping)
        .with_contact(contact)
        .with_velocity(vec![Vector1::new(bp1::PLATE_RATE); fault.cells().count()])
        .with_load_history(fault.plate(bp1::PLATE_RATE))
}

/// A fluid that is injected at the middle of a fault for 100 days spreads along it, and takes off what presses it shut.
fn injection<Op: Operator<1>>(fault: &Fault, [stiffness, damping]: [Op; 2]) -> Scene<Op, 1> {
    let aging = Dieterich {
        slip_distance: bp6::SLIP_DISTANCE,
    };
    let centers = fault.cells().map(|z| z);
    let contact = Contact::new(fault, bp6::law(), bp6::NORMAL)
        .with_state(aging, LogTheta(bp6::state()))
        .with_normal_stress_history(move |time, stress| {
            for (stress, &z) in stress.iter_mut().zip(&centers) {
                *stress -= bp6::pressure(z, time);
            }
        })
        .with_shear_stress(Vector1::new(bp6::shear()));
    Scene::new(stiffness)
        .with_viscosity(damping)
        .with_contact(contact)
        .with_velocity(vec![Vector1::new(bp6::INITIAL_RATE); fault.cells().count()])
}

/// Of a fault, a scene by products and one by matrices, the one that the method takes.
fn motion(
    arguments: &Arguments,
    fault: &Fault,
    by_products: fn(&Fault, [Kernel; 2]) -> Scene<Kernel, 1>,
    by_matrices: fn(&Fault, [DMatrix<f64>; 2]) -> Scene<DMatrix<f64>, 1>,
) -> Result<Box<dyn Stepper<1>>, SceneError> {
    let operators = [fault.stiffness(), fault.radiation_damping()];
    Ok(match arguments.method {
        Method::RungeKutta => Box::new(RungeKutta::new(by_products(fault, operators))?),
        Method::Implicit => {
            let scene = by_matrices(fault, operators.each_ref().map(DMatrix::from));
            Box::new(Simulation::new(scene, Sdirk2, DenseNewton::new())?)
        }
    })
}

fn main() -> ExitCode {
    cli::run(|arguments: &Arguments| match arguments.problem {
        Problem::Bp1 => {
            let cells = Cells::new([0.0, 40e3], arguments.count(40e3))?;
            let fault = Fault::half_space(cells, bp1::ROCK)?;
            bp1::run(
                arguments,
                &fault,
                &mut *motion(arguments, &fault, cycles, cycles)?,
            )
        }
        Problem::Bp6 => {
            let cells = Cells::new([-20e3, 20e3], arguments.count(40e3))?;
            let fault = Fault::whole_space(cells, bp6::ROCK, Mode::Antiplane)?;
            bp6::run(
                arguments,
                &fault,
                &mut *motion(arguments, &fault, injection, injection)?,
            )
        }
    })
}
