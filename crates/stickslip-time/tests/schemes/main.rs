//! The schemes: their contract, their orders, what they damp.

mod conformance;
mod first_order_alpha;
mod generalized_alpha;
mod newmark;
mod orders;
