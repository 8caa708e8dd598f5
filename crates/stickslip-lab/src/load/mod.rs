//! The history of the load point.

mod gauge;
mod joints;
mod limits;
mod line;
mod measured;
mod memory;
mod noise;
mod phases;
mod pieces;
mod polygon;
mod protocol;
mod quantum;
mod removal;
mod within;

use crate::error::LabError;
use gauge::LineError;

/// The relative difference of velocities that are one: those of the rounding of a table with six digits. As a step it would
/// change friction by a millionth of `a`.
const SAME: f64 = 1e-6;

/// The velocity of the load point: constant between changes, with any number of velocity steps and holds.
///
/// ```
/// use stickslip_lab::LoadHistory;
///
/// // 1 um/s, ten times faster from 100 s on, a hold from 150 s to 250 s.
/// let load = LoadHistory::new(1e-6, &[(100.0, 1e-5), (150.0, 0.0), (250.0, 1e-5)])?;
/// assert_eq!(load.velocity(200.0), 0.0);
/// assert!((load.displacement(200.0) - 5e-4).abs() < 1e-18);
/// # Ok::<(), stickslip_lab::LabError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("load path", "load-point history"))]
pub struct LoadHistory {
    pieces: Vec<Piece>,
    end: f64,
}

/// A piece of constant velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    start: f64,
    displacement: f64,
    velocity: f64,
    error: LineError,
}

impl LoadHistory {
    /// The history of an initial velocity > 0 [m/s], and of changes: times \[s\], in ascending order, and the
    /// velocities [m/s] from there on, 0 in a hold. The displacement is 0 at the first change. A velocity that repeats the
    /// last one, to within a millionth, is no change.
    ///
    /// # Errors
    /// [`LabError::Value`] for an initial velocity that is not positive, and for times and velocities that are not
    /// finite or not in order.
    pub fn new(initial: f64, changes: &[(f64, f64)]) -> Result<Self, LabError> {
        LabError::check_positive("initial velocity of the load point [m/s]", 0, initial)?;
        let mut load = Self {
            pieces: vec![Piece {
                start: changes.first().map_or(0.0, |change| change.0),
                displacement: 0.0,
                velocity: initial,
                error: LineError::default(),
            }],
            end: changes.last().map_or(0.0, |change| change.0),
        };
        for (position, &(time, velocity)) in changes.iter().enumerate() {
            LabError::check_finite("time of a velocity step [s]", position, time)?;
            LabError::check_finite("velocity of the load point [m/s]", position, velocity)?;
            let ordered = position == 0 || time > changes[position - 1].0;
            LabError::check(
                "time of a velocity step [s]",
                "after the one before",
                position,
                time,
                ordered,
            )?;
            load.push(time, velocity);
        }
        Ok(load)
    }

    /// The history by changes at displacements \[m\] of the load point, in ascending order from any origin; time is 0 at
    /// the first one. It has no holds.
    ///
    /// # Errors
    /// Those of [`new`](Self::new), and [`LabError::Value`] for a velocity that is not positive.
    pub fn by_displacement(initial: f64, changes: &[(f64, f64)]) -> Result<Self, LabError> {
        let mut times = Vec::with_capacity(changes.len());
        let (mut time, mut last) = (0.0, None);
        for (position, &(displacement, velocity)) in changes.iter().enumerate() {
            LabError::check_finite(
                "displacement of a velocity step [m]",
                position,
                displacement,
            )?;
            LabError::check_positive("velocity of the load point [m/s]", position, velocity)?;
            if let Some((before, velocity)) = last {
                time += (displacement - before) / velocity;
            }
            times.push((time, velocity));
            last = Some((displacement, velocity));
        }
        let mut load = Self::new(initial, &times)?;
        let origin = changes.first().map_or(0.0, |change| change.0);
        for piece in &mut load.pieces {
            piece.displacement += origin;
        }
        Ok(load)
    }

    /// Appends a piece, unless the last one goes on.
    fn push(&mut self, start: f64, velocity: f64) {
        let last = self.pieces.last().map_or(f64::NAN, |piece| piece.velocity);
        if (velocity - last).abs() <= SAME * velocity.abs().max(last.abs()) {
            return;
        }
        let displacement = self.displacement(start);
        self.pieces.push(Piece {
            start,
            displacement,
            velocity,
            error: LineError::default(),
        });
    }

    /// The times \[s\] and the velocities [m/s] from there on, as [`new`](Self::new) takes them: first the initial velocity,
    /// then the changes.
    pub fn steps(&self) -> Vec<(f64, f64)> {
        let pieces = self.pieces.iter();
        pieces.map(|piece| (piece.start, piece.velocity)).collect()
    }

    /// The velocity [m/s] at a time \[s\], from the right.
    pub fn velocity(&self, time: f64) -> f64 {
        self.at(time).velocity
    }

    /// The displacement \[m\] at a time \[s\].
    pub fn displacement(&self, time: f64) -> f64 {
        let piece = self.at(time);
        piece.displacement + piece.velocity * (time - piece.start)
    }

    /// The time \[s\] at which a displacement \[m\] is reached, for a history without holds.
    pub fn time(&self, displacement: f64) -> f64 {
        let after = (self.pieces).partition_point(|piece| piece.displacement <= displacement);
        let piece = &self.pieces[after.saturating_sub(1)];
        // Before the first change.
        let piece = if after == 0 { &self.pieces[0] } else { piece };
        piece.start + (displacement - piece.displacement) / piece.velocity
    }

    fn at(&self, time: f64) -> &Piece {
        let after = self.pieces.partition_point(|piece| piece.start <= time);
        // The change at the origin follows the initial piece.
        &self.pieces[after.saturating_sub(1)]
    }

    /// The velocity before a time \[s\]: that from the left.
    pub(crate) fn velocity_before(&self, time: f64) -> f64 {
        let after = self.pieces.partition_point(|piece| piece.start < time);
        self.pieces[after.saturating_sub(1)].velocity
    }

    /// The time of the last change before a time \[s\].
    pub(crate) fn change_before(&self, time: f64) -> Option<f64> {
        let changes = self.pieces[1..].iter().map(|piece| piece.start);
        changes.take_while(|start| *start < time).last()
    }

    /// Times and velocities of the changes after `from` and before `to` \[s\]; that at `from` counts.
    pub(crate) fn changes(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> {
        let changes = self.pieces[1..].iter();
        changes
            .filter(move |piece| piece.start >= from && piece.start < to)
            .map(|piece| (piece.start, piece.velocity))
    }
}

/// Requires finite times in order; several samples may have one time.
pub(crate) fn ascending(times: &[f64]) -> Result<(), LabError> {
    for (position, &time) in times.iter().enumerate() {
        LabError::check_finite("time [s]", position, time)?;
        let ordered = position == 0 || time >= times[position - 1];
        LabError::check(
            "time [s]",
            "not before the last sample",
            position,
            time,
            ordered,
        )?;
    }
    Ok(())
}
