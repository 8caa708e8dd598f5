//! Faults by their kernels: closed forms, and the matrices that products stand for.

mod allocation;
mod closed_forms;
mod compressed;
mod dipping;
mod hmatrix;
mod loads;
mod operators;
mod planes;
mod receivers;
mod refusals;
mod segments;
mod surfaces;
mod systems;
#[cfg(feature = "rayon")]
mod threads;

use nalgebra::{DMatrix, DVector, Vector1};
use stickslip_bie::{Cells, Fault, Kernel, KernelError, Medium, Mode};

pub(crate) type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

pub(crate) const MEDIUM: Medium = Medium {
    shear_modulus: 30e9,
    shear_wave_speed: 3464.0,
};

pub(crate) const IN_PLANE: Mode = Mode::InPlane {
    poisson_ratio: 0.25,
};

/// Every kind of fault of so many cells.
pub(crate) fn kinds(count: usize) -> Result<Vec<Fault>, KernelError> {
    let around = Cells::new([-3e3, 2e3], count)?;
    Ok(vec![
        Fault::half_space(Cells::new([0.0, 5e3], count)?, MEDIUM)?,
        Fault::half_space(Cells::new([700.0, 5e3], count)?, MEDIUM)?.one_sided(),
        Fault::whole_space(around, MEDIUM, Mode::Antiplane)?,
        Fault::whole_space(around, MEDIUM, IN_PLANE)?,
        Fault::periodic(around, MEDIUM, Mode::Antiplane)?,
        Fault::periodic(around, MEDIUM, IN_PLANE)?.one_sided(),
    ])
}

pub(crate) fn dense(kernel: &Kernel) -> DMatrix<f64> {
    DMatrix::from(kernel)
}

pub(crate) fn field(values: &[f64]) -> Vec<Vector1<f64>> {
    values.iter().map(|&value| Vector1::new(value)).collect()
}

pub(crate) fn flat(field: &[Vector1<f64>]) -> DVector<f64> {
    DVector::from_iterator(field.len(), field.iter().map(|x| x[0]))
}
