//! The dynamic rupture: parameters, command line and report.
//!
//! Quantities across the fault are twice those of the body where it is one of two halves; in TPV6 there is a body on each side.
//! Arrivals of TPV205 and TPV6 by cell are in the how-to "A rupture in the plane".
//!
//! TPV101: the largest shear stress is that of all steps. It lasts for the passage of the front: 0.04 s within 4 MPa of it 3 km
//! from the middle, 0.02 s at 6 km. Tables with a row every 0.101 s, as that of the spectral code, miss it:
//!
//! | x | that table | cells of 20 m, at its times | every step of 20 m | of 40 m | of 80 m |
//! | --- | --- | --- | --- | --- | --- |
//! | 0 km | 98.64 MPa | 98.64 MPa | 98.77 MPa | 98.77 MPa | 98.77 MPa |
//! | 3 km | 96.69 MPa | 96.86 MPa | 101.37 MPa | 101.39 MPa | 101.34 MPa |
//! | 6 km | 91.07 MPa | 91.23 MPa | 101.88 MPa | 101.68 MPa | 101.44 MPa |
//!
//! At 6 km the front is faster and sharper, and cells of 20 m are still 0.2 MPa above those of 40 m.
//!
//! TPV103, arrival, slip at 5 s and largest shear stress. Cells resolve `G L/((1 - nu) sigma_n (f_p - f_w))`, 284 m at rest and
//! far less at the front: in cells of 80 m it runs ahead of the shear waves, a numerical artefact.
//!
//! | x | cells of 20 m | of 40 m | of 80 m |
//! | --- | --- | --- | --- |
//! | 0 km | 0.571 s, 15.510 m, 81.69 MPa | 0.571 s, 15.548 m, 81.68 MPa | 0.571 s, 16.466 m, 81.68 MPa |
//! | 3 km | 1.468 s, 12.058 m, 84.66 MPa | 1.468 s, 12.087 m, 84.40 MPa | 1.469 s, 13.130 m, 84.15 MPa |
//! | 6 km | 2.197 s, 9.536 m, 83.07 MPa | 2.195 s, 9.571 m, 83.37 MPa | 2.191 s, 10.915 m, 83.60 MPa |
//! | 9 km | 3.482 s, 7.253 m, 84.60 MPa | 3.455 s, 7.290 m, 84.16 MPa | 2.917 s, 9.195 m, 83.77 MPa |
//! | 12 km | 4.518 s, 3.903 m, 84.89 MPa | 4.501 s, 3.950 m, 84.48 MPa | 3.526 s, 7.075 m, 83.79 MPa |

mod benchmark;
mod problem;
mod report;
mod resolution;
mod rock;
mod run;
mod sides;
mod take;
#[cfg(test)]
mod tests;
mod weakening;

pub use benchmark::Benchmark;
pub use problem::{Law, aging_of, drainage_of, flash_of, heated, initial_of, smooth, start};
pub use report::report;
pub use rock::Rock;
pub use run::run;
pub use take::take;
pub use weakening::{PATCH, PATCHES, SHEAR, SLIP_DISTANCE, cohesive_zone, friction};

use clap::{Parser, ValueEnum};

use crate::cli::{non_negative, positive};
use crate::output::Files;

/// A dynamic rupture of a fault in the plane
#[derive(Debug, Parser)]
pub struct Arguments {
    /// The benchmark
    #[arg(long, value_enum, default_value_t = Benchmark::Tpv101)]
    pub problem: Benchmark,
    /// The largest edge of cells at the fault [m]
    #[arg(long, value_name = "METRES", default_value_t = 40.0, value_parser = positive)]
    pub cell: f64,
    /// The growth of edges with the distance from the fault
    #[arg(long, value_name = "SHARE", default_value_t = 0.1, value_parser = non_negative)]
    pub growth: f64,
    /// The height of the body, above and below the fault if there are two [m]
    #[arg(long, value_name = "METRES", default_value_t = 30e3, value_parser = positive)]
    pub height: f64,
    /// The time discretisation
    #[arg(long, value_enum, default_value_t = Scheme::Explicit)]
    pub scheme: Scheme,
    /// L* of `(V + V*)/L*`, the rate at which friction follows the normal stress between two materials [m]
    #[arg(long, value_name = "METRES", default_value_t = 0.01, value_parser = positive)]
    pub relaxation_distance: f64,
    /// V* of the same [m/s]
    #[arg(long, value_name = "SPEED", default_value_t = 1.0, value_parser = positive)]
    pub relaxation_velocity: f64,
    /// The end of the run [s]
    #[arg(long, value_name = "TIME", default_value_t = 10.0, value_parser = positive)]
    pub until: f64,
    /// The folder and the digits of the files.
    #[command(flatten)]
    pub files: Files,
}

/// Schemes by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Scheme {
    /// Central differences with a lumped mass
    Explicit,
    /// The generalised-alpha method with static condensation
    Implicit,
}

impl Arguments {
    /// Whether the scheme is explicit.
    pub fn explicit(&self) -> bool {
        self.scheme == Scheme::Explicit
    }

    /// The times at which the run stops \[s\].
    fn stops(&self) -> impl Iterator<Item = f64> {
        let seconds = (1..=self.until.ceil() as usize).map(|n| n as f64);
        seconds.map(|time| time.min(self.until))
    }

    /// Whether cells and end time suffice for the reference results.
    fn resolves(&self) -> bool {
        let fine = self.problem == Benchmark::Tpv101
            && self.cell <= 40.0
            && self.growth <= 0.1
            && self.height >= 30e3;
        fine && self.explicit() && self.until >= 10.0
    }

    /// The largest edge of a cell at a distance from the fault \[m\].
    pub fn size(&self, distance: f64) -> f64 {
        self.cell + self.growth * distance
    }
}

/// The share of the nucleating load at a time \[s\]: it grows within 1 s.
pub fn growth(time: f64) -> f64 {
    if time <= 0.0 {
        0.0
    } else if time < 1.0 {
        ((time - 1.0).powi(2) / (time * (time - 2.0))).exp()
    } else {
        1.0
    }
}
