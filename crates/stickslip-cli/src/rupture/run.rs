//! Dynamic earthquake rupture: a plane (mode II) rupture, TPV5, TPV6, TPV101, TPV103, TPV105 or TPV205 in two dimensions.
//!
//! One body stands for two halves, which move in opposite directions. Slip rate, slip and the laws' velocity and length
//! are half of those across the fault, and the normal traction stays constant. Under friction of rate and state the rupture
//! is symmetric, too: on the line through its middle the body moves along the fault alone. TPV6 has a body on each side
//! of the fault. Sides absorb the waves.
//!
//! ```text
//! stickslip rupture --scheme implicit --cell 100
//! stickslip rupture --problem tpv103
//! stickslip rupture --problem tpv6 --cell 100 --relaxation-distance 0.1
//! ```
//!
//! Parameters: R. Harris et al., Seismol. Res. Lett. 80 (2009) and 89 (2018), and the 2D setting of the code uguca.

use super::sides::Sides;
use super::{Arguments, Law, Rock, report, resolution, take};
use crate::cli::Problem;
use stickslip::fem::{P1, dashpot, elasticity, lumped_mass, mass, traction};
use stickslip::nalgebra::Vector2;
use stickslip::{
    CentralDifferences, Components, Condensed, Diagonal, GeneralizedAlpha, Scene, Simulation,
};

/// A dynamic rupture; that of TPV101 beside the numbers of a spectral code.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    let problem = arguments.problem;
    resolution::warn(arguments);
    let (space, mut rupture) = match problem.law() {
        Some(law) => of_rate_and_state(arguments, law)?,
        None => {
            let [above, below] = problem.rocks();
            let sides = Sides {
                arguments,
                patches: problem.patches(),
                above,
                below: problem.has_two_sides().then_some(below),
            };
            sides.build()?
        }
    };
    let run = take(arguments, &mut rupture)?;
    report(arguments, &space, &run)
}

/// The space and the simulation of half of a rupture by a law of rate and state.
fn of_rate_and_state(arguments: &Arguments, law: Law) -> Result<(P1<2>, Simulation<2>), Problem> {
    let [length, height] = [36e3, arguments.height];
    let space = P1::grid([length, height], [6, 5])?.graded(|x| arguments.size(x[1]))?;
    let fault = space.trace(|x| x[1] == 0.0)?;
    let top = space.trace(|x| x[1] == height)?;
    let middle = space.trace(|x| x[0] == 0.0)?;
    let image = space.trace(|x| x[0] == length)?;
    let (density, elastic) = (Rock::HARD.density, Rock::HARD.elastic()?);
    // The normal stress is there from the start and compresses nothing.
    let balance = traction(&space, &fault, |_| Vector2::new(0.0, -law.normal()))?;
    let pull = traction(&space, &fault, |x| Vector2::new(law.nucleation(x[0]), 0.0))?;
    let impedance = Rock::HARD.impedance()?;
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
        .with_scaled_load(pull, super::growth)
        .with_velocity(vec![
            Vector2::new(law.initial_rate(), 0.0);
            space.vertex_count()
        ]);
    let scene = law.on(scene, &fault)?;
    let rupture = if explicit {
        Simulation::new(scene, CentralDifferences, Diagonal::new())?
    } else {
        Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?
    };
    Ok((space, rupture))
}
