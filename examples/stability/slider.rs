//! The paper's slider and bodies like it: meshes, materials, three solvers.

use std::collections::BTreeMap;
use std::sync::Mutex;

use nalgebra::{DMatrix, SVector};
use stickslip::fem::{Elastic, P1, body_force, elasticity, mass};
use stickslip::friction::{DieterichRuina, Nodal};
use stickslip::problems::{Slider, load_velocity};
use stickslip::state::{Dieterich, Discontinuous, LogTheta, Ruina, StateLaw, Theta};
use stickslip::{
    BlockGaussSeidel, BlockMatrix, Condensed, FixedPoint, InterfacePotential, Monolithic, Newmark,
    NonsmoothSolver, Operator, Scene, Simulation, StateUpdate, Tnnmg,
};

use crate::case::{Case, Verdict};
use crate::check::{Equations, march};
use crate::point::{METHODS, Method, PAPER, Setup, friction};

const SECTION: &str = "slider";
const STEPS: usize = 5;
/// The steps of a run over the whole 15 s of the paper, and their size [s].
const WHOLE: (usize, f64) = (1000, 1.5e-2);

/// An error on the way to the first step, whatever its type.
type Refusal = Box<dyn std::error::Error>;

/// A body on its frictional bottom, moved at its top.
#[derive(Debug, Clone)]
struct Body {
    size: [f64; 2],
    cells: [usize; 2],
    refinements: usize,
    elastic: Elastic,
    /// None for a quasi-static body.
    density: Option<f64>,
    numbers: Setup,
    /// Parameters at odd frictional vertices, over those at even ones: `a`, `b`, `L`, `sigma_n`.
    contrast: [f64; 4],
    steps: usize,
}

impl Body {
    fn paper(refinements: usize) -> Self {
        let Slider {
            density, elastic, ..
        } = Slider::default();
        Self {
            size: [5.0, 1.0],
            cells: [5, 1],
            refinements,
            elastic,
            density: Some(density),
            numbers: Setup {
                slip_rate: 0.0,
                ..PAPER
            },
            contrast: [1.0; 4],
            steps: STEPS,
        }
    }
}

