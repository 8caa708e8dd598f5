//! The number of cycles of TNNMG over its levels.
//!
//! Nested levels of a structured mesh, auxiliary ones of the same mesh, and auxiliary ones of a mesh without any order,
//! on stretched cells and with nearly incompressible material; condensation beside them.
//!
//! ```text
//! cargo run --release --manifest-path benches/studies/Cargo.toml --bin levels -- --report docs/reports/levels.md
//! ```

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use stickslip::fem::{Elastic, Mesh, P1, elasticity, gmsh, mass};
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, Components, Condensed, Contact, Newmark, NonsmoothSolver, Scene, Simulation,
    Steps, Tnnmg,
};
use stickslip_cli::cli::{self, Problem};
use stickslip_studies::{Report, Table};

/// The name of the report's table.
const CYCLES: &str = "cycles";
/// The step [s], and how many of them are counted.
const STEP: f64 = 1.5e-3;
const STEPS: usize = 20;
/// The largest slip rate from which on the body slips [m/s].
const SLIPS: f64 = 1e-4;
/// The steps within which it has to.
const PATIENCE: usize = 20_000;

/// Cycles on nested and on auxiliary levels
#[derive(Debug, Parser)]
#[command(name = "levels")]
struct Arguments {
    /// The mesh without order, of the paper's body
    #[arg(
        long,
        value_name = "FILE",
        default_value = "examples/meshes/slider.msh"
    )]
    mesh: PathBuf,
    /// The report whose table is filled; printed, unless given
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
}

/// The command line: the body's length and height in those of the paper's, and the material.
struct Case {
    name: &'static str,
    scale: [f64; 2],
    poisson_ratio: f64,
}

const CASES: [Case; 7] = [
    case("cells of 1 : 1, nu = 0.3", [1.0, 1.0], 0.3),
    case("10 : 1, flat", [1.0, 0.1], 0.3),
    case("100 : 1, flat", [1.0, 0.01], 0.3),
    case("10 : 1, upright", [0.1, 1.0], 0.3),
    case("nu = 0.49", [1.0, 1.0], 0.49),
    case("nu = 0.499", [1.0, 1.0], 0.499),
    case("nu = 0.4999", [1.0, 1.0], 0.4999),
];

const fn case(name: &'static str, scale: [f64; 2], poisson_ratio: f64) -> Case {
    Case {
        name,
        scale,
        poisson_ratio,
    }
}

fn main() -> ExitCode {
    cli::run(|arguments: &Arguments| {
        let report = arguments.report.as_ref();
        let report = report
            .map(|file| Report::open(file, [CYCLES]))
            .transpose()?;
        let unstructured = gmsh::read::<2>(&arguments.mesh)?;
        let mut text = String::from(
            "| vertices | case | nested | auxiliary, structured | auxiliary, without order | condensed |\n\
             | --- | --- | --- | --- | --- | --- |\n",
        );
        for refinements in [0, 1] {
            for case in &CASES {
                let row = row(case, refinements, &unstructured)?;
                eprintln!("{row}");
                text.push_str(&format!("{row}\n"));
            }
        }
        match report {
            Some(report) => report.fill(&[Table {
                name: CYCLES.into(),
                text,
            }]),
            None => {
                println!("{text}");
                Ok(())
            }
        }
    })
}

/// The cycles of a case on all levels.
fn row(case: &Case, refinements: usize, unstructured: &Mesh<2>) -> Result<String, Problem> {
    let nested =
        P1::grid([5.0 * case.scale[0], case.scale[1]], [5, 1])?.refined(4 + refinements)?;
    // A mesh that is not known to be a refined one.
    let alone = |mesh: &Mesh<2>| -> Result<P1<2>, Problem> {
        let scaled = |x: &nalgebra::Vector2<f64>| {
            nalgebra::Vector2::new(x[0] * case.scale[0], x[1] * case.scale[1])
        };
        let vertices = mesh.vertices().iter().map(scaled).collect();
        let cells = mesh.cells().flatten().copied().collect();
        Ok(P1::new(Mesh::new(vertices, cells)?).with_auxiliary_levels()?)
    };
    let structured = P1::grid([5.0, 1.0], [5, 1])?.refined(4 + refinements)?;
    let auxiliary = alone(structured.mesh())?;
    let finer = P1::new(unstructured.clone()).refined(refinements)?;
    let unordered = alone(finer.mesh())?;
    let vertices = [&nested, &unordered].map(P1::vertex_count);
    let by_cycles = |space: &P1<2>| count(case, space, || Box::new(Tnnmg::new(space.transfers())));
    Ok(format!(
        "| {} and {} | {} | {} | {} | {} | {} |",
        vertices[0],
        vertices[1],
        case.name,
        by_cycles(&nested)?,
        by_cycles(&auxiliary)?,
        by_cycles(&unordered)?,
        count(case, &unordered, || Box::new(Condensed::new()))?,
    ))
}

/// The solver's iterations for a velocity problem while a body sticks and while it slips, and the most that a step took;
/// or why there are none.
fn count(
    case: &Case,
    space: &P1<2>,
    solver: impl Fn() -> Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>>,
) -> Result<String, Problem> {
    let on = |height: f64| space.trace(move |x| (x[1] - height).abs() < 1e-9);
    let elastic = Elastic {
        poisson_ratio: case.poisson_ratio,
        ..PippingSlider::default().elastic
    };
    let contact = Contact::new(&on(0.0)?, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = Scene::new(elasticity(space, &elastic)?)
        .on(space)
        .with_mass(mass(space, PippingSlider::default().density)?)
        .with_contact(contact)
        .prescribe_velocity(&on(case.scale[1])?, Components::ALL, |time| {
            [2e-3 * (time / 0.01).min(1.0), 0.0]
        });
    let mut body = Simulation::new(scene, Newmark::default(), solver())?;
    let (mut means, mut most) = (Vec::new(), 0);
    for _ in 0..2 {
        let (mut cycles, mut problems) = (0, 0);
        body.set_solver(solver())?;
        let run = body.run(&Steps::constant(STEP).count(STEPS), |at| {
            cycles += at.report.solver_iterations;
            problems += at.report.coupling_iterations;
            most = most.max(at.report.solver_iterations);
        });
        if let Err(failure) = run {
            return Ok(failure.to_string());
        }
        means.push(cycles as f64 / problems as f64);
        body.set_solver(Condensed::new())?;
        let mut slips = false;
        body.run(&Steps::constant(STEP).count(PATIENCE), |at| {
            slips = at.max_slip_rate() > SLIPS;
            match slips {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        })?;
        if !slips {
            return Err(format!("{}: it does not slip", case.name).into());
        }
    }
    Ok(format!("{:.1} / {:.1} ({most})", means[0], means[1]))
}
