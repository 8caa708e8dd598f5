//! Two blocks that slide on each other through events, as the slider of the paper on its mirror image, in several
//! processes.
//!
//! ```text
//! mpirun -n 4 target/release/examples/two_sides
//! ```

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use stickslip::fem::{GridDiagonal, Mesh, elasticity, mass};
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::state::LogTheta;
use stickslip::{Components, Contact, GeneralizedAlpha, NormalStress, Scene, Simulation, Steps};
use stickslip_petsc::{Column, DistributedSpace, PetscTnnmg, SharedHistory, World, run};

/// Two blocks of 5 m x 1 m. The upper one is driven at its top by ten times the velocity of the paper, the lower one is
/// held at its bottom, and the normal stress follows the deformation.
#[derive(Parser)]
struct Arguments {
    /// Uniform refinements of a mesh of 40 triangles
    #[arg(long, default_value_t = 2)]
    refinements: usize,
    /// Time steps of 1e-4 of the time of the paper
    #[arg(long, default_value_t = 2400)]
    steps: usize,
    /// The folder to write to
    #[arg(long, default_value = "out/two_sides")]
    out: PathBuf,
}

type Problem = Box<dyn std::error::Error>;

fn slide(world: World, arguments: &Arguments) -> Result<(), Problem> {
    let paper = PippingSlider::default();
    let blocks = Mesh::<2>::grid([5.0, 2.0], [10, 4], GridDiagonal::Rising)?
        .with_surface_where("fault", |x| x[1] == 1.0)?
        .split("fault")?;
    let space = DistributedSpace::new(world, blocks, arguments.refinements)?;
    let [plus, minus] = ["fault+", "fault-"].map(|side| space.named_part(side));
    let (plus, minus) = (plus?, minus?);
    let pressure = NormalStress::from_body(NORMAL_STRESS);
    let contact = Contact::between(&plus, &minus, FRICTION, pressure)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = Scene::new(space.matrix(&elasticity(space.local(), &paper.elastic)?)?)
        .with_mass(space.matrix(&mass(space.local(), paper.density)?)?)
        .prescribe_velocity(&space.part(|x| x[1] == 2.0)?, Components::ALL, |time| {
            [10.0 * load_velocity(time), 0.0]
        })
        .fix(&space.part(|x| x[1] == 0.0)?, Components::ALL)
        .with_contact(contact);
    let solver = PetscTnnmg::new(&space);
    let mut blocks = Simulation::new(scene, GeneralizedAlpha::default(), solver)?;
    let middle = |k: &usize| plus.points[*k][0] == 2.5;
    let place = (0..plus.points.len()).find(middle);
    let mut history = SharedHistory::new(world, place.map(|k| plus.vertices[k]));
    let mut cycles = 0;
    let step = END / 1e4;
    blocks.run(&Steps::constant(step).count(arguments.steps), |at| {
        history.record(&at);
        cycles += at.report.solver_iterations;
    })?;
    let mut columns = Column::motion(2);
    columns.extend([
        ("normal_stress", Column::NormalStress),
        ("state", Column::State),
        ("max_slip_rate", Column::MaxSlipRate),
    ]);
    history.write(&arguments.out.join("history.csv"), &columns)?;
    if world.is_first() {
        println!("{} processes, cycles {cycles}", world.size());
    }
    Ok(())
}

fn main() -> ExitCode {
    run(|world| slide(world, &Arguments::parse()))
}
