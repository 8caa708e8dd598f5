//! Stress and displacement of a dislocation, in plane strain and antiplane.

use std::f64::consts::PI;

use nalgebra::Complex;

use crate::{Medium, Mode};

/// An elastic whole space, or the half space below the real axis, with points `x + i z`.
///
/// A dislocation at `z0` is the begin of a jump `B`, left minus right, along a line from `z0` to infinity; a segment is the
/// difference of those at its begin and at its end. In plane strain, with `C = i mu B/(4 pi (1 - nu))`, `d = z - z0`,
/// `e = z - z0*`, `*` the conjugate and `kappa = 3 - 4 nu`, Kolosov's and Muskhelishvili's potentials are
///
/// ```text
/// Phi0 = C/d,                            Psi0 = C*/d + C z0*/d^2
/// Phi1 = -C/e + C* (z0* - z0)/e^2,       Psi1 = -C*/e - Phi1 - z Phi1'          (free surface)
/// sxx + szz = 4 Re Phi,                  szz - sxx + 2 i sxz = 2 (z* Phi' + Psi)
/// 2 mu (ux + i uz) = kappa phi - z Phi* - psi*,   phi' = Phi,  psi' = Psi
/// ```
///
/// Sources: N. I. Muskhelishvili, "Some Basic Problems of the Mathematical Theory of Elasticity", 1953, Secs. 32 and 112;
/// J. P. Hirth and J. Lothe, "Theory of Dislocations", 1982, Secs. 3-2 and 3-4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Space {
    pub(crate) shear_modulus: f64,
    /// `nu` in plane strain; 0 antiplane, where nothing depends on it.
    poisson_ratio: f64,
    free_surface: bool,
}

/// The stress in plane strain \[Pa\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct InPlane {
    /// `sxx + szz`.
    pub(crate) trace: f64,
    /// `szz - sxx + 2 i sxz`.
    pub(crate) deviator: Complex<f64>,
}

impl Space {
    pub(crate) fn new(rock: Medium, mode: Mode, free_surface: bool) -> Self {
        let poisson_ratio = match mode {
            Mode::Antiplane => 0.0,
            Mode::InPlane { poisson_ratio } => poisson_ratio,
        };
        Self {
            shear_modulus: rock.shear_modulus,
            poisson_ratio,
            free_surface,
        }
    }

    /// `nu`.
    pub(crate) fn poisson_ratio(&self) -> f64 {
        self.poisson_ratio
    }

    /// `C`.
    fn constant(&self, jump: Complex<f64>) -> Complex<f64> {
        let modulus = self.shear_modulus / (4.0 * PI * (1.0 - self.poisson_ratio));
        Complex::new(-jump.im, jump.re) * modulus
    }

    /// The stress of a segment at `z`.
    pub(crate) fn in_plane(
        &self,
        [begin, end]: [Complex<f64>; 2],
        jump: Complex<f64>,
        z: Complex<f64>,
    ) -> InPlane {
        let constant = self.constant(jump);
        let [a, b] = [begin, end].map(|z0| self.dislocation(constant, z0, z));
        InPlane {
            trace: a.trace - b.trace,
            deviator: a.deviator - b.deviator,
        }
    }

    fn dislocation(&self, constant: Complex<f64>, z0: Complex<f64>, z: Complex<f64>) -> InPlane {
        let turned = constant.conj();
        let d = z - z0;
        let inverse = d.inv();
        let mut potential = constant * inverse;
        // z* Phi0' + Psi0.
        let mut deviator = (turned - constant * d.conj() * inverse) * inverse;
        if self.free_surface {
            let near = (z - z0.conj()).inv();
            let moment = turned * (z0.conj() - z0) * near;
            let image = (moment - constant) * near;
            let slope = (constant - moment * 2.0) * near * near;
            potential += image;
            deviator += (z.conj() - z) * slope - turned * near - image;
        }
        InPlane {
            trace: 4.0 * potential.re,
            deviator: deviator * 2.0,
        }
    }

    /// The displacement `ux + i uz` of a segment at `z`, cut along the segment.
    pub(crate) fn in_plane_displacement(
        &self,
        [begin, end]: [Complex<f64>; 2],
        jump: Complex<f64>,
        z: Complex<f64>,
    ) -> Complex<f64> {
        let constant = self.constant(jump);
        let turned = constant.conj();
        let kappa = 3.0 - 4.0 * self.poisson_ratio;
        let log = ratio_log(z - begin, z - end);
        let mut sum = (constant * log) * kappa - (turned * log).conj();
        if self.free_surface {
            let image_log = ratio_log(z - begin.conj(), z - end.conj());
            sum += -(constant * image_log) * kappa + (turned * image_log).conj();
        }
        for (sign, z0) in [(1.0, begin), (-1.0, end)] {
            let inverse = (z - z0).inv();
            // -z Phi0* - psi0* without its logarithm.
            let mut part = -z * (constant * inverse).conj();
            part += (constant * z0.conj() * inverse).conj();
            if self.free_surface {
                let near = (z - z0.conj()).inv();
                let moment = turned * (z0.conj() - z0) * near;
                let image = (moment - constant) * near;
                // kappa phi1 - z Phi1* - psi1*, psi1 = -C* log e - z Phi1.
                part += -moment * kappa + (z.conj() - z) * image.conj();
            }
            sum += part * sign;
        }
        sum / (2.0 * self.shear_modulus)
    }

