//! Steps of many cells in the threads of rayon's pool, if the feature `rayon` is on.

#[cfg(feature = "rayon")]
mod awake;
#[cfg(not(feature = "rayon"))]
mod one;
#[cfg(feature = "rayon")]
mod shares;

#[cfg(not(feature = "rayon"))]
pub(super) use one::{Threads, in_shares, on_shares, on_two_shares};
#[cfg(feature = "rayon")]
pub(super) use shares::{Threads, in_shares, on_shares, on_two_shares};
