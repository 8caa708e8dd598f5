//! The claims of meshes, spaces and operators: one program, a module for each theme.
#![allow(clippy::unwrap_used)]

mod auxiliary;
mod common;
mod convergence;
mod curves;
#[cfg(feature = "gmsh")]
mod gmsh;
mod grading;
mod groups;
mod materials;
mod mesh;
mod nonconforming;
mod operators;
mod parts;
mod refinement;
mod samples;
#[cfg(feature = "csv")]
mod samples_csv;
mod split;
mod stress;
#[cfg(feature = "rayon")]
mod threads;
mod waves;

use stickslip_fem::FemError;

/// A parameter out of its range.
fn illegal(what: &'static str, requirement: &'static str, value: f64) -> FemError {
    FemError::Value {
        what,
        requirement,
        value,
        cell: None,
    }
}

fn not_positive(what: &'static str, value: f64) -> FemError {
    illegal(what, "positive and finite", value)
}

fn negative(what: &'static str, value: f64) -> FemError {
    illegal(what, "finite and non-negative", value)
}

/// Something without members.
fn empty(what: &'static str) -> FemError {
    FemError::Empty {
        what,
        name: String::new(),
    }
}

/// Two items of a list that are the same.
fn repeated(what: &'static str, places: [usize; 2]) -> FemError {
    FemError::Repeated {
        what,
        places,
        name: String::new(),
    }
}
