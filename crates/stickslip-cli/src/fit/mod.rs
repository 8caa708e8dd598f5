//! Fits of laboratory experiments: command line, tables and pictures.

mod arguments;
mod fits;
mod report;
mod run;
mod settings;

pub use arguments::Arguments;
pub use run::run;
