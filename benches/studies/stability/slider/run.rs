//! A body with its laws, solver and coupling through its steps.

use nalgebra::SVector;
use stickslip::fem::{P1, Trace, body_force, elasticity, mass};
use stickslip::friction::{DieterichRuina, Tresca};
use stickslip::problems::pipping_slider::load_velocity;
use stickslip::state::{Discontinuous, LogTheta, StateLaw, Theta};
use stickslip::{
    BlockGaussSeidel, BlockMatrix, Cholesky, Condensed, Contact, LinearSolver, MultigridSolver,
    Newmark, NonsmoothSolver, Scene, Simulation, StateUpdate, Tnnmg,
};
use stickslip_cli::laws::{Friction, Law, Laws};

use super::Solver;
use super::body::Body;
use super::units::SI;
use crate::accuracy::TOLERANCE;
use crate::case::{IntoControlFlow, Refusal};
use crate::check::Check;
use crate::march::{Twin, march};
use crate::method::Method;
use crate::setup::Setup;

type AnySolver<const D: usize> = Box<dyn NonsmoothSolver<BlockMatrix<D>, D>>;
type AnyLinearSolver<const D: usize> = Box<dyn LinearSolver<BlockMatrix<D>, D>>;
type Judged<const D: usize> = (Simulation<D>, Check<BlockMatrix<D>, D>);

pub(super) fn run<const D: usize>(
    body: &Body<D>,
    solver: Solver,
    coupling: (Method, StateUpdate),
    law: Law,
) -> Result<IntoControlFlow, Refusal> {
    let (mut simulation, check) = judged(body, solver, coupling, law)?;
    let (steps, dt) = (body.steps, body.numbers.dt);
    let mut twin = None;
    // The discontinuous law is another one in every unit of length: theta' = V.
    if body.units != SI && body.tolerance_in_units && law != Law::Discontinuous {
        let si = Body {
            units: SI,
            ..body.clone()
        };
        let (simulation, check) = judged(&si, solver, coupling, law)?;
        let (length, units) = (body.units.length, body.units);
        twin = Some(Twin {
            simulation,
            check,
            length,
            convert: Box::new(move |si, state| units.convert(si, state)),
        });
    }
    Ok(march(
        &mut simulation,
        &check,
        twin.as_mut(),
        (steps, dt, body.pace),
    ))
}

/// The body in motion, and what judges its steps.
fn judged<const D: usize>(
    body: &Body<D>,
    solver: Solver,
    (method, update): (Method, StateUpdate),
    law: Law,
) -> Result<Judged<D>, Refusal> {
    let size = body.size.map(|size| size * body.units.length);
    let space = P1::grid(size, body.cells)?.refined(body.refinements)?;
    let (solver, linear) = solvers(solver, &space);
    let scene = slide(scene(body, &space, linear)?, body, &space, law)?;
    let tolerance = if body.tolerance_in_units {
        TOLERANCE * body.units.norm()
    } else {
        TOLERANCE
    };
    let simulation = Simulation::new(scene, Newmark::default(), solver)?;
    let simulation = simulation
        .with_state_update(update)
        .with_absolute_tolerance(tolerance)?;
    let simulation = method.on(simulation);
    let load = load(body, &space);
    let check = Check::of(&simulation, move |_| load.clone(), &mut Cholesky::new())?;
    Ok((simulation, check.with_tolerance(tolerance)))
}

/// A solver of the steps, and one of its kind of the equilibrium.
fn solvers<const D: usize>(solver: Solver, space: &P1<D>) -> (AnySolver<D>, AnyLinearSolver<D>) {
    let transfers = space.transfers();
    match solver {
        Solver::Tnnmg => (
            Box::new(Tnnmg::new(transfers)),
            Box::new(MultigridSolver::new(transfers)),
        ),
        Solver::Condensed => (Box::new(Condensed::new()), Box::new(Cholesky::new())),
        Solver::GaussSeidel => (Box::new(BlockGaussSeidel::new()), Box::new(Cholesky::new())),
    }
}

/// The vertices with that extreme coordinate.
fn side<const D: usize>(space: &P1<D>, axis: usize, place: f64) -> Result<Trace<D>, Refusal> {
    Ok(space.trace(|x| x[axis] == place)?)
}

