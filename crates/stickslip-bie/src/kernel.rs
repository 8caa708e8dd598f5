//! The operator of a fault: a Toeplitz matrix, a Hankel matrix, a diagonal.

use nalgebra::{DMatrix, SMatrix, SVector};
use realfft::num_complex::Complex;
use stickslip_solvers::{Matrix, MeshId, Operator};

use crate::convolution::{Transform, fast_length};

/// The symmetric matrix of uniform cells, `A_ij = t_abs(i - j) + h_(i + j) + d_i`: the interaction of cells by their
/// distance, the interaction by their images, and a diagonal.
///
/// A product takes two Fourier transforms of twice the number of cells, in the operator's own memory: threads that
/// share one operator wait for each other. Sums of kernels are kernels. `DMatrix::from` returns the dense matrix for
/// `DenseNewton`, for implicit steps.
///
/// [`Fault`](crate::Fault) makes it.
#[derive(Debug, Clone)]
#[doc(alias("FFT", "boundary element"))]
pub struct Kernel {
    /// `t_m`; empty for a diagonal matrix.
    toeplitz: Vec<f64>,
    /// `h_n`; empty without images.
    hankel: Vec<f64>,
    diagonal: Vec<f64>,
    /// Their spectra, on a period of the transform.
    spectra: Option<Spectra>,
    /// The cells.
    mesh: Option<MeshId>,
}

#[derive(Debug, Clone)]
struct Spectra {
    transform: Transform,
    toeplitz: Vec<f64>,
    hankel: Vec<Complex<f64>>,
}

impl Kernel {
    /// `d`.
    pub(crate) fn diagonal(diagonal: Vec<f64>) -> Self {
        Self {
            toeplitz: Vec::new(),
            hankel: Vec::new(),
            diagonal,
            spectra: None,
            mesh: None,
        }
    }

    /// The same matrix of known cells.
    pub(crate) fn on(self, mesh: MeshId) -> Self {
        let mesh = Some(mesh);
        Self { mesh, ..self }
    }

    /// `t_m` by distance, and `h_n` by the sum of the cells' numbers.
    pub(crate) fn of_distances(
        count: usize,
        influence: impl Fn(usize) -> f64,
        image: Option<&dyn Fn(usize) -> f64>,
    ) -> Self {
        let toeplitz: Vec<f64> = (0..count).map(influence).collect();
        let hankel: Vec<f64> = match image {
            Some(image) => (0..2 * count - 1).map(image).collect(),
            None => Vec::new(),
        };
        let transform = Transform::new(fast_length(2 * count - 1));
        let mut period = vec![0.0; transform.length()];
        for (m, &value) in toeplitz.iter().enumerate() {
            period[m] = value;
            // Behind, as far as it does not meet itself.
            if m > 0 {
                period[transform.length() - m] = value;
            }
        }
        let even = transform.modes(period);
        let mut correlated = Vec::new();
        if !hankel.is_empty() {
            let mut period = vec![0.0; transform.length()];
            period[..hankel.len()].copy_from_slice(&hankel);
            correlated = transform.modes(period);
        }
        Self {
            spectra: Some(Spectra {
                toeplitz: even.iter().map(|mode| mode.re).collect(),
                hankel: correlated,
                transform,
            }),
            diagonal: vec![0.0; count],
            toeplitz,
            hankel,
            mesh: None,
        }
    }

    /// A circulant matrix from its eigenvalues, by the number of waves of the mode.
    pub(crate) fn of_modes(count: usize, eigenvalue: impl Fn(usize) -> f64) -> Self {
        let modes = (0..count / 2 + 1).map(|n| Complex::new(eigenvalue(n), 0.0));
        // On a period of its own a product would take half the time, and sums with other kernels a case of their own.
        let values = Transform::new(count).values(modes.collect());
        Self::of_distances(count, |m| values[m], None)
    }

    /// `A_ij`.
    #[inline]
    pub(crate) fn entry(&self, i: usize, j: usize) -> f64 {
        let at = |values: &[f64], index: usize| values.get(index).copied().unwrap_or(0.0);
        let own = if i == j { self.diagonal[i] } else { 0.0 };
        at(&self.toeplitz, i.abs_diff(j)) + at(&self.hankel, i + j) + own
    }