impl Body {
    /// [`compliance`] of the norm of this body, which many cases share.
    fn compliance(&self, norm: &BlockMatrix<2>, fixed: &[[bool; 2]]) -> Result<f64, Refusal> {
        static KNOWN: Mutex<BTreeMap<String, f64>> = Mutex::new(BTreeMap::new());
        let key = format!(
            "{:?} {:?} {} {:?} {:?}",
            self.size, self.cells, self.refinements, self.elastic, self.density
        );
        let known = || KNOWN.lock().map_err(|_| "a case panicked");
        if let Some(&value) = known()?.get(&key) {
            return Ok(value);
        }
        let value = compliance(norm, fixed)?;
        known()?.insert(key, value);
        Ok(value)
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Solver {
    Tnnmg,
    Condensed,
    GaussSeidel,
}

/// What the state laws of the frictional vertices are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Evolution {
    Dieterich,
    Ruina,
    Discontinuous,
}

fn bodies(refinements: usize, quick: bool) -> Vec<(String, Body)> {
    let paper = Body::paper(refinements);
    let mut all = vec![("none".to_string(), paper.clone())];
    let with = |change: &dyn Fn(&mut Body)| {
        let mut body = paper.clone();
        change(&mut body);
        body
    };
    let numbers = |change: fn(&mut Setup, f64), value: f64| {
        let mut body = paper.clone();
        change(&mut body.numbers, value);
        body
    };
    type Change = fn(&mut Setup, f64);
    let lists: [(&str, &str, Change, &[f64]); 7] = [
        (
            "tau",
            " s",
            |s, x| s.dt = x,
            &[1e-12, 1e-9, 1e-6, 1.0, 1e3, 1e6],
        ),
        (
            "V(0)",
            " m/s",
            |s, x| s.slip_rate = x,
            &[5e-324, 1e-300, 1e-20, 1.0, 1e10],
        ),
        (
            "alpha(0)",
            "",
            |s, x| s.alpha = x,
            &[-800.0, -100.0, 100.0, 800.0],
        ),
        (
            "L",
            " m",
            |s, x| s.slip_distance = x,
            &[1e-12, 1e-9, 1e-7, 1.0],
        ),
        ("a", "", |s, x| s.a = x, &[1e-6, 1e-4, 1.0]),
        ("b/a", "", |s, x| s.ratio = x, &[0.0, 0.5, 2.0, 5.0, 150.0]),
        (
            "sigma_n",
            " Pa",
            |s, x| s.normal_stress = x,
            &[0.0, 1.0, 1e12],
        ),
    ];
    for (name, unit, change, values) in lists {
        for &value in values {
            all.push((format!("{name} = {value:e}{unit}"), numbers(change, value)));
        }
    }
    for nu in [0.0, 0.45, 0.49, 0.499, 0.4999] {
        all.push((
            format!("nu = {nu}"),
            with(&|body| body.elastic.poisson_ratio = nu),
        ));
    }
    all.push(("quasi-static".into(), with(&|body| body.density = None)));
    for ratio in [1e-6, 1e-3, 1e3, 1e6] {
        let body = with(&|body| body.density = Some(5e3 * ratio));
        all.push((format!("rho = {:e} kg/m^3", 5e3 * ratio), body));
    }
    for young_modulus in [1.0, 1e3, 1e9, 1e12] {
        let body = with(&|body| body.elastic.young_modulus = young_modulus);
        all.push((format!("E = {young_modulus:e} Pa"), body));
    }
    for (name, size, cells) in [
        ("flat cells 1e4 : 1", [5.0, 1e-4], [5, 1]),
        ("upright cells 1 : 1e4", [5e-4, 1.0], [5, 1]),
        ("flat cells 1e2 : 1", [5.0, 1e-2], [5, 1]),
        ("upright cells 1 : 1e2", [5e-2, 1.0], [5, 1]),
    ] {
        all.push((
            name.into(),
            with(&|body| (body.size, body.cells) = (size, cells)),
        ));
    }
    for (name, contrast) in [
        ("a, b varied by 1e6", [1e-6, 1e-6, 1.0, 1.0]),
        ("L varied by 1e6", [1.0, 1.0, 1e-6, 1.0]),
        ("sigma_n varied by 1e6", [1.0, 1.0, 1.0, 1e6]),
        ("a, b, L, sigma_n varied by 1e6", [1e-6, 1e-6, 1e6, 1e-6]),
    ] {
        all.push((name.into(), with(&|body| body.contrast = contrast)));
    }
    if quick {
        let some = [
            "tau = 1e-12",
            "tau = 1e6",
            "V(0) = 1e10",
            "L = 1e-9",
            "sigma_n = 1e12",
            "nu = 0.4999",
            "quasi",
            "rho = 5e-3",
            "E = 1e0",
            "flat cells 1e4",
            "a, b, L",
        ];
        all.retain(|(name, _)| some.iter().any(|some| name.starts_with(some)));
    }
    all
}

pub(crate) fn cases(quick: bool) -> Vec<Case> {
    let mut cases = Vec::new();
    let refinements = if quick { 2 } else { 3 };
    for (name, body) in bodies(refinements, quick) {
        all_methods(&mut cases, &name, &body, quick);
    }
    let whole = [
        "none",
        "L = 1e-7 m",
        "L = 1e-9 m",
        "L = 1e-12 m",
        "a = 1e-4",
        "b/a = 5e0",
        "b/a = 1.5e2",
        "nu = 0.4999",
        "quasi-static",
        "E = 1e9 Pa",
        "flat cells 1e2 : 1",
        "sigma_n varied by 1e6",
    ];
    for (name, mut body) in bodies(2, false) {
        let wanted = if quick {
            name == "none" || name == "L = 1e-9 m"
        } else {
            whole.contains(&name.as_str())
        };
        if wanted {
            (body.steps, body.numbers.dt) = WHOLE;
            all_methods(
                &mut cases,
                &format!("1000 steps of 15 ms, {name}"),
                &body,
                quick,
            );
        }
    }
    for (name, body) in bodies(0, quick) {
        for (method, update, label) in METHODS {
            if is_paired(method, update) {
                let label = format!("{label}; Gauss-Seidel");
                let name = format!("5 cells, {name}");
                add(
                    &mut cases,
                    &name,
                    &body,
                    Solver::GaussSeidel,
                    &label,
                    (method, update),
                    quick,
                );
            }
        }
    }
    cases
}

/// Each coupling with one of the updates: the paper's pair, and that of second order.
fn is_paired(method: Method, update: StateUpdate) -> bool {
    (method == Method::Monolithic) == (update == StateUpdate::Midpoint)
}

fn all_methods(cases: &mut Vec<Case>, name: &str, body: &Body, quick: bool) {
    for (solver, solver_name) in [(Solver::Tnnmg, "TNNMG"), (Solver::Condensed, "condensed")] {
        for (method, update, label) in METHODS {
            if is_paired(method, update) {
                let label = format!("{label}; {solver_name}");
                add(cases, name, body, solver, &label, (method, update), quick);
            }
        }
    }
}

fn add(
    cases: &mut Vec<Case>,
    name: &str,
    body: &Body,
    solver: Solver,
    label: &str,
    coupling: (Method, StateUpdate),
    quick: bool,
) {
    let all = [
        (Evolution::Dieterich, "Dieterich"),
        (Evolution::Ruina, "Ruina"),
        (Evolution::Discontinuous, "discontinuous"),
    ];
    for (evolution, member) in all.into_iter().take(if quick { 2 } else { 3 }) {
        let body = body.clone();
        cases.push(Case::new(SECTION, name, label, member, move || {
            run(&body, solver, coupling, evolution).unwrap_or_else(Verdict::refused)
        }));
    }
}

fn run(
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

/// The largest diagonal entry of the inverse on the free components.
///
/// With the matrix scaled to a unit diagonal first, which keeps it as well conditioned as it can be.
fn compliance(matrix: &BlockMatrix<2>, fixed: &[[bool; 2]]) -> Result<f64, Refusal> {
    let free: Vec<(usize, usize)> = (0..fixed.len())
        .flat_map(|i| (0..2).map(move |c| (i, c)))
        .filter(|&(i, c)| !fixed[i][c])
        .collect();
    let mut place = vec![[usize::MAX; 2]; fixed.len()];
    for (n, &(i, c)) in free.iter().enumerate() {
        place[i][c] = n;
    }
    let mut dense = DMatrix::<f64>::zeros(free.len(), free.len());
    for (block, (i, j)) in matrix {
        for (r, c) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let (row, column) = (place[i as usize][r], place[j as usize][c]);
            if row != usize::MAX && column != usize::MAX {
                dense[(row, column)] = block[(r, c)];
            }
        }
    }
    let scale: Vec<f64> = dense.diagonal().iter().map(|d| d.sqrt().recip()).collect();
    for (i, row) in scale.iter().enumerate() {
        for (j, column) in scale.iter().enumerate() {
            dense[(i, j)] *= row * column;
        }
    }
    let factor = dense
        .cholesky()
        .ok_or("the norm is not positive definite in rounding")?;
    let inverse = factor
        .l()
        .solve_lower_triangular(&DMatrix::identity(free.len(), free.len()));
    let inverse = inverse.ok_or("the norm is singular")?;
    let entries = inverse.column_iter().zip(&scale);
    Ok(entries
        .map(|(column, s)| column.norm_squared() * s * s)
        .fold(0.0, f64::max))
}
