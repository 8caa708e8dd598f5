//! Vibrations of the interior with the boundary fixed, by shift and invert.

use faer::Mat;
use nalgebra::SVector;

use super::lanczos::{NotConverged, Pairs, all, largest};
use super::ordered::Ordered;
use super::{StaticResponses, substitution};
use crate::cholesky::{Interior, Layout};
use crate::several_vectors::{Row, WIDTH, lay, stack};
use crate::{BlockMatrix, SolveError};

/// A vibration `phi cos(omega t)` of the interior.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode<const C: usize> {
    /// `omega` [rad/s].
    pub angular_frequency: f64,
    /// `phi`, with `phi . M phi = 1`, zero on the boundary and on fixed components.
    pub shape: Vec<SVector<f64, C>>,
}

/// The lowest modes.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes<const C: usize> {
    /// The requested modes, lowest first.
    pub found: Vec<Mode<C>>,
    /// The angular frequency of the first mode beyond [rad/s]; `None` without one.
    pub next: Option<f64>,
}

/// The largest number of unknowns for which all modes are found at once, densely.
const DENSE: usize = 320;

impl<const C: usize> StaticResponses<C> {
    /// The modes up to an angular frequency [rad/s], lowest first, from those of `L^-1 M L^-T` with `A_II = L L^T`.
    ///
    /// # Errors
    /// [`SolveError`]: a mass of another pattern, no convergence, memory.
    pub fn modes(&mut self, mass: &BlockMatrix<C>, up_to: f64) -> Result<Modes<C>, SolveError> {
        self.search(mass, up_to.powi(-2) == 0.0, |_| up_to)
    }

    /// The modes up to an angular frequency that depends on the lowest one [rad/s].
    ///
    /// # Errors
    /// As of [`modes`](Self::modes).
    pub fn modes_from(
        &mut self,
        mass: &BlockMatrix<C>,
        up_to: impl Fn(f64) -> f64,
    ) -> Result<Modes<C>, SolveError> {
        self.search(mass, false, up_to)
    }

    fn search(
        &mut self,
        mass: &BlockMatrix<C>,
        every: bool,
        up_to: impl Fn(f64) -> f64,
    ) -> Result<Modes<C>, SolveError> {
        self.check_pattern(mass)?;
        let size = self.layout.interior;
        if size == 0 {
            return Ok(Modes {
                found: Vec::new(),
                next: None,
            });
        }
        let frequency = |value: f64| value.recip().sqrt();
        let mut inverse = self.inverse(mass);
        let pairs = if size <= DENSE || every {
            all(inverse.dense().as_ref())
        } else {
            let bound = |largest: f64| up_to(frequency(largest)).powi(-2);
            largest(size, &bound, &mut |z, into| inverse.apply(z, into))
        };
        let Pairs { values, vectors } =
            pairs.map_err(|NotConverged(iterations)| SolveError::NotConverged {
                iterations,
                change: f64::NAN,
                tolerance: 0.0,
            })?;
        let up_to = values.first().map_or(0.0, |&first| up_to(frequency(first)));
        let kept = values.iter().take_while(|&&v| frequency(v) <= up_to);
        let kept = kept.count();
        let mut found = Vec::with_capacity(kept);
        for first in (0..kept).step_by(WIDTH) {
            let those = first..(first + WIDTH).min(kept);
            let columns = those.clone().map(|k| column(&vectors, k));
            for (&value, mut shape) in values[those].iter().zip(inverse.shapes(columns)) {
                // `phi = L^-T z / sqrt(mu)`.
                let length = value.sqrt().recip();
                shape.iter_mut().for_each(|v| *v *= length);
                found.push(Mode {
                    angular_frequency: frequency(value),
                    shape,
                });
            }
        }
        Ok(Modes {
            found,
            next: values.get(kept).map(|&value| frequency(value)),
        })
    }

    fn inverse<'a>(&'a self, mass: &BlockMatrix<C>) -> Inverse<'a, C> {
        let unknowns = self.layout.unknowns();
        Inverse {
            mass: Ordered::new(&self.layout, mass),
            factor: substitution(&self.analysis, &self.factor, &self.layout),
            layout: &self.layout,
            x: vec![[0.0; WIDTH]; unknowns],
            momentum: vec![[0.0; WIDTH]; unknowns],
            work: vec![[0.0; WIDTH]; self.work.len()],
        }
    }
}

/// A column of a matrix whose columns are contiguous.
fn column(matrix: &Mat<f64>, k: usize) -> &[f64] {
    let column = matrix.col(k).try_as_col_major();
    column.map_or(&[], |column| column.as_slice())
}

/// `L^-1 M L^-T`, for up to [`WIDTH`] vectors, stored one after the other.
struct Inverse<'a, const C: usize> {
    layout: &'a Layout<C>,
    factor: Interior<'a>,
    mass: Ordered,
    x: Vec<Row>,
    momentum: Vec<Row>,
    work: Vec<Row>,
}

impl<const C: usize> Inverse<'_, C> {
    fn apply(&mut self, z: &[f64], into: &mut [f64]) {
        let interior = self.layout.interior;
        self.extend(z.chunks_exact(interior));
        self.mass.multiply(&self.x, &mut self.momentum);
        self.factor
            .forward_abreast(&mut self.momentum, &mut self.work);
        stack(&self.momentum[..interior], interior, into);
    }

    /// `L^-T z` as fields.
    fn shapes<'z>(
        &mut self,
        z: impl ExactSizeIterator<Item = &'z [f64]>,
    ) -> Vec<Vec<SVector<f64, C>>> {
        let mut shapes = vec![vec![SVector::zeros(); self.layout.size()]; z.len()];
        self.extend(z);
        let unknowns = self.x.len();
        let mut stacked = vec![0.0; shapes.len() * unknowns];
        stack(&self.x, unknowns, &mut stacked);
        for (x, shape) in stacked.chunks_exact(unknowns).zip(&mut shapes) {
            self.layout.scatter(x, shape);
        }
        shapes
    }

    /// `x = L^-T z`.
    fn extend<'z>(&mut self, z: impl IntoIterator<Item = &'z [f64]>) {
        let (inside, boundary) = self.x.split_at_mut(self.layout.interior);
        lay(z, inside);
        boundary.fill([0.0; WIDTH]);
        self.factor.backward_abreast(&mut self.x, &mut self.work);
    }

    /// The whole matrix.
    fn dense(&mut self) -> Mat<f64> {
        let size = self.layout.interior;
        let mut dense = Mat::<f64>::zeros(size, size);
        for first in (0..size).step_by(WIDTH) {
            let count = WIDTH.min(size - first);
            let (mut units, mut images) = (vec![0.0; count * size], vec![0.0; count * size]);
            for c in 0..count {
                units[c * size + first + c] = 1.0;
            }
            self.apply(&units, &mut images);
            for (c, image) in images.chunks_exact(size).enumerate() {
                dense.col_as_slice_mut(first + c).copy_from_slice(image);
            }
        }
        dense
    }
}
