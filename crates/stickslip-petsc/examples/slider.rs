//! The paper's slider in several processes; its serial twin is `examples/slider.rs`.
//!
//! ```text
//! mpirun -n 4 target/release/examples/slider --refinements 4
//! ```

mod kept;

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use stickslip::fem::{GridDiagonal, Mesh, body_force, elasticity, mass};
use stickslip::nalgebra::Vector2;
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::state::LogTheta;
use stickslip::{Contact, FixedPoint, Newmark, Scene, Simulation, StateUpdate};
use stickslip_cli::checkpoints::Checkpoints;
use stickslip_petsc::{Column, DistributedSpace, PetscGradients, PetscTnnmg, SharedHistory, run};

use kept::Kept;

/// The columns of the serial twin.
const COLUMNS: [(&str, Column); 8] = [
    ("step", Column::Step),
    ("time", Column::Time),
    ("displacement", Column::Displacement(0)),
    ("velocity", Column::Velocity(0)),
    ("alpha", Column::State),
    ("max_slip_rate", Column::MaxSlipRate),
    ("fixed_point_iterations", Column::CouplingIterations),
    ("solver_iterations", Column::SolverIterations),
];

/// Stick and slip of an elastic body that is pulled over a rigid surface, in several processes.
#[derive(Parser)]
struct Arguments {
    /// Uniform refinements of the mesh of ten triangles
    #[arg(long, default_value_t = 4)]
    refinements: usize,
    /// Time steps in the whole 15 s
    #[arg(long, default_value_t = 10000)]
    steps: usize,
    /// The share of the 15 s after which to stop
    #[arg(long, default_value_t = 1.0)]
    until: f64,
    /// The tolerance of the coupling of rate and state
    #[arg(long, default_value_t = 1e-10)]
    tolerance: f64,
    /// The folder to write to
    #[arg(long, default_value = "out/slider")]
    out: PathBuf,
    /// The checkpoint file of the run, and the file of its restart.
    #[command(flatten)]
    checkpoints: Checkpoints,
}

fn main() -> ExitCode {
    run(|world| -> Result<(), Box<dyn std::error::Error>> {
        let arguments = Arguments::parse();
        if arguments.steps == 0 || !(arguments.until > 0.0 && arguments.until <= 1.0) {
            return Err("--steps must be positive, --until above 0 and at most 1".into());
        }
        let PippingSlider {
            density,
            gravity,
            elastic,
            ..
        } = PippingSlider::default();
        let coarse = Mesh::<2>::grid([5.0, 1.0], [5, 1], GridDiagonal::Rising)?;
        let space = DistributedSpace::new(world, coarse, arguments.refinements)?;
        let weight = Vector2::new(0.0, -density * gravity);
        let contact = Contact::new(&space.part(|x| x[1] == 0.0)?, FRICTION, NORMAL_STRESS);
        let scene = Scene::new(space.matrix(&elasticity(space.local(), &elastic)?)?)
            .with_mass(space.matrix(&mass(space.local(), density)?)?)
            .with_load(space.field(&body_force(space.local(), |_| weight)))
            .with_contact(contact.with_state(AGING, LogTheta(INITIAL_LOG_THETA)))
            .prescribe_velocity(&space.part(|x| x[1] == 1.0)?, [true; 2], |time| {
                [load_velocity(time), 0.0]
            })
            .in_equilibrium(PetscGradients::new(&space))
            .with_zero_acceleration();
        let mut slider = Simulation::new(scene, Newmark::default(), PetscTnnmg::new(&space))?
            .with_coupling(FixedPoint::paper())
            .with_state_update(StateUpdate::BackwardEuler)
            .with_absolute_tolerance(arguments.tolerance)?;
        let mut history = SharedHistory::new(world, space.vertex_at([2.5, 0.0]));
        let clock = Instant::now();
        let run = Kept {
            space: &space,
            files: &arguments.checkpoints,
            tags: vec![
                ("example", "slider".into()),
                ("refinements", arguments.refinements.to_string()),
                ("steps", arguments.steps.to_string()),
                ("tolerance", arguments.tolerance.to_string()),
            ],
            step: END / arguments.steps as f64,
            count: (arguments.until * arguments.steps as f64).round() as usize,
        };
        let (taken, record) = run.take(&mut slider, &mut history)?;
        std::fs::create_dir_all(&arguments.out)?;
        history.write(&arguments.out.join("history.csv"), &COLUMNS)?;
        let (vertices, time) = (space.total_vertices(), clock.elapsed().as_secs_f64());
        if world.is_first() {
            let each = 1e3 * time / taken.max(1) as f64;
            println!(
                "{vertices} vertices, {} processes, {each:.3} ms a step",
                world.size()
            );
            let (couplings, cycles) = (record.couplings, record.cycles);
            println!("coupling iterations {couplings}, cycles {cycles}");
        }
        Ok(())
    })
}
