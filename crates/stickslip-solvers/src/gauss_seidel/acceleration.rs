//! Acceleration of slow sweeps: minimisation over two directions at once.

use nalgebra::{SMatrix, SVector};

use crate::field::{clear_masked, dot};
use crate::{BlockMatrix, Energy, Matrix};

/// The curvature of friction, next to the operator's, from which a component is left to the sweep: as in
/// [`Tnnmg`](crate::Tnnmg).
const TRUNCATION: f64 = 1e4;

/// The share of the descent by which the energy may rise at the end of an unshortened step.
const NEGLIGIBLE: f64 = 1e-6;

/// The largest number of halvings of a step.
const HALVINGS: usize = 30;

/// A step after each forward and backward sweep: to the minimum of the second-order model over the change of the sweep
/// and the step before, shortened if the energy itself does not fall.
///
/// On a quadratic energy this is the method of conjugate gradients preconditioned by symmetric sweeps. Sweeps in one
/// direction would take several times as many: their directions would not stay conjugate.
#[derive(Debug, Clone, Default)]
pub(super) struct Acceleration<const C: usize> {
    /// The change of the last sweep and step together, if there were both.
    last: Vec<SVector<f64, C>>,
    /// The two directions, on components where friction has a model.
    directions: [Vec<SVector<f64, C>>; 2],
    /// The second derivative times each of them.
    images: [Vec<SVector<f64, C>>; 2],
    /// Minus the gradient.
    descent: Vec<SVector<f64, C>>,
    /// Gradient and second derivative of friction at the frictional vertices.
    models: Vec<(SVector<f64, C>, SMatrix<f64, C, C>)>,
}

impl<const C: usize> Acceleration<C> {
    /// Allocates for so many vertices, and frictional ones.
    pub(super) fn resize(&mut self, size: usize, frictional: usize) {
        let [one, two] = &mut self.directions;
        let [image, other] = &mut self.images;
        for field in [one, two, image, other, &mut self.last, &mut self.descent] {
            field.resize(size, SVector::zeros());
        }
        let nothing = (SVector::zeros(), SMatrix::zeros());
        self.models.resize(frictional, nothing);
    }

    /// Drops the last step.
    pub(super) fn begin(&mut self) {
        self.last.fill(SVector::zeros());
    }

    /// Takes a step from `v` after a sweep that subtracted `moved`; `moved` becomes the change of sweep and step
    /// together. `scale` is the size of the operator's block at a frictional vertex.
    pub(super) fn advance(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        scale: impl Fn(usize) -> f64,
        v: &mut [SVector<f64, C>],
        moved: &mut [SVector<f64, C>],
    ) {
        self.linearize(energy, scale, v, moved);
        let (factors, decrease) = self.minimum();
        let [one, two] = &mut self.directions;
        for (one, two) in one.iter_mut().zip(two) {
            *one = *one * factors[0] + *two * factors[1];
        }
        let length = self.length(energy, decrease, v);
        let fields = v.iter_mut().zip(moved).zip(&mut self.last);
        for (((v, moved), last), direction) in fields.zip(&self.directions[0]) {
            let step = direction * length;
            *v += step;
            *moved -= step;
            *last = -*moved;
        }
    }
}

impl<const C: usize> Acceleration<C> {
    /// Directions, their images, descent and the models of friction at `v`.
    fn linearize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        scale: impl Fn(usize) -> f64,
        v: &[SVector<f64, C>],
        moved: &[SVector<f64, C>],
    ) {
        let [sweep, last] = &mut self.directions;
        for (sweep, moved) in sweep.iter_mut().zip(moved) {
            *sweep = -moved;
        }
        last.copy_from_slice(&self.last);
        self.descent.copy_from_slice(energy.load);
        energy.operator.multiply_add(-1.0, v, &mut self.descent);
        for (k, &vertex) in energy.vertices.iter().enumerate() {
            let model = energy.potentials.local_model(k, &v[vertex]);
            let stiffest = TRUNCATION * scale(k);
            let dropped: [bool; C] =
                std::array::from_fn(|c| !model.smooth[c] || model.hessian[(c, c)].abs() > stiffest);
            for direction in [&mut *sweep, &mut *last] {
                clear_masked(&mut direction[vertex], &dropped);
            }
            let kept = |r: usize, c: usize| !(dropped[r] || dropped[c]);
            let mut gradient = model.gradient;
            clear_masked(&mut gradient, &dropped);
            let hessian = SMatrix::from_fn(|r, c| {
                if kept(r, c) {
                    model.hessian[(r, c)]
                } else {
                    0.0
                }
            });
            self.descent[vertex] -= gradient;
            self.models[k] = (gradient, hessian);
        }
        for (direction, image) in self.directions.iter().zip(&mut self.images) {
            image.fill(SVector::zeros());
            energy.operator.multiply_add(1.0, direction, image);
            for ((_, hessian), &vertex) in self.models.iter().zip(energy.vertices) {
                image[vertex] += hessian * direction[vertex];
            }
        }
    }

    /// The factors of both directions at the minimum of the model, and twice the decrease of the model; zero without a
    /// minimum.
    fn minimum(&self) -> ([f64; 2], f64) {
        let ([one, two], [image, other]) = (&self.directions, &self.images);
        let (a, b, c) = (dot(one, image), dot(one, other), dot(two, other));
        let (f, g) = (dot(one, &self.descent), dot(two, &self.descent));
        // As far from rounding as a quotient of differences allows.
        let determinant = a * c - b * b;
        let factors = if determinant > 1e-8 * a * c {
            [(f * c - g * b) / determinant, (g * a - f * b) / determinant]
        } else {
            [f / a, 0.0]
        };
        let decrease = factors[0] * f + factors[1] * g;
        let falls = a > 0.0 && decrease > 0.0 && factors.iter().all(|factor| factor.is_finite());
        if falls {
            (factors, decrease)
        } else {
            ([0.0; 2], 0.0)
        }
    }

    /// The accepted fraction of the direction along which the energy falls: the whole, halved as often as needed.
    fn length(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        decrease: f64,
        v: &[SVector<f64, C>],
    ) -> f64 {
        // Of the model, and what it misses.
        let slope = |t: f64| {
            let frictional = energy.vertices.iter().zip(&self.models).enumerate();
            let missed = frictional.map(|(k, (&vertex, (gradient, hessian)))| {
                let d = &self.directions[0][vertex];
                if d.iter().all(|component| *component == 0.0) {
                    return 0.0;
                }
                let ahead = energy.potentials.slope_along(k, &(v[vertex] + d * t), d);
                ahead.upper - gradient.dot(d) - t * d.dot(&(hessian * d))
            });
            (t - 1.0) * decrease + missed.sum::<f64>()
        };
        let mut length = 1.0;
        for _ in 0..HALVINGS {
            if slope(length) <= NEGLIGIBLE * decrease {
                return length;
            }
            length *= 0.5;
        }
        0.0
    }
}
