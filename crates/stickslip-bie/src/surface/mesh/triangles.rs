//! A surface of triangles.

use nalgebra::Vector3;
use stickslip_solvers::MeshId;

use super::super::SurfaceError;
use super::adjacency::{self, Neighbors};
use super::axes::{self, CellAxes};
use super::vertices::Vertices;
use super::{orientation, separation};

/// The area over the longest side squared below which a triangle is degenerate.
const DEGENERATE: f64 = 1e-6;

/// The triangles of a fault in space, cells with constant slip: one sheet or several, with branches, holes and rims.
///
/// Positions are `[x, y, z]` \[m\]: east, north and up. Points that coincide within 1e-9 of the box are merged. A sheet is
/// what is connected across edges; where more than two triangles meet at an edge, those continue each other that bend
/// least. Corners are put in such an order that normals of a sheet agree and point up on average, or as that of its
/// largest triangle if it is vertical: [`flipped`](Self::flipped) says which were not.
///
/// ```
/// use stickslip_bie::Triangles;
///
/// // A square that dips 45 degrees to the south, of two triangles.
/// let points = [[0.0, 0.0, 0.0], [1e3, 0.0, 0.0], [1e3, -1e3, -1e3], [0.0, -1e3, -1e3]];
/// let cells = Triangles::new(&points, &[[0, 1, 2], [0, 2, 3]])?;
/// assert_eq!((cells.count(), cells.sheet_count(), cells.flipped()), (2, 1, &[0, 1][..]));
/// assert_eq!(cells.neighbors(0).iter().flatten().count(), 1);
/// // It dips to the right of strike, which is east.
/// assert_eq!(cells.axes(0).strike, [1.0, 0.0, 0.0]);
/// assert!((cells.area(0) - 0.5e6 * 2f64.sqrt()).abs() < 1e-3);
/// # Ok::<(), stickslip_bie::SurfaceError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("unstructured", "nonplanar", "mesh", "TriangleMesh"))]
pub struct Triangles {
    pub(super) points: Vec<[f64; 3]>,
    pub(super) corners: Vec<[usize; 3]>,
    centroids: Vec<[f64; 3]>,
    areas: Vec<f64>,
    axes: Vec<CellAxes>,
    neighbors: Vec<Neighbors>,
    sheets: Vec<usize>,
    around: (Vec<usize>, Vec<usize>),
    merged: usize,
    flipped: Vec<usize>,
}

impl Triangles {
    /// From points \[m\] and the numbers of three of them per triangle. Points that no triangle has are left out.
    ///
    /// # Errors
    /// [`SurfaceError`] for no triangle, a number out of range, a coordinate that is not finite, a degenerate triangle,
    /// two with the same corners, a sheet with one side only, triangles that cross, and a centroid that is nearer to
    /// another triangle than a tenth of the root of the smaller area.
    pub fn new(points: &[[f64; 3]], triangles: &[[usize; 3]]) -> Result<Self, SurfaceError> {
        let Vertices {
            points,
            triangles: mut corners,
            merged,
        } = Vertices::new(points, triangles)?;
        let mut vectors = Vec::with_capacity(corners.len());
        for (triangle, corners) in corners.iter().enumerate() {
            vectors.push(area_vector(&points, corners, triangle)?);
        }
        let mut neighbors = adjacency::neighbors(&points, &corners)?;
        let oriented = orientation::orient(&points, &corners, &neighbors, &vectors)?;
        let areas: Vec<_> = vectors.iter().map(Vector3::norm).collect();
        separation::check(&points, &corners, &areas)?;
        let flipped = (0..corners.len()).filter(|&cell| oriented.flipped[cell]);
        let flipped: Vec<_> = flipped.collect();
        for &cell in &flipped {
            // The edge from corner k to the next is another one then.
            corners[cell].swap(1, 2);
            neighbors[cell].swap(0, 2);
            vectors[cell] = -vectors[cell];
        }
        let normals: Vec<_> = (vectors.iter().zip(&areas))
            .map(|(vector, area)| vector / *area)
            .collect();
        let centroids = (corners.iter()).map(|corners| {
            std::array::from_fn(|c| corners.iter().map(|&p| points[p][c]).sum::<f64>() / 3.0)
        });
        Ok(Self {
            centroids: centroids.collect(),
            axes: axes::axes(&normals, &areas, &neighbors, &oriented.sheets),
            around: adjacency::around_vertices(&corners, &oriented.sheets),
            sheets: oriented.sheets,
            points,
            corners,
            areas,
            neighbors,
            merged,
            flipped,
        })
    }

