//! The state of motion at the start.

use nalgebra::SVector;
use stickslip_tnnmg::LinearSolver;

/// An empty field is zero.
pub(crate) struct Initial<Op, const C: usize> {
    pub(crate) time: f64,
    /// What finds the displacement that balances the load, if it is asked for.
    pub(crate) equilibrium: Option<Box<dyn LinearSolver<Op, C>>>,
    pub(crate) displacement: Vec<SVector<f64, C>>,
    pub(crate) velocity: Vec<SVector<f64, C>>,
    pub(crate) acceleration: Vec<SVector<f64, C>>,
    /// Accelerations are left to the scheme's recurrence, from zero or what is given.
    pub(crate) recurrent: bool,
}

impl<Op, const C: usize> Default for Initial<Op, C> {
    fn default() -> Self {
        Self {
            time: 0.0,
            equilibrium: None,
            displacement: Vec::new(),
            velocity: Vec::new(),
            acceleration: Vec::new(),
            recurrent: false,
        }
    }
}

/// A field that was given, or zero.
pub(crate) fn or_zeros<const C: usize>(
    field: &[SVector<f64, C>],
    size: usize,
) -> Vec<SVector<f64, C>> {
    if field.is_empty() {
        vec![SVector::zeros(); size]
    } else {
        field.to_vec()
    }
}
