//! The motion in coordinates, for steps in local frames.

use nalgebra::SVector;
use stickslip_solvers::Frames;

use crate::StepState;

/// The local frames of a body's vertices, and an accepted step in coordinates. Without local frames it is empty: the
/// step itself is in coordinates.
#[derive(Debug, Clone)]
pub(crate) struct GlobalFields<const C: usize> {
    frames: Frames<C>,
    pub(crate) displacement: Vec<SVector<f64, C>>,
    pub(crate) velocity: Vec<SVector<f64, C>>,
    pub(crate) acceleration: Vec<SVector<f64, C>>,
}

impl<const C: usize> GlobalFields<C> {
    pub(crate) fn new(frames: Frames<C>) -> Self {
        Self {
            frames,
            displacement: Vec::new(),
            velocity: Vec::new(),
            acceleration: Vec::new(),
        }
    }

    pub(crate) fn frames(&self) -> &Frames<C> {
        &self.frames
    }

    /// Rotates an accepted step to coordinates; allocates on first use.
    pub(crate) fn show(&mut self, state: &StepState<C>) {
        if self.frames.is_empty() {
            return;
        }
        for (seen, own) in [
            (&mut self.displacement, &state.displacement),
            (&mut self.velocity, &state.velocity),
            (&mut self.acceleration, &state.acceleration),
        ] {
            seen.clone_from(own);
            if !seen.is_empty() {
                self.frames.field_to_coordinates(seen);
            }
        }
    }
}
