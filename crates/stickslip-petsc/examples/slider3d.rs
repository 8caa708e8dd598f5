//! The slider in three dimensions in several processes; its serial twin is `examples/slider3d.rs`.
//!
//! ```text
//! mpirun -n 4 target/release/examples/slider3d --refinements 2
//! ```

mod kept;

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use stickslip::fem::{Mesh, body_force, elasticity, mass};
use stickslip::friction::DieterichRuina;
use stickslip::nalgebra::Vector3;
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::state::LogTheta;
use stickslip::{Contact, Newmark, Scene, Simulation};
use stickslip_cli::checkpoints::Checkpoints;
use stickslip_petsc::{Column, DistributedSpace, PetscGradients, PetscTnnmg, SharedHistory, run};

use kept::Kept;

/// The columns of the serial twin.
const COLUMNS: [(&str, Column); 7] = [
    ("time", Column::Time),
    ("slip_x", Column::Slip(0)),
    ("slip_y", Column::Slip(1)),
    ("velocity_x", Column::Velocity(0)),
    ("velocity_y", Column::Velocity(1)),
    ("alpha", Column::State),
    ("max_slip_rate", Column::MaxSlipRate),
];

/// A body of 5 m x 1 m x 1 m, moved obliquely at its top, on a weakening patch with a strengthening rim.
#[derive(Parser)]
struct Arguments {
    /// Uniform refinements of five unit cubes
    #[arg(long, default_value_t = 2)]
    refinements: usize,
    /// The angle of the motion off the long side [degrees]
    #[arg(long, default_value_t = 20.0)]
    degrees: f64,
    /// Time steps in the whole 15 s
    #[arg(long, default_value_t = 10000)]
    steps: usize,
    /// The share of the 15 s after which to stop
    #[arg(long, default_value_t = 0.8)]
    until: f64,
    /// The folder to write to
    #[arg(long, default_value = "out/slider3d")]
    out: PathBuf,
    /// The checkpoint file of the run, and the file of its restart.
    #[command(flatten)]
    checkpoints: Checkpoints,
}

/// `a` grows from 0.010 to 0.020 towards the edge, over 0.7 m at the ends and 0.2 m at the sides.
fn law(x: f64, y: f64) -> DieterichRuina {
    let from_end = x.min(5.0 - x) / 0.7;
    let from_side = y.min(1.0 - y) / 0.2;
    let rim = 1.0 - from_end.min(from_side).min(1.0);
    let a = 0.010 + 0.010 * rim;
    DieterichRuina { a, ..FRICTION }
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
        let coarse = Mesh::<3>::grid([5.0, 1.0, 1.0], [5, 1, 1])?;
        let space = DistributedSpace::new(world, coarse, arguments.refinements)?;
        let weight = Vector3::new(0.0, 0.0, -density * gravity);
        let bottom = space.part(|x| x[2] == 0.0)?;
        let laws = bottom.points.iter().map(|x| law(x[0], x[1]));
        let contact = Contact::per_vertex(&bottom, laws, NORMAL_STRESS);
        let (sin, cos) = arguments.degrees.to_radians().sin_cos();
        let scene = Scene::new(space.matrix(&elasticity(space.local(), &elastic)?)?)
            .with_mass(space.matrix(&mass(space.local(), density)?)?)
            .with_load(space.field(&body_force(space.local(), |_| weight)))
            .with_contact(contact.with_state(AGING, LogTheta(INITIAL_LOG_THETA)))
            .prescribe_velocity(&space.part(|x| x[2] == 1.0)?, [true; 3], move |time| {
                [cos, sin, 0.0].map(|part| part * load_velocity(time))
            })
            .in_equilibrium(PetscGradients::new(&space));
        let mut slider = Simulation::new(scene, Newmark::default(), PetscTnnmg::new(&space))?;
        let mut history = SharedHistory::new(world, space.vertex_at([2.5, 0.5, 0.0]));
        history.record(&slider.snapshot());
        let clock = Instant::now();
        let run = Kept {
            space: &space,
            files: &arguments.checkpoints,
            tags: vec![
                ("example", "slider3d".into()),
                ("refinements", arguments.refinements.to_string()),
                ("degrees", arguments.degrees.to_string()),
                ("steps", arguments.steps.to_string()),
            ],
            step: END / arguments.steps as f64,
            count: (arguments.until * arguments.steps as f64).round() as usize,
        };
        let (taken, record) = run.take(&mut slider, &mut history)?;
        std::fs::create_dir_all(&arguments.out)?;
        history.write(&arguments.out.join("history.csv"), &COLUMNS)?;
        let (vertices, time) = (space.total_vertices(), clock.elapsed().as_secs_f64());
        let memory = world.largest(stickslip_petsc::peak_memory());
        if world.is_first() {
            let each = 1e3 * time / taken.max(1) as f64;
            println!(
                "{vertices} vertices, {} processes, {each:.3} ms a step",
                world.size()
            );
            let cycles = record.cycles;
            println!("cycles {cycles}, at most {memory:.0} MB a process");
        }
        Ok(())
    })
}
