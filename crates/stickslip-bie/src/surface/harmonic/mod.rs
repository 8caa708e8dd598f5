//! The harmonic part of a triangular dislocation, or one with more corners, in a half space `z <= 0`.
//!
//! Stress in a half space is the sum of three parts:
//!
//! 1. the triangle's in a whole space, at the receiver;
//! 2. its mirror image's at `z = 0`: in a whole space, the loop mirrored and traversed backwards, with the slip's `z`
//!    component reversed. It equals part 1 at the mirrored receiver with the signs of `xz` and `yz` reversed;
//! 3. the part of this module.
//!
//! Parts 1 and 2 leave the surface free of shear, with the normal stress `2 s_zz` of part 1. Part 3 removes it: in a half space
//! without shear at its surface, stresses follow from one harmonic function `phi` of the mirrored receiver, with
//! `z = -height >= 0` its height above the surface:
//!
//! ```text
//! s_zz = -phi,zz + z phi,zzz     s_iz = -z phi,zzi     s_ij = (1 - 2 nu) phi,ij + z phi,ijz - 2 nu delta_ij phi,zz     i, j = x, y
//! ```
//!
//! `phi,zz = 2 s_zz` at the surface defines it: `2 s_zz` of an edge is biharmonic, `h0 + z h1`, so `phi,zz = 2 h0`. With `M,zz = 1/R`,
//! `L = M,z`, edge direction `t`, `v = b x t` for slip `b`, source height `z'`
//!
//! ```text
//! phi = mu/(2 pi) sum over edges, integral ds { 2 t_z (b x grad M)_z + [v . grad M - v_z L + z' v . grad L]/(1 - nu) }
//! ```
//!
//! The integrals are differences of potentials between the ends of an edge, which have closed derivatives without angular
//! dislocations, logarithms or cancellation (file `end.rs`): nothing is singular below the surface.
//!
//! The sum of the three parts is that of M. Nikkhoo and T. Walter, Geophys. J. Int. 201 (2015), doi:10.1093/gji/ggv035.

mod axial;
mod end;
mod in_space;
mod slopes;
mod two;

use std::f64::consts::PI;

use end::{Ends, jets};
use in_space::Direction;
use slopes::slopes;
use two::Two;

/// Edges whose cosine with the vertical is smaller may be traversed either way.
const FLAT: f64 = 0.5;

/// An edge that points up, as seen from a receiver.
struct Edge {
    direction: Direction,
    /// The horizontal direction `e`.
    horizontal: [f64; 2],
    /// The mirrored receiver from each end, in the edge's frame.
    from_ends: [Two; 3],
    /// Heights of the ends, at most 0.
    heights: Two,
    /// `1/(2 pi)`, negative if the loop traverses it the other way.
    share: f64,
}

/// Stress `xx yy zz xy xz yz` per unit shear modulus [1/length of the triangle per unit slip], for each slip.
///
/// A slip is that of the side to which `(v1 - v0) x (v2 - v0)` points, relative to the other. Heights are at most 0; the receiver
/// is not at a vertex or edge that is at the surface.
pub(crate) fn stress<const N: usize, const K: usize>(
    corners: &[[f64; 3]; K],
    slips: &[[f64; 3]; N],
    poisson_ratio: f64,
    point: [f64; 3],
) -> [[f64; 6]; N] {
    let k = (1.0 - poisson_ratio).recip();
    let mut stresses = [[0.0; 6]; N];
    for edge in edges(corners, point) {
        let ends = Ends::new(edge.from_ends, edge.direction);
        let jets = jets(&ends, edge.direction, edge.heights, k);
        let potentials = jets.map(|jet| jet.map(|both| edge.share * both.drop()));
        for (stress, slip) in stresses.iter_mut().zip(slips) {
            let jet = edge.combine(&potentials, slip, k);
            edge.add_stress(&jet, poisson_ratio, -point[2], stress);
        }
    }
    stresses
}

/// Displacement along `x`, `y`, `z` per unit slip, for each slip; slips and heights are those of [`stress`].
///
/// ```text
/// u_i = [(1 - 2 nu) phi,i + z phi,iz]/(2 mu)     u_z = [2 (1 - nu) phi,z - z phi,zz]/(2 mu)     i = x, y
/// ```
pub(crate) fn displacement<const N: usize, const K: usize>(
    corners: &[[f64; 3]; K],
    slips: &[[f64; 3]; N],
    poisson_ratio: f64,
    point: [f64; 3],
) -> [[f64; 3]; N] {
    let k = (1.0 - poisson_ratio).recip();
    let mut displacements = [[0.0; 3]; N];
    for edge in edges(corners, point) {
        let ends = Ends::new(edge.from_ends, edge.direction);
        let slopes = slopes(&ends, edge.direction, edge.heights, k);
        let potentials = slopes.map(|slopes| slopes.map(|both| edge.share * both.drop()));
        for (displacement, slip) in displacements.iter_mut().zip(slips) {
            let slopes = edge.combine(&potentials, slip, k);
            edge.add_displacement(&slopes, poisson_ratio, -point[2], displacement);
        }
    }
    displacements
}

