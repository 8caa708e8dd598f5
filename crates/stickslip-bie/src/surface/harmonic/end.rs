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

/// The place of the mirrored receiver from an end of an edge, and what all potentials share.
struct Both {
    e: f64,
    h: f64,
    r: f64,
    a: f64,
    b: f64,
    q: f64,
    u: f64,
    lambda_hh: f64,
}

/// Jets of `Gamma,h`, of `W,h` with `W = Gamma + depth Lambda + c Xi`, and of `(k - 2) c Gamma,e - k (depth Lambda + c Xi),w`,
/// where `k = 1/(1 - nu)` and `depth` is the height of the end, at most 0.
pub(super) fn jets([e, h, z]: [f64; 3], to: Direction, depth: f64, k: f64) -> [Jet; 3] {
    let Direction { s, c, f } = to;
    let r = (e * e + h * h + z * z).sqrt();
    let (t, w) = (s * e + c * z, s * z - c * e);
    let a = r + z;
    // r + t without cancellation.
    let b = if t < 0.0 {
        (w * w + h * h) / (r - t)
    } else {
        r + t
    };
    let [l, m] = Axial::pair(&Place { r, t, w, h, b });
    let u = r + f * (t + z) - h * h / r;
    let both = Both {
        e,
        h,
        r,
        a,
        b,
        q: f * s * z - e,
        u,
        lambda_hh: -u / (a * b),
    };
    let [gamma_h, gamma_e, lambda_h, lambda_w] = both.gamma_and_lambda(to, &l);
    let [xi_h, xi_w] = both.xi(to, [t, w, z], &m);
    let mut jets = [gamma_h, gamma_h, [0.0; 8]];
    for n in 0..8 {
        jets[1][n] += depth * lambda_h[n] + c * xi_h[n];
        jets[2][n] = (k - 2.0) * c * gamma_e[n] - k * (depth * lambda_w[n] + c * xi_w[n]);
    }
    jets
}

impl Both {
    /// Jets of `Gamma,h`, `Gamma,e`, `Lambda,h`, `Lambda,w`.
    fn gamma_and_lambda(&self, to: Direction, l: &Axial) -> [Jet; 4] {
        let &Self {
            e,
            h,
            r,
            a,
            b,
            q,
            u,
            ..
        } = self;
        let Direction { s, c, f } = to;
        let z = a - r;
        let (ir, ia, ib) = (r.recip(), a.recip(), b.recip());
        let iab = ia * ib;
        // Gradients of u, a and b along h and e.
        let across = h * ir;
        let along = e * ir;
        let u_h = across * (across * across - 1.0);
        let u_e = along * (1.0 + across * across) + f * s;
        let lambda_hhh = iab * (u * across * (ia + ib) - u_h);
        let lambda_hhe = iab * (u * (along * ia + (along + s) * ib) - u_e);
        let (l_h, l_e) = (across * ib, (along + s) * ib);
        let l = InSpace::of(to, l);
        let lambda_hee = -lambda_hhh - l.hz;
        let v = r * r - h * h + f * r * (a + b + z - r);
        let share = -ir * ia * iab;
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
    fn xi(&self, to: Direction, [t, w, z]: [f64; 3], m: &Axial) -> [Jet; 2] {
        let &Self { h, r, a, b, q, .. } = self;
        let Direction { s, c, f } = to;
        let iab = (r * a * b).recip();
        let v = r * r - h * h + f * r * (r + 2.0 * t + z);
        let share = -iab / b;
        let xi_hhh = share * h * v;
        let xi_hhw = share * (w * v - r * b * q);
        let xi_hww = -xi_hhh - h * b * iab;
        let lambda_hw = h * (q + f * s * b) * iab;
        let xi_hhe = s * self.lambda_hh - c * xi_hhw;
        let xi_hew = s * lambda_hw - c * xi_hww;
        let m = InSpace::of(to, m);
        [m.jet_of_h(xi_hhh, xi_hhe), m.jet_of_w(xi_hhw, xi_hew)]
    }
}
