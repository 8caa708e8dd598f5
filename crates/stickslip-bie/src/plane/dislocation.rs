//! The stress and the displacement of a rectangular dislocation in a half space.

use std::f64::consts::PI;

use nalgebra::Matrix3;

use super::angles::cos_sin;
use super::okada::{self, Dip, Gradient};
use crate::KernelError;
use crate::error::positive;
use crate::surface::displacement;

/// A rectangle with constant slip in an elastic half space: the stress (Okada) and the displacement at any point.
///
/// The rectangle lies on a plane that meets the free surface at `y = z = 0` and dips to the right of strike. Axes: `x`
/// along strike, `y` horizontal to the left, `z` up; the rock is at `z <= 0`. Slip is that of the hanging wall relative
/// to the footwall: along strike (left-lateral, rake 0) and up dip (thrust, rake 90). Tension is positive.
///
/// Source: Y. Okada, "Internal deformation due to shear and tensile faults in a half-space", Bull. Seismol. Soc. Am. 82
/// (1992) 1018-1040.
///
/// ```
/// use stickslip_bie::RectangularDislocation;
///
/// // A vertical patch of 10 km x 10 km with its centre at a depth of 10 km.
/// let patch = RectangularDislocation::new([-5e3, 5e3], [5e3, 15e3], 90.0, 32.04e9, 0.25)?;
/// let stress = patch.stress([1.0, 0.0], [0.0, 0.0, -10e3]);
/// // The normal into the hanging wall is -y: left-lateral slip of 1 m relieves 3.309 MPa.
/// assert!((-stress[(0, 1)] / -3.309_041_65e6 - 1.0).abs() < 1e-8);
/// # Ok::<(), stickslip_bie::KernelError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("Okada", "DC3D"))]
pub struct RectangularDislocation {
    along_strike: [f64; 2],
    down_dip: [f64; 2],
    cos: f64,
    sin: f64,
    shear_modulus: f64,
    poisson_ratio: f64,
}

impl RectangularDislocation {
    /// From its ends along strike and down dip \[m\], the latter as distances from the surface along the plane, the dip
    /// in degrees, above 0 and at most 90, `mu` \[Pa\] and `nu`, above -1 and below 1/2.
    ///
    /// # Errors
    /// [`KernelError`] for ends that are not finite or do not increase, a rectangle above the surface, and a dip, a
    /// shear modulus or a Poisson ratio out of its range.
    pub fn new(
        along_strike: [f64; 2],
        down_dip: [f64; 2],
        dip: f64,
        shear_modulus: f64,
        poisson_ratio: f64,
    ) -> Result<Self, KernelError> {
        for (what, [begin, end]) in [
            ("end along strike [m]", along_strike),
            ("end down dip [m]", down_dip),
        ] {
            if !(begin < end && begin.is_finite() && end.is_finite()) {
                let requirement = "finite, and beyond a finite begin at";
                return Err(KernelError::new(what, requirement, end).bound(begin));
            }
        }
        require_buried(down_dip[0])?;
        positive("shear modulus", shear_modulus)?;
        require_poisson_ratio(poisson_ratio)?;
        let [cos, sin] = dip_cos_sin(dip)?;
        Ok(Self {
            along_strike,
            down_dip,
            cos,
            sin,
            shear_modulus,
            poisson_ratio,
        })
    }

    /// The stress tensor \[Pa\] at a point `[x, y, z]` \[m\], `z <= 0`, of slip \[m\] along strike and up dip.
    ///
    /// It is not finite on the edges of the rectangle, and without meaning above the surface.
    pub fn stress(&self, slip: [f64; 2], [x, y, z]: [f64; 3]) -> Matrix3<f64> {
        let rock = Rock::new(self.shear_modulus, self.poisson_ratio, [self.cos, self.sin]);
        let Self { cos, sin, .. } = *self;
        // Okada's point and its image: up dip from the surface, and along the normal.
        let (up, q) = (y * cos + z * sin, y * sin - z * cos);
        let (up_image, q_image) = (y * cos - z * sin, y * sin + z * cos);
        let behind = [x < self.along_strike[0], up + self.down_dip[1] < 0.0];
        let mut stress = Matrix3::zeros();
        for (i, strike) in self.along_strike.into_iter().enumerate() {
            for (j, down) in self.down_dip.into_iter().enumerate() {
                // Okada's second coordinate is up dip: his lower corner is the deeper one.
                let sign = if i == j { -1.0 } else { 1.0 };
                let xi = x - strike;
                let source = okada::source(&rock.dip, [xi, up + down, q], behind);
                let at_image = [xi, up_image + down, q_image];
                let image = okada::image(&rock.dip, at_image, behind[0], z);
                for (slip, gradients) in slip.into_iter().zip(source.into_iter().zip(image)) {
                    for gradient in [gradients.0, gradients.1] {
                        stress += rock.stress(&gradient) * (sign * slip);
                    }
                }
            }
        }
        stress
    }

