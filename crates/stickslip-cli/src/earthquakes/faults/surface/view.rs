//! A surface in space as seen from afar: a parallel projection.

use stickslip::bie::Triangles;
use stickslip::nalgebra::Vector3;

use crate::plot::Points;

/// The angle of the view above the horizontal, and from the normal of the surface about the vertical \[degrees\].
const ABOVE: f64 = 28.0;
const BESIDE: f64 = 35.0;

/// The distance of texts from the box, as a share of its diagonal.
const AWAY: f64 = 0.09;

/// A surface in the plane of the picture \[km\].
pub(super) struct View {
    /// Cells, the farthest first.
    pub(super) order: Vec<usize>,
    /// Their corners, in this order.
    pub(super) corners: Vec<[[f64; 2]; 3]>,
    /// The edges of the box about the surface.
    pub(super) frame: Vec<Points>,
    /// The extents of the box beside its edges.
    pub(super) texts: Vec<((f64, f64), String)>,
}

impl View {
    pub(super) fn new(cells: &Triangles) -> Self {
        let [right, up, toward] = camera(cells);
        let flat = |point: [f64; 3]| {
            let point = Vector3::from(point) / 1e3;
            [point.dot(&right), point.dot(&up)]
        };
        let depth = |cell: usize| Vector3::from(cells.centroid(cell)).dot(&toward);
        let mut order: Vec<usize> = (0..cells.count()).collect();
        order.sort_by(|&a, &b| depth(a).total_cmp(&depth(b)));
        let corners = order.iter().map(|&cell| cells.corners(cell).map(flat));
        let [low, high] = bounds(cells);
        let corner = |n: usize| [0, 1, 2].map(|c| if (n >> c) & 1 == 0 { low[c] } else { high[c] });
        let edges = (0..8_usize).flat_map(|n| (0..3).map(move |c| (n, c)));
        let edges: Vec<_> = edges.filter(|(n, c)| (n >> c) & 1 == 0).collect();
        let point = |n: usize| {
            let [x, y] = flat(corner(n));
            (x, y)
        };
        let ends = |&(n, c): &(usize, usize)| [n, n | (1 << c)].map(point);
        // The extents of x and y stand outside of the lowest edge along them, that of z outside of the leftmost one.
        let middle = |edge: &(usize, usize)| {
            let [a, b] = ends(edge);
            (0.5 * (a.0 + b.0), 0.5 * (a.1 + b.1))
        };
        let [x, y] = flat([0, 1, 2].map(|c| 0.5 * (low[c] + high[c])));
        let size = Vector3::from(high) - Vector3::from(low);
        let texts = (0..3).filter_map(|c| {
            let along = edges.iter().filter(|(_, axis)| *axis == c).map(&middle);
            let place = along.min_by(|a, b| {
                let place = |p: &(f64, f64)| if c == 2 { p.0 } else { p.1 };
                place(a).total_cmp(&place(b))
            })?;
            let outward = (place.0 - x, place.1 - y);
            let share = AWAY * size.norm() / 1e3 / outward.0.hypot(outward.1).max(1e-9);
            let place = (place.0 + share * outward.0, place.1 + share * outward.1);
            let [from, to] = [low, high].map(|point| point[c] / 1e3 + 0.0);
            Some((
                place,
                format!("{} {from:.0} to {to:.0} km", ["x", "y", "z"][c]),
            ))
        });
        Self {
            corners: corners.collect(),
            frame: edges.iter().map(|edge| ends(edge).to_vec()).collect(),
            texts: texts.collect(),
            order,
        }
    }
}

/// The directions to the right, up and to the viewer: from above, on the side to which the normals point.
fn camera(cells: &Triangles) -> [Vector3<f64>; 3] {
    let normals =
        (0..cells.count()).map(|cell| Vector3::from(cells.axes(cell).normal) * cells.area(cell));
    let normal: Vector3<f64> = normals.sum();
    let azimuth = if normal.x.hypot(normal.y) > 1e-6 * normal.norm() {
        normal.y.atan2(normal.x)
    } else {
        -std::f64::consts::FRAC_PI_2
    };
    let (sin, cos) = (azimuth + BESIDE.to_radians()).sin_cos();
    let (rise, flat) = ABOVE.to_radians().sin_cos();
    let toward = Vector3::new(flat * cos, flat * sin, rise);
    let right = Vector3::z().cross(&toward).normalize();
    [right, toward.cross(&right), toward]
}

/// The lowest and the highest coordinates.
fn bounds(cells: &Triangles) -> [[f64; 3]; 2] {
    let none = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    cells.points().iter().fold(none, |[low, high], point| {
        [
            [0, 1, 2].map(|c| low[c].min(point[c])),
            [0, 1, 2].map(|c| high[c].max(point[c])),
        ]
    })
}
