//! The scene of an injection, and its run.

use stickslip::bie::{Fault, FaultGeometry, Medium, Mode, PlaneFault};
use stickslip::fields::Diffusion;
use stickslip::friction::{FrictionLaw, Tresca};
use stickslip::integrate::Stepper;
use stickslip::nalgebra::{DMatrix, Vector1};
use stickslip::state::{Dieterich, LogTheta, Ruina, StateLaw};
use stickslip::{
    BackwardEuler, BoundaryPart, Contact, DenseNewton, RungeKutta, Scene, Simulation, Steps,
};

use super::fault::Grid;
use super::record::Record;
use super::wells;
use super::{Arguments, Failed, Law};
use crate::earthquakes::state_for;

/// The largest number of cells of a dense matrix: 800 MB.
const DENSE: usize = 10_000;

/// Injects fluid into a fault, and writes and prints slip, pore pressure and fronts.
///
/// # Errors
/// In one line: a wrong setting, a wrong table of wells, a failed step, and a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failed> {
    let (geometry, wells) = (&arguments.geometry, wells::read(arguments)?);
    let grid = Grid::new(arguments)?;
    let field = grid.diffusion(&arguments.zone, &wells)?;
    let rock = Medium {
        shear_modulus: geometry.shear_modulus,
        shear_wave_speed: geometry.shear_wave_speed,
    };
    let mut motion = match grid {
        Grid::Line(cells) => motion(
            arguments,
            &Fault::whole_space(cells, rock, Mode::Antiplane)?,
            field,
        )?,
        Grid::Plane(cells) => {
            let fault = PlaneFault::whole_space(cells, rock, geometry.poisson_ratio)?;
            motion(arguments, &fault.with_rake(0.0)?, field)?
        }
    };
    let mut record = Record::new(arguments, &grid, &wells, &motion.snapshot())?;
    record.run(&steps(arguments), &mut *motion)
}

/// Adaptive steps, or equal ones under constant friction.
fn steps(arguments: &Arguments) -> Steps {
    let (time, constant) = (&arguments.time, arguments.friction.constant_friction);
    let steps = match constant {
        Some(_) => Steps::constant(time.end / time.steps.get() as f64),
        None => Steps::adaptive(time.adaptive).with_max_steps(usize::MAX),
    };
    steps.until(time.end)
}

/// The motion of a fault with the friction of a command line.
fn motion<G>(
    arguments: &Arguments,
    fault: &G,
    field: Diffusion,
) -> Result<Box<dyn Stepper<1>>, Failed>
where
    G: FaultGeometry<1>,
    G::Kernel: 'static,
    for<'a> DMatrix<f64>: From<&'a G::Kernel>,
{
    let (geometry, friction) = (&arguments.geometry, &arguments.friction);
    let part = BoundaryPart::from(fault.cells());
    let kernels = [fault.stiffness(), fault.radiation_damping()];
    if let Some(coefficient) = friction.constant_friction {
        let count = part.vertices.len();
        if count > DENSE {
            return Err(format!(
                "--constant-friction takes a dense matrix, of at most {DENSE} cells, not {count}: raise --cell"
            )
            .into());
        }
        let contact = Contact::new(part, Tresca { coefficient }, geometry.normal_stress);
        let [stiffness, damping] = kernels.each_ref().map(DMatrix::from);
        let scene = Scene::new(stiffness)
            .with_viscosity(damping)
            .with_contact(pressed(arguments, contact, field));
        return Ok(Box::new(Simulation::new(
            scene,
            BackwardEuler,
            DenseNewton::new(),
        )?));
    }
    let (law, rate) = (friction.of_rate_and_state(), friction.initial_rate);
    let radiated = 0.5 * geometry.shear_modulus / geometry.shear_wave_speed * rate;
    let ratio = (geometry.shear_stress - radiated) / geometry.normal_stress;
    if ratio <= 0.0 || friction.b == 0.0 {
        return Err(format!(
            "no state balances a shear stress of {} Pa at {rate} m/s: raise --shear-stress and --b, or take \
             --constant-friction",
            geometry.shear_stress
        )
        .into());
    }
    let state = LogTheta(state_for(&law, ratio, rate));
    let contact = Contact::new(part, law, geometry.normal_stress);
    let slip_distance = friction.slip_distance;
    let [stiffness, damping] = kernels;
    let velocity = vec![Vector1::new(rate); fault.cells().areas.len()];
    let scene = Scene::new(stiffness)
        .with_viscosity(damping)
        .with_velocity(velocity);
    let scene = match friction.law {
        Law::Aging => {
            let contact = contact.with_state(Dieterich { slip_distance }, state);
            scene.with_contact(pressed(arguments, contact, field))
        }
        Law::Slip => {
            let contact = contact.with_state(Ruina { slip_distance }, state);
            scene.with_contact(pressed(arguments, contact, field))
        }
    };
    Ok(Box::new(RungeKutta::new(scene)?))
}

/// A contact under shear stress and pore pressure.
fn pressed<L: FrictionLaw, S: StateLaw>(
    arguments: &Arguments,
    contact: Contact<L, S, 1>,
    field: Diffusion,
) -> Contact<L, S, 1> {
    let zone = &arguments.zone;
    let shear = Vector1::new(arguments.geometry.shear_stress);
    let mut contact = contact.with_shear_stress(shear).with_field(field);
    if let Some(least) = zone.least_normal_stress {
        contact = contact.with_least_normal_stress(least);
    }
    if zone.allow_opening {
        contact = contact.allow_opening();
    }
    contact
}
