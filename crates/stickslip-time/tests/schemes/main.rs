//! The schemes: their contract, their orders, what they damp.

mod conformance;
mod orders;
