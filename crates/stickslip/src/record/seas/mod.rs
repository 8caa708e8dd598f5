//! Files in the format of the SEAS benchmarks.

mod columns;
mod files;
mod fluid;
mod folder;
mod global;
mod header;
mod place;
mod point;
mod profile;
mod quantity;
mod read;
mod rows;
mod station;
mod table;

pub use files::SeasFiles;
pub use folder::SeasFolder;
pub use global::SeasGlobal;
pub use header::SeasHeader;
pub use point::SeasPoint;
pub use profile::SeasProfile;
pub use station::SeasStation;
pub use table::SeasTable;

pub(super) use rows::{Column, Rows};

/// The smallest slip rate in a logarithm [m/s]: that of a component at rest in the benchmarks.
const REST: f64 = 1e-20;

/// The logarithm of a slip rate, to base 10; rates below 1e-20 m/s count as 1e-20 m/s.
fn log_rate(rate: f64) -> f64 {
    // A rate that is not a number stays one.
    let rate = rate.abs();
    if rate < REST {
        REST.log10()
    } else {
        rate.log10()
    }
}
