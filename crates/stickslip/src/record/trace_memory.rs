//! Traces of a contact in space and time, in memory.

use std::path::Path;

use super::check::require;
use super::npy;
use super::tracing::{Sampler, Seen, Tracing, along};
use crate::{FileError, SceneError, Snapshot};

/// Traces of a contact in memory, with a limited number of rows: for a plot.
///
/// When the memory is full, every second row is dropped, and from then on every second of the otherwise kept steps is
/// omitted. The rows are always evenly spaced among the steps that [`Tracing`] keeps, and at least half of the memory
/// is in use.
///
/// ```
/// # use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
/// # use stickslip::record::{Quantity, TraceMemory, Tracing};
/// # use stickslip::{GeneralizedAlpha, Point, Simulation, Steps};
/// # let load = LoadPath::steady(1e-6);
/// # let slider = SpringSlider { stiffness: 1e9, normal_stress: 1e6, mass: 0.0, damping: 0.0, load };
/// # let scene = slider.steady(FRICTION, AGING, 1e-6)?;
/// let mut simulation = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
/// let tracing = Tracing::of(0, &[Quantity::Slip]);
/// let mut trace = TraceMemory::new(&simulation.snapshot(), tracing, 64)?;
/// simulation.run(&Steps::constant(0.1).count(1000), |at| trace.record(&at))?;
/// // Steps 1, 17, 33, ..., 993.
/// assert_eq!(trace.times().len(), 63);
/// assert!((trace.times()[1] - 1.7).abs() < 1e-12 && (trace.value(1, 0, 0) - 1.7e-6).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TraceMemory {
    sampler: Sampler,
    order: Vec<usize>,
    along: Vec<f64>,
    rows: usize,
    times: Vec<f64>,
    values: Vec<f64>,
    /// The number of the sampler's kept steps per row.
    stride: usize,
    passed: usize,
}

impl TraceMemory {
    /// Allocates the memory for `rows` rows.
    ///
    /// # Errors
    /// [`SceneError::Index`] for a contact that the scene does not have, [`SceneError::Value`] for numbers out
    /// of range and fewer than two rows.
    pub fn new<const C: usize>(
        at: &Snapshot<'_, C>,
        tracing: Tracing,
        rows: usize,
    ) -> Result<Self, SceneError> {
        require("rows", "at least 2", rows as f64, rows >= 2)?;
        let sampler = Sampler::new(at, tracing)?;
        let (order, along) = along(&at.contact(sampler.tracing.contact));
        let width = order.len() * sampler.tracing.quantities.len();
        Ok(Self {
            sampler,
            order,
            along,
            rows,
            times: Vec::with_capacity(rows),
            values: Vec::with_capacity(rows * width),
            stride: 1,
            passed: 0,
        })
    }

    /// Records the step shown.
    ///
    /// # Panics
    /// For a step of a scene with fewer contacts or vertices than the recorder's own.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) {
        let Some(contact) = self.sampler.keep(at) else {
            return;
        };
        let is_row = self.passed.is_multiple_of(self.stride);
        self.passed += 1;
        if !is_row {
            return;
        }
        if self.times.len() == self.rows {
            self.thin();
            if !(self.passed - 1).is_multiple_of(self.stride) {
                return;
            }
        }
        self.times.push(at.time);
        let seen = Seen::new(&contact, &self.sampler.tracing.quantities);
        for &k in &self.order {
            let quantities = &self.sampler.tracing.quantities;
            let values = quantities.iter().map(|quantity| seen.of(*quantity, k));
            self.values.extend(values);
        }
    }

    /// Drops every second row.
    fn thin(&mut self) {
        let width = self.width();
        let kept = self.times.len().div_ceil(2);
        for row in 1..kept {
            self.times[row] = self.times[2 * row];
            let from = 2 * row * width;
            self.values.copy_within(from..from + width, row * width);
        }
        self.times.truncate(kept);
        self.values.truncate(kept * width);
        self.stride *= 2;
    }

    fn width(&self) -> usize {
        self.order.len() * self.sampler.tracing.quantities.len()
    }

    /// The times of the rows \[s\].
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The positions of the vertices, increasing: along the contact in the plane \[m\], else their numbers.
    pub fn along(&self) -> &[f64] {
        &self.along
    }

    /// The vertices of the contact in the order of their positions, as numbers in the contact.
    pub fn vertices(&self) -> &[usize] {
        &self.order
    }

    /// The value of quantity number `quantity`, in the order of [`Tracing::of`], at the vertex at `along()[place]` in
    /// row `row`.
    ///
    /// # Panics
    /// If there is no such row, place or quantity: [`get`](Self::get) is `None` then.
    pub fn value(&self, row: usize, place: usize, quantity: usize) -> f64 {
        let count = self.sampler.tracing.quantities.len();
        let row = &self.values[row * self.width()..][..self.width()];
        row[place * count..][..count][quantity]
    }

    /// The same value, or none if the row, place or quantity does not exist.
    pub fn get(&self, row: usize, place: usize, quantity: usize) -> Option<f64> {
        let count = self.sampler.tracing.quantities.len();
        let there = row < self.times.len() && place < self.order.len() && quantity < count;
        there.then(|| self.value(row, place, quantity))
    }

    /// Writes the values as an array of NumPy, `[row, place, quantity]`. Times and positions are arrays of their own:
    /// [`NpyArray::from`](super::NpyArray) of [`times`](Self::times) and [`along`](Self::along).
    ///
    /// # Errors
    /// [`FileError::Write`].
    #[doc(alias("NumPy", "npy"))]
    pub fn save_npy(&self, path: impl AsRef<Path>) -> Result<(), FileError> {
        let quantities = self.sampler.tracing.quantities.len();
        let shape = [self.times.len(), self.order.len(), quantities];
        npy::save(path.as_ref(), &shape, &self.values)
    }
}
