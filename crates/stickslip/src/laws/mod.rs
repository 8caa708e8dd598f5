//! The laws of a contact without their types: functions of numbers per vertex.

mod capped;
mod contact_laws;
mod laws_at;
mod normal_stress_effect;
mod one_by_one;
mod places;
mod rate_and_state;
mod state_update;

pub(crate) use capped::CappedLaws;
pub(crate) use contact_laws::{
    ContactLaws, Followed, LawProperties, StateStart, StateStep, at_least, change,
};
pub(crate) use laws_at::LawsAt;
pub(crate) use normal_stress_effect::NormalStressEffect;
pub(crate) use places::Places;
pub(crate) use rate_and_state::RateAndState;
pub use state_update::StateUpdate;
