//! The slider's physics on a mesh of your own: the file, the frictional groups, the driven group or a compression.
//!
//! The scene needs only the names of the groups in a file of Gmsh, or their numbers where there are no names. A contact
//! may have any direction and be curved, in the plane or in space. On the boundary it slides on a rigid surface; along a
//! group inside the body the mesh is split, and one side slides on the other. The weight presses the body along the mean
//! normal of the first contact, or down the last axis if that is inside. The drive is tangential to it. Under compression there is neither.
//!
//! ```text
//! stickslip gmsh --mesh examples/meshes/block.msh --direction 1,0.5,0
//! stickslip gmsh crack.msh --contact crack --compression 1e6 --direction 1,0 --friction coulomb --coefficient 0.2
//! ```

use super::compression::{forces, without_rigid_modes};
use super::faults::{Fault, split};
use super::report::{report, take};
use super::{Arguments, Solver};
use crate::cli::Problem;
use stickslip::fem::{Mesh, P1, body_force, elasticity, mass};
use stickslip::fem::{ReadError, gmsh};
use stickslip::nalgebra::SVector;
use stickslip::problems::pipping_slider::{END, PippingSlider, load_velocity};
use stickslip::state::LogTheta;
use stickslip::{
    BackwardEuler, BlockMatrix, Cholesky, Condensed, GeneralizedAlpha, NonsmoothSolver, RateScheme,
    Scene, Simulation, Tnnmg,
};

/// The slider's physics on a mesh of Gmsh.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    // In space if there are tetrahedra, else in the plane.
    let file = arguments.mesh();
    let failed = |error: ReadError| {
        let (name, message) = (file.display().to_string(), error.to_string());
        if message.contains(&name) {
            message
        } else {
            format!("{name}: {message}")
        }
    };
    match gmsh::read::<3>(file) {
        Err(ReadError::Empty {
            what: "elements", ..
        }) => slide(arguments, gmsh::read::<2>(file).map_err(failed)?),
        mesh => slide(arguments, mesh.map_err(failed)?),
    }
}

fn slide<const D: usize>(arguments: &Arguments, mesh: Mesh<D>) -> Result<(), Problem> {
    let space = P1::new(split(mesh, &arguments.contact)?);
    let space = match arguments.solver {
        Solver::Condensed => space,
        Solver::Tnnmg | Solver::TnnmgSingle => space.with_auxiliary_levels()?,
    };
    let space = space.refined(arguments.refinements.into())?;
    let faults = Fault::all(&space, &arguments.contact)?;
    let direction = arguments.along(&faults[0].mean_normal())?;
    let probe = arguments.probe(&faults[0].part)?;

    let scene = Scene::new(elasticity(&space, &arguments.elastic())?);
    let scene = match arguments.compression {
        Some(pressure) => compressed(arguments, scene, &space, &faults, pressure)?,
        None => driven(arguments, scene, &space, &faults)?,
    };
    let (laws, initial) = (arguments.laws()?, LogTheta(arguments.initial_log_theta));
    let scene = faults.iter().fold(scene, |scene, fault| {
        let stress = (arguments.normal_stress(), arguments.allow_opening);
        laws.on_surface(scene, fault.surface(), stress, initial)
    });

    let solver: Box<dyn NonsmoothSolver<BlockMatrix<D>, D>> = match arguments.solver {
        Solver::Condensed => Box::new(Condensed::new()),
        Solver::Tnnmg => Box::new(Tnnmg::new(space.transfers())),
        Solver::TnnmgSingle => Box::new(Tnnmg::new(space.transfers()).in_single_precision()),
    };
    let scheme: Box<dyn RateScheme> = match arguments.compression {
        Some(_) => Box::new(BackwardEuler),
        None => Box::new(GeneralizedAlpha::default()),
    };
    let mut simulation = Simulation::new(scene, scheme, solver)?;
    let fault = (&space, &faults[..]);
    let run = take(arguments, &mut simulation, fault, probe, direction)?;
    report(arguments, &space, &faults, run)
}

/// The body with inertia and weight, its parts driven and fixed.
fn driven<const D: usize>(
    arguments: &Arguments,
    scene: Scene<BlockMatrix<D>, D>,
    space: &P1<D>,
    faults: &[Fault<D>],
) -> Result<Scene<BlockMatrix<D>, D>, Problem> {
    let (driven, opposite) = (arguments.driven(), arguments.opposite.as_deref());
    let named = |name: &str| faults.iter().any(|fault| fault.name == name);
    if named(driven) {
        return Err("what is driven cannot slide: --contact and --driven are one part".into());
    }
    if opposite.is_some_and(|opposite| opposite == driven || named(opposite)) {
        return Err("--opposite is the part of --driven or of --contact".into());
    }
    let normal = faults[0].mean_normal();
    let direction = arguments.along(&normal)?;
    let mut scene = scene.with_mass(mass(space, arguments.density)?);
    if !arguments.no_gravity {
        let down = match faults[0].minus {
            None => normal,
            Some(_) => SVector::from_fn(|c, _| if c + 1 == D { -1.0 } else { 0.0 }),
        };
        let weight = down * (arguments.density * PippingSlider::default().gravity);
        scene = scene.with_load(body_force(space, |_| weight));
    }
    let part = |option: &str, name: &str| {
        (space.part(name)).map_err(|error| format!("--{option} {name}: {error}"))
    };
    let moved = [("driven", Some(driven), 1.0), ("opposite", opposite, -1.0)];
    for (option, name, sign) in moved {
        if let Some(name) = name {
            let velocity = move |time: f64| (direction * (sign * load_velocity(time))).into();
            scene = scene.prescribe_velocity(&part(option, name)?, [true; D], velocity);
        }
    }
    for name in &arguments.fixed {
        scene = scene.fix(&part("fixed", name)?, [true; D]);
    }
    Ok(scene.in_equilibrium(Cholesky::new()))
}

/// The body without inertia and weight, under tractions that grow linearly in time.
fn compressed<const D: usize>(
    arguments: &Arguments,
    scene: Scene<BlockMatrix<D>, D>,
    space: &P1<D>,
    faults: &[Fault<D>],
    pressure: f64,
) -> Result<Scene<BlockMatrix<D>, D>, Problem> {
    if let Some(fault) = faults.iter().find(|fault| fault.minus.is_none()) {
        let name = &fault.name;
        let why =
            "--compression needs faults inside the body, with tractions on its whole boundary";
        return Err(format!("--contact {name} is on the boundary: {why}").into());
    }
    let forces = forces(space, faults, &arguments.axis()?, pressure);
    let scene = without_rigid_modes(scene, space, faults)?;
    Ok(scene.with_load_history(move |time, load| {
        for (load, force) in load.iter_mut().zip(&forces) {
            *load += force * (time / END);
        }
    }))
}
