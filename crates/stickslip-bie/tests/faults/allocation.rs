//! The evaluation of a kernel in a step allocates no memory.

use stickslip_bie::Kernel;
use stickslip_solvers::{Matrix, Operator};

use crate::{Outcome, field, kinds};

#[test]
fn products_and_sums_take_no_memory() -> Outcome {
    for fault in kinds(37)? {
        let (stiffness, damping) = (fault.stiffness(), fault.radiation_damping());
        let terms = [(0.5, &stiffness), (1.0, &damping)];
        let mut sum = Kernel::combination(&terms);
        let (x, mut y) = (field(&[1.0; 37]), field(&[0.0; 37]));
        let taken = allocation_counter::measure(|| {
            sum.set_combination(&terms);
            sum.multiply_add(1.0, &x, &mut y);
            y[0][0] += sum.quadratic(&x) + sum.norm(&x);
        });
        assert_eq!(taken.count_total, 0);
    }
    Ok(())
}
