//! A thrust that ends inside a block, under its weight and a push, in several processes.
//!
//! ```text
//! mpirun -n 4 target/release/examples/dipping_fault
//! ```

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use stickslip::fem::{Elastic, GridDiagonal, Mesh, body_force, elasticity};
use stickslip::friction::Tresca;
use stickslip::nalgebra::Vector2;
use stickslip::{BackwardEuler, Components, Contact, NormalStress, Scene, Simulation, Steps};
use stickslip_petsc::{
    Column, DistributedSpace, PetscGradients, PetscTnnmg, SharedHistory, World, run,
};

/// A block of sand of 4 m x 1.15 m on its base, with a fault that dips by 30 degrees and ends at half of its depth. The
/// normal stress comes from the deformation.
#[derive(Parser)]
struct Arguments {
    /// Uniform refinements of a mesh of 64 triangles
    #[arg(long, default_value_t = 3)]
    refinements: usize,
    /// Time steps of 0.25 s
    #[arg(long, default_value_t = 30)]
    steps: usize,
    /// The folder to write to
    #[arg(long, default_value = "out/dipping_fault")]
    out: PathBuf,
}

const SAND: Elastic = Elastic {
    young_modulus: 5e7,
    poisson_ratio: 0.3,
};
const SPECIFIC_WEIGHT: f64 = 5e3 * 9.81;
const COEFFICIENT: f64 = 0.4;

type Problem = Box<dyn std::error::Error>;

/// A grid whose diagonals rise by 30 degrees, split along that from (2, 0.58) m to the surface at (3, 1.15) m.
fn split_block() -> Result<Mesh<2>, Problem> {
    let slope = 30_f64.to_radians().tan();
    let grid = Mesh::<2>::grid([4.0, 2.0], [8, 4], GridDiagonal::Rising)?;
    let points = grid.vertices().iter();
    let points = points.map(|x| Vector2::new(x[0], slope * x[1]));
    let block = Mesh::new(points.collect(), grid.cells().flatten().copied().collect())?;
    let on_fault = |x: &Vector2<f64>| x[0] >= 2.0 && x[1] == slope * (x[0] - 1.0);
    Ok(block
        .with_surface_where("fault", on_fault)?
        .split("fault")?)
}

fn push(world: World, arguments: &Arguments) -> Result<(), Problem> {
    let space = DistributedSpace::new(world, split_block()?, arguments.refinements)?;
    let [plus, minus] = ["fault+", "fault-"].map(|side| space.named_part(side));
    let (plus, minus) = (plus?, minus?);
    let friction = Tresca {
        coefficient: COEFFICIENT,
    };
    let weight = body_force(space.local(), |_| Vector2::new(0.0, -SPECIFIC_WEIGHT));
    // Without a mass matrix: quasi-static.
    let scene = Scene::new(space.matrix(&elasticity(space.local(), &SAND)?)?)
        .with_load(space.field(&weight))
        .with_contact(Contact::between(
            &plus,
            &minus,
            friction,
            NormalStress::from_body(0.0),
        ))
        .fix(&space.part(|x| x[1] == 0.0)?, Components::ALL)
        .prescribe_velocity(
            &space.part(|x| x[0] == 0.0 && x[1] > 0.0)?,
            Components::X,
            |_| [1e-3, 0.0],
        )
        .in_equilibrium(PetscGradients::new(&space));
    let mut block = Simulation::new(scene, BackwardEuler, PetscTnnmg::new(&space))?;
    // In the middle of the fault, on the side of the footwall or of the hanging wall.
    let middle = |k: &usize| plus.points[*k][0] == 2.5;
    let place = (0..plus.points.len()).find(middle);
    let mut history = SharedHistory::new(world, place.map(|k| plus.vertices[k]));
    let (mut cycles, mut contraction) = (0, 0.0_f64);
    block.run(&Steps::constant(0.25).count(arguments.steps), |at| {
        history.record(&at);
        cycles += at.report.solver_iterations;
        contraction = contraction.max(at.report.contraction);
    })?;
    let mut columns = Column::motion(2);
    columns.extend([
        ("normal_stress", Column::NormalStress),
        ("max_slip_rate", Column::MaxSlipRate),
    ]);
    history.write(&arguments.out.join("history.csv"), &columns)?;
    if world.is_first() {
        let size = world.size();
        println!("{size} processes, cycles {cycles}, contraction {contraction:.3}");
    }
    Ok(())
}

fn main() -> ExitCode {
    run(|world| push(world, &Arguments::parse()))
}
