//! The paper's slider and bodies like it: meshes, materials, three solvers.

mod body;
mod run;

use stickslip::StateUpdate;

use crate::case::{Case, Verdict};
use crate::method::{EVOLUTIONS, METHODS, Method};
use body::{Body, bodies};
use run::run;

/// The part of the report.
pub(crate) const SECTION: &str = "slider";
const STEPS: usize = 5;
/// The steps of a run over the whole 15 s of the paper, and their size [s].
const WHOLE: (usize, f64) = (1000, 1.5e-2);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Solver {
    Tnnmg,
    Condensed,
    GaussSeidel,
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
                let label = format!("{label}; Gauss-Seidel, 5 cells");
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
    for (law, member) in EVOLUTIONS.into_iter().take(if quick { 2 } else { 3 }) {
        let body = body.clone();
        cases.push(Case::new(SECTION, name, label, member, move || {
            run(&body, solver, coupling, law).unwrap_or_else(Verdict::refused)
        }));
    }
}
