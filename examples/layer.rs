//! Verification: an antiplane layer with an exact solution.
//!
//! A layer of 1 m is moved at its top and slides on its base under rate-and-state friction. Nothing depends on the
//! position along it, so that waves between top and base give the slip rate of the base by one scalar equation a time.
//! Finite elements are set beside that solution up to the first event.

use std::error::Error;
use std::path::Path;

use stickslip::fem::{P1, antiplane, mass};
use stickslip::problems::antiplane_layer::{AGING, AntiplaneLayer, FRICTION, load_velocity};
use stickslip::state::LogTheta;
use stickslip::{Components, Condensed, Contact, GeneralizedAlpha, Scene, Simulation, Steps};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, DARK, PALE, Panel};

fn main() -> Result<(), Box<dyn Error>> {
    let (shear_modulus, density, pressure) = (1.923e7, 5e3, 49_050.0);
    let space = P1::grid([1.0 / 64.0, 1.0], [1, 64])?;
    let base = space.trace(|x| x[1] == 0.0)?;
    let top = space.trace(|x| x[1] == 1.0)?;
    let contact = Contact::new(&base, FRICTION, pressure).with_state(AGING, LogTheta(-10.0));
    let scene = Scene::new(antiplane(&space, shear_modulus)?)
        .with_mass(mass(&space, density)?)
        .with_contact(contact)
        .prescribe_velocity(&top, Components::ALL, |time| [load_velocity(time)]);
    let mut layer = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;

    let mut computed = Vec::new();
    layer.run(&Steps::constant(1.5e-3).until(10.2), |at| {
        computed.push((at.time, at.contact(0).slip_rate(0)));
    })?;

    // The same layer by the method of characteristics; its steps are 1/400 of the time a wave takes through it.
    let characteristics = AntiplaneLayer {
        shear_modulus,
        density,
        ..AntiplaneLayer::default()
    };
    let mut exact = Vec::new();
    characteristics.exact(&FRICTION, &AGING, LogTheta(-10.0), 400, |at| {
        if at.time < 10.2 {
            exact.push((at.time, at.slip_rate));
        }
    })?;

    let first_event = |history: &[(f64, f64)]| {
        history
            .iter()
            .find(|(_, rate)| *rate > 1e-4)
            .map(|&(time, _)| time)
    };
    let [found, expected] =
        [first_event(&computed), first_event(&exact)].map(|time| time.unwrap_or(f64::NAN));
    println!("first event at {found:.4} s, exactly at {expected:.4} s");
    assert!((found - expected).abs() < 2e-3);

    let since = |history: Vec<(f64, f64)>| {
        history
            .into_iter()
            .filter(|(time, _)| *time > 9.0)
            .collect()
    };
    let panel = Panel::new("time [s]", "slip rate of the base [m/s]")
        .logarithmic()
        .with("exact", PALE, 4, since(exact))
        .with("finite elements", DARK, 2, since(computed));
    let output = Output::create(Path::new("out/layer"), &[])?;
    plot::draw(&output.path("layer.png"), &[panel])?;
    println!("layer.png in {}", output.folder().display());
    Ok(())
}
