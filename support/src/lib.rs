//! What the examples share and what is not physics: command lines, laws by name, the output folder, the record
//! of a run, pictures.

pub mod cli;
pub mod laws;
pub mod layer;
pub mod output;
pub mod own_law;
pub mod plot;
pub mod record;
pub mod slider;
pub mod spring_slider;
