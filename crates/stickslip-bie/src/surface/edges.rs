//! The stress of a closed loop of straight dislocations in a whole space.
//!
//! Peach and Koehler's line integral, edge by edge (T. Mura, Micromechanics of defects in solids, 1987). The integrals
//! along an edge are taken without their limits at infinity, so that nothing cancels on the continuation of an edge.

use std::f64::consts::PI;

use nalgebra::Vector3;

/// The elastic factors of stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Elastic {
    /// `mu/(4 pi)`.
    screw: f64,
    /// `mu/(4 pi (1 - nu))`.
    edge: f64,
}

impl Elastic {
    pub(crate) fn new(shear_modulus: f64, poisson_ratio: f64) -> Self {
        let screw = shear_modulus / (4.0 * PI);
        Self {
            screw,
            edge: screw / (1.0 - poisson_ratio),
        }
    }
}

/// A triangle, or another plane polygon, as a loop: its corners, and the unit tangents of the edges that begin there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Loop<const K: usize = 3> {
    pub(crate) corners: [Vector3<f64>; K],
    tangents: [Vector3<f64>; K],
}

impl<const K: usize> Loop<K> {
    pub(crate) fn new(corners: [Vector3<f64>; K]) -> Self {
        let edge = |k: usize| corners[(k + 1) % K] - corners[k];
        Self {
            corners,
            tangents: std::array::from_fn(|k| edge(k) / edge(k).norm()),
        }
    }

    /// The traction at a point on a plane with a unit normal, for each slip of the side from which the loop is seen to
    /// run counterclockwise, relative to the other.
    ///
    /// With `d` from an edge to the point, its tangent `t`, `w = b x t` and the integrals `J`, `I = d J30 - t J31`:
    /// `sigma = c [(I x b) t + t (I x b)] - c' [3 (w.d)(d d J50 - (d t + t d) J51 + t t J52) - w I - I w + (w.I)]`.
    #[inline(always)]
    pub(crate) fn tractions<const S: usize>(
        &self,
        at: &Vector3<f64>,
        normal: &Vector3<f64>,
        slips: &[Vector3<f64>; S],
        elastic: &Elastic,
    ) -> [Vector3<f64>; S] {
        let from = self.corners.map(|corner| at - corner);
        let inverse = from.map(|r| 1.0 / r.norm());
        let across = slips.map(|slip| slip.cross(normal));
        let (mut with_slip, mut about_slip) = (Vector3::zeros(), Vector3::zeros());
        let mut screw = [Vector3::zeros(); S];
        let mut edge = [Vector3::zeros(); S];
        let mut pressure = [0.0; S];
        for k in 0..K {
            let (next, t) = ((k + 1) % K, self.tangents[k]);
            let ends = [-from[k].dot(&t), -from[next].dot(&t)];
            let d = from[k] + t * ends[0];
            let [j30, j31, j50, j51, j52] = integrals(ends, [inverse[k], inverse[next]], &d);
            let i = d * j30 - t * j31;
            let [tn, dn, in_] = [t, d, i].map(|vector| vector.dot(normal));
            with_slip += i * tn;
            about_slip += t * in_;
            let beside = t.cross(&d);
            let second = d * (j50 * dn - j51 * tn) + t * (j52 * tn - j51 * dn);
            for (s, slip) in slips.iter().enumerate() {
                let wd = slip.dot(&beside);
                screw[s] += t * i.dot(&across[s]);
                edge[s] += second * (3.0 * wd) + i * t.dot(&across[s]);
                pressure[s] += wd * j30;
            }
        }
        std::array::from_fn(|s| {
            let screw = screw[s] + with_slip.cross(&slips[s]);
            let edge = edge[s] - slips[s].cross(&about_slip) + normal * pressure[s];
            screw * elastic.screw - edge * elastic.edge
        })
    }
}

/// `J30`, `J31`, `J50`, `J51`, `J52`: the integrals of `1/R^3`, `s/R^3`, `1/R^5`, `s/R^5`, `s^2/R^5` between the ends of
/// an edge, `R^2 = d^2 + s^2`, from the inverse distances of its ends.
#[inline(always)]
fn integrals(ends: [f64; 2], inverse: [f64; 2], d: &Vector3<f64>) -> [f64; 5] {
    let mut sums = [0.0; 5];
    if ends[0] < 0.0 && ends[1] >= 0.0 {
        // The limits at both infinities.
        let limit = 2.0 / d.norm_squared();
        sums = [limit, 0.0, limit * limit, 0.0, limit];
    }
    for (end, s) in ends.into_iter().enumerate() {
        let ir = inverse[end];
        let u = s.abs() * ir;
        let q = ir * ir / (1.0 + u);
        let [sign, side] = [if s >= 0.0 { -q } else { q }, -ir];
        let sign = if end == 0 { -sign } else { sign };
        let side = if end == 0 { -side } else { side };
        sums[0] += sign;
        sums[1] += side;
        sums[2] += sign * (u + 2.0) * q;
        sums[3] += side * ir * ir;
        sums[4] += sign * (1.0 + u + u * u);
    }
    const THIRD: f64 = 1.0 / 3.0;
    let [j30, j31, j50, j51, j52] = sums;
    [j30, j31, j50 * THIRD, j51 * THIRD, j52 * THIRD]
}
