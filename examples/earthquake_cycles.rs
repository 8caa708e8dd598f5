//! Earthquake cycles on a planar fault by boundary integrals: the SEAS benchmark BP1-QD.
//!
//! A vertical strike-slip fault in a half space, velocity weakening down to 15 km and strengthening below, is loaded by a
//! plate that creeps at 1e-9 m/s beyond 40 km. Stress is a Fourier transform away from slip, and waves are radiation
//! damping: quasi-dynamic. Cells of 100 m resolve the cohesive zone, G D_c/(b sigma_n) = 340 m; `stickslip earthquakes`
//! has finer ones, and more numbers beside published ones.
//!
//! Parameters: B. Erickson et al., Seismol. Res. Lett. 91 (2020).

use std::error::Error;
use std::path::Path;

use stickslip::bie::{Cells, Fault, Medium};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::nalgebra::Vector1;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{Contact, RungeKutta, Scene, Steps};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, COLORS, Panel, Points};

const YEAR: f64 = 365.0 * 86_400.0;
const PLATE: f64 = 1e-9;
const NORMAL: f64 = 50e6;
const CRUST: Medium = Medium {
    shear_modulus: 32.038_120_320e9,
    shear_wave_speed: 3464.0,
};
const AGING: Dieterich = Dieterich {
    slip_distance: 8e-3,
};

fn law(depth: f64) -> RegularizedDieterichRuina {
    RegularizedDieterichRuina {
        a: 0.010 + 0.015 * ((depth - 15e3) / 3e3).clamp(0.0, 1.0),
        b: 0.015,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: AGING.slip_distance,
    }
}

/// `ln(theta)` at which friction bears a shear stress over normal stress of `ratio` at the plate rate.
fn state(depth: f64, ratio: f64) -> LogTheta {
    let law = law(depth);
    let psi = law.a * (2.0 * law.reference_velocity / PLATE * (ratio / law.a).sinh()).ln();
    LogTheta(
        (psi - law.reference_friction) / law.b + (law.slip_distance / law.reference_velocity).ln(),
    )
}

fn main() -> Result<(), Box<dyn Error>> {
    let fault = Fault::half_space(Cells::new([0.0, 40e3], 400)?, CRUST)?;
    let depths: Vec<f64> = (0..400).map(|k| fault.cells().center(k)).collect();
    // Steady creep at the plate rate far below sets the initial shear stress everywhere.
    let deep = law(40e3);
    let strength = deep.reference_friction + deep.b * (deep.reference_velocity / PLATE).ln();
    let ratio =
        deep.a * (PLATE / (2.0 * deep.reference_velocity) * (strength / deep.a).exp()).asinh();
    let radiated = 0.5 * CRUST.shear_modulus / CRUST.shear_wave_speed * PLATE;
    let contact = Contact::per_vertex(&fault, fault.cells().map(law), NORMAL)
        .with_state(AGING, fault.cells().map(|z| state(z, ratio)))
        .with_shear_stress(Vector1::new(NORMAL * ratio + radiated));
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(contact)
        .with_load_history(fault.plate_loading(PLATE))
        .with_velocity(vec![Vector1::new(PLATE); 400]);
    let mut motion = RungeKutta::new(scene)?;

    let shown = [0, 75, 120, 180];
    let mut rates = vec![Points::new(); shown.len()];
    let mut events = Vec::new();
    let mut slips = false;
    motion.run(&Steps::adaptive(1e-4).until(450.0 * YEAR), |at| {
        for (history, k) in rates.iter_mut().zip(shown) {
            history.push((at.time / YEAR, at.contact(0).slip_rate(k)));
        }
        // At 7.5 km depth, where the fault weakens.
        let rate = at.contact(0).slip_rate(75);
        if rate > 1e-2 && !slips {
            events.push((at.time / YEAR, at.contact(0).slip(75)));
        }
        slips = rate > 1e-2 || slips && rate > 1e-6;
    })?;
    let years: Vec<f64> = events.iter().map(|event| event.0).collect();
    println!("earthquakes after {years:.1?} years");
    // The first event of codes of boundary elements is after 195.9 to 196.5 years.
    assert!((years[0] - 196.2).abs() < 1.0 && years.len() >= 3);
    // From event to event the fault slips as far as the plate moves, to some per cent while the cycle settles.
    for pair in events.windows(2).skip(1) {
        let [interval, slip] = [pair[1].0 - pair[0].0, pair[1].1 - pair[0].1];
        println!("{slip:.3} m in {interval:.1} years");
        assert!((slip / (PLATE * interval * YEAR) - 1.0).abs() < 0.03);
    }

    let labels: Vec<String> = shown.map(|k| format!("{:.1} km", depths[k] / 1e3)).into();
    let mut panel = Panel::new("time [years]", "slip rate [m/s]").logarithmic();
    for ((history, label), color) in rates.into_iter().zip(&labels).zip(COLORS) {
        panel = panel.with(label, color, 2, history);
    }
    let output = Output::create(Path::new("out/earthquake_cycles"), &[])?;
    plot::draw(&output.path("earthquake_cycles.png"), &[panel])?;
    println!("earthquake_cycles.png in {}", output.folder().display());
    Ok(())
}
