//! A layer between two surfaces with laws of different types in several processes, in plane strain or antiplane shear.
//!
//! ```text
//! mpirun -n 4 target/release/examples/two_contacts --antiplane
//! ```

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use stickslip::fem::{Assembled, GridDiagonal, Mesh, antiplane, elasticity, mass};
use stickslip::friction::Tresca;
use stickslip::problems::pipping_slider::{AGING, FRICTION, INITIAL_LOG_THETA, PippingSlider};
use stickslip::state::LogTheta;
use stickslip::{Contact, Newmark, Scene, Simulation, Steps};
use stickslip_petsc::{
    Column, DistributedSpace, PetscGradients, PetscTnnmg, SharedHistory, World, run,
};

/// A layer of 4 m x 1 m that is pulled by its right edge: a weakening seam below, a constant coefficient above.
#[derive(Parser)]
struct Arguments {
    /// Uniform refinements of a mesh of eight triangles
    #[arg(long, default_value_t = 3)]
    refinements: usize,
    /// Time steps of 2 ms
    #[arg(long, default_value_t = 400)]
    steps: usize,
    /// Antiplane shear
    #[arg(long)]
    antiplane: bool,
    /// The folder to write to
    #[arg(long, default_value = "out/two_contacts")]
    out: PathBuf,
}

/// \[Pa\], low enough for the seam to slide without a jump.
const PRESSURE: f64 = 5e3;

type Problem = Box<dyn std::error::Error>;

/// Runs the layer with `C` components, of which the first is along the surfaces.
fn slide<const C: usize>(
    world: World,
    arguments: &Arguments,
    space: &DistributedSpace<2>,
    stiffness: &Assembled<C>,
) -> Result<(), Problem> {
    let density = PippingSlider::default().density;
    let seam = Contact::new(&space.part(|x| x[1] == 0.0)?, FRICTION, PRESSURE);
    let guide = Tresca { coefficient: 0.1 };
    let guide = Contact::new(&space.part(|x| x[1] == 1.0)?, guide, PRESSURE);
    let scene = Scene::new(space.matrix(stiffness)?)
        .with_mass(space.matrix(&mass(space.local(), density)?)?)
        .with_contact(seam.with_state(AGING, LogTheta(INITIAL_LOG_THETA)))
        .with_contact(guide)
        .prescribe_velocity(&space.part(|x| x[0] == 4.0)?, [true; C], |time| {
            std::array::from_fn(|c| if c == 0 { 2e-2 * time.min(0.1) } else { 0.0 })
        })
        .in_equilibrium(PetscGradients::new(space));
    let mut layer = Simulation::new(scene, Newmark::default(), PetscTnnmg::new(space))?
        .with_absolute_tolerance(1e-12)?;
    let mut history = SharedHistory::new(world, space.vertex_at([2.0, 0.0]));
    let mut cycles = 0;
    layer.run(&Steps::constant(2e-3).count(arguments.steps), |at| {
        history.record(&at);
        cycles += at.report.solver_iterations;
    })?;
    let mut columns = Column::motion(C);
    columns.extend([
        ("alpha", Column::State),
        ("max_slip_rate", Column::MaxSlipRate),
    ]);
    history.write(&arguments.out.join("history.csv"), &columns)?;
    if world.is_first() {
        println!("{} processes, cycles {cycles}", world.size());
    }
    Ok(())
}

fn main() -> ExitCode {
    run(|world| -> Result<(), Problem> {
        let arguments = Arguments::parse();
        let elastic = PippingSlider::default().elastic;
        let coarse = Mesh::<2>::grid([4.0, 1.0], [4, 1], GridDiagonal::Rising)?;
        let space = DistributedSpace::new(world, coarse, arguments.refinements)?;
        if arguments.antiplane {
            let stiffness = antiplane(space.local(), elastic.lame()?.1)?;
            slide(world, &arguments, &space, &stiffness)
        } else {
            let stiffness = elasticity(space.local(), &elastic)?;
            slide(world, &arguments, &space, &stiffness)
        }
    })
}
