//! Explicit steps of a block in space without a matrix, in several processes: what a step and a vertex cost.
//!
//! ```text
//! mpirun -n 4 target/release/examples/explicit3d --refinements 4
//! ```

use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use stickslip::fem::{Impedance, Mesh, dashpot, element_stiffness, lumped_mass};
use stickslip::nalgebra::Vector3;
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::LogTheta;
use stickslip::{CentralDifferences, Contact, Scene, Simulation, Staggered, StateUpdate};
use stickslip_petsc::{DistributedDiagonal, DistributedSpace, peak_memory, run};

/// A block of 4 m x 2 m x 2 m that slides on its base and radiates through its other sides.
#[derive(Parser)]
struct Arguments {
    /// Uniform refinements of sixteen unit cubes
    #[arg(long, default_value_t = 3)]
    refinements: usize,
    /// The number of steps, of half of the stable one
    #[arg(long, default_value_t = 100)]
    steps: usize,
}

fn main() -> ExitCode {
    run(|world| -> Result<(), Box<dyn std::error::Error>> {
        let Arguments { refinements, steps } = Arguments::parse();
        let PippingSlider {
            density, elastic, ..
        } = PippingSlider::default();
        let coarse = Mesh::<3>::grid([4.0, 2.0, 2.0], [4, 2, 2])?;
        let space = DistributedSpace::new(world, coarse, refinements)?;
        let (local, impedance) = (space.local(), Impedance::of(&elastic, density)?);
        let none = Impedance {
            normal: 0.0,
            tangential: 0.0,
        };
        let sides = dashpot(local, &local.trace(|_| true)?, |x| {
            let (side, top) = ([0.0, 4.0].contains(&x[0]), x[2] == 2.0);
            let end = [0.0, 2.0].contains(&x[1]);
            if side || end || top { impedance } else { none }
        })?;
        let contact = Contact::new(&space.part(|x| x[2] == 0.0)?, FRICTION, NORMAL_STRESS)
            .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
        let start = local.interpolate(|x| Vector3::new(1e-3 * (1.0 + x[0]), 0.0, 0.0));
        let scene = Scene::new(space.elements(&element_stiffness(local, &elastic)?)?)
            .with_mass(space.matrix(&lumped_mass(local, density)?)?)
            .with_viscosity(space.matrix(&sides)?)
            .with_contact(contact)
            .with_velocity(space.field(&start));
        let mut block = Simulation::new(scene, CentralDifferences, DistributedDiagonal::new())?
            .with_coupling(Staggered::default())
            .with_state_update(StateUpdate::Midpoint);
        block.step(1e-9)?;
        let dt = 0.5 * block.step_limit().unwrap_or_default();
        let clock = Instant::now();
        for _ in 0..steps {
            block.step(dt)?;
        }
        let each = 1e3 * clock.elapsed().as_secs_f64() / steps.max(1) as f64;
        let (vertices, memory) = (space.total_vertices(), world.largest(peak_memory()));
        let slip_rate = world.largest(block.snapshot().max_slip_rate());
        if world.is_first() {
            let processes = world.size();
            println!("{vertices} vertices, {processes} processes, {each:.3} ms a step");
            println!("at most {memory:.0} MB a process, largest slip rate {slip_rate:.6e} m/s");
        }
        Ok(())
    })
}