    /// The sum of `factor * kernel` over the terms.
    pub(crate) fn sum<'a>(terms: impl Iterator<Item = (f64, &'a Self)> + Clone) -> Self {
        let first = terms.clone().next();
        let count = first.map_or(0, |(_, term)| term.diagonal.len());
        let mut sum = Self::diagonal(vec![0.0; count]);
        sum.mesh = first.and_then(|(_, term)| term.mesh);
        // Room for what any of them has. All transforms of so many cells are of one length.
        for (_, term) in terms.clone() {
            sum.toeplitz
                .resize(sum.toeplitz.len().max(term.toeplitz.len()), 0.0);
            sum.hankel
                .resize(sum.hankel.len().max(term.hankel.len()), 0.0);
            let Some(spectra) = &term.spectra else {
                continue;
            };
            let own = sum.spectra.get_or_insert_with(|| spectra.clone());
            let modes = own.hankel.len().max(spectra.hankel.len());
            own.hankel.resize(modes, Complex::default());
        }
        sum.set_sum(terms);
        sum
    }

    /// Overwrites itself by another such sum. Allocates nothing.
    pub(crate) fn set_sum<'a>(&mut self, terms: impl Iterator<Item = (f64, &'a Self)> + Clone) {
        self.toeplitz.fill(0.0);
        self.hankel.fill(0.0);
        self.diagonal.fill(0.0);
        for (factor, term) in terms.clone() {
            add(&mut self.toeplitz, factor, &term.toeplitz);
            add(&mut self.hankel, factor, &term.hankel);
            add(&mut self.diagonal, factor, &term.diagonal);
        }
        let Some(own) = &mut self.spectra else {
            return;
        };
        own.toeplitz.fill(0.0);
        own.hankel.fill(Complex::default());
        for (factor, term) in terms {
            if let Some(spectra) = &term.spectra {
                add(&mut own.toeplitz, factor, &spectra.toeplitz);
                for (sum, value) in own.hankel.iter_mut().zip(&spectra.hankel) {
                    *sum += value * factor;
                }
            }
        }
    }

    /// Passes on `(A x)_i` for each cell.
    fn product(&self, x: &[SVector<f64, 1>], mut show: impl FnMut(usize, f64)) {
        match &self.spectra {
            None => {
                for (i, (x, own)) in x.iter().zip(&self.diagonal).enumerate() {
                    show(i, own * x[0]);
                }
            }
            Some(Spectra {
                transform,
                toeplitz,
                hankel,
            }) => transform.product(toeplitz, hankel, x, |i, value| {
                show(i, value + self.diagonal[i] * x[i][0]);
            }),
        }
    }
}

impl Matrix<1> for Kernel {
    fn vertex_count(&self) -> usize {
        self.diagonal.len()
    }

    fn mesh(&self) -> Option<MeshId> {
        self.mesh
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, 1>]) -> SVector<f64, 1> {
        if self.spectra.is_none() {
            return x[i] * self.diagonal[i];
        }
        let terms = x.iter().enumerate();
        let sum: f64 = terms.map(|(j, x)| self.entry(i, j) * x[0]).sum();
        SVector::from([sum])
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, 1, 1> {
        SMatrix::from([[self.entry(i, i)]])
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, 1>], y: &mut [SVector<f64, 1>]) {
        self.product(x, |i, value| y[i][0] += scale * value);
    }

    fn quadratic(&self, x: &[SVector<f64, 1>]) -> f64 {
        let mut sum = 0.0;
        self.product(x, |i, value| sum += x[i][0] * value);
        sum
    }
}

impl Operator<1> for Kernel {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        Self::sum(terms.iter().copied().chain(mass))
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        self.set_sum(terms.iter().copied().chain(mass));
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, 1, 1>) {
        self.diagonal[i] += block[(0, 0)];
    }
}

fn add(sum: &mut [f64], factor: f64, values: &[f64]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += factor * value;
    }
}

impl From<&Kernel> for DMatrix<f64> {
    fn from(kernel: &Kernel) -> Self {
        let count = kernel.vertex_count();
        Self::from_fn(count, count, |i, j| kernel.entry(i, j))
    }
}