/// Its weight; a body without inertia weighs as much as the paper's.
fn load<const D: usize>(body: &Body<D>, space: &P1<D>) -> Vec<SVector<f64, D>> {
    let density = body.density.unwrap_or(5e3) * body.units.density(D as i32);
    let mut weight = SVector::zeros();
    weight[D - 1] = -9.81 * body.units.length * density;
    body_force(space, |_| weight)
}

/// The body with its loads, in equilibrium; the contacts are still missing.
fn scene<const D: usize>(
    body: &Body<D>,
    space: &P1<D>,
    linear: AnyLinearSolver<D>,
) -> Result<Scene<BlockMatrix<D>, D>, Refusal> {
    let (units, dimension) = (body.units, D as i32);
    let size = body.size.map(|size| size * units.length);
    let height = size[D - 1];
    let mut elastic = body.elastic;
    elastic.young_modulus *= units.stress(dimension);
    // Along the first axis; a block in three dimensions obliquely.
    let drive = move |time| {
        let mut velocity = [0.0; D];
        velocity[0] = load_velocity(time) * units.length;
        if D == 3 {
            velocity[1] = 0.5 * velocity[0];
        }
        velocity
    };
    let mut scene = Scene::new(elasticity(space, &elastic)?)
        .on(space)
        .with_load(load(body, space));
    scene = match body.guide {
        None => scene.prescribe_velocity(&side(space, D - 1, height)?, [true; D], drive),
        Some(_) => {
            let mut along = [true; D];
            along[D - 1] = false;
            scene.prescribe_velocity(&side(space, 0, size[0])?, along, drive)
        }
    };
    scene = scene.in_equilibrium(linear);
    if let Some(density) = body.density {
        scene = scene.with_mass(mass(space, density * units.density(dimension))?);
    }
    let rate = body.numbers.slip_rate * units.length;
    if rate != 0.0 {
        let start = |x: &SVector<f64, D>| {
            let mut velocity = SVector::zeros();
            velocity[0] = if x[D - 1] < height { rate } else { 0.0 };
            velocity
        };
        scene = scene.with_velocity(space.interpolate(start));
    }
    Ok(scene)
}

/// The scene with its contacts, whose parameters may differ from vertex to vertex.
fn slide<const D: usize>(
    scene: Scene<BlockMatrix<D>, D>,
    body: &Body<D>,
    space: &P1<D>,
    law: Law,
) -> Result<Scene<BlockMatrix<D>, D>, Refusal> {
    let (units, stress) = (body.units, body.units.stress(D as i32));
    let bottom = side(space, D - 1, 0.0)?;
    let numbers: Vec<Setup> = (0..bottom.vertices().len())
        .map(|k| body.numbers_at(k))
        .collect();
    let laws = numbers.iter().map(|numbers| {
        let mut laws: Laws = numbers.laws(law, Friction::DieterichRuina);
        laws.parameters.reference_velocity *= units.length;
        laws.parameters.slip_distance *= units.length;
        laws
    });
    let frictions: Vec<DieterichRuina> = laws.clone().map(|laws| laws.parameters).collect();
    let stresses: Vec<f64> = numbers
        .iter()
        .map(|numbers| numbers.normal_stress * stress)
        .collect();
    let contact = Contact::per_vertex(&bottom, frictions, stresses);
    let alpha = LogTheta(body.numbers.alpha);
    let scene = if law == Law::Discontinuous {
        scene.with_contact(contact.with_state(Discontinuous, Theta::from(alpha)))
    } else {
        let evolutions: Vec<Box<dyn StateLaw<State = LogTheta>>> =
            laws.map(|laws| laws.evolution()).collect();
        scene.with_contact(contact.with_state_per_vertex(evolutions, alpha))
    };
    let Some(coefficient) = body.guide else {
        return Ok(scene);
    };
    let top = side(space, D - 1, body.size[D - 1] * units.length)?;
    let guide = Contact::new(&top, Tresca { coefficient }, 1e4 * stress);
    Ok(scene.with_contact(guide))
}
