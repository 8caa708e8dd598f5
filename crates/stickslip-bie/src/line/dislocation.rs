//! The stress of an edge dislocation below a free surface, on the plane of its own fault.

use std::f64::consts::PI;

use nalgebra::Complex;

/// Shear and normal traction on a fault \[Pa\]: shear positive where it drives slip, normal positive in compression.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Traction {
    pub(crate) shear: f64,
    pub(crate) normal: f64,
}

/// A plane through the surface of a half space in plane strain, and dislocations on it.
///
/// Distances are measured down dip from the surface. A dislocation at the distance `c` is the upper end of slip of 1 m,
/// the hanging wall up dip, from `c` to infinity; a segment is the difference of its upper and its lower end.
///
/// Kolosov's and Muskhelishvili's potentials of a dislocation `B` at `z0` and of its image, with the material at
/// `y < 0`, `z = x + i y`, `C = i mu B/(4 pi (1 - nu))`, `d = z - z0`, `e = z - z0*` and `*` the conjugate:
///
/// ```text
/// Phi0 = C/d,                            Psi0 = C*/d + C z0*/d^2
/// Phi1 = -(C + C*)/e + C* (z - z0)/e^2,  Psi1 = -C*/e - Phi1 - z Phi1'
/// sxx + syy = 4 Re Phi,                  syy - sxx + 2 i sxy = 2 (z* Phi' + Psi)
/// ```
///
/// Sources: N. I. Muskhelishvili, "Some Basic Problems of the Mathematical Theory of Elasticity", 1953, Secs. 32 and
/// 112 (continuation across a free straight edge); J. P. Hirth and J. Lothe, "Theory of Dislocations", 1982, Sec. 3-4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plane {
    /// `mu/(4 pi (1 - nu))` \[Pa\].
    modulus: f64,
    /// The unit vector down dip, `exp(-i dip)`.
    down: Complex<f64>,
}

impl Plane {
    /// `mu` \[Pa\], `nu`, dip \[radians\].
    pub(crate) fn new(shear_modulus: f64, poisson_ratio: f64, dip: f64) -> Self {
        Self {
            modulus: shear_modulus / (4.0 * PI * (1.0 - poisson_ratio)),
            down: Complex::new(dip.cos(), -dip.sin()),
        }
    }

    /// The traction of the image of a dislocation at the distance `c`, seen at the distance `s` on the plane.
    pub(crate) fn image(&self, s: f64, c: f64) -> Traction {
        self.traction(self.image_stress(self.down * s, c))
    }

    /// `sxx + syy` and `syy - sxx + 2 i sxy` of the image at any `z` in the material.
    fn image_stress(&self, z: Complex<f64>, c: f64) -> (f64, Complex<f64>) {
        let (z0, constant) = (self.down * c, self.constant());
        let turned = constant.conj();
        let near = (z - z0.conj()).inv();
        let potential = (turned * (z - z0) * near - (constant + turned)) * near;
        let slope = (constant + turned * 2.0 - turned * (z - z0) * near * 2.0) * near * near;
        let deviator = (z.conj() - z) * slope - turned * near - potential;
        (4.0 * potential.re, deviator * 2.0)
    }

    /// `C` of the unit dislocation `B = -exp(-i dip)`, up dip.
    fn constant(&self) -> Complex<f64> {
        Complex::new(0.0, -self.modulus) * self.down
    }

