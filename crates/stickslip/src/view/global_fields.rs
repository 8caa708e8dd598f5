//! The motion in coordinates, where that of a step is in frames.

use nalgebra::SVector;
use stickslip_solvers::Frames;

use crate::StepState;

/// The frames of a body's vertices, and what an accepted step looks like in coordinates. Without frames it holds
/// nothing: a step is seen as it is.
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

    /// Takes over an accepted step; takes memory the first time.
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
