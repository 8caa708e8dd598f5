//! Faults along lines that are not straight: polylines of segments in a plane.

mod down;
mod error;
mod fault;
mod influence;
mod loading;
mod off_fault;
mod orientation;
mod pairs;
mod polylines;
mod potentials;
mod quality;
mod separation;
mod surface;
#[cfg(feature = "csv")]
mod table;

pub(crate) use potentials::Space;

pub use down::DipProfile;
pub use error::SegmentsError;
pub use fault::SegmentFault;
pub use polylines::Segments;
pub use quality::SegmentsQuality;
