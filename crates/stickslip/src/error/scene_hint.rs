//! What to try after a scene was refused: the last part of its message.

use super::scene::SceneError;

pub(crate) const SAME_PART: &str = "give the part that it was made of";
pub(crate) const ONE_WALL: &str =
    "merge them or take one wall, or allow it by Scene::with_open_walls";
pub(crate) const OPEN_WALLS: &str =
    "give its sides a contact, or allow it by Scene::with_open_walls";
pub(crate) const EXPLICIT: &str = "RungeKutta integrates such scenes, and so does a Simulation without mass of the stiffness as a DMatrix";
pub(crate) const BALANCED: &str =
    "change rate, state or stress, or use `Scene::with_balanced_rates`";
pub(crate) const NORMALS: &str = "make the surfaces that meet there contacts of their own, or give normals by BoundaryPart::with_normals";
pub(crate) const AXES: &str =
    "use a BlockMatrix, or align contacts and boundary parts with the axes";
pub(crate) const SIDES: &str = "use `name+` and `name-` of Mesh::split";
pub(crate) const ALIKE: &str = "mesh both sides alike";
pub(crate) const BOTH: &str = "prescribe both";
#[cfg(feature = "condensed")]
pub(crate) const FREQUENCY: &str = "raise that frequency";
#[cfg(feature = "condensed")]
pub(crate) const MORE_MODES: &str = "keep more of them";
#[cfg(feature = "condensed")]
pub(crate) const WHOLE_PART: &str = "displace the whole part, or keep the vertex";

impl SceneError {
    /// The method of an [`Unsupported`](Self::Unsupported) scene: implicit steps.
    pub const IMPLICIT: &'static str = "implicit integration";
    /// The method of an [`Unsupported`](Self::Unsupported) scene: an explicit scheme, or `RungeKutta`.
    pub const EXPLICIT: &'static str = "explicit integration";
    /// The method of an [`Unsupported`](Self::Unsupported) scene: the reduction of its body.
    pub const REDUCTION: &'static str = "Craig-Bampton reduction";

    pub(crate) fn unsupported(by: &'static str, requirement: &'static str) -> Self {
        Self::Unsupported { by, requirement }
    }
}

impl SceneError {
    /// What to try, in words of this library: the last part of the message. `None` if the message alone says it, or the
    /// error is that of another crate.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Start(cause) => cause.hint(),
            Self::OtherVertices { .. } => Some(SAME_PART),
            Self::Coincident { .. } => Some(ONE_WALL),
            Self::OpenWalls(_) => Some(OPEN_WALLS),
            Self::NotSymmetric { .. } => Some(EXPLICIT),
            Self::Unbalanced { .. } => Some(BALANCED),
            Self::Normal { .. } => Some(NORMALS),
            Self::NoBasis { .. } => Some(AXES),
            Self::NotPaired { .. } => Some(SIDES),
            Self::NotPeriodic { .. } => Some(ALIKE),
            Self::HalfHeld { .. } => Some(BOTH),
            #[cfg(feature = "condensed")]
            Self::BelowModes { .. } => Some(FREQUENCY),
            #[cfg(feature = "condensed")]
            Self::ReducedStart { .. } => Some(MORE_MODES),
            #[cfg(feature = "condensed")]
            Self::HeldApart { .. } => Some(WHOLE_PART),
            _ => None,
        }
    }
}
