//! Several planes in one half space.

mod entries;
mod operators;
mod refusals;
mod surface;
mod symmetries;

use nalgebra::DMatrix;
use stickslip_bie::{FaultSystem, KernelError, Placement, PlaneFault, Rectangles, SystemKernel};

use crate::MEDIUM;
use crate::planes::{POISSON, cells};

pub(crate) fn plane(cells: Rectangles, dip: f64) -> Result<PlaneFault, KernelError> {
    PlaneFault::half_space(cells, dip, MEDIUM, POISSON)
}

pub(crate) fn at(strike: f64, origin: [f64; 2]) -> Placement {
    Placement { strike, origin }
}

/// Three planes of other cells, dips and strikes, two of which reach the surface; turned clockwise as a whole.
pub(crate) fn planes(turn: f64) -> Result<Vec<(PlaneFault, Placement)>, KernelError> {
    let (sin, cos) = turn.to_radians().sin_cos();
    let at = |strike: f64, [east, north]: [f64; 2]| {
        let origin = [east * cos + north * sin, north * cos - east * sin];
        at(strike + turn, origin)
    };
    Ok(vec![
        (
            plane(cells([5, 4], [300.0, 200.0], 0.0)?, 90.0)?,
            at(0.0, [100.0, -50.0]),
        ),
        (
            plane(cells([3, 5], [250.0, 250.0], 0.0)?, 55.0)?,
            at(20.0, [1500.0, 300.0]),
        ),
        (
            plane(cells([4, 3], [200.0, 300.0], 800.0)?, 30.0)?,
            at(-130.0, [-900.0, 900.0]),
        ),
    ])
}

/// The same planes with slip along other rakes.
pub(crate) fn raked(
    planes: Vec<(PlaneFault, Placement)>,
    rake: f64,
) -> Result<Vec<(PlaneFault<1>, Placement)>, KernelError> {
    let planes = planes.into_iter().enumerate();
    let raked = planes.map(|(number, (plane, placement))| {
        Ok((plane.with_rake(rake * (1.0 + number as f64))?, placement))
    });
    raked.collect()
}

pub(crate) fn dense<const C: usize>(kernel: &SystemKernel<C>) -> DMatrix<f64> {
    DMatrix::from(kernel)
}

/// The matrix of normal stress.
pub(crate) fn dense_normal<const C: usize>(system: &FaultSystem<C>) -> DMatrix<f64> {
    let (normal, count) = (system.normal_stiffness(), system.vertex_count());
    DMatrix::from_fn(count, C * count, |i, j| normal.entry(i, j / C)[j % C])
}
