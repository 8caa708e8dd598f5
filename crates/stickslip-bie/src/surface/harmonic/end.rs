//! What the end of an edge adds to the harmonic part: derivatives of potentials of a vertical and an inclined direction.
//!
//! Frame: `e` horizontal along the edge, `z` up, `h = z x e`; the edge's direction `t = s e + c z` points up (`c >= 0`, or at
//! least not steeply down), and `w = s z - c e` is across it in the vertical plane. With `r` from the end of the edge to the
//! mirrored receiver, `A = R + Z`, `B = R + t.r`, harmonic potentials are `L = ln A`, `M = Z L - R`, `l = ln B`,
//! `m = (t.r) l - R`, and those of both directions:
//!
//! ```text
//! Lambda,t = L   Lambda,z = l      Gamma,t = M   Gamma,z = Lambda      Xi,t = Lambda   Xi,z = m
//! ```
//!
//! Harmonicity gives their derivatives across the vertical plane: with `f = 1/(1 + c)`, `q = f s Z - e`
//!
//! ```text
//! Lambda,hh  = -U/(A B)           U = R + f (t + Z) - h^2/R
//! Gamma,hhh  = -h V/(R A^2 B)     V = R^2 - h^2 + f R (R + 2 Z + t)     Gamma,hhe = -(e V + R A q)/(R A^2 B)
//! ```
//!
//! and `Xi` is `Gamma` with `t` and `z` exchanged. Nothing is divided by `s`: vertical edges are no special case.

use super::axial::{Axial, Place};
use super::in_space::{Direction, InSpace, Jet};
use super::two::Two;

/// The place of the mirrored receiver from the ends of an edge, and what all potentials share.
pub(super) struct Ends {
    pub(super) e: Two,
    pub(super) z: Two,
    pub(super) a: Two,
    pub(super) b: Two,
    pub(super) q: Two,
    pub(super) u: Two,
    /// `1/A`.
    pub(super) ia: Two,
    pub(super) axial: Place,
}

/// Jets of `Gamma,h`, of `W,h` with `W = Gamma + depth Lambda + c Xi`, and of `(k - 2) c Gamma,e - k (depth Lambda + c Xi),w`,
/// where `k = 1/(1 - nu)` and `depth` is the height of an end, at most 0.
#[inline(always)]
pub(super) fn jets(ends: &Ends, to: Direction, depth: Two, k: f64) -> [Jet; 3] {
    let Direction { c, .. } = to;
    let [l, m] = Axial::pair(&ends.axial);
    let [gamma_h, gamma_e, lambda_h, lambda_w] = ends.gamma_and_lambda(to, &l);
    let [xi_h, xi_w] = ends.xi(to, &m);
    let steep = (k - 2.0) * c;
    let sum = |n: usize| {
        let along = depth * lambda_w[n] + c * xi_w[n];
        steep * gamma_e[n] - k * along
    };
    [
        gamma_h,
        std::array::from_fn(|n| gamma_h[n] + depth * lambda_h[n] + c * xi_h[n]),
        std::array::from_fn(sum),
    ]
}

impl Ends {
    /// From the mirrored receiver along `e`, `h`, `z`.
    #[inline(always)]
    pub(super) fn new([e, h, z]: [Two; 3], to: Direction) -> Self {
        let Direction { s, c, f } = to;
        let r = (e.squared() + h.squared() + z.squared()).sqrt();
        let (t, w) = (s * e + c * z, s * z - c * e);
        let a = r + z;
        // r + t without cancellation.
        let b = (r + t).or((w.squared() + h.squared()) * (r - t).recip(), t);
        let ir = r.recip();
        Self {
            e,
            z,
            a,
            b,
            q: f * s * z - e,
            u: r + f * (t + z) - h.squared() * ir,
            ia: a.recip(),
            axial: Place {
                r,
                t,
                w,
                h,
                inverse: [ir, b.recip()],
            },
        }
    }

    /// Jets of `Gamma,h`, `Gamma,e`, `Lambda,h`, `Lambda,w`.
    #[inline(always)]
    fn gamma_and_lambda(&self, to: Direction, l: &Axial) -> [Jet; 4] {
        let &Self {
            e, z, a, q, u, ia, ..
        } = self;
        let &Place {
            r,
            t,
            h,
            inverse: [ir, ib],
            ..
        } = &self.axial;
        let Direction { s, c, f } = to;
        let iab = ia * ib;
        // Gradients of r, b and u along h and e.
        let (r_h, r_e) = (h * ir, e * ir);
        let b_e = r_e + Two::both(s);
        let u_h = r_h * r_h.squared() - r_h;
        let u_e = r_e + r_e * r_h.squared() + Two::both(f * s);
        let lambda_hhh = iab * (u * r_h * (ia + ib) - u_h);
        let lambda_hhe = iab * (u * (r_e * ia + b_e * ib) - u_e);
        let (l_h, l_e) = (r_h * ib, b_e * ib);
        let l = InSpace::of(to, l);
        let lambda_hee = -lambda_hhh - l.hz;
        let v = r.squared() - h.squared() + f * r * (r + 2.0 * z + t);
        let share = -(ir * ia * iab);
        let gamma_hhh = share * h * v;
        let gamma_hhe = share * (e * v + r * a * q);
        let gamma_hee = -gamma_hhh - l_h;
        [
            [
                gamma_hhh, gamma_hhe, lambda_hhh, lambda_hhe, l_h, l.he, l.hh, l.hz,
            ],
            [
                gamma_hhe, gamma_hee, lambda_hhe, lambda_hee, l_e, l.ee, l.he, l.ez,
            ],
            l.jet_of_h(lambda_hhh, lambda_hhe),
            l.jet_of_w(s * l.hh - c * lambda_hhe, s * l.he - c * lambda_hee),
        ]
    }

    /// Jets of `Xi,h`, `Xi,w`.
    #[inline(always)]
    fn xi(&self, to: Direction, m: &Axial) -> [Jet; 2] {
        let &Self { z, b, q, u, ia, .. } = self;
        let &Place {
            r,
            t,
            w,
            h,
            inverse: [ir, ib],
        } = &self.axial;
        let Direction { s, c, f } = to;
        let iab = ia * ib;
        let (share, lambda_hh) = (ir * iab, -(u * iab));
        let v = r.squared() - h.squared() + f * r * (r + 2.0 * t + z);
        let xi_hhh = -(share * ib * h * v);
        let xi_hhw = share * ib * (r * b * q - w * v);
        let xi_hww = -xi_hhh - ir * ia * h;
        let lambda_hw = share * h * (q + f * s * b);
        let xi_hhe = s * lambda_hh - c * xi_hhw;
        let xi_hew = s * lambda_hw - c * xi_hww;
        let m = InSpace::of(to, m);
        [m.jet_of_h(xi_hhh, xi_hhe), m.jet_of_w(xi_hhw, xi_hew)]
    }
}
