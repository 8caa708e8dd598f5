//! Tractions of triangles in a whole or half space.

use nalgebra::{Matrix3, Vector3};

use super::edges::{Elastic, Loop};
use super::{displacement, harmonic};
use crate::KernelError;
use crate::error::positive;
use crate::plane::require_poisson_ratio;

/// Elastic rock, with a free surface at `z = 0` above it or without.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rock {
    shear_modulus: f64,
    poisson_ratio: f64,
    elastic: Elastic,
    has_surface: bool,
}

impl Rock {
    pub(crate) fn new(
        shear_modulus: f64,
        poisson_ratio: f64,
        has_surface: bool,
    ) -> Result<Self, KernelError> {
        positive("shear modulus", shear_modulus)?;
        require_poisson_ratio(poisson_ratio)?;
        Ok(Self {
            shear_modulus,
            poisson_ratio,
            elastic: Elastic::new(shear_modulus, poisson_ratio),
            has_surface,
        })
    }

    pub(crate) fn poisson_ratio(&self) -> f64 {
        self.poisson_ratio
    }

    pub(crate) fn has_surface(&self) -> bool {
        self.has_surface
    }

    /// The stress tensor at a point for each slip of a triangle or another polygon.
    pub(crate) fn stresses<const S: usize, const K: usize>(
        &self,
        source: &Loop<K>,
        at: &Vector3<f64>,
        slips: &[Vector3<f64>; S],
    ) -> [Matrix3<f64>; S] {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let columns = axes.map(|normal| self.tractions(source, at, &normal, slips));
        std::array::from_fn(|s| {
            let tractions = [columns[0][s], columns[1][s], columns[2][s]];
            Matrix3::from_columns(&tractions)
        })
    }

    /// The displacement at a point for each slip of a triangle or a rectangle.
    pub(crate) fn displacements<const S: usize, const K: usize>(
        &self,
        source: &Loop<K>,
        at: &Vector3<f64>,
        slips: &[Vector3<f64>; S],
    ) -> [Vector3<f64>; S] {
        let corners = source.corners.map(Into::into);
        let of = |slip: Vector3<f64>| {
            let (slip, point, nu) = (slip.into(), (*at).into(), self.poisson_ratio);
            if self.has_surface {
                displacement::half_space(&corners, slip, nu, point).into()
            } else {
                displacement::whole_space(&corners, slip, nu, point).into()
            }
        };
        slips.map(of)
    }

    /// The traction at a point on a plane with a unit normal for each slip of a triangle.
    #[inline(always)]
    pub(crate) fn tractions<const S: usize, const K: usize>(
        &self,
        source: &Loop<K>,
        at: &Vector3<f64>,
        normal: &Vector3<f64>,
        slips: &[Vector3<f64>; S],
    ) -> [Vector3<f64>; S] {
        let mut sum = self.without_surface(source, at, normal, slips);
        if self.has_surface {
            self.add_surface(source, at, normal, slips, &mut sum);
        }
        sum
    }

    /// The same in a whole space.
    #[inline(always)]
    pub(crate) fn without_surface<const S: usize, const K: usize>(
        &self,
        source: &Loop<K>,
        at: &Vector3<f64>,
        normal: &Vector3<f64>,
        slips: &[Vector3<f64>; S],
    ) -> [Vector3<f64>; S] {
        source.tractions(at, normal, slips, &self.elastic)
    }

    /// Adds the mirror image of the triangle, which is the triangle at the mirrored point, and the harmonic part.
    fn add_surface<const S: usize, const K: usize>(
        &self,
        source: &Loop<K>,
        at: &Vector3<f64>,
        normal: &Vector3<f64>,
        slips: &[Vector3<f64>; S],
        sums: &mut [Vector3<f64>; S],
    ) {
        let mirrored = |v: &Vector3<f64>| Vector3::new(v.x, v.y, -v.z);
        let images = self.without_surface(source, &mirrored(at), &mirrored(normal), slips);
        let corners = source.corners.map(Into::into);
        let slips = slips.map(Into::into);
        let harmonic = harmonic::stress(&corners, &slips, self.poisson_ratio, (*at).into());
        for ((sum, image), [xx, yy, zz, xy, xz, yz]) in sums.iter_mut().zip(&images).zip(harmonic) {
            let traction = Vector3::new(
                xx * normal.x + xy * normal.y + xz * normal.z,
                xy * normal.x + yy * normal.y + yz * normal.z,
                xz * normal.x + yz * normal.y + zz * normal.z,
            );
            *sum += mirrored(image) + traction * self.shear_modulus;
        }
    }
}
