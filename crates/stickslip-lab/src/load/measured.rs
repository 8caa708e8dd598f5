//! Histories of measured displacements.

use super::{LoadHistory, Piece, ascending};
use crate::error::LabError;

impl LoadHistory {
    /// The history of displacements \[m\] measured at times \[s\]: the velocities between some of the samples, so few
    /// that the displacement of every sample is met to within `resolution` \[m\], that of the gauge, at least 0.
    ///
    /// Before the second sample the velocity is `initial` > 0 [m/s] if it is given.
    ///
    /// # Errors
    /// [`LabError::Length`] for lists of different length, [`LabError::Value`] for less than two samples, times that
    /// do not ascend strictly, values that are not finite, and an initial velocity that is not positive.
    pub fn measured(
        times: &[f64],
        displacements: &[f64],
        resolution: f64,
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
        let legal = resolution >= 0.0 && resolution.is_finite();
        LabError::check(
            "resolution [m]",
            "finite and non-negative",
            0,
            resolution,
            legal,
        )?;
        for (position, &displacement) in displacements.iter().enumerate() {
            LabError::check_finite("displacement [m]", position, displacement)?;
        }
        let corners = corners(times, displacements, resolution);
        let velocity = |from: usize, to: usize| {
            (displacements[to] - displacements[from]) / (times[to] - times[from])
        };
        let first = initial.unwrap_or_else(|| velocity(corners[0], corners[1]));
        LabError::check_positive("initial velocity of the load point [m/s]", 0, first)?;
        let mut load = Self {
            pieces: vec![Piece {
                start: times[0],
                displacement: displacements[0],
                velocity: first,
            }],
            end: times[times.len() - 1],
        };
        for pair in corners.windows(2) {
            load.push(times[pair[0]], velocity(pair[0], pair[1]));
        }
        // Rounding of the velocities does not add up.
        for (piece, &corner) in load.pieces[1..].iter_mut().zip(&corners) {
            piece.displacement = displacements[corner];
        }
        Ok(load)
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

/// The samples at which a polygon through some of the samples has its corners: it meets the others to `resolution`.
///
/// A piece goes on as long as one line through its first sample meets all of its samples.
fn corners(times: &[f64], displacements: &[f64], resolution: f64) -> Vec<usize> {
    let mut corners = vec![0];
    let (mut from, mut last) = (0, 0);
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for to in 1..times.len() {
        let span = times[to] - times[from];
        let change = displacements[to] - displacements[from];
        let velocity = change / span;
        if !(low..=high).contains(&velocity) && last > from {
            corners.push(last);
            from = last;
            (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
        }
        let span = times[to] - times[from];
        let change = displacements[to] - displacements[from];
        low = low.max((change - resolution) / span);
        high = high.min((change + resolution) / span);
        last = to;
    }
    corners.push(last);
    corners
}
