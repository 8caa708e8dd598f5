//! A body with its laws, solver and coupling through its steps.

use nalgebra::SVector;
use stickslip::fem::{P1, body_force, elasticity, mass};
use stickslip::friction::{DieterichRuina, Nodal};
use stickslip::problems::load_velocity;
use stickslip::state::{Dieterich, Discontinuous, LogTheta, Ruina, StateLaw, Theta};
use stickslip::{
    BlockGaussSeidel, BlockMatrix, Condensed, FixedPoint, InterfacePotential, Monolithic, Newmark,
    NonsmoothSolver, Operator, Scene, Simulation, StateUpdate, Tnnmg,
};

use super::body::Body;
use super::{Evolution, Refusal, Solver};
use crate::case::Verdict;
use crate::check::{Equations, march};
use crate::method::{Method, friction};
use crate::setup::Setup;

pub(crate) fn run(
    body: &Body,
    solver: Solver,
    coupling: (Method, StateUpdate),
    evolution: Evolution,
) -> Result<Verdict, Refusal> {
    let alpha = body.numbers.alpha;
    match evolution {
        Evolution::Dieterich => {
            with_laws(body, solver, coupling, LogTheta(alpha), |slip_distance| {
                Dieterich { slip_distance }
            })
        }
        Evolution::Ruina => with_laws(body, solver, coupling, LogTheta(alpha), |slip_distance| {
            Ruina { slip_distance }
        }),
        Evolution::Discontinuous => with_laws(body, solver, coupling, Theta(alpha.exp()), |_| {
            Discontinuous
        }),
    }
}

fn with_laws<S>(
    body: &Body,
    solver: Solver,
    (method, update): (Method, StateUpdate),
    initial: S::State,
    law: impl Fn(f64) -> S,
) -> Result<Verdict, Refusal>
where
    S: StateLaw + Clone + 'static,
    LogTheta: From<S::State>,
{
    let space = P1::grid(body.size, body.cells)?.refined(body.refinements)?;
    let [_, height] = body.size;
    let (bottom, top) = (
        space.trace(|x| x[1] == 0.0)?,
        space.trace(|x| x[1] == height)?,
    );
    let stiffness = elasticity(&space, &body.elastic)?;
    let inertia = match body.density {
        Some(density) => Some(mass(&space, density)?),
        None => None,
    };
    let weight = SVector::from([0.0, -9.81 * body.density.unwrap_or(5e3)]);
    let load: Vec<SVector<f64, 2>> = body_force(&space, |_| weight);

    let Setup {
        a,
        ratio,
        slip_distance,
        normal_stress,
        dt,
        slip_rate,
        ..
    } = body.numbers;
    let at = |k: usize, which: usize| {
        if k % 2 == 1 {
            body.contrast[which]
        } else {
            1.0
        }
    };
    let count = bottom.vertices().len();
    let frictions: Vec<DieterichRuina> = (0..count)
        .map(|k| {
            let (mut law, ..) = friction(a * at(k, 0), 0.0, slip_distance * at(k, 2));
            law.b = ratio * a * at(k, 1);
            law
        })
        .collect();
    let laws: Vec<S> = (0..count).map(|k| law(slip_distance * at(k, 2))).collect();
    let stresses: Vec<f64> = (0..count).map(|k| normal_stress * at(k, 3)).collect();

    let mut scene = Scene::new(stiffness.clone())
        .with_load(load.clone())
        .with_friction::<DieterichRuina>(&bottom, frictions.clone(), stresses.clone())
        .with_state::<S>(laws.clone(), initial)
        .hold(&bottom, [false, true])
        .move_at(&top, [true, true], |time| [load_velocity(time), 0.0])
        .in_equilibrium();
    if slip_rate != 0.0 {
        let start = space
            .interpolate(|x| SVector::from([if x[1] < height { slip_rate } else { 0.0 }, 0.0]));
        scene = scene.with_velocity(start);
    }
    let mut norm = stiffness.clone();
    if let Some(inertia) = &inertia {
        scene = scene.with_mass(inertia.clone());
        norm = BlockMatrix::combination(&[(1.0, &stiffness), (1.0, inertia)]);
    }
    let mut fixed = vec![[false; 2]; space.vertex_count()];
    for &vertex in bottom.vertices() {
        fixed[vertex][1] = true;
    }
    for &vertex in top.vertices() {
        fixed[vertex] = [true; 2];
    }
    let modulus = |matrix: &BlockMatrix<2>| matrix.map(|block| block.abs());
    let equations = Equations {
        moduli: [
            Some(modulus(&stiffness)),
            inertia.as_ref().map(modulus),
            None,
        ],
        stiffness,
        mass: inertia,
        viscosity: None,
        load: Box::new(move |_| load.clone()),
        friction: Nodal::PerVertex(frictions),
        law: Nodal::PerVertex(laws),
        normal_stress: Nodal::PerVertex(stresses),
        vertices: bottom.vertices().to_vec(),
        weights: bottom.weights().to_vec(),
        compliance: body.compliance(&norm, &fixed)?,
        norm,
        fixed,
        update,
        tolerance: 1e-10,
    };
    let solver: Box<dyn NonsmoothSolver<BlockMatrix<2>, InterfacePotential<DieterichRuina, S>, 2>> =
        match solver {
            Solver::Tnnmg => Box::new(Tnnmg::new(space.hierarchy().prolongations())),
            Solver::Condensed => Box::new(Condensed::new()),
            Solver::GaussSeidel => Box::new(BlockGaussSeidel::new()),
        };
    let simulation = Simulation::new(scene, Newmark::default(), solver)?.with_state_update(update);
    let mut simulation = match method {
        Method::FixedPoint => simulation.with_coupling(FixedPoint::default()),
        Method::Monolithic => simulation.with_coupling(Monolithic::default()),
    };
    Ok(march(&mut simulation, body.steps, dt, &|from, to, dt| {
        equations.check(from, to, dt)
    }))
}