    /// The number of triangles.
    pub fn count(&self) -> usize {
        self.corners.len()
    }

    /// The vertices \[m\], each once.
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// The vertices of each triangle, counterclockwise as seen from the side to which the normal points.
    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.corners
    }

    /// The corners of a triangle \[m\].
    pub fn corners(&self, cell: usize) -> [[f64; 3]; 3] {
        self.corners[cell].map(|corner| self.points[corner])
    }

    /// The centroid of a triangle \[m\].
    pub fn centroid(&self, cell: usize) -> [f64; 3] {
        self.centroids[cell]
    }

    /// The area of a triangle [m^2].
    pub fn area(&self, cell: usize) -> f64 {
        self.areas[cell]
    }

    /// The axes of a triangle.
    pub fn axes(&self, cell: usize) -> &CellAxes {
        &self.axes[cell]
    }

    /// The triangle that continues a triangle across each of its edges, that from corner `k` to the next; none at a rim.
    pub fn neighbors(&self, cell: usize) -> &[Option<usize>; 3] {
        &self.neighbors[cell]
    }

    /// The triangles of the same sheet that share a vertex with a triangle, itself among them.
    pub fn vertex_neighbors(&self, cell: usize) -> &[usize] {
        let (cells, starts) = &self.around;
        &cells[starts[cell]..starts[cell + 1]]
    }

    /// The sheet of a triangle, from 0.
    pub fn sheet(&self, cell: usize) -> usize {
        self.sheets[cell]
    }

    /// The number of sheets.
    pub fn sheet_count(&self) -> usize {
        self.sheets.iter().max().map_or(0, |last| last + 1)
    }

    /// The number of points that were merged with another.
    pub fn merged_points(&self) -> usize {
        self.merged
    }

    /// The triangles whose corners were put in the other order.
    pub fn flipped(&self) -> &[usize] {
        &self.flipped
    }

    /// The value of a function of position \[m\] at the centroid of each triangle.
    pub fn map<T>(&self, value: impl FnMut([f64; 3]) -> T) -> Vec<T> {
        self.centroids.iter().copied().map(value).collect()
    }

    /// The identity by which parts of a scene are matched: the number of cells, and the [fingerprint](Self::fingerprint).
    pub fn identity(&self) -> MeshId {
        MeshId {
            vertices: self.count(),
            elements: None,
            fingerprint: self.fingerprint(),
        }
    }

    /// A fingerprint that other cells do not have, as far as 64 bits allow.
    pub fn fingerprint(&self) -> u64 {
        // FNV-1a over words, as that of `Cells`.
        let points = self.points.iter().flatten().map(|x| x.to_bits());
        let corners = self.corners.iter().flatten().map(|&corner| corner as u64);
        points
            .chain(corners)
            .fold(0xcbf2_9ce4_8422_2325, |hash: u64, word| {
                (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3)
            })
    }
}

/// The area times the normal.
fn area_vector(
    points: &[[f64; 3]],
    corners: &[usize; 3],
    triangle: usize,
) -> Result<Vector3<f64>, SurfaceError> {
    let [a, b, c] = corners.map(|corner| Vector3::from(points[corner]));
    let vector = (b - a).cross(&(c - a)) * 0.5;
    let sides = [b - a, c - b, a - c].map(|side| side.norm());
    let longest = sides.into_iter().fold(0.0, f64::max);
    let area = vector.norm();
    // What is not a number is no area either.
    if area >= DEGENERATE * longest * longest && area > 0.0 {
        return Ok(vector);
    }
    Err(SurfaceError::Degenerate {
        triangle,
        area,
        longest,
    })
}
