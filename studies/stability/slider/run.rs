//! A body with its laws, solver and coupling through its steps.

use nalgebra::SVector;
use stickslip::fem::{P1, Trace, body_force, elasticity, mass};
use stickslip::friction::DieterichRuina;
use stickslip::problems::load_velocity;
use stickslip::state::{Discontinuous, LogTheta, StateLaw, Theta};
use stickslip::{
    BlockGaussSeidel, BlockMatrix, Cholesky, Condensed, Contact, LinearSolver, MultigridSolver,
    Newmark, NonsmoothSolver, Scene, Simulation, StateUpdate, Tnnmg,
};
use support::laws::{Friction, Law};

use super::Solver;
use super::body::Body;
use crate::case::{Refusal, Verdict};
use crate::check::Check;
use crate::march::march;
use crate::method::Method;
use crate::setup::Setup;

type AnySolver = Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>>;
type AnyLinearSolver = Box<dyn LinearSolver<BlockMatrix<2>, 2>>;

pub(crate) fn run(
    body: &Body,
    solver: Solver,
    (method, update): (Method, StateUpdate),
    law: Law,
) -> Result<Verdict, Refusal> {
    let space = P1::grid(body.size, body.cells)?.refined(body.refinements)?;
    let (solver, linear) = solvers(solver, &space);
    let scene = slide(scene(body, &space, linear)?, body, &bottom(&space)?, law);
    let simulation = Simulation::new(scene, Newmark::default(), solver)?;
    let mut simulation = method.on(simulation.with_state_update(update));
    let load = load(body, &space);
    let check = Check::of(&simulation, move |_| load.clone(), &mut Cholesky::new())?;
    Ok(march(&mut simulation, &check, body.steps, body.numbers.dt))
}

/// A solver of the steps, and one of its kind of the equilibrium.
fn solvers(solver: Solver, space: &P1<2>) -> (AnySolver, AnyLinearSolver) {
    let transfers = space.hierarchy().prolongations();
    match solver {
        Solver::Tnnmg => (
            Box::new(Tnnmg::new(transfers)),
            Box::new(MultigridSolver::new(transfers)),
        ),
        Solver::Condensed => (Box::new(Condensed::new()), Box::new(Cholesky::new())),
        Solver::GaussSeidel => (Box::new(BlockGaussSeidel::new()), Box::new(Cholesky::new())),
    }
}

fn bottom(space: &P1<2>) -> Result<Trace<2>, Refusal> {
    Ok(space.trace(|x| x[1] == 0.0)?)
}

/// Its weight; a body without inertia weighs as much as the paper's.
fn load(body: &Body, space: &P1<2>) -> Vec<SVector<f64, 2>> {
    let weight = SVector::from([0.0, -9.81 * body.density.unwrap_or(5e3)]);
    body_force(space, |_| weight)
}

/// The body with its loads, in equilibrium; the contact is still missing.
fn scene(
    body: &Body,
    space: &P1<2>,
    linear: AnyLinearSolver,
) -> Result<Scene<BlockMatrix<2>, 2>, Refusal> {
    let [_, height] = body.size;
    let top = space.trace(|x| x[1] == height)?;
    let mut scene = Scene::new(elasticity(space, &body.elastic)?)
        .on(space)
        .with_load(load(body, space))
        .move_at(&top, [true, true], |time| [load_velocity(time), 0.0])
        .in_equilibrium(linear);
    if let Some(density) = body.density {
        scene = scene.with_mass(mass(space, density)?);
    }
    let rate = body.numbers.slip_rate;
    if rate != 0.0 {
        let start = |x: &SVector<f64, 2>| if x[1] < height { rate } else { 0.0 };
        scene = scene.with_velocity(space.interpolate(|x| SVector::from([start(x), 0.0])));
    }
    Ok(scene)
}

/// The scene with its contact, whose parameters may differ from vertex to vertex.
fn slide(
    scene: Scene<BlockMatrix<2>, 2>,
    body: &Body,
    bottom: &Trace<2>,
    law: Law,
) -> Scene<BlockMatrix<2>, 2> {
    let numbers: Vec<Setup> = (0..bottom.vertices().len())
        .map(|k| body.numbers_at(k))
        .collect();
    let laws = numbers
        .iter()
        .map(|numbers| numbers.laws(law, Friction::DieterichRuina));
    let frictions: Vec<DieterichRuina> = laws.clone().map(|laws| laws.parameters).collect();
    let stresses: Vec<f64> = numbers
        .iter()
        .map(|numbers| numbers.normal_stress)
        .collect();
    let contact = Contact::per_vertex(bottom, frictions, stresses);
    let alpha = LogTheta(body.numbers.alpha);
    if law == Law::Discontinuous {
        return scene.with_contact(contact.with_state(Discontinuous, Theta::from(alpha)));
    }
    let evolutions: Vec<Box<dyn StateLaw<State = LogTheta>>> =
        laws.map(|laws| laws.evolution()).collect();
    scene.with_contact(contact.with_state_per_vertex(evolutions, alpha))
}
