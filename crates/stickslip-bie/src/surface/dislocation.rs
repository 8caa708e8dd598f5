//! The stress and the displacement of a triangular dislocation.

use nalgebra::{Matrix3, Vector3};

use super::edges::Loop;
use super::rock::Rock;
use crate::KernelError;
use crate::error::positive;

/// A triangle with constant slip in an elastic whole or half space: the stress and the displacement at any point.
///
/// Slip `b` is that of the side to which `(v1 - v0) x (v2 - v0)` points, relative to the other; it may have a part along
/// this normal, which opens the triangle. Tension is positive. The stress is a sum over the edges, with one root per
/// corner, and regular everywhere but on the edges themselves, also on their continuations. Rounding is of the order of
/// 1e-16 times the square of the distance by the size of the triangle.
///
/// ```
/// use nalgebra::Vector3;
/// use stickslip_bie::TriangularDislocation;
///
/// // Four triangles about an inner point are a vertical square of 10 km x 10 km, of left-lateral slip of 1 m.
/// let corners = [[-5e3, -15e3], [5e3, -15e3], [5e3, -5e3], [-5e3, -5e3]].map(|[x, z]| [x, 0.0, z]);
/// let mut stress = 0.0;
/// for k in 0..4 {
///     let triangle = [[-1300.0, 0.0, -11e3], corners[k], corners[(k + 1) % 4]];
///     let triangle = TriangularDislocation::whole_space(triangle, 32.04e9, 0.25)?;
///     // The normal is -y.
///     stress -= triangle.stress([1.0, 0.0, 0.0], [0.0, 0.0, -10e3])[(0, 1)];
/// }
/// assert!((stress / -3_365_382.390 - 1.0).abs() < 1e-9);
/// # Ok::<(), stickslip_bie::KernelError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("TDE", "triangular dislocation element", "Nikkhoo"))]
pub struct TriangularDislocation {
    edges: Loop,
    rock: Rock,
}

impl TriangularDislocation {
    /// In a whole space, from its corners \[m\], `mu` \[Pa\] and `nu`, above -1 and below 1/2.
    ///
    /// # Errors
    /// [`KernelError`] for corners that are not finite, a triangle without area, and a shear modulus or a Poisson ratio
    /// out of its range.
    pub fn whole_space(
        corners: [[f64; 3]; 3],
        shear_modulus: f64,
        poisson_ratio: f64,
    ) -> Result<Self, KernelError> {
        Self::new(corners, Rock::new(shear_modulus, poisson_ratio, false)?)
    }

    /// In a half space `z <= 0` with a free surface, see [`whole_space`](Self::whole_space). The triangle may touch the
    /// surface.
    ///
    /// Source: M. Nikkhoo and T. R. Walter, Geophys. J. Int. 201 (2015), of which this is the sum.
    ///
    /// # Errors
    /// The errors of [`whole_space`](Self::whole_space); [`KernelError`] for a corner above the surface.
    pub fn half_space(
        corners: [[f64; 3]; 3],
        shear_modulus: f64,
        poisson_ratio: f64,
    ) -> Result<Self, KernelError> {
        if let Some(&[_, _, z]) = corners.iter().find(|corner| corner[2] > 0.0) {
            let what = "height [m] of a corner above the surface";
            return Err(KernelError::new(what, "at most", z).bound(0.0));
        }
        Self::new(corners, Rock::new(shear_modulus, poisson_ratio, true)?)
    }

    fn new(corners: [[f64; 3]; 3], rock: Rock) -> Result<Self, KernelError> {
        for &value in corners.as_flattened() {
            if !value.is_finite() {
                let what = "coordinate [m] of a corner";
                return Err(KernelError::new(what, "finite", value));
            }
        }
        let [a, b, c] = corners.map(Vector3::from);
        let area = 0.5 * (b - a).cross(&(c - a)).norm();
        positive("area [m^2] of a triangle", area)?;
        Ok(Self {
            edges: Loop::new([a, b, c]),
            rock,
        })
    }

    pub(crate) fn edges(&self) -> Loop {
        self.edges
    }

    pub(crate) fn rock(&self) -> Rock {
        self.rock
    }

    /// The stress tensor \[Pa\] at a point of slip \[m\], both along the axes of the corners.
    ///
    /// It is not finite on the edges of the triangle, and without meaning above the surface of a half space.
    pub fn stress(&self, slip: [f64; 3], at: [f64; 3]) -> Matrix3<f64> {
        let (at, slips) = (Vector3::from(at), [Vector3::from(slip)]);
        let [stress] = self.rock.stresses(&self.edges, &at, &slips);
        stress
    }

    /// The displacement \[m\] at a point of slip \[m\], both along the axes of the corners; zero far away.
    ///
    /// A point in the triangle belongs to one of its sides, and half of the slip. On the edges of the triangle the displacement
    /// is not defined, and above the surface of a half space it has no meaning.
    pub fn displacement(&self, slip: [f64; 3], at: [f64; 3]) -> [f64; 3] {
        let (at, slips) = (Vector3::from(at), [Vector3::from(slip)]);
        let [displacement] = self.rock.displacements(&self.edges, &at, &slips);
        displacement.into()
    }
}
