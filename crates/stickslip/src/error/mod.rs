//! Errors of a scene and of a step.

mod boundary_condition;
mod failure;
mod hint;
mod local;
mod open_walls;
mod place;
mod retry;
mod scene;
mod scene_hint;
mod shear_along_normal;
mod step;

pub use boundary_condition::BoundaryCondition;
pub use failure::StepFailure;
pub use local::{ErrorOf, Limit, LocalError, VertexError};
pub use open_walls::OpenWalls;
pub use place::Place;
pub use scene::SceneError;
pub use shear_along_normal::ShearAlongNormal;
pub(crate) use step::BODY_STRESS;
pub use step::StepError;
