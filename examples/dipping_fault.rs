//! A thrust in a compressed block: which push drives a wedge of sand up its ramp?
//!
//! The file `meshes/thrust.msh` has the fault inside the body, as group 3, and its sides slide on each other. The normal
//! stress comes from the deformation: from the weight, the push and slip. Once all of the fault slides, the push is that
//! of Coulomb's wedge, whatever the stiffness of the block,
//!
//! ```text
//! F = W tan(dip + phi),    tan(phi) the coefficient of friction, W the weight of the hanging wall
//! ```

use std::error::Error;
use std::path::Path;

use stickslip::fem::{Elastic, P1, body_force, elasticity, gmsh};
use stickslip::friction::Tresca;
use stickslip::nalgebra::Vector2;
use stickslip::{
    BackwardEuler, Cholesky, Components, Condensed, Contact, NormalStress, Scene, Simulation,
    Snapshot, Steps,
};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, DARK, PALE, Panel, Points};

const DIP: f64 = 30.0;
const COEFFICIENT: f64 = 0.4;
const SPECIFIC_WEIGHT: f64 = 5e3 * 9.81;

fn main() -> Result<(), Box<dyn Error>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes/thrust.msh");
    let space = P1::new(gmsh::read::<2>(file)?.split("3")?).refined(1)?;
    let (wall, base) = (space.part("5")?, space.part("6")?);
    let sand = Elastic {
        young_modulus: 5e7,
        poisson_ratio: 0.3,
    };
    let fault = Contact::between(
        &space.part("3+")?,
        &space.part("3-")?,
        Tresca {
            coefficient: COEFFICIENT,
        },
        NormalStress::from_body(0.0),
    );
    // Without a mass matrix: quasi-static. The wall pushes at 1 mm/s, and hanging sand slides along it.
    let scene = Scene::new(elasticity(&space, &sand)?)
        .with_load(body_force(&space, |_| Vector2::new(0.0, -SPECIFIC_WEIGHT)))
        .with_contact(fault)
        .fix(&base, Components::ALL)
        .prescribe_velocity(&wall, Components::X, |_| [-1e-3, 0.0])
        .in_equilibrium(Cholesky::new());
    let mut block = Simulation::new(scene, BackwardEuler, Condensed::new())?;

    // Normal stress along the fault, from its top down.
    let pressure = |at: &Snapshot<'_, 2>| -> Points {
        let contact = at.contact(0);
        let depth = |k: usize| (1.0 - contact.point(k)[1]) / DIP.to_radians().sin();
        let stress = |k: usize| (depth(k), 1e-3 * contact.normal_stress(k));
        let mut along: Points = (0..contact.len()).map(stress).collect();
        along.sort_by(|a, b| a.0.total_cmp(&b.0));
        along
    };
    let before = pressure(&block.snapshot());
    let (mut push, mut worst) = (Points::new(), 0.0_f64);
    block.run(&Steps::constant(0.25).until(15.0), |at| {
        let force = at.reaction(&wall).map_or(f64::NAN, |force| -force[0]);
        push.push((at.time, 1e-3 * force));
        worst = worst.max(at.report.contraction);
    })?;
    let at = block.snapshot();
    let fault = at.contact(0);
    let (slowest, fastest) = (0..fault.len())
        .map(|k| fault.slip_rate(k))
        .fold((f64::MAX, 0.0_f64), |(a, b), rate| {
            (a.min(rate), b.max(rate))
        });

    // The hanging wall: between the fault, from (1, 1) m to the base, and the wall at 3.4 m.
    let foot = 1.0 + 1.0 / DIP.to_radians().tan();
    let weight = SPECIFIC_WEIGHT * 0.5 * ((3.4 - 1.0) + (3.4 - foot));
    let expected = weight * (DIP.to_radians() + COEFFICIENT.atan()).tan();
    let force = 1e3 * push.last().map_or(f64::NAN, |last| last.1);
    println!(
        "push {force:.3} N, Coulomb's wedge {expected:.3} N; slip rates from {slowest:.3e} to {fastest:.3e} m/s; \
         contraction of the normal stress {worst:.2}"
    );
    assert!((force / expected - 1.0).abs() < 1e-6);
    // The hanging wall moves along the fault as a whole.
    let rate = 1e-3 / DIP.to_radians().cos();
    assert!((slowest / rate - 1.0).abs() < 1e-6 && (fastest / rate - 1.0).abs() < 1e-6);

    let wedge = vec![(0.0, 1e-3 * expected), (15.0, 1e-3 * expected)];
    let panels = [
        Panel::new("displacement of the wall [mm]", "push [kN]")
            .with("Coulomb's wedge", PALE, 2, wedge)
            .with("block", DARK, 3, push),
        Panel::new("distance down the fault [m]", "normal stress [kPa]")
            .logarithmic()
            .with("at rest", PALE, 2, before)
            .with("while it slides", DARK, 3, pressure(&at)),
    ];
    let output = Output::create(Path::new("out/dipping_fault"), &[])?;
    plot::draw(&output.path("dipping-fault.png"), &panels)?;
    println!("dipping-fault.png in {}", output.folder().display());
    Ok(())
}
