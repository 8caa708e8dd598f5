//! Products of a plane that are large enough for several tasks.

use nalgebra::{Vector1, Vector3};
use rayon::ThreadPoolBuilder;
use stickslip_bie::PlaneFault;
use stickslip_solvers::Operator;

use super::{POISSON, cells};
use crate::{MEDIUM, Outcome};

/// The same bits in any number of threads: the sums of the stresses of all cells.
#[test]
fn products_in_threads_have_the_same_bits() -> Outcome {
    let rectangles = cells([400, 80], [300.0, 200.0], 0.0)?;
    let count = rectangles.count();
    let fault = PlaneFault::half_space(rectangles, 90.0, MEDIUM, POISSON)?.with_rake(0.0)?;
    let stiffness = fault.stiffness();
    let slip: Vec<_> = (0..count)
        .map(|k| Vector1::new((k % 17) as f64 - 7.5))
        .collect();
    let in_threads = |threads: usize| -> Outcome<Vec<Vector1<f64>>> {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
        let mut forces = vec![Vector1::zeros(); count];
        pool.install(|| stiffness.multiply_add(1.0, &slip, &mut forces));
        Ok(forces)
    };
    let one = in_threads(1)?;
    for threads in [2, 3, 7] {
        assert!(in_threads(threads)? == one, "{threads}");
    }
    let largest = one.iter().map(|force| force[0].abs()).fold(0.0, f64::max);
    for cell in [0, 3333, count - 1] {
        let [x, y] = rectangles.center(cell);
        let mut traction = 0.0;
        for (from, slip) in slip.iter().enumerate() {
            let of_cell = fault.dislocation(from).ok_or("no rectangle")?;
            let stress = of_cell.stress([slip[0], 0.0], [x, 0.0, -y]);
            traction += (stress * Vector3::new(0.0, -1.0, 0.0))[0];
        }
        let error = one[cell][0] + traction * rectangles.area();
        assert!(error.abs() < 1e-11 * largest, "{cell}: {error:e}");
    }
    Ok(())
}
