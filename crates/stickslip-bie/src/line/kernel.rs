//! The operators of a dipping fault.

use std::sync::Arc;

use nalgebra::{DMatrix, SMatrix, SVector};
use stickslip_solvers::{Matrix, MeshId, Operator};

use super::low_rank::LowRank;
use crate::Kernel;

/// The matrix of a [`DippingFault`](crate::DippingFault): the kernel of a whole space, by Fourier transforms, and the
/// images of the free surface, of low rank.
///
/// A product takes two Fourier transforms of twice the number of cells, and two passes over each pair of vectors of the
/// images: 15 to 70 of them at dips of 30 degrees and more, for up to 4000 cells. The error of a product is below 1e-10 of the diagonal times the largest slip.
/// Matrices of few cells keep their images dense. Copies and sums share the images.
///
/// # Symmetry
///
/// **The matrix is not symmetric.** The elastic body is (Betti); the stress is taken at centres of cells instead of its
/// mean over them, and below a free surface `A_ij` and `A_ji` then differ: by 1 to 5 % of the diagonal in the first rows
/// and columns of a fault that reaches the surface, by less than 1e-4 from the tenth on. For an energy ledger: [`quadratic`](Matrix::quadratic)`/2` is the
/// elastic energy up to that error, and its rate `V . (A + A^T) D/2` is not the power `V . A D` of the tractions. The
/// difference, `V . (A - A^T) D/2`, vanishes with the length of the cells, not with the time step.
///
/// Steps that evaluate forces (Runge-Kutta) need no symmetry. Solvers that minimise an energy assume a symmetric
/// matrix: a simulation gives them the symmetric part of the dense matrix, which `DMatrix::from` returns, and iterates on
/// the rest.
///
/// ```
/// use nalgebra::DMatrix;
/// use stickslip_bie::{Cells, DippingFault, Medium, Sense};
///
/// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
/// let fault = DippingFault::new(Cells::new([0.0, 40e3], 40)?, rock, 0.25, 30.0, Sense::Thrust)?;
/// let matrix = DMatrix::from(&fault.stiffness());
/// let skew = (matrix.transpose() - &matrix).amax() / matrix[(39, 39)];
/// assert!(skew > 0.01 && skew < 0.06);
/// # Ok::<(), stickslip_bie::KernelError>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("FFT", "boundary element", "low rank", "ACA"))]
pub struct DippingKernel {
    /// `t_abs(i - j) + d_i`.
    whole: Kernel,
    /// The images and their factors, each once.
    images: Vec<(f64, Arc<LowRank>)>,
}

impl DippingKernel {
    pub(crate) fn new(whole: Kernel, image: Option<LowRank>) -> Self {
        let images = image.into_iter().map(|image| (1.0, Arc::new(image)));
        Self {
            whole,
            images: images.collect(),
        }
    }

    /// `A_ij`.
    fn entry(&self, i: usize, j: usize) -> f64 {
        let images = self.images.iter();
        let images: f64 = images
            .map(|(factor, image)| factor * image.entry(i, j))
            .sum();
        self.whole.entry(i, j) + images
    }

    /// Adds the images of the terms, those that are the same into one.
    fn add_images<'a>(&mut self, terms: impl Iterator<Item = (f64, &'a Self)>) {
        for (factor, term) in terms {
            for (own, image) in &term.images {
                let same = |(_, other): &&mut (f64, Arc<LowRank>)| Arc::ptr_eq(other, image);
                match self.images.iter_mut().find(same) {
                    Some((sum, _)) => *sum += factor * own,
                    None => self.images.push((factor * own, Arc::clone(image))),
                }
            }
        }
    }
}

impl Matrix<1> for DippingKernel {
    fn vertex_count(&self) -> usize {
        self.whole.vertex_count()
    }

    fn mesh(&self) -> Option<MeshId> {
        self.whole.mesh()
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, 1>]) -> SVector<f64, 1> {
        let images = self.images.iter();
        let images: f64 = images
            .map(|(factor, image)| factor * image.product_at(i, x))
            .sum();
        self.whole.product_at(i, x) + SVector::from([[images]])
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, 1, 1> {
        SMatrix::from([[self.entry(i, i)]])
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, 1>], y: &mut [SVector<f64, 1>]) {
        self.whole.multiply_add(scale, x, y);
        for (factor, image) in &self.images {
            image.product(scale * factor, x, |i, value| y[i][0] += value);
        }
    }

    fn quadratic(&self, x: &[SVector<f64, 1>]) -> f64 {
        let images = self.images.iter();
        let images: f64 = images
            .map(|(factor, image)| factor * image.quadratic(x))
            .sum();
        self.whole.quadratic(x) + images
    }
}

impl Operator<1> for DippingKernel {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        let all = terms.iter().copied().chain(mass);
        let mut sum = Self {
            whole: Kernel::sum(all.clone().map(|(factor, term)| (factor, &term.whole))),
            images: Vec::new(),
        };
        sum.add_images(all);
        sum
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        let all = terms.iter().copied().chain(mass);
        let whole = all.clone().map(|(factor, term)| (factor, &term.whole));
        self.whole.set_sum(whole);
        self.images.clear();
        self.add_images(all);
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, 1, 1>) {
        self.whole.add_to_diagonal(i, block);
    }
}

impl From<&DippingKernel> for DMatrix<f64> {
    fn from(kernel: &DippingKernel) -> Self {
        let count = kernel.vertex_count();
        Self::from_fn(count, count, |i, j| kernel.entry(i, j))
    }
}
