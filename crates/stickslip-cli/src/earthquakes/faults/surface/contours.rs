//! Contours of a field of cells on an unrolled surface.

use stickslip::bie::Triangles;

/// Means of cells about each corner of each cell, by area, on the same sheet.
pub(super) fn at_corners(cells: &Triangles, values: &[f64]) -> Vec<[f64; 3]> {
    let triangles = cells.triangles();
    let about = |cell: usize, corner: usize| {
        let around = cells.vertex_neighbors(cell).iter();
        let around = around.filter(|&&other| triangles[other].contains(&corner));
        let (sum, area) = around.fold((0.0, 0.0), |(sum, area), &other| {
            let own = cells.area(other);
            (sum + own * values[other], area + own)
        });
        sum / area
    };
    (triangles.iter().enumerate())
        .map(|(cell, corners)| corners.map(|corner| about(cell, corner)))
        .collect()
}
