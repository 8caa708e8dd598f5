//! Dynamic earthquake rupture: a plane (mode II) rupture, TPV101, TPV103 or TPV105 in two dimensions.
//!
//! One body stands for two halves, which move in opposite directions. Slip rate, slip and the laws' velocity and length
//! are half of those across the fault, and the normal traction stays constant. The rupture is symmetric, too: on the
//! line through its middle the body moves along the fault alone. The top absorbs the waves.
//!
//! ```text
//! stickslip rupture --scheme implicit --cell 100
//! stickslip rupture --law strong-weakening
//! stickslip rupture --law strong-weakening --thermal-pressurization
//! ```
//!
//! Parameters: R. Harris et al., Seismol. Res. Lett. 89 (2018), and the 2D setting of the code uguca.

use super::{Arguments, report, take};
use crate::cli::Problem;
use stickslip::fem::{Elastic, Impedance, P1, dashpot, elasticity, lumped_mass, mass, traction};
use stickslip::nalgebra::Vector2;
use stickslip::{
    CentralDifferences, Components, Condensed, Diagonal, GeneralizedAlpha, Scene, Simulation,
};

/// A dynamic rupture; that of TPV101 beside the numbers of a spectral code.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    let (law, [length, height]) = (arguments.fault()?, [36e3, arguments.height]);
    let space = P1::grid([length, height], [6, 5])?.graded(|x| arguments.size(x[1]))?;
    let fault = space.trace(|x| x[1] == 0.0)?;
    let top = space.trace(|x| x[1] == height)?;
    let middle = space.trace(|x| x[0] == 0.0)?;
    let image = space.trace(|x| x[0] == length)?;
    // c_s = 3464 m/s and c_p = 6000 m/s.
    let (density, elastic) = (2670.0, Elastic::of_waves(2670.0, 6000.0, 3464.0)?);
    // The normal stress is there from the start and compresses nothing.
    let balance = traction(&space, &fault, |_| Vector2::new(0.0, -law.normal()))?;
    let pull = traction(&space, &fault, |x| Vector2::new(law.nucleation(x[0]), 0.0))?;
    let impedance = Impedance::of(&elastic, density)?;
    let explicit = arguments.explicit();
    let inertia = if explicit {
        lumped_mass(&space, density)?
    } else {
        mass(&space, density)?
    };
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(inertia)
        .with_viscosity(dashpot(&space, &top, |_| impedance)?)
        .fix(&middle, Components::Y)
        .fix(&image, Components::Y)
        .with_load(balance)
        .with_load_history(move |time, load| super::grow(time, &pull, load))
        .with_velocity(vec![
            Vector2::new(law.initial_rate(), 0.0);
            space.vertex_count()
        ]);
    let scene = law.on(scene, &fault)?;
    let mut rupture = if explicit {
        Simulation::new(scene, CentralDifferences, Diagonal::new())?
    } else {
        Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?
    };
    let run = take(arguments, &mut rupture)?;
    report(arguments, &space, &run)
}
