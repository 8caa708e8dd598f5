//! Loads on the cells of a fault that grow in time.

use nalgebra::SVector;
use stickslip_solvers::Operator;

use crate::KernelError;

/// A load history that grows by `rates` per second.
pub(crate) fn growing<const C: usize>(
    rates: Vec<SVector<f64, C>>,
) -> impl Fn(f64, &mut [SVector<f64, C>]) + Send + Sync + 'static {
    move |time, load| {
        for (load, rate) in load.iter_mut().zip(&rates) {
            *load += rate * time;
        }
    }
}

/// A load history that relieves cells which slip at `rates` [m/s].
pub(crate) fn relieving<Op: Operator<C>, const C: usize>(
    stiffness: &Op,
    rates: &[SVector<f64, C>],
) -> impl Fn(f64, &mut [SVector<f64, C>]) + Send + Sync + 'static + use<Op, C> {
    let mut loading = vec![SVector::zeros(); rates.len()];
    stiffness.multiply_add(1.0, rates, &mut loading);
    growing(loading)
}

/// Refuses another number of rates than cells, and rates that are not finite.
pub(crate) fn check_rates<const C: usize>(
    count: usize,
    [number, rate]: [&'static str; 2],
    rates: &[SVector<f64, C>],
) -> Result<(), KernelError> {
    if rates.len() != count {
        let wrong = KernelError::new(number, "that of the cells,", rates.len() as f64);
        return Err(wrong.bound(count as f64));
    }
    for (cell, values) in rates.iter().enumerate() {
        if let Some(&value) = values.iter().find(|value| !value.is_finite()) {
            return Err(KernelError {
                cell: Some(cell),
                ..KernelError::new(rate, "finite", value)
            });
        }
    }
    Ok(())
}

/// The names of plate rates and of stress rates in errors: their number, and one of them.
pub(crate) const PLATE_RATES: [&str; 2] = ["number of plate rates", "plate rate [m/s] of cell"];
pub(crate) const STRESS_RATES: [&str; 2] = ["number of stress rates", "stress rate [Pa/s] of cell"];
