//! The source of a stage that is not finite.

use nalgebra::SVector;

use super::RungeKutta;
use crate::StepError;
use crate::scene::NORMAL_STRESS_CHANGE;
use crate::step::check_finite;

impl<const C: usize> RungeKutta<C> {
    /// The error of the load or the law from which a stage is not finite; the error of the stage, if it is its motion.
    #[cold]
    pub(super) fn source_of(&mut self, stage: usize, time: f64, error: StepError) -> StepError {
        match error {
            StepError::Stage { .. } => {}
            StepError::Data { what, .. } if what == NORMAL_STRESS_CHANGE => {
                let moved = check_finite("displacement", &self.stages.motion.displacement);
                return moved.err().unwrap_or(error);
            }
            _ => return error,
        }
        let mut load = vec![SVector::zeros(); self.drive.forces.len()];
        let mut scratch = self.scene.loads.scratch(load.len());
        self.scene.loads.fill(time, &mut load, &mut scratch);
        if let Err(source) = check_finite("load", &load) {
            return source;
        }
        let watch = self.scene.contacts.watch();
        let _ = self.find_slopes(stage, time);
        self.scene.contacts.end_watch(watch).unwrap_or(error)
    }
}