    /// The displacement \[m\] at a point `[x, y, z]` \[m\], `z <= 0`, of slip \[m\] along strike and up dip; zero far away.
    ///
    /// A point in the rectangle belongs to one of its sides, and half of the slip. On the edges of the rectangle the
    /// displacement is not defined, and above the surface it has no meaning.
    ///
    /// ```
    /// use stickslip_bie::RectangularDislocation;
    ///
    /// // The case of Okada, Bull. Seismol. Soc. Am. 75 (1985), Table 2: x = 2, y = 3, d = 4, dip 70 degrees, 3 x 2.
    /// let (sin, cos) = 70_f64.to_radians().sin_cos();
    /// // His plane ends at the depth 4 below y = 0: here it meets the surface at y = 0.
    /// let bottom = 4.0 / sin;
    /// let patch = RectangularDislocation::new([0.0, 3.0], [bottom - 2.0, bottom], 70.0, 1.0, 0.25)?;
    /// let [x, y, z] = patch.displacement([1.0, 0.0], [2.0, 3.0 - bottom * cos, 0.0]);
    /// let published = [-8.689e-3, -4.298e-3, -2.747e-3];
    /// assert!([x, y, z].iter().zip(published).all(|(u, okada)| (u - okada).abs() < 1e-6));
    /// # Ok::<(), stickslip_bie::KernelError>(())
    /// ```
    #[doc(alias("surface displacement", "geodesy"))]
    pub fn displacement(&self, [strike, up_dip]: [f64; 2], at: [f64; 3]) -> [f64; 3] {
        let Self { cos, sin, .. } = *self;
        let slip = [strike, up_dip * cos, up_dip * sin];
        let corners = corners(self.along_strike, self.down_dip, [cos, sin]);
        displacement::half_space(&corners, slip, self.poisson_ratio, at)
    }
}

/// The corners of a rectangle, counterclockwise as seen from the hanging wall, its directions along strike and up dip.
fn corners(
    [left, right]: [f64; 2],
    [top, bottom]: [f64; 2],
    [cos, sin]: [f64; 2],
) -> [[f64; 3]; 4] {
    let corner = |x: f64, down: f64| [x, -down * cos, -down * sin];
    [
        corner(left, bottom),
        corner(right, bottom),
        corner(right, top),
        corner(left, top),
    ]
}

/// Hooke's law, and a plane's axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rock {
    pub(crate) dip: Dip,
    shear_modulus: f64,
    /// `lambda/mu = 2 nu/(1 - 2 nu)`.
    ratio: f64,
}

impl Rock {
    pub(crate) fn new(shear_modulus: f64, poisson_ratio: f64, [cos, sin]: [f64; 2]) -> Self {
        Self {
            dip: Dip {
                alpha: 0.5 / (1.0 - poisson_ratio),
                cos,
                sin,
            },
            shear_modulus,
            ratio: 2.0 * poisson_ratio / (1.0 - 2.0 * poisson_ratio),
        }
    }

    /// The stress of a gradient times 2 pi.
    fn stress(&self, gradient: &Gradient) -> Matrix3<f64> {
        let mu = self.shear_modulus / (2.0 * PI);
        let divergence: f64 = (0..3).map(|i| gradient[i][i]).sum();
        Matrix3::from_fn(|i, j| {
            let own = if i == j { self.ratio * divergence } else { 0.0 };
            mu * (own + gradient[i][j] + gradient[j][i])
        })
    }

    /// The weights of a gradient, times 2 pi, whose weighted sum is that of its stress with `weights`.
    pub(crate) fn of_gradient(&self, weights: &Matrix3<f64>) -> Gradient {
        let mu = self.shear_modulus / (2.0 * PI);
        let own = self.ratio * weights.trace();
        let entry = |i: usize, j: usize| {
            let own = if i == j { own } else { 0.0 };
            mu * (own + weights[(i, j)] + weights[(j, i)])
        };
        std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
    }

    /// The traction on the plane of a gradient times 2 pi: shear along strike and up dip, which drive positive slip if
    /// positive, and tension.
    pub(crate) fn traction(&self, gradient: &Gradient) -> [f64; 3] {
        let Dip { cos, sin, .. } = self.dip;
        let mu = self.shear_modulus / (2.0 * PI);
        let divergence: f64 = (0..3).map(|i| gradient[i][i]).sum();
        // The normal is (0, -sin, cos), into the hanging wall.
        let normal: [f64; 3] = std::array::from_fn(|i| {
            let sum = |j: usize| gradient[i][j] + gradient[j][i];
            -sin * sum(1) + cos * sum(2)
        });
        let up_dip = cos * normal[1] + sin * normal[2];
        let tension = self.ratio * divergence - sin * normal[1] + cos * normal[2];
        [mu * normal[0], mu * up_dip, mu * tension]
    }
}

/// `[cos, sin]` of a dip in degrees, above 0 and at most 90.
pub(crate) fn dip_cos_sin(dip: f64) -> Result<[f64; 2], KernelError> {
    if dip > 0.0 && dip <= 90.0 {
        return Ok(cos_sin(dip));
    }
    Err(KernelError::new("dip [degrees]", "above 0, and at most", dip).bound(90.0))
}

/// Refuses a plane whose upper end is above the surface.
pub(crate) fn require_buried(upper_end: f64) -> Result<(), KernelError> {
    if upper_end >= 0.0 {
        return Ok(());
    }
    let what = "distance [m] of the plane's upper end from the surface";
    Err(KernelError::new(what, "at least", upper_end).bound(0.0))
}

/// Refuses a Poisson ratio that is not above -1 and below 1/2.
pub(crate) fn require_poisson_ratio(poisson_ratio: f64) -> Result<(), KernelError> {
    if poisson_ratio > -1.0 && poisson_ratio < 0.5 {
        return Ok(());
    }
    let requirement = "above -1 and below 1/2";
    Err(KernelError::new(
        "Poisson's ratio",
        requirement,
        poisson_ratio,
    ))
}
