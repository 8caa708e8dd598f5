//! Dynamic earthquake rupture in space: SCEC's TPV5, TPV101, TPV102, TPV104 and TPV105.
//!
//! One body stands for two halves, which move in opposite directions: slip, slip rate and the laws' velocity and length
//! are half of those across the fault, and the normal traction stays constant. It has no matrix. Sides absorb waves.
//!
//! ```text
//! stickslip rupture3d --problem tpv102 --cell 200
//! ```
//!
//! Parameters: R. Harris et al., Seismol. Res. Lett. 80 (2009) and 89 (2018).

mod arguments;
mod averages;
mod benchmark;
mod maps;
mod problem;
mod record;
mod report;
mod rock;
mod run;

pub use arguments::Arguments;
pub use benchmark::Benchmark;
pub use run::run;