    /// `sxy - i szy` of a segment at `z`, `-(i mu/(2 pi)) [f(end) - f(begin)]`, `f(z0) = 1/(z - z0) - 1/(z - z0*)`.
    pub(crate) fn antiplane(
        &self,
        [begin, end]: [Complex<f64>; 2],
        jump: f64,
        z: Complex<f64>,
    ) -> Complex<f64> {
        let mut sum = (z - end).inv() - (z - begin).inv();
        if self.free_surface {
            sum -= (z - end.conj()).inv() - (z - begin.conj()).inv();
        }
        Complex::new(sum.im, -sum.re) * (self.shear_modulus * jump / (2.0 * PI))
    }

    /// The displacement along `y` of a segment at `z`, cut along the segment.
    pub(crate) fn antiplane_displacement(
        &self,
        [begin, end]: [Complex<f64>; 2],
        jump: f64,
        z: Complex<f64>,
    ) -> f64 {
        let mut angle = ratio_log(z - begin, z - end).im;
        if self.free_surface {
            angle -= ratio_log(z - begin.conj(), z - end.conj()).im;
        }
        -angle * jump / (2.0 * PI)
    }
}

/// `log(a/b)`, with its cut where `a/b` is negative: between the ends of a segment.
fn ratio_log(a: Complex<f64>, b: Complex<f64>) -> Complex<f64> {
    let turned = a * b.conj();
    Complex::new((a.norm() / b.norm()).ln(), turned.im.atan2(turned.re))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn space(mode: Mode, free_surface: bool) -> Space {
        let rock = Medium {
            shear_modulus: 1.0,
            shear_wave_speed: 1.0,
        };
        Space::new(rock, mode, free_surface)
    }

    const PLANE_STRAIN: Mode = Mode::InPlane {
        poisson_ratio: 0.25,
    };

    /// Long strips of triangular dislocations below a free surface approach these values, to 3e-8.
    #[test]
    fn segments_are_long_strips() {
        let ends = [Complex::new(1.0, -2.0), Complex::new(3.0, -7.0)];
        let z = Complex::new(-1.0, -3.0);
        let stress = space(PLANE_STRAIN, true).in_plane(ends, Complex::new(0.6, 0.8), z);
        let xx = 0.5 * (stress.trace - stress.deviator.re);
        let zz = 0.5 * (stress.trace + stress.deviator.re);
        let found = [xx, zz, 0.5 * stress.deviator.im];
        let known = [-0.026_754_701_4, 0.040_392_949_0, 0.058_687_316_7];
        for (found, known) in found.into_iter().zip(known) {
            assert!((found - known).abs() < 1e-10, "{found}");
        }
        let stress = space(Mode::Antiplane, true).antiplane(ends, 1.0, z);
        assert!((stress.re + 0.038_005_102_8).abs() < 1e-10, "{stress}");
        assert!((-stress.im - 0.038_279_507_9).abs() < 1e-10, "{stress}");
    }

    /// The inside of a closed polygon with one jump everywhere is moved as a rigid body; nothing is strained.
    #[test]
    fn a_closed_polygon_moves_its_inside() {
        let corners = [(0.0, -1.0), (2.0, -1.5), (2.5, -4.0), (-1.0, -3.0)];
        let corners = corners.map(|(x, z)| Complex::new(x, z));
        let jump = Complex::new(0.3, -0.7);
        let sides = (0..4).map(|k| [corners[k], corners[(k + 1) % 4]]);
        for free_surface in [false, true] {
            let [strained, sheared] =
                [PLANE_STRAIN, Mode::Antiplane].map(|mode| space(mode, free_surface));
            // Clockwise: the inside is to the right.
            for (x, z, inside) in [(1.0, -2.0, 1.0), (4.0, -1.0, 0.0), (-2.0, -7.0, 0.0)] {
                let z = Complex::new(x, z);
                let stresses = sides.clone().map(|side| strained.in_plane(side, jump, z));
                let sum = stresses.fold(0.0, |sum, stress| sum + stress.trace);
                let shear = (sides.clone()).map(|side| strained.in_plane(side, jump, z).deviator);
                assert!(sum.abs() < 1e-14 && shear.sum::<Complex<f64>>().norm() < 1e-14);
                let moved = sides
                    .clone()
                    .map(|side| strained.in_plane_displacement(side, jump, z));
                let moved: Complex<f64> = moved.sum();
                assert!((moved + jump * inside).norm() < 1e-14, "{moved}");
                let stress = sides.clone().map(|side| sheared.antiplane(side, 1.0, z));
                assert!(stress.sum::<Complex<f64>>().norm() < 1e-14);
                let along = sides.clone();
                let along = along.map(|side| sheared.antiplane_displacement(side, 1.0, z));
                assert!((along.sum::<f64>() + inside).abs() < 1e-14);
            }
        }
    }
}
