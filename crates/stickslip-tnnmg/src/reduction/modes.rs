//! Vibrations of the interior with the boundary at rest, by shift and invert.

use faer::{Mat, MatRef, Side};
use nalgebra::SVector;

use super::StaticResponses;
use super::lanczos::{NotConverged, Pairs, largest};
use crate::abreast::{Row, WIDTH, lay, stack};
use crate::cholesky::{Interior, Layout};
use crate::{BlockMatrix, Operator, SolveError};

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
    /// Those asked for, lowest first.
    pub found: Vec<Mode<C>>,
    /// The angular frequency of the first one beyond [rad/s]; `None` if there is none.
    pub next: Option<f64>,
}

/// Up to so many unknowns all modes are found at once, densely.
const DENSE: usize = 320;

impl<const C: usize> StaticResponses<C> {
    /// The modes up to an angular frequency [rad/s], lowest first, by those of `L^-1 M L^-T` with `A_II = L L^T`.
    ///
    /// # Errors
    /// [`SolveError`]: an iteration that does not converge, memory.
    pub fn modes(&mut self, mass: &BlockMatrix<C>, up_to: f64) -> Result<Modes<C>, SolveError> {
        let size = self.layout.interior;
        if size == 0 {
            return Ok(Modes {
                found: Vec::new(),
                next: None,
            });
        }
        let bound = up_to.powi(-2);
        let mut inverse = self.inverse(mass);
        let pairs = if size <= DENSE || bound == 0.0 {
            inverse.all_pairs()?
        } else {
            largest(size, bound, |z, into| inverse.apply(z, into))
                .map_err(|NotConverged(steps)| unconverged(steps))?
        };
        let frequency = |value: f64| value.recip().sqrt();
        let kept = pairs.values.iter().take_while(|&&v| frequency(v) <= up_to);
        let kept = kept.count();
        let mut found = Vec::with_capacity(kept);
        for first in (0..kept).step_by(WIDTH) {
            let those = first..(first + WIDTH).min(kept);
            let vectors = those.clone().flat_map(|k| pairs.vectors.col(k).iter());
            let vectors: Vec<f64> = vectors.copied().collect();
            for (k, mut shape) in those.zip(inverse.shapes(&vectors)) {
                // `phi = L^-T z / sqrt(mu)`.
                let length = pairs.values[k].sqrt().recip();
                shape.iter_mut().for_each(|v| *v *= length);
                found.push(Mode {
                    angular_frequency: frequency(pairs.values[k]),
                    shape,
                });
            }
        }
        Ok(Modes {
            found,
            next: pairs.values.get(kept).map(|&value| frequency(value)),
        })
    }

    fn inverse<'a>(&'a self, mass: &'a BlockMatrix<C>) -> Inverse<'a, C> {
        let (size, unknowns) = (self.layout.size(), self.layout.unknowns());
        Inverse {
            mass,
            factor: Interior {
                symbolic: &self.analysis.symbolic,
                factor: &self.factor,
                columns: self.layout.interior,
            },
            layout: &self.layout,
            x: vec![[0.0; WIDTH]; unknowns],
            work: vec![[0.0; WIDTH]; self.work.len()],
            one: vec![0.0; unknowns],
            field: vec![SVector::zeros(); size],
            forces: vec![SVector::zeros(); size],
        }
    }
}

fn unconverged(iterations: usize) -> SolveError {
    SolveError::NotConverged {
        iterations,
        change: f64::NAN,
        tolerance: 0.0,
    }
}

/// `L^-1 M L^-T`, of up to [`WIDTH`] vectors one behind another.
struct Inverse<'a, const C: usize> {
    layout: &'a Layout<C>,
    factor: Interior<'a>,
    mass: &'a BlockMatrix<C>,
    x: Vec<Row>,
    work: Vec<Row>,
    /// One of the vectors.
    one: Vec<f64>,
    field: Vec<SVector<f64, C>>,
    forces: Vec<SVector<f64, C>>,
}

impl<const C: usize> Inverse<'_, C> {
    fn apply(&mut self, z: &[f64], into: &mut [f64]) {
        let interior = self.layout.interior;
        self.extend(z);
        for c in 0..z.len() / interior {
            self.take(c);
            self.layout.scatter(&self.one, &mut self.field);
            self.forces.fill(SVector::zeros());
            self.mass.multiply_add(1.0, &self.field, &mut self.forces);
            self.layout.gather_free(&self.forces, &mut self.one);
            for (row, value) in self.x.iter_mut().zip(&self.one) {
                row[c] = *value;
            }
        }
        self.factor.forward(&mut self.x, &mut self.work);
        stack(&self.x[..interior], interior, into);
    }

    /// `L^-T z` as fields.
    fn shapes(&mut self, z: &[f64]) -> Vec<Vec<SVector<f64, C>>> {
        self.extend(z);
        let mut shapes = Vec::with_capacity(WIDTH);
        for c in 0..z.len() / self.layout.interior {
            self.take(c);
            let mut shape = vec![SVector::zeros(); self.layout.size()];
            self.layout.scatter(&self.one, &mut shape);
            shapes.push(shape);
        }
        shapes
    }

    /// `x = L^-T z`.
    fn extend(&mut self, z: &[f64]) {
        let (inside, boundary) = self.x.split_at_mut(self.layout.interior);
        lay(z, inside.len(), inside);
        boundary.fill([0.0; WIDTH]);
        self.factor.backward(&mut self.x, &mut self.work);
    }

    fn take(&mut self, c: usize) {
        for (value, row) in self.one.iter_mut().zip(&self.x) {
            *value = row[c];
        }
    }

    /// All of them, densely.
    fn all_pairs(&mut self) -> Result<Pairs, SolveError> {
        let size = self.layout.interior;
        let mut dense = Mat::<f64>::zeros(size, size);
        for first in (0..size).step_by(WIDTH) {
            let count = WIDTH.min(size - first);
            let (mut units, mut images) = (vec![0.0; count * size], vec![0.0; count * size]);
            for c in 0..count {
                units[c * size + first + c] = 1.0;
            }
            self.apply(&units, &mut images);
            let images = MatRef::from_column_major_slice(&images, size, count);
            dense.subcols_mut(first, count).copy_from(images);
        }
        let pairs = dense.self_adjoint_eigen(Side::Lower);
        let pairs = pairs.map_err(|_| unconverged(size))?;
        let order = |k: usize| size - 1 - k;
        Ok(Pairs {
            values: (0..size).map(|k| pairs.S()[order(k)]).collect(),
            vectors: Mat::from_fn(size, size, |i, k| pairs.U()[(i, order(k))]),
        })
    }
}
