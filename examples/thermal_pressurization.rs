//! A patch of a fault whose friction heats its pore fluid: friction, temperature and pore pressure through an earthquake.
//!
//! The plate loads the patch by its own stiffness. As it slips by metres per second, heat expands the fluid faster than it
//! escapes: the effective normal stress falls, and the patch slips farther than without.

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;

use stickslip::fields::{PoreFluid, ShearZone, ThermalPressurization};
use stickslip::friction::{FrictionLaw, RegularizedDieterichRuina};
use stickslip::nalgebra::{Matrix1, Vector1};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{BoundaryPart, Contact, RungeKutta, Scene, Steps};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, COLORS, DARK, Panel, Points};

const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 8e-3,
};
const AGING: Dieterich = Dieterich {
    slip_distance: LAW.slip_distance,
};
/// [Pa], [Pa/m], [Pa s/m] and [m/s]
const NORMAL_STRESS: f64 = 50e6;
const STIFFNESS: f64 = 3.3e6;
const DAMPING: f64 = 4.62e6;
const PLATE: f64 = 1e-9;
const YEAR: f64 = 31_557_600.0;

/// The patch, with a shear zone of 2 cm between wall rocks or without fluid.
fn patch(fluid: bool) -> Result<Scene<Matrix1<f64>, 1>, Box<dyn Error>> {
    let state = LogTheta((AGING.slip_distance / PLATE).ln());
    let shear = NORMAL_STRESS * LAW.coefficient(0.1 * PLATE, state);
    let mut contact = Contact::new(BoundaryPart::point(1.0), LAW, NORMAL_STRESS)
        .with_state(AGING, state)
        .with_shear_stress(Vector1::new(shear));
    if fluid {
        let zone = ShearZone {
            half_width: 0.01.into(),
            volumetric_heat_capacity: 2.7e6.into(),
            thermal_diffusivity: 1e-6.into(),
            initial_temperature: 483.15.into(),
        };
        let fluid = PoreFluid {
            hydraulic_diffusivity: 1e-4.into(),
            pressurization_coefficient: 1e5.into(),
        };
        contact = contact.with_field(ThermalPressurization::new(1, zone, fluid)?);
    }
    Ok(Scene::new(Matrix1::new(STIFFNESS))
        .with_viscosity(Matrix1::new(DAMPING))
        .with_contact(contact)
        .with_load_history(|time, load| load[0][0] = STIFFNESS * PLATE * time))
}

/// Shear stress \[MPa\], pore pressure \[MPa\] and temperature \[K\] by slip \[m\], from 1 mm/s on; the slip of the event.
fn event(fluid: bool) -> Result<([Points; 3], f64), Box<dyn Error>> {
    let mut motion = RungeKutta::new(patch(fluid)?)?;
    let mut curves = [const { Points::new() }; 3];
    let (mut begin, mut last) = (None, 0.0);
    motion.run(&Steps::adaptive(1e-6).until(350.0 * YEAR), |at| {
        let contact = at.contact(0);
        if contact.slip_rate(0) < 1e-3 {
            // Before the earthquake, or at its end.
            return match begin {
                None => ControlFlow::Continue(()),
                Some(_) => ControlFlow::Break(()),
            };
        }
        let slip = contact.slip(0) - *begin.get_or_insert(contact.slip(0));
        let temperature = contact
            .reading("temperature")
            .map_or(f64::NAN, |all| all[0]);
        let values = [
            contact.traction(0)[0] * 1e-6,
            contact.pore_pressure(0) * 1e-6,
            temperature,
        ];
        for (curve, value) in curves.iter_mut().zip(values) {
            curve.push((slip, value));
        }
        last = slip;
        ControlFlow::Continue(())
    })?;
    Ok((curves, last))
}

fn main() -> Result<(), Box<dyn Error>> {
    let (dry, without) = event(false)?;
    let (wet, with) = event(true)?;
    let largest = |curve: &Points| curve.iter().map(|&(_, value)| value).fold(0.0, f64::max);
    let (pressure, temperature) = (largest(&wet[1]), largest(&wet[2]));
    println!("slip of an earthquake: {without:.2} m without pressurization, {with:.2} m with");
    println!(
        "pore pressure up to {pressure:.1} MPa of {:.0}, {temperature:.0} K",
        NORMAL_STRESS * 1e-6
    );
    assert!(with > 1.5 * without);
    // Heat drives the pressure, and less of it the more the fault weakens: below the normal stress.
    assert!(pressure > 0.5 * NORMAL_STRESS * 1e-6 && pressure < NORMAL_STRESS * 1e-6);

    // No hotter than with all work of friction within the shear zone.
    let adiabatic = 0.6 * NORMAL_STRESS * with / (2.7e6 * 0.01 * std::f64::consts::TAU.sqrt());
    assert!(temperature < 483.15 + adiabatic);

    let output = Output::create(Path::new("out/thermal_pressurization"), &[])?;
    let [dry_stress, ..] = dry;
    let [stress, pressures, temperatures] = wet;
    plot::draw(
        &output.path("thermal_pressurization.png"),
        &[
            Panel::new("slip [m]", "shear stress [MPa]")
                .with("without fluid", COLORS[1], 2, dry_stress)
                .with("thermal pressurization", DARK, 2, stress),
            Panel::new("slip [m]", "pore pressure [MPa]").with("", DARK, 2, pressures),
            Panel::new("slip [m]", "temperature [K]").with("", DARK, 2, temperatures),
        ],
    )?;
    println!(
        "thermal_pressurization.png in {}",
        output.folder().display()
    );
    Ok(())
}
