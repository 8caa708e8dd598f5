//! The energy that absorbing sides send back, of plane waves by angle.

use nalgebra::Vector2;
use stickslip::fem::{
    BlockMatrix, Elastic, GridDiagonal, Impedance, Mesh, P1, Sponge, dashpot, elasticity,
    lumped_mass, sponge,
};
use stickslip::{Condensed, Newmark, Scene, Simulation, Steps};

use crate::Outcome;

/// The speeds of pressure and shear waves are 3^(1/2) and 1, wavelengths 1.
const ROCK: Elastic = Elastic {
    young_modulus: 2.5,
    poisson_ratio: 0.25,
};
const CELLS: f64 = 16.0;
const START: f64 = 4.0;
/// That of the packet: several waves.
const SIGMA: f64 = 0.8;

#[derive(Clone, Copy, PartialEq)]
enum Wave {
    Pressure,
    Shear,
}

#[derive(Clone, Copy)]
enum Sides {
    Reflecting,
    Dashpots,
    Sponge(f64),
}

fn energy(matrix: &BlockMatrix<2>, x: &[Vector2<f64>]) -> f64 {
    let rows = matrix.outer_iterator().enumerate();
    let row = |(i, row): (usize, sprs::CsVecViewI<'_, nalgebra::Matrix2<f64>, u32>)| {
        let force: Vector2<f64> = row.iter().map(|(j, block)| block * x[j]).sum();
        0.5 * x[i].dot(&force)
    };
    rows.map(row).sum()
}

/// The share of the energy of a packet of waves that is in the body after the time in which it has come back from the
/// side at `y = 0`.
fn returned(wave: Wave, degrees: f64, sides: Sides) -> Outcome<f64> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    // One period of the wave along the side.
    let wide: f64 = if sin > 0.0 { 1.0 / sin } else { 0.5 };
    let high = 10.0;
    let cells = [(wide * CELLS).round() as usize, (high * CELLS) as usize];
    let space = P1::new(Mesh::<2>::grid([wide, high], cells, GridDiagonal::Rising)?);
    let (left, right) = (
        space.trace(|x| x[0] == 0.0)?,
        space.trace(|x| x[0] == wide)?,
    );
    let (speed, direction) = match wave {
        Wave::Pressure => (3_f64.sqrt(), Vector2::new(sin, -cos)),
        Wave::Shear => (1.0, Vector2::new(cos, sin)),
    };
    let k = Vector2::new(sin, -cos) * std::f64::consts::TAU;
    let (omega, group) = (speed * std::f64::consts::TAU, -speed * cos);
    let envelope = |x: &Vector2<f64>| (-0.5 * ((x[1] - START) / SIGMA).powi(2)).exp();
    let displacement = space.interpolate(|x| direction * envelope(x) * k.dot(x).cos());
    let velocity = space.interpolate(|x| {
        let slope = -(x[1] - START) / (SIGMA * SIGMA) * envelope(x);
        direction * (omega * envelope(x) * k.dot(x).sin() - group * slope * k.dot(x).cos())
    });
    let (stiffness, mass) = (elasticity(&space, &ROCK)?, lumped_mass(&space, 1.0)?);
    let mut scene = Scene::new(stiffness.clone())
        .with_mass(mass.clone())
        .with_periodic(&left, &right)
        .with_displacement(displacement)
        .with_velocity(velocity);
    if !matches!(sides, Sides::Reflecting) {
        let impedance = Impedance::of(&ROCK, 1.0)?;
        let side = space.trace(|x| x[1] == 0.0)?;
        scene = scene.with_viscosity(dashpot(&space, &side, |_| impedance)?);
    }
    if let Sides::Sponge(width) = sides {
        let layer = Sponge::new(width, 3_f64.sqrt(), 0.1)?;
        scene = scene.with_viscosity(sponge(&space, &mass, |x| layer.rate(x[1]))?);
    }
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let total = |body: &Simulation<2>| {
        let at = body.snapshot();
        energy(&stiffness, at.displacement) + energy(&mass, at.velocity)
    };
    let start = total(&body);
    let dt = 0.02;
    let steps = (2.0 * START / (group.abs() * dt)).round() as usize;
    body.run(&Steps::constant(dt).count(steps), |_| ())?;
    Ok(total(&body) / start)
}

/// Less than 1 % of the energy comes back by a sponge of three wavelengths before dashpots.
#[test]
fn a_sponge_absorbs_at_all_angles() -> Outcome {
    for wave in [Wave::Pressure, Wave::Shear] {
        for degrees in [0.0, 30.0, 60.0] {
            let all = returned(wave, degrees, Sides::Reflecting)?;
            let dashpots = returned(wave, degrees, Sides::Dashpots)?;
            let narrow = returned(wave, degrees, Sides::Sponge(2.0))?;
            let wide = returned(wave, degrees, Sides::Sponge(3.0))?;
            let name = if wave == Wave::Shear { "S" } else { "P" };
            println!("| {name} | {degrees} | {dashpots:.4} | {narrow:.4} | {wide:.4} | {all:.6}");
            assert!((all - 1.0).abs() < 1e-6, "{all}");
            assert!(wide < 0.01, "{name} at {degrees}: {wide}");
        }
    }
    Ok(())
}
