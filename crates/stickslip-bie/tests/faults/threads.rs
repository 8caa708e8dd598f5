//! Products of a plane that are large enough for several tasks.

use nalgebra::{Vector1, Vector3};
use rayon::ThreadPoolBuilder;
use stickslip_bie::{Cells, Medium, PlaneFault, Rectangles};
use stickslip_solvers::Matrix;

type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

/// The same bits in any number of threads: the sums of the stresses of all cells.
#[test]
fn products_in_threads_have_the_same_bits() -> Outcome {
    let medium = Medium {
        shear_modulus: 30e9,
        shear_wave_speed: 3464.0,
    };
    let along = [Cells::new([0.0, 120e3], 400)?, Cells::new([0.0, 16e3], 80)?];
    let rectangles = Rectangles::new(along[0], along[1]);
    let count = rectangles.count();
    let fault = PlaneFault::half_space(rectangles, 90.0, medium, 0.25)?.with_rake(0.0)?;
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
