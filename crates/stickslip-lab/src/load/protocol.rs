//! Histories of usual experiments, and their samples.

use super::LoadHistory;
use crate::error::LabError;

impl LoadHistory {
    /// Velocity steps [m/s] > 0 from time 0 on, each after the same displacement > 0 \[m\], and so the end.
    ///
    /// # Errors
    /// [`LabError::Value`] for values out of range.
    pub fn velocity_steps(velocities: &[f64], displacement: f64) -> Result<Self, LabError> {
        let first = velocities.first().copied().unwrap_or(f64::NAN);
        LabError::check_positive("displacement of a step [m]", 0, displacement)?;
        let mut time = displacement / first;
        let mut changes = Vec::with_capacity(velocities.len());
        for (position, &velocity) in velocities.iter().enumerate().skip(1) {
            LabError::check_positive("velocity of the load point [m/s]", position, velocity)?;
            changes.push((time, velocity));
            time += displacement / velocity;
        }
        Self::new(first, &changes)?.ending(time)
    }

    /// Holds of these durations > 0 \[s\] between slides at one velocity > 0 [m/s], each over a displacement > 0
    /// \[m\], from time 0 on.
    ///
    /// # Errors
    /// [`LabError::Value`] for values out of range.
    pub fn slide_hold_slide(
        velocity: f64,
        durations: &[f64],
        displacement: f64,
    ) -> Result<Self, LabError> {
        LabError::check_positive("displacement of a slide [m]", 0, displacement)?;
        let slide = displacement / velocity;
        let mut time = slide;
        let mut changes = Vec::with_capacity(2 * durations.len());
        for (position, &duration) in durations.iter().enumerate() {
            LabError::check_positive("duration of a hold [s]", position, duration)?;
            changes.extend([(time, 0.0), (time + duration, velocity)]);
            time += duration + slide;
        }
        Self::new(velocity, &changes)?.ending(time)
    }

    /// Sets the end of the experiment \[s\], after the last change: up to it [`samples`](Self::samples) go.
    ///
    /// # Errors
    /// [`LabError::Value`] for an end that is not behind the last change.
    pub fn ending(mut self, end: f64) -> Result<Self, LabError> {
        let last = self.pieces.last().map_or(0.0, |piece| piece.start);
        LabError::check(
            "end of the experiment [s]",
            "finite and behind the last change",
            0,
            end,
            end > last && end.is_finite(),
        )?;
        self.end = end;
        Ok(self)
    }

    /// Times \[s\] of samples from 0 to the end, evenly spaced in each piece of constant velocity, `count` per piece. Of
    /// a history without an end those up to its last change.
    pub fn samples(&self, count: usize) -> Vec<f64> {
        let mut starts = vec![0.0];
        starts.extend(self.pieces[1..].iter().map(|piece| piece.start));
        starts.push(self.end);
        let mut times = Vec::new();
        for pair in starts.windows(2) {
            let step = (pair[1] - pair[0]) / count as f64;
            if step > 0.0 {
                times.extend((0..count).map(|n| pair[0] + step * n as f64));
            }
        }
        times.push(self.end);
        times
    }
}
