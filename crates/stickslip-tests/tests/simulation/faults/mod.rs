//! Quasi-dynamic faults without a mesh, by Runge-Kutta steps on products of their kernel and by implicit steps on its
//! matrix.

mod agreement;
mod closed_forms;
mod energy;
mod fields;
mod fluid_driven;
mod fluids;
mod in_threads;
mod one_type;
mod other_cells;
mod own_geometry;
mod refusals;
mod restart;
mod segments;

use nalgebra::Vector1;
use stickslip::bie::{Cells, Fault, Medium, Mode};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{Contact, Operator, RungeKutta, Scene, SceneError};

use crate::Outcome;

const MEDIUM: Medium = Medium {
    shear_modulus: 30e9,
    shear_wave_speed: 3000.0,
};
const NORMAL: f64 = 50e6;
const PLATE: f64 = 1e-9;

fn law(a: f64) -> RegularizedDieterichRuina {
    RegularizedDieterichRuina {
        a,
        b: 0.015,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 8e-3,
    }
}

const AGING: Dieterich = Dieterich {
    slip_distance: 8e-3,
};

/// Cells of 500 m down to 20 km, which weaken above 10 km and strengthen below: a contact each, or one for both.
fn fault() -> Outcome<Fault> {
    Ok(Fault::half_space(Cells::new([0.0, 20e3], 40)?, MEDIUM)?)
}

/// At steady sliding, and loaded by the plate below; the stress that steady friction needs is there from the start.
fn scene<Op: Operator<1>>(fault: &Fault, operators: [Op; 2], split: bool) -> Outcome<Scene<Op, 1>> {
    let [stiffness, damping] = operators;
    let steady = LogTheta((AGING.slip_distance / PLATE).ln());
    let shear = |z: f64| {
        // Somewhat off balance, so that something happens.
        let bump = 1.0 + 0.02 * (-((z - 6e3) / 2e3).powi(2)).exp();
        Vector1::new(bump * NORMAL * (0.6 + (weight(z) - 0.015) * (PLATE / 1e-6).ln()))
    };
    let mut scene = Scene::new(stiffness)
        .with_viscosity(damping)
        .with_load_history(fault.plate_loading(PLATE))
        .with_velocity(vec![Vector1::new(PLATE); fault.cells().count()])
        .with_balanced_rates();
    let sections = if split {
        vec![fault.section([0.0, 10e3])?, fault.section([10e3, 20e3])?]
    } else {
        vec![fault.cells().all()]
    };
    for section in &sections {
        let contact = Contact::per_vertex(section, section.map(|z| law(weight(z))), NORMAL)
            .with_state(AGING, steady)
            .with_shear_stress(section.map(shear));
        scene = scene.with_contact(contact);
    }
    Ok(scene)
}

/// `a` at a depth.
fn weight(z: f64) -> f64 {
    if z < 10e3 { 0.010 } else { 0.025 }
}

/// The same by products.
fn explicit(fault: &Fault, split: bool) -> Outcome<RungeKutta<1>> {
    let operators = [fault.stiffness(), fault.radiation_damping()];
    Ok(RungeKutta::new(scene(fault, operators, split)?)?)
}

/// A fault in a whole space under one law.
fn whole(cells: Cells) -> Outcome<Fault> {
    Ok(Fault::whole_space(cells, MEDIUM, Mode::Antiplane)?)
}

/// The fault of a scene.
fn refused<Op: Operator<1>>(scene: Scene<Op, 1>) -> Option<SceneError> {
    RungeKutta::new(scene).err()
}
