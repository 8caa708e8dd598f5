//! Published problems, earthquake cycles and fluid injection: parameters, command line and reports.

pub mod bp1;
pub mod bp2;
pub mod bp3;
pub mod bp4;
pub mod bp5;
pub mod bp6;
pub mod bp7;
pub mod bp8;

mod antiplane;
mod arguments;
mod contours;
mod events;
mod faults;
mod fluid;
mod line;
mod off_fault;
mod pictures;
mod plane;
mod plane_record;
mod problem;
mod profiles;
mod run;
mod seas;
pub(crate) mod space_time;
pub(crate) mod stations;
pub(crate) mod watch;

pub use arguments::{Arguments, Method};
pub use faults::FaultFile;
pub use fluid::{Fluid, Pressure, Source};
pub use off_fault::OffFault;
pub use problem::Problem;
pub use run::run;

use stickslip::friction::RegularizedDieterichRuina;

use crate::cli::Problem as Failed;
use stations::Station;

/// A year of 365.25 days \[s\].
pub const YEAR: f64 = 31_557_600.0;
/// A day \[s\].
pub const DAY: f64 = 86_400.0;

/// The state, `ln(theta / 1 s)`, for which friction at a slip rate balances a ratio of shear to normal stress.
pub(crate) fn state_for(law: &RegularizedDieterichRuina, ratio: f64, rate: f64) -> f64 {
    // ln(2 sinh y) without overflow, y = f/a.
    let y = ratio / law.a;
    let log_sinh = y + (-(-2.0 * y).exp()).ln_1p();
    let friction = law.a * (log_sinh + (law.reference_velocity / rate).ln());
    (friction - law.reference_friction) / law.b + (law.slip_distance / law.reference_velocity).ln()
}
