//! The claims of a simulation of a body: one program, a module for each theme.
#![cfg(all(feature = "fem", feature = "tnnmg", feature = "condensed"))]

mod absence;
mod accelerations;
mod adaptive_body;
mod allocation;
mod arrest;
mod block_3d;
#[cfg(feature = "checkpoint")]
mod checkpoint;
mod clones;
mod column;
mod common;
mod contacts;
mod convexity;
mod costs;
mod coupling;
mod custom_laws;
mod dense;
mod energy;
mod error_control;
mod explicit;
mod extremes;
mod failures;
#[cfg(feature = "bie")]
mod faults;
mod fixed_point_balance;
mod friction_alone;
mod globs;
mod invariance;
mod lagged_viscosity;
mod layer;
mod monolithic;
mod options;
mod orders;
mod pins;
mod plane_in_space;
mod recorders;
mod reduced;
mod rest;
mod restart;
mod ruina_and_others;
mod second_order;
mod slider_reference;
mod stretched;
mod substitutions;
mod threads;
mod uniqueness;
mod units;
#[cfg(feature = "gmsh")]
mod unstructured;

/// The result of a test that builds scenes and takes steps.
type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;
