//! Vibrations of the interior with the boundary at rest, by shift and invert.

use faer::{Mat, Side};
use nalgebra::SVector;

use super::StaticResponses;
use super::lanczos::{NotConverged, Pairs, largest};
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
        let pairs = if size <= DENSE || bound == 0.0 {
            self.all_pairs(mass)?
        } else {
            let inverse = self.inverse(mass);
            let mut scratch = inverse.scratch();
            largest(size, bound, |z, into| inverse.apply(z, into, &mut scratch))
                .map_err(|NotConverged(steps)| unconverged(steps))?
        };
        let frequency = |value: f64| value.recip().sqrt();
        let kept = pairs.values.iter().take_while(|&&v| frequency(v) <= up_to);
        let kept = kept.count();
        let found = (0..kept).map(|k| {
            let vector: Vec<f64> = pairs.vectors.col(k).iter().copied().collect();
            Mode {
                angular_frequency: frequency(pairs.values[k]),
                shape: self.shape(&vector, pairs.values[k]),
            }
        });
        Ok(Modes {
            found: found.collect(),
            next: pairs.values.get(kept).map(|&value| frequency(value)),
        })
    }

    /// `phi = L^-T z / sqrt(mu)`.
    fn shape(&mut self, z: &[f64], value: f64) -> Vec<SVector<f64, C>> {
        self.x.fill(0.0);
        self.x[..z.len()].copy_from_slice(z);
        self.interior_factor(|factor, x, work| factor.backward(x, work));
        let mut shape = vec![SVector::zeros(); self.layout.size()];
        self.layout.scatter(&self.x, &mut shape);
        let length = value.sqrt().recip();
        shape.iter_mut().for_each(|v| *v *= length);
        shape
    }

    /// All of them, densely.
    fn all_pairs(&mut self, mass: &BlockMatrix<C>) -> Result<Pairs, SolveError> {
        let size = self.layout.interior;
        let inverse = self.inverse(mass);
        let mut scratch = inverse.scratch();
        let mut dense = Mat::<f64>::zeros(size, size);
        let (mut unit, mut image) = (vec![0.0; size], vec![0.0; size]);
        for column in 0..size {
            unit[column] = 1.0;
            inverse.apply(&unit, &mut image, &mut scratch);
            unit[column] = 0.0;
            let entries = dense.col_mut(column).iter_mut();
            entries
                .zip(&image)
                .for_each(|(entry, value)| *entry = *value);
        }
        let pairs = dense.self_adjoint_eigen(Side::Lower);
        let pairs = pairs.map_err(|_| unconverged(size))?;
        let order = |k: usize| size - 1 - k;
        Ok(Pairs {
            values: (0..size).map(|k| pairs.S()[order(k)]).collect(),
            vectors: Mat::from_fn(size, size, |i, k| pairs.U()[(i, order(k))]),
        })
    }

    fn inverse<'a>(&'a self, mass: &'a BlockMatrix<C>) -> Inverse<'a, C> {
        Inverse {
            mass,
            factor: Interior {
                symbolic: &self.analysis.symbolic,
                factor: &self.factor,
                columns: self.layout.interior,
            },
            layout: &self.layout,
            work: self.work.len(),
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

struct Scratch<const C: usize> {
    x: Vec<f64>,
    work: Vec<f64>,
    field: Vec<SVector<f64, C>>,
    forces: Vec<SVector<f64, C>>,
}

/// `L^-1 M L^-T`.
struct Inverse<'a, const C: usize> {
    layout: &'a Layout<C>,
    factor: Interior<'a>,
    mass: &'a BlockMatrix<C>,
    work: usize,
}

impl<const C: usize> Inverse<'_, C> {
    fn scratch(&self) -> Scratch<C> {
        let size = self.layout.size();
        Scratch {
            x: vec![0.0; self.layout.unknowns()],
            work: vec![0.0; self.work],
            field: vec![SVector::zeros(); size],
            forces: vec![SVector::zeros(); size],
        }
    }

    fn apply(&self, z: &[f64], into: &mut [f64], scratch: &mut Scratch<C>) {
        let Scratch {
            x,
            work,
            field,
            forces,
        } = scratch;
        x.fill(0.0);
        x[..z.len()].copy_from_slice(z);
        self.factor.backward(x, work);
        self.layout.scatter(x, field);
        forces.fill(SVector::zeros());
        self.mass.multiply_add(1.0, field, forces);
        self.layout.gather_free(forces, x);
        self.factor.forward(x, work);
        into.copy_from_slice(&x[..z.len()]);
    }
}
