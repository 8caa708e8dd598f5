//! Faults by their kernels: closed forms, and the matrices that products stand for.

mod allocation;
mod closed_forms;
mod operators;
mod refusals;

use nalgebra::{DMatrix, DVector, Vector1};
use stickslip_kernel::{Cells, Fault, Kernel, KernelError, Mode, Rock};

pub(crate) type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

pub(crate) const ROCK: Rock = Rock {
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
        Fault::half_space(Cells::new([0.0, 5e3], count)?, ROCK)?,
        Fault::half_space(Cells::new([700.0, 5e3], count)?, ROCK)?.of_one_body(),
        Fault::whole_space(around, ROCK, Mode::Antiplane)?,
        Fault::whole_space(around, ROCK, IN_PLANE)?,
        Fault::periodic(around, ROCK, Mode::Antiplane)?,
        Fault::periodic(around, ROCK, IN_PLANE)?.of_one_body(),
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
