//! The paper's slider, a block in three dimensions, and bodies like them: meshes, materials,
//! contacts, units, steps, three solvers.

mod body;
mod run;
mod units;

use stickslip::StateUpdate;

use crate::case::{Case, IntoControlFlow};
use crate::method::{EVOLUTIONS, METHODS, Method};
use body::{Body, bodies};
use run::run;

/// The part of the report with the slider.
pub(crate) const SECTION: &str = "slider";
/// That with the block.
pub(crate) const BLOCK: &str = "block in three dimensions";
const STEPS: usize = 5;
/// The steps of a run over the whole 15 s of the paper, and their size [s].
const WHOLE: (usize, f64) = (1000, 1.5e-2);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Solver {
    Tnnmg,
    Condensed,
    GaussSeidel,
}

const FAST: [(Solver, &str); 2] = [(Solver::Tnnmg, "TNNMG"), (Solver::Condensed, "condensed")];

/// Cases of one part, by a solver with its name.
struct Cases {
    section: &'static str,
    quick: bool,
    all: Vec<Case>,
}

pub(crate) fn cases(quick: bool) -> Vec<Case> {
    let mut cases = Cases {
        section: SECTION,
        quick,
        all: Vec::new(),
    };
    for (name, body) in bodies(&Body::paper(if quick { 2 } else { 3 }), quick) {
        cases.add_by(&FAST, &name, &body);
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
        "two contacts, the other with mu = 1e-1",
    ];
    for (name, mut body) in bodies(&Body::paper(2), false) {
        let wanted = if quick {
            name == "none" || name == "L = 1e-9 m"
        } else {
            whole.contains(&name.as_str())
        };
        if wanted {
            (body.steps, body.numbers.dt) = WHOLE;
            cases.add_by(&FAST, &format!("1000 steps of 15 ms, {name}"), &body);
        }
    }
    for (name, body) in bodies(&Body::paper(0), quick) {
        cases.add_by(
            &[(Solver::GaussSeidel, "Gauss-Seidel, 5 cells")],
            &name,
            &body,
        );
    }
    cases.all
}

pub(crate) fn blocks(quick: bool) -> Vec<Case> {
    let mut cases = Cases {
        section: BLOCK,
        quick,
        all: Vec::new(),
    };
    for (name, body) in bodies(&Body::block(1), quick) {
        cases.add_by(&FAST, &name, &body);
    }
    cases.all
}

/// Each coupling with one of the updates: the paper's pair, and that of second order.
fn is_paired(method: Method, update: StateUpdate) -> bool {
    (method == Method::Monolithic) == (update == StateUpdate::Midpoint)
}

impl Cases {
    fn add_by<const D: usize>(&mut self, solvers: &[(Solver, &str)], name: &str, body: &Body<D>) {
        for &(solver, solver_name) in solvers {
            for (method, update, label) in METHODS {
                if !is_paired(method, update) {
                    continue;
                }
                for (law, member) in EVOLUTIONS.into_iter().take(if self.quick { 2 } else { 3 }) {
                    let (body, label) = (body.clone(), format!("{label}; {solver_name}"));
                    let case = Case::new(self.section, name, label, member, move || {
                        run(&body, solver, (method, update), law)
                            .unwrap_or_else(IntoControlFlow::refused)
                    });
                    self.all.push(case);
                }
            }
        }
    }
}
