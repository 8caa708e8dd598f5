//! Planes of so many rows that the part of a whole space is multiplied by transforms, and the images by low rank.

use nalgebra::{Vector2, Vector3};
use stickslip_bie::PlaneFault;
use stickslip_solvers::Matrix;

use super::{POISSON, cells};
use crate::{MEDIUM, Outcome};

/// Slip of single cells causes the stress of a rectangle at the centres of all others, by its closed form.
#[test]
fn products_are_stresses_of_cells() -> Outcome {
    for (dip, begin) in [(90.0_f64, 0.0), (60.0, 300.0), (30.0, 0.0)] {
        let rectangles = cells([6, 96], [200.0, 200.0], begin)?;
        let fault = PlaneFault::half_space(rectangles, dip, MEDIUM, POISSON)?;
        let (stiffness, normal_stiffness) = (fault.stiffness(), fault.normal_stiffness());
        // The matrix of the rows is not held.
        assert!(format!("{stiffness:?}").contains("ranks"), "{stiffness:?}");
        let (sin, cos) = match dip {
            90.0 => (1.0, 0.0),
            _ => dip.to_radians().sin_cos(),
        };
        let normal = Vector3::new(0.0, -sin, cos);
        let axes = [Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.0, cos, sin)];
        let scale = stiffness.diagonal_block(0).amax();
        for (from, slip) in [
            (0, [1.0, 0.0]),
            (3 + 6 * 40, [0.6, -0.8]),
            (575, [0.0, 1.0]),
        ] {
            let of_cell = fault.dislocation(from).ok_or("no rectangle")?;
            let mut slips = vec![Vector2::zeros(); rectangles.count()];
            slips[from] = Vector2::from(slip);
            let (mut forces, mut pressures) = (vec![Vector2::zeros(); 576], vec![0.0; 576]);
            stiffness.multiply_add(1.0, &slips, &mut forces);
            normal_stiffness.multiply_add(1.0, &slips, &mut pressures);
            for cell in 0..576 {
                let [x, y] = rectangles.center(cell);
                let traction = of_cell.stress(slip, [x, -y * cos, -y * sin]) * normal;
                let exact = Vector2::from(axes.map(|axis| -traction.dot(&axis)));
                let [[column, row], [of_column, of_row]] =
                    [cell, from].map(|cell| rectangles.column_and_row(cell));
                // The cross term of diagonal neighbours is corrected.
                if column.abs_diff(of_column) != 1 || row.abs_diff(of_row) != 1 {
                    let error = (forces[cell] - exact * rectangles.area()).amax() / scale;
                    assert!(error < 1e-11, "{dip} {cell} {from}: {error:e}");
                }
                let error = (pressures[cell] + traction.dot(&normal)) * rectangles.area() / scale;
                assert!(error.abs() < 1e-11, "{dip} {cell} {from}: normal {error:e}");
                // Entries by themselves are the same.
                let entry = normal_stiffness.entry(cell, from).dot(&Vector2::from(slip));
                let error = (pressures[cell] - entry) * rectangles.area() / scale;
                assert!(error.abs() < 1e-12, "{dip} {cell} {from}: entry {error:e}");
            }
            let products = stiffness.product_at(from, &slips);
            let own = stiffness.diagonal_block(from) * slips[from];
            assert!((products - own).amax() < 1e-12 * scale, "{dip} {from}");
        }
    }
    Ok(())
}