/// The edges of a triangle or another polygon.
fn edges<const K: usize>(corners: &[[f64; 3]; K], point: [f64; 3]) -> impl Iterator<Item = Edge> {
    let pairs: [_; K] = std::array::from_fn(|first| [corners[first], corners[(first + 1) % K]]);
    (pairs.into_iter()).filter_map(move |ends| Edge::seen(ends, point))
}

impl Edge {
    /// None if it has no length.
    fn seen([begin, end]: [[f64; 3]; 2], point: [f64; 3]) -> Option<Self> {
        let mut reversed = end[2] < begin[2];
        let [mut low, mut high] = if reversed { [end, begin] } else { [begin, end] };
        let [x, y, rise] = [0, 1, 2].map(|i| high[i] - low[i]);
        let run = (x * x + y * y).sqrt();
        let length = (run * run + rise * rise).sqrt();
        if length == 0.0 {
            return None;
        }
        let mut horizontal = if run > 0.0 {
            [x / run, y / run]
        } else {
            [1.0, 0.0]
        };
        let mut c = rise / length;
        let s = run / length;
        // A receiver behind a flat edge is ahead of the reversed one: no cancellation on its continuation.
        let ahead = |[x, y, z]: [f64; 3]| {
            s * (horizontal[0] * (point[0] - x) + horizontal[1] * (point[1] - y))
                - c * (point[2] + z)
        };
        if c < FLAT && ahead(low) < 0.0 {
            (low, high) = (high, low);
            horizontal = horizontal.map(|x| -x);
            c = -c;
            reversed = !reversed;
        }
        let from = |[x, y, z]: [f64; 3]| {
            let [x, y] = [point[0] - x, point[1] - y];
            let [e, h] = [
                horizontal[0] * x + horizontal[1] * y,
                horizontal[0] * y - horizontal[1] * x,
            ];
            [e, h, -point[2] - z]
        };
        let (from_low, from_high) = (from(low), from(high));
        Some(Self {
            direction: Direction {
                s,
                c,
                f: (1.0 + c).recip(),
            },
            horizontal,
            from_ends: [0, 1, 2].map(|i| Two([from_low[i], from_high[i]])),
            heights: Two([low[2], high[2]]),
            share: if reversed { -0.5 } else { 0.5 } / PI,
        })
    }

    /// Derivatives of `phi` for a slip.
    fn combine<const D: usize>(
        &self,
        [gamma, both, rest]: &[[f64; D]; 3],
        slip: &[f64; 3],
        k: f64,
    ) -> [f64; D] {
        let Direction { s, c, .. } = self.direction;
        let [x, y] = self.horizontal;
        let along = x * slip[0] + y * slip[1];
        let across = x * slip[1] - y * slip[0];
        let of_both = k * (s * slip[2] - c * along);
        std::array::from_fn(|n| 2.0 * c * along * gamma[n] + of_both * both[n] + across * rest[n])
    }

    /// Adds the stress of `phi` at a depth.
    fn add_stress(&self, jet: &[f64; 8], poisson_ratio: f64, depth: f64, stress: &mut [f64; 6]) {
        let &[hh, he, hhz, hez, zz, zze, zzh, zzz] = jet;
        let free = 1.0 - 2.0 * poisson_ratio;
        let inside = -2.0 * poisson_ratio * zz;
        let s_hh = free * hh + depth * hhz + inside;
        let s_ee = -free * (zz + hh) - depth * (zzz + hhz) + inside;
        let s_he = free * he + depth * hez;
        let [x, y] = self.horizontal;
        let cross = 2.0 * x * y * s_he;
        stress[0] += x * x * s_ee + y * y * s_hh - cross;
        stress[1] += y * y * s_ee + x * x * s_hh + cross;
        stress[2] += depth * zzz - zz;
        stress[3] += x * y * (s_ee - s_hh) + (x * x - y * y) * s_he;
        stress[4] -= depth * (x * zze - y * zzh);
        stress[5] -= depth * (y * zze + x * zzh);
    }

    /// Adds the displacement of `phi` at a depth.
    fn add_displacement(
        &self,
        slopes: &[f64; 6],
        poisson_ratio: f64,
        depth: f64,
        displacement: &mut [f64; 3],
    ) {
        let &[h, e, z, hz, ez, zz] = slopes;
        let free = 0.5 - poisson_ratio;
        let u_h = free * h + 0.5 * depth * hz;
        let u_e = free * e + 0.5 * depth * ez;
        let [x, y] = self.horizontal;
        displacement[0] += x * u_e - y * u_h;
        displacement[1] += y * u_e + x * u_h;
        displacement[2] += (1.0 - poisson_ratio) * z - 0.5 * depth * zz;
    }
}

#[cfg(test)]
pub(super) mod tests;
