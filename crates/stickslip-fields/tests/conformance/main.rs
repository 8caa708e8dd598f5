//! The contract of fields: right ones keep it, each wrong one breaks it by its own violation.

mod drained;
mod right;
mod wrong;
