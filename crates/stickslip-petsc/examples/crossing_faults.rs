//! A block in space with two faults that cross, of which one ends inside, in several processes.
//!
//! ```text
//! mpirun -n 4 target/release/examples/crossing_faults
//! ```

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use stickslip::fem::{Elastic, Mesh, elasticity};
use stickslip::friction::Tresca;
use stickslip::{BackwardEuler, Components, Contact, NormalStress, Scene, Simulation, Steps};
use stickslip_petsc::{Column, DistributedSpace, PetscTnnmg, SharedHistory, World, run};

/// A cube of 4 m that is compressed and sheared by its top. A level fault ends 1 m before a wall, an upright one 1 m
/// before another; the normal stress comes from the deformation.
#[derive(Parser)]
struct Arguments {
    /// Uniform refinements of a mesh of 384 tetrahedra
    #[arg(long, default_value_t = 1)]
    refinements: usize,
    /// Time steps of 0.1 s
    #[arg(long, default_value_t = 5)]
    steps: usize,
    /// The folder to write to
    #[arg(long, default_value = "out/crossing_faults")]
    out: PathBuf,
}

const SOFT: Elastic = Elastic {
    young_modulus: 1e3,
    poisson_ratio: 0.25,
};

type Problem = Box<dyn std::error::Error>;

fn shear(world: World, arguments: &Arguments) -> Result<(), Problem> {
    let cube = Mesh::<3>::grid([4.0; 3], [4; 3])?
        .with_surface_where("level", |x| x[2] == 2.0 && x[0] <= 3.0)?
        .with_surface_where("upright", |x| x[0] == 2.0 && x[1] >= 1.0)?
        .split_all(["level", "upright"])?;
    let space = DistributedSpace::new(world, cube, arguments.refinements)?;
    let between = |name: &str| -> Result<_, Problem> {
        let [plus, minus] = ["+", "-"].map(|side| space.named_part(&format!("{name}{side}")));
        let friction = Tresca { coefficient: 0.3 };
        let from_body = NormalStress::from_body(1.0);
        Ok(Contact::between(&plus?, &minus?, friction, from_body))
    };
    let upright = space.named_part("upright+")?;
    // Without a mass matrix: quasi-static.
    let scene = Scene::new(space.matrix(&elasticity(space.local(), &SOFT)?)?)
        .with_contact(between("upright")?)
        .with_contact(between("level")?)
        .fix(&space.part(|x| x[2] == 0.0)?, Components::ALL)
        .prescribe_velocity(&space.part(|x| x[2] == 4.0)?, Components::ALL, |_| {
            [0.1, 0.02, -0.3]
        });
    let mut cube = Simulation::new(scene, BackwardEuler, PetscTnnmg::new(&space))?;
    let watched = |k: &usize| upright.points[*k] == [2.0, 3.0, 3.0];
    let place = (0..upright.points.len()).find(watched);
    let mut history = SharedHistory::new(world, place.map(|k| upright.vertices[k]));
    let mut cycles = 0;
    cube.run(&Steps::constant(0.1).count(arguments.steps), |at| {
        history.record(&at);
        cycles += at.report.solver_iterations;
    })?;
    let mut columns = Column::motion(3);
    columns.extend([
        ("normal_stress", Column::NormalStress),
        ("max_slip_rate", Column::MaxSlipRate),
    ]);
    history.write(&arguments.out.join("history.csv"), &columns)?;
    if world.is_first() {
        println!("{} processes, cycles {cycles}", world.size());
    }
    Ok(())
}

fn main() -> ExitCode {
    run(|world| shear(world, &Arguments::parse()))
}
