//! Recorders against closed forms, against what the steps show, and against the allocator.

mod allocation;
mod catalogue;
mod histories;
mod ledger;
mod vtk;
