//! What the examples share and what is not physics: command lines, laws by name, the output folder, the record
//! of a run, pictures.

// Brackets in the help of a command line are units, not links.
#![allow(rustdoc::broken_intra_doc_links)]

// Its program draws a picture, with what this crate draws with.
#[cfg(doctest)]
#[doc = include_str!("../../docs/scenes.md")]
struct Scenes;

pub mod checkpoints;
pub mod cli;
pub mod earthquakes;
pub mod figures;
pub mod gmsh;
pub mod laws;
pub mod layer;
pub mod output;
pub mod own_law;
pub mod plot;
pub mod probes;
pub mod record;
pub mod rupture;
pub mod slider;
pub mod slider3d;
pub mod spring_slider;
pub mod sweep;
