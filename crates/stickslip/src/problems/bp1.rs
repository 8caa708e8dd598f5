//! BP1-QD: earthquake cycles on a vertical strike-slip fault in a half space, quasi-dynamic.
//!
//! Friction is velocity weakening down to 15 km and strengthening below 18 km; a plate creeps beyond the cells of the
//! fault. Displacements are slip across the fault. Source: B. Erickson et al., "The community code verification exercise
//! for simulating sequences of earthquakes and aseismic slip (SEAS)", Seismol. Res. Lett. 91 (2020).
//!
//! ```
//! use stickslip::bie::{Cells, Fault};
//! use stickslip::problems::bp1;
//! use stickslip::{RungeKutta, Steps};
//!
//! let fault = Fault::half_space(Cells::new([0.0, 40e3], 100)?, bp1::MEDIUM)?;
//! let mut motion = RungeKutta::new(bp1::scene(&fault))?;
//! motion.run(&Steps::adaptive(1e-4).count(10), |_| ())?;
//! assert!(motion.snapshot().max_slip_rate() < 1.1 * bp1::PLATE_RATE);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use nalgebra::Vector1;
use stickslip_bie::{Fault, Kernel, Medium};
use stickslip_friction::RegularizedDieterichRuina;
use stickslip_state::{Dieterich, LogTheta};

use crate::{Contact, Scene};

/// The medium around the fault.
pub const MEDIUM: Medium = Medium {
    shear_modulus: 32.038_120_320e9,
    shear_wave_speed: 3464.0,
};

/// The normal stress \[Pa\].
pub const NORMAL_STRESS: f64 = 50e6;

/// The plate rate, also the initial slip rate of the fault [m/s].
pub const PLATE_RATE: f64 = 1e-9;

/// The aging law.
pub const AGING: Dieterich = Dieterich {
    slip_distance: 8e-3,
};

/// The depth below which the plate creeps \[m\].
pub const DEPTH: f64 = 40e3;

/// The friction law at a depth \[m\].
pub fn friction(depth: f64) -> RegularizedDieterichRuina {
    let (shallow, deep) = (0.010, 0.025);
    RegularizedDieterichRuina {
        a: shallow + (deep - shallow) * ((depth - 15e3) / 3e3).clamp(0.0, 1.0),
        b: 0.015,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: AGING.slip_distance,
    }
}

/// The initial radiation damping stress \[Pa\].
fn radiated() -> f64 {
    0.5 * MEDIUM.shear_modulus / MEDIUM.shear_wave_speed * PLATE_RATE
}

/// The initial shear stress \[Pa\]: that of steady slip at the plate rate at [`DEPTH`].
pub fn shear_stress() -> f64 {
    let deep = friction(DEPTH);
    let strength = deep.reference_friction + deep.b * (deep.reference_velocity / PLATE_RATE).ln();
    let argument = PLATE_RATE / (2.0 * deep.reference_velocity) * (strength / deep.a).exp();
    NORMAL_STRESS * deep.a * argument.asinh() + radiated()
}

/// The initial state at a depth \[m\], `ln(theta / 1 s)`, at which friction at the plate rate bears the shear stress.
pub fn initial_log_theta(depth: f64) -> f64 {
    let law = friction(depth);
    let ratio = (shear_stress() - radiated()) / NORMAL_STRESS;
    // ln(2 sinh y) without overflow, y = f/a.
    let y = ratio / law.a;
    let log_sinh = y + (-(-2.0 * y).exp()).ln_1p();
    let friction = law.a * (log_sinh + (law.reference_velocity / PLATE_RATE).ln());
    (friction - law.reference_friction) / law.b + (law.slip_distance / law.reference_velocity).ln()
}

/// The frictional contact of a fault whose cells are depths.
pub fn contact(fault: &Fault) -> Contact<RegularizedDieterichRuina, Dieterich, 1> {
    let cells = fault.cells();
    Contact::per_vertex(fault, cells.map(friction), NORMAL_STRESS)
        .with_state(AGING, cells.map(|depth| LogTheta(initial_log_theta(depth))))
        .with_shear_stress(Vector1::new(shear_stress()))
}

/// The scene of a fault in the half space, from the surface to [`DEPTH`].
pub fn scene(fault: &Fault) -> Scene<Kernel, 1> {
    Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(contact(fault))
        .with_load_history(fault.plate_loading(PLATE_RATE))
        .with_velocity(fault.cells().map(|_| Vector1::new(PLATE_RATE)))
}

#[cfg(test)]
#[path = "../../tests/unit/bp1.rs"]
mod tests;
