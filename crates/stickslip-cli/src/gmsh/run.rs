//! The slider's physics on a mesh of your own: the file, the sliding part, the driven part.
//!
//! The scene needs only the names of the groups in a file of Gmsh. The contact may have any direction and be curved, in
//! the plane or in space. The weight presses the body on it, along the contact's mean normal. The drive is tangential
//! to it.
//!
//! ```text
//! stickslip gmsh --mesh examples/meshes/block.msh --direction 1,0.5,0
//! ```

use super::{Arguments, Solver, mean_normal, report, take};
use crate::cli::Problem;
use stickslip::fem::{Mesh, P1, body_force, elasticity, mass};
use stickslip::fem::{ReadError, gmsh};
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, Cholesky, Condensed, Contact, GeneralizedAlpha, NonsmoothSolver, Scene,
    Simulation, Tnnmg,
};

/// The slider's physics on a mesh of Gmsh.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    // In space if there are tetrahedra, else in the plane.
    match gmsh::read::<3>(&arguments.mesh) {
        Err(ReadError::Empty {
            what: "elements", ..
        }) => slide(arguments, gmsh::read::<2>(&arguments.mesh)?),
        mesh => slide(arguments, mesh?),
    }
}

fn slide<const D: usize>(arguments: &Arguments, mesh: Mesh<D>) -> Result<(), Problem> {
    let space = P1::new(mesh)
        .with_auxiliary_levels()?
        .refined(arguments.refinements.into())?;
    let (fault, driven) = (
        space.part(&arguments.contact)?,
        space.part(&arguments.driven)?,
    );
    let PippingSlider {
        density,
        gravity,
        elastic,
        ..
    } = PippingSlider::default();
    if arguments.contact == arguments.driven {
        return Err("what is driven cannot slide: --contact and --driven are one part".into());
    }
    let down = mean_normal(&fault);
    let direction = arguments.along(&down)?;
    let probe = arguments.probe(&fault)?;
    let contact = Contact::new(&fault, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(mass(&space, density)?)
        .with_load(body_force(&space, |_| down * (density * gravity)))
        .with_contact(contact)
        .prescribe_velocity(&driven, [true; D], move |time| {
            (direction * load_velocity(time)).into()
        })
        .in_equilibrium(Cholesky::new());
    let solver: Box<dyn NonsmoothSolver<BlockMatrix<D>, D>> = match arguments.solver {
        Solver::Condensed => Box::new(Condensed::new()),
        Solver::Tnnmg => Box::new(Tnnmg::new(space.transfers())),
    };
    let mut simulation = Simulation::new(scene, GeneralizedAlpha::default(), solver)?;
    let run = take(arguments, &mut simulation, probe, direction);
    report(arguments, &space, run)
}
