//! Quasi-dynamic faults without a mesh.

use nalgebra::{DMatrix, Vector1, Vector2};
use stickslip::bie::{Cells, DippingFault, Fault, PlaneFault, Rectangles, Sense};
use stickslip::problems::bp1;
use stickslip::state::LogTheta;
use stickslip::{Contact, DenseNewton, Monolithic, RungeKutta, Scene, Sdirk2, Simulation, Steps};

use super::{Cost, simulated, stepped};
use crate::Outcome;

const YEAR: f64 = 3.15576e7;
const STATE: LogTheta = LogTheta(15.9);

fn line() -> Outcome<Fault> {
    Ok(Fault::half_space(
        Cells::new([0.0, bp1::DEPTH], 50)?,
        bp1::MEDIUM,
    )?)
}

fn cycle() -> Outcome<Cost> {
    let steps = Steps::adaptive(1e-4).until(150.0 * YEAR);
    stepped(
        "BP1 of 50 cells",
        RungeKutta::new(bp1::scene(&line()?))?,
        &steps,
    )
}

/// The same fault by its matrix.
fn implicit() -> Outcome<Cost> {
    let fault = line()?;
    let scene = Scene::new(DMatrix::from(&fault.stiffness()))
        .with_viscosity(DMatrix::from(&fault.radiation_damping()))
        .with_contact(bp1::contact(&fault));
    let simulation =
        Simulation::new(scene, Sdirk2, DenseNewton::new())?.with_coupling(Monolithic::default());
    let steps = Steps::adaptive(1e-3).until(20.0 * YEAR);
    simulated("BP1 by a dense matrix", simulation, &steps)
}

fn plane() -> Outcome<Cost> {
    let cells = Rectangles::new(Cells::new([-20e3, 20e3], 20)?, Cells::new([0.0, 16e3], 8)?);
    let fault = PlaneFault::half_space(cells, 90.0, bp1::MEDIUM, 0.25)?;
    let shear = cells.map(|[x, y]| {
        let bump = (-(x * x + (y - 8e3).powi(2)) / 16e6).exp();
        Vector2::new(28e6 + 2e6 * bump, 1e6 * bump)
    });
    let contact = Contact::new(&fault, bp1::friction(0.0), bp1::NORMAL_STRESS)
        .with_state(bp1::AGING, STATE)
        .with_shear_stress(shear);
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(contact);
    let steps = Steps::adaptive(1e-4).until(1e7);
    stepped("plane of 20 x 8 cells", RungeKutta::new(scene)?, &steps)
}

/// A thrust fault, whose normal stress follows slip.
fn thrust() -> Outcome<Cost> {
    let cells = Cells::new([0.0, 20e3], 40)?;
    let fault = DippingFault::new(cells, bp1::MEDIUM, 0.25, 60.0, Sense::Thrust)?;
    let contact = Contact::new(&fault, bp1::friction(0.0), bp1::NORMAL_STRESS)
        .with_state(bp1::AGING, STATE)
        .with_shear_stress(Vector1::new(28.5e6));
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_normal_stress_change(fault.normal_stiffness(), Vector1::zeros())
        .with_contact(contact);
    let steps = Steps::adaptive(1e-4).until(1e7);
    stepped("thrust of 40 cells", RungeKutta::new(scene)?, &steps)
}

pub(super) fn all() -> Outcome<Vec<Cost>> {
    Ok(vec![cycle()?, implicit()?, plane()?, thrust()?])
}
