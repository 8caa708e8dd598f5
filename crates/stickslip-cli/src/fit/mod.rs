//! Fits of laboratory experiments: command line, tables and pictures.

mod arguments;
mod report;
mod run;
mod settings;

pub use arguments::Arguments;
pub use run::run;
