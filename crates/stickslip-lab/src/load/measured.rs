//! Histories of measured displacements.

use super::gauge::LineError;
use super::polygon::polygon;
use super::within::within;
use super::{LoadHistory, Piece, ascending};
use crate::error::LabError;

impl LoadHistory {
    /// The history of displacements \[m\] measured at times \[s\]: the least-squares polygon with as few corners as the data
    /// defend.
    ///
    /// The noise of the gauge is estimated from the record, with its memory: a slow drift of the gauge and
    /// the ripple of a machine are noise. A piece is kept if
    /// it lowers the sum of squares by more than Schwarz's modified criterion (BIC) asks. So the velocity of
    /// a slide is that of all of its samples, and a corner lies between samples, where two lines meet. Of gauges that
    /// repeat a value until the next one the polygon is that through the steps. `n` samples take `n ln n` operations.
    ///
    /// A fit takes the errors of the polygon into account in its standard errors.
    ///
    /// A `resolution` \[m\] of at least 0 takes its place: the history has the velocities between some of the samples, so few
    /// that the displacement of every sample is met to within the resolution. With 0 the noise of the gauge is a
    /// velocity step per sample.
    ///
    /// Before the first sample the velocity is `initial` > 0 [m/s], or that of the first piece.
    ///
    /// ```
    /// use stickslip_lab::LoadHistory;
    ///
    /// // 1 um/s, from 30.5 s on 10 um/s, read to 0.1 um.
    /// let times: Vec<f64> = (0..=60).map(f64::from).collect();
    /// let exact = |t: f64| 1e-6 * t + 9e-6 * (t - 30.5).max(0.0);
    /// let displacements: Vec<f64> = times.iter().map(|t| 1e-7 * (1e7 * exact(*t)).round()).collect();
    /// let load = LoadHistory::measured(&times, &displacements, None, None)?;
    /// assert!((load.velocity(20.0) / 1e-6 - 1.0).abs() < 1e-2);
    /// assert!((load.velocity(40.0) / 1e-5 - 1.0).abs() < 1e-3);
    /// assert!((load.displacement(30.5) - exact(30.5)).abs() < 1e-7);
    /// # Ok::<(), stickslip_lab::LabError>(())
    /// ```
    ///
    /// # Errors
    /// [`LabError::Length`] for lists of different length, [`LabError::Value`] for less than two samples, times that
    /// do not ascend strictly, values that are not finite, and an initial velocity that is not positive.
    pub fn measured(
        times: &[f64],
        displacements: &[f64],
        resolution: impl Into<Option<f64>>,
        initial: Option<f64>,
    ) -> Result<Self, LabError> {
        if times.len() != displacements.len() {
            return Err(LabError::Length {
                what: "displacements",
                expected: times.len(),
                found: displacements.len(),
            });
        }
        ascending(times)?;
        distinct(times)?;
        let enough = times.len() >= 2;
        LabError::check(
            "number of samples",
            "at least 2",
            0,
            times.len() as f64,
            enough,
        )?;
        let resolution = resolution.into();
        if let Some(resolution) = resolution {
            let legal = resolution >= 0.0 && resolution.is_finite();
            LabError::check(
                "resolution [m]",
                "finite and non-negative",
                0,
                resolution,
                legal,
            )?;
        }
        for (position, &displacement) in displacements.iter().enumerate() {
            LabError::check_finite("displacement [m]", position, displacement)?;
        }
        let mut pieces = match resolution {
            Some(resolution) => within(times, displacements, resolution),
            None => polygon(times, displacements),
        };
        let first = initial.unwrap_or(pieces[0].velocity);
        LabError::check_positive("initial velocity of the load point [m/s]", 0, first)?;
        if first != pieces[0].velocity {
            pieces.insert(
                0,
                Piece {
                    velocity: first,
                    error: LineError::default(),
                    ..pieces[0]
                },
            );
        }
        pieces.dedup_by(|next, last| next.velocity == last.velocity);
        Ok(Self {
            pieces,
            end: times[times.len() - 1],
        })
    }
}

/// Requires one sample per time.
fn distinct(times: &[f64]) -> Result<(), LabError> {
    for (before, pair) in times.windows(2).enumerate() {
        let later = pair[1] > pair[0];
        LabError::check(
            "time [s]",
            "after the last sample",
            before + 1,
            pair[1],
            later,
        )?;
    }
    Ok(())
}
