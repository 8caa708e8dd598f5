//! A block in three dimensions, pulled obliquely: which way does it slide?
//!
//! Friction is isotropic: the shear traction has the direction of the slip rate, whatever that is. A square block that is pulled
//! along the diagonal slides along the diagonal; where every vertex slides, its traction is the strength.

use std::error::Error;
use std::path::Path;

use stickslip::fem::{Elastic, P1, elasticity, mass};
use stickslip::friction::DieterichRuina;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{Contact, GeneralizedAlpha, Scene, Simulation, Steps, Tnnmg};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, DARK, PALE, Panel, Points};

fn main() -> Result<(), Box<dyn Error>> {
    let space = P1::<3>::grid([1.0, 1.0, 1.0], [1, 1, 1])?.refined(3)?;
    let bottom = space.trace(|x| x[2] == 0.0)?;
    let top = space.trace(|x| x[2] == 1.0)?;
    let law = DieterichRuina {
        a: 0.010,
        b: 0.015,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 1e-5,
    };
    let elastic = Elastic {
        young_modulus: 5e7,
        poisson_ratio: 0.3,
    };
    let contact = Contact::new(&bottom, law, 20e3);
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(mass(&space, 5e3)?)
        .with_contact(contact.with_state(
            Dieterich {
                slip_distance: 1e-5,
            },
            LogTheta(-5.0),
        ))
        .prescribe_velocity(&top, [true; 3], |_| [2e-3, 2e-3, 0.0]);
    let solver = Tnnmg::new(space.transfers());
    let mut block = Simulation::new(scene, GeneralizedAlpha::default(), solver)?;
    let (mut forces, mut path) = ([Points::new(), Points::new()], Points::new());
    block.run(&Steps::constant(2e-3).until(1.0), |at| {
        let contact = at.contact(0);
        let (force, moved) = (contact.force(), at.displacement[contact.vertex(0)]);
        for (c, history) in forces.iter_mut().enumerate() {
            history.push((at.time, force[c] / 1e3));
        }
        path.push((1e3 * moved[0], 1e3 * moved[1]));
    })?;

    let at = block.snapshot();
    let contact = at.contact(0);
    for k in 0..contact.len() {
        let (slip_rate, strength) = (contact.slip_velocity(k), contact.strength(k));
        assert!(
            slip_rate.norm() > 0.0,
            "vertex {} sticks",
            contact.vertex(k)
        );
        // The body drags the surface along, as hard as friction can bear.
        let expected = slip_rate * (strength / slip_rate.norm());
        let error = (contact.traction(k) - expected).norm() / strength;
        assert!(
            error < 1e-6,
            "vertex {}: off by {error:e}",
            contact.vertex(k)
        );
    }
    let force = contact.force();
    println!(
        "friction after 1 s: {:.3?} N, {:.3} mm of slip",
        force.as_slice(),
        1e3 * contact.slip(0)
    );
    assert!(
        (force[0] / force[1] - 1.0).abs() < 1e-2,
        "it does not slide along the diagonal"
    );
    assert_eq!(force[2], 0.0);

    let [x, y] = forces;
    let friction = Panel::new("time [s]", "friction on the base [kN]")
        .with("along x", PALE, 8, x)
        .with("along y", DARK, 2, y);
    let diagonal = path.last().map_or(0.0, |end| end.0);
    let motion = Panel::new("displacement along x [mm]", "displacement along y [mm]")
        .with("diagonal", PALE, 8, vec![(0.0, 0.0), (diagonal, diagonal)])
        .with("a corner of the base", DARK, 2, path);
    let output = Output::create(Path::new("out/block_3d"), &[])?;
    plot::draw(&output.path("block_3d.png"), &[friction, motion])?;
    println!("block_3d.png in {}", output.folder().display());
    Ok(())
}
