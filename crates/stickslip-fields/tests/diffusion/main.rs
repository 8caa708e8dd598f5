//! Pore pressure that diffuses along a fault.

mod bp6;
mod bp8;
mod conformance;
mod couplings;
mod estimates;
mod extremes;
mod fourth_order;
mod march;
mod networks;
mod planes;
mod rates;
mod refusals;
mod refusals_of_wells;
mod terzaghi;
mod volume;
mod wells;
mod within;
