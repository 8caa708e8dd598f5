//! What friction computes with: contacts on their vertices, and the states of a step.

mod balance;
mod common_gap;
#[cfg(feature = "checkpoint")]
mod describe;
mod discrete_contact;
mod fields;
mod follows_slip;
mod forced_rupture;
mod friction_cap;
mod frictional_node;
mod from_body;
mod gap;
mod impact;
mod opening;
mod place;
mod quadrature;
mod set;
mod shear;
mod states;
mod tractions;
mod trial;
mod watch;
mod weakening;

pub(crate) use discrete_contact::DiscreteContact;
pub(crate) use fields::Balanced;
pub(crate) use frictional_node::{Contribution, FrictionalNode};
pub(crate) use from_body::FromBody;
pub(crate) use gap::Opening;
pub(crate) use set::ContactSet;
pub(crate) use trial::Trial;
