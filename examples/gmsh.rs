//! A fault on a mesh of Gmsh: groups of the file by name.
//!
//! The file `meshes/slider.msh` names its base `fault` and its top `top`. The base may point anywhere and be curved.
//! `stickslip gmsh --mesh FILE` takes files of your own, in the plane and in space.

use std::error::Error;
use std::path::Path;

use stickslip::fem::{P1, body_force, elasticity, gmsh, mass};
use stickslip::nalgebra::Vector2;
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::state::LogTheta;
use stickslip::{
    Cholesky, Components, Condensed, Contact, GeneralizedAlpha, Scene, Simulation, Steps,
};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, DARK, Panel, Points};

fn main() -> Result<(), Box<dyn Error>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes/slider.msh");
    let space = P1::<2>::new(gmsh::read(file)?);
    let (fault, top) = (space.part("fault")?, space.part("top")?);
    let PippingSlider {
        density,
        gravity,
        elastic,
        ..
    } = PippingSlider::default();
    let weight = Vector2::new(0.0, -density * gravity);
    let contact = Contact::new(&fault, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(mass(&space, density)?)
        .with_load(body_force(&space, |_| weight))
        .with_contact(contact)
        .prescribe_velocity(&top, Components::ALL, |time| [load_velocity(time), 0.0])
        .in_equilibrium(Cholesky::new());
    let mut slider = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;

    let mut rates = Points::new();
    slider.run(&Steps::constant(3e-3).until(11.0), |at| {
        rates.push((at.time, at.max_slip_rate()))
    })?;
    let event = rates
        .iter()
        .find(|(_, rate)| *rate > 1e-3)
        .map_or(f64::NAN, |&(time, _)| time);
    println!(
        "{} cells; the first event after {event:.2} s",
        space.mesh().cells().len()
    );
    // On grids of the same size it comes after 10.0 s.
    assert!((event - 10.0).abs() < 0.5);

    let panel = Panel::new("time [s]", "largest slip rate [m/s]")
        .logarithmic()
        .with("", DARK, 2, rates);
    let output = Output::create(Path::new("out/gmsh"), &[])?;
    plot::draw(&output.path("gmsh.png"), &[panel])?;
    println!("gmsh.png in {}", output.folder().display());
    Ok(())
}
