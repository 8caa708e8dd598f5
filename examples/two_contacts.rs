//! Two frictional surfaces with laws of different types: the force that each bears.
//!
//! A plate of 4 m x 1 m is pulled by its right edge. Its bottom slides by rate- and state-dependent friction, its
//! top along a guide by a constant coefficient, and both meet the edge. Without inertia the two surfaces carry
//! together the force that pulls the edge, at every time.

use std::error::Error;
use std::path::Path;

use stickslip::fem::{Elastic, P1, elasticity};
use stickslip::friction::{DieterichRuina, Tresca};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{Components, Condensed, Contact, GeneralizedAlpha, Scene, Simulation, Steps};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, COLORS, Panel, Points};

fn main() -> Result<(), Box<dyn Error>> {
    let space = P1::grid([4.0, 1.0], [4, 1])?.refined(3)?;
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let top = space.trace(|x| x[1] == 1.0)?;
    let edge = space.trace(|x| x[0] == 4.0)?;

    let aging = DieterichRuina {
        a: 0.010,
        // Below a, velocity strengthening: a body without inertia has a solution at all times.
        b: 0.005,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 1e-5,
    };
    let seam = Contact::new(&bottom, aging, 50e3);
    let seam = seam.with_state(
        Dieterich {
            slip_distance: 1e-5,
        },
        LogTheta(0.0),
    );
    let guide = Contact::new(&top, Tresca { coefficient: 0.1 }, 50e3);
    let elastic = Elastic {
        young_modulus: 5e7,
        poisson_ratio: 0.3,
    };
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_contact(seam)
        .with_contact(guide)
        .prescribe_velocity(&edge, Components::X, |_| [1e-3, 0.0]);
    let mut plate = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;

    println!("  t [s]   pull [N]   bottom [N]   top [N]");
    let mut balanced = true;
    let mut carried = [0.0; 2];
    let mut forces = [Points::new(), Points::new(), Points::new()];
    plate.run(&Steps::constant(0.05).until(12.0), |at| {
        let pull = at.reaction(&edge).map_or(f64::NAN, |force| force[0]);
        carried = [0, 1].map(|contact| at.contact(contact).force()[0]);
        let left = (pull - carried[0] - carried[1]).abs() / pull;
        balanced &= left < 1e-8;
        for (history, force) in forces.iter_mut().zip([pull, carried[0], carried[1]]) {
            history.push((at.time, force / 1e3));
        }
        if at.step % 40 == 0 {
            println!(
                "{:7.2} {pull:10.1} {:12.1} {:9.1}",
                at.time, carried[0], carried[1]
            );
        }
    })?;

    assert!(balanced, "what pulls is not what the contacts carry");
    // Everything slides in the end: the guide by its constant coefficient, the seam at its steady one.
    let steady = [aging.steady_coefficient(1e-3), 0.1].map(|mu| mu * 50e3 * 4.0);
    assert!((carried[0] / steady[0] - 1.0).abs() < 1e-2);
    assert!((carried[1] / steady[1] - 1.0).abs() < 1e-6);

    let mut panel = Panel::new("time [s]", "force [kN]");
    let labels = ["pull at the edge", "bottom", "top"];
    for ((history, label), color) in forces.into_iter().zip(labels).zip(COLORS) {
        panel = panel.with(label, color, 2, history);
    }
    let output = Output::create(Path::new("out/two_contacts"), &[])?;
    plot::draw(&output.path("two_contacts.png"), &[panel])?;
    println!("two_contacts.png in {}", output.folder().display());
    Ok(())
}
