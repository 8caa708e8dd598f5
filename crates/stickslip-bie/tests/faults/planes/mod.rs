//! Planes of rectangular cells.

mod crack;
mod dislocation;
mod half_space;
mod many_rows;
mod operators;
mod periodic;
mod refusals;
mod whole_space;

use nalgebra::{DMatrix, DVector, SVector};
use stickslip_bie::{Cells, KernelError, PlaneFault, PlaneKernel, Rectangles};

pub(crate) const POISSON: f64 = 0.25;

/// Cells of a plane from `[0, begin down dip]` on.
pub(crate) fn cells(
    counts: [usize; 2],
    size: [f64; 2],
    begin: f64,
) -> Result<Rectangles, KernelError> {
    let length = |axis: usize| counts[axis] as f64 * size[axis];
    Ok(Rectangles::new(
        Cells::new([0.0, length(0)], counts[0])?,
        Cells::new([begin, begin + length(1)], counts[1])?,
    ))
}

/// Planes of every space of so many cells.
pub(crate) fn planes(counts: [usize; 2]) -> Result<Vec<PlaneFault>, KernelError> {
    let whole =
        || PlaneFault::whole_space(cells(counts, [300.0, 200.0], -1e3)?, crate::MEDIUM, POISSON);
    let half = |begin: f64, dip: f64| {
        PlaneFault::half_space(
            cells(counts, [300.0, 200.0], begin)?,
            dip,
            crate::MEDIUM,
            POISSON,
        )
    };
    Ok(vec![
        whole()?,
        whole()?.periodic_along_strike()?,
        whole()?.periodic_down_dip()?,
        whole()?.periodic_along_strike()?.periodic_down_dip()?,
        half(0.0, 90.0)?,
        half(0.0, 60.0)?,
        half(500.0, 20.0)?,
    ])
}

pub(crate) fn dense<const C: usize>(kernel: &PlaneKernel<C>) -> DMatrix<f64> {
    DMatrix::from(kernel)
}

pub(crate) fn flat<const C: usize>(field: &[SVector<f64, C>]) -> DVector<f64> {
    let entries = field.iter().flat_map(|x| x.iter().copied());
    DVector::from_iterator(C * field.len(), entries)
}
