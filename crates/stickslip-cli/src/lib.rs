//! The commands of the program `stickslip`, with their command lines, tables and pictures.
//!
//! ```text
//! stickslip slider --refinements 4 --law dieterich    # the main experiment of Pipping, Sander and Kornhuber
//! stickslip earthquakes --problem bp1                 # earthquake cycles of the SEAS benchmark BP1-QD
//! ```

// Brackets in the help of a command line are units, not links.
#![allow(rustdoc::broken_intra_doc_links)]
// A reader that closes a pipe must not end a command by a panic.
#![deny(clippy::print_stdout, clippy::print_stderr)]

// Before the modules that use its macros.
#[macro_use]
pub mod output;

pub mod checkpoints;
pub mod cli;
pub mod commands;
pub mod cost;
pub mod earthquakes;
pub mod figures;
pub mod fit;
pub mod gmsh;
pub mod injection;
pub mod interrupt;
pub mod laws;
pub mod layer;
pub mod memory;
pub mod onsets;
pub mod plot;
pub mod probes;
pub mod progress;
pub mod record;
pub mod rupture;
pub mod rupture3d;
pub mod sample;
pub mod slider;
pub mod slider3d;
pub mod spring_slider;
pub mod sweep;
pub mod table;
mod threads;
mod unused;
mod words;