    /// In axes up dip and into the footwall, turned by the angle `pi - dip`: `syy - sxx + 2 i sxy` turns by twice that.
    fn traction(&self, (trace, deviator): (f64, Complex<f64>)) -> Traction {
        let turned = deviator * self.down * self.down;
        Traction {
            shear: -0.5 * turned.im,
            normal: -0.5 * (trace + turned.re),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `sxx + syy` and `syy - sxx + 2 i sxy` of a dislocation in a whole space, by its potentials as they stand.
    fn whole_space(plane: &Plane, z: Complex<f64>, c: f64) -> (f64, Complex<f64>) {
        let (z0, constant) = (plane.down * c, plane.constant());
        let d = z - z0;
        let (potential, slope) = (constant / d, -constant / (d * d));
        let other = constant.conj() / d + constant * z0.conj() / (d * d);
        (4.0 * potential.re, (z.conj() * slope + other) * 2.0)
    }

    /// `[sxx, syy, sxy]` of the dislocation with its image.
    fn stress(plane: &Plane, z: Complex<f64>, c: f64) -> [f64; 3] {
        let ((trace, deviator), image) = (whole_space(plane, z, c), plane.image_stress(z, c));
        let (trace, deviator) = (trace + image.0, deviator + image.1);
        [
            0.5 * (trace - deviator.re),
            0.5 * (trace + deviator.re),
            0.5 * deviator.im,
        ]
    }

    const DIPS: [f64; 5] = [90.0, 60.0, 45.0, 30.0, 10.0];

    fn planes() -> impl Iterator<Item = Plane> {
        DIPS.iter()
            .flat_map(|dip| [0.0, 0.25, 0.4].map(|nu| Plane::new(1.0, nu, dip.to_radians())))
    }

    #[test]
    fn the_surface_is_free() {
        for plane in planes() {
            for x in [-7.0, -1.0, 0.0, 0.3, 0.9, 5.0, 40.0] {
                let [sxx, syy, sxy] = stress(&plane, Complex::new(x, 0.0), 1.0);
                let largest = plane.modulus.max(sxx.abs());
                assert!(syy.abs() < 1e-14 * largest && sxy.abs() < 1e-14 * largest);
            }
        }
    }

    /// `d sxx/dx + d sxy/dy = 0 = d sxy/dx + d syy/dy`, by central differences of fourth order.
    #[test]
    fn stresses_are_in_equilibrium_and_compatible() {
        let h = 2e-4;
        for plane in planes() {
            for z in [(0.3, -0.2), (-1.5, -0.7), (2.0, -3.0), (0.9, -0.05)] {
                let z = Complex::new(z.0, z.1);
                let at = |dx: f64, dy: f64| stress(&plane, z + Complex::new(dx, dy), 1.0);
                let slope = |of: usize, dx: f64, dy: f64| {
                    let difference = |n: f64| at(n * dx, n * dy)[of] - at(-n * dx, -n * dy)[of];
                    (8.0 * difference(1.0) - difference(2.0)) / (12.0 * h)
                };
                let size = slope(0, h, 0.0).abs() + slope(2, 0.0, h).abs() + plane.modulus;
                for (of_x, of_y) in [(0, 2), (2, 1)] {
                    let force = slope(of_x, h, 0.0) + slope(of_y, 0.0, h);
                    assert!(force.abs() < 1e-8 * size, "{force:e} of {size:e}");
                }
                // Compatibility: sxx + syy is harmonic.
                let trace = |dx: f64, dy: f64| at(dx, dy)[0] + at(dx, dy)[1];
                let bend = |dx: f64, dy: f64| {
                    let pair = |n: f64| trace(n * dx, n * dy) + trace(-n * dx, -n * dy);
                    (16.0 * pair(1.0) - pair(2.0) - 30.0 * trace(0.0, 0.0)) / (12.0 * h * h)
                };
                let (across, down) = (bend(h, 0.0), bend(0.0, h));
                assert!((across + down).abs() < 1e-6 * (across.abs() + plane.modulus));
            }
        }
    }

    /// `-mu/(2 pi (1 - nu)) 1/(s - c)` of shear, and no normal traction.
    #[test]
    fn a_whole_space_has_the_known_traction() {
        for plane in planes() {
            for (s, c) in [(0.5, 1.0), (1.2, 1.0), (9.0, 4.0)] {
                let Traction { shear, normal } =
                    plane.traction(whole_space(&plane, plane.down * s, c));
                let exact = -2.0 * plane.modulus / (s - c);
                assert!((shear / exact - 1.0).abs() < 1e-13);
                assert!(normal.abs() < 1e-14 * exact.abs());
            }
        }
    }

    /// `(mu/(2 pi (1 - nu))) (1/(s + c) + 2 c/(s + c)^2 - 4 c^2/(s + c)^3)` of shear on a vertical plane; by symmetry no
    /// normal traction.
    #[test]
    fn a_vertical_plane_has_the_closed_form() {
        let plane = Plane::new(2.0, 0.25, 0.5 * PI);
        for (s, c) in [(0.5_f64, 1.0_f64), (1.2, 1.0), (1.0, 1.0), (9.0, 0.0)] {
            let Traction { shear, normal } = plane.image(s, c);
            let sum = s + c;
            let exact = 1.0 / sum + 2.0 * c / sum.powi(2) - 4.0 * c.powi(2) / sum.powi(3);
            let exact = 2.0 * plane.modulus * exact;
            assert!((shear - exact).abs() < 1e-14 * plane.modulus);
            assert!(normal.abs() < 1e-15 * plane.modulus);
        }
    }

    /// A dislocation at the surface leaves the half space at rest: its image takes its stress away.
    #[test]
    fn a_dislocation_at_the_surface_has_no_stress() {
        for plane in planes() {
            for s in [0.1, 1.0, 30.0] {
                let Traction { shear, normal } = plane.image(s, 0.0);
                let own = -2.0 * plane.modulus / s;
                assert!((shear + own).abs() < 1e-14 * own.abs());
                assert!(normal.abs() < 1e-14 * own.abs());
            }
        }
    }
}
