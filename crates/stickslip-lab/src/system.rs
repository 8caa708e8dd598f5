//! The right-hand sides of the model and of its sensitivities.
//!
//! The unknowns are `m = mu - mu0` and `phi_i = ln(V0 theta_i/L_i)`, with `w = ln(V/V0) = (m - sum b_i phi_i)/a`:
//!
//! ```text
//! m' = k V0 (V_lp/V0 - exp(w)),   phi_i' = (V0/L_i) G_i(phi_i, w) - (c_i/b_i) m'
//! ```
//!
//! with `c_i` of Nagata's law, 0 of others.

use crate::law::{Curvature, Law, Rate};

/// The unknowns `m`, `phi_1`, .. and in the columns from 1 on their derivatives in the parameters.
pub(crate) type Unknowns<const N: usize, const W: usize> = [[f64; W]; N];

/// The columns of the derivatives: `a`, `b_i`, `ln L_i`, `ln k`, the initial `phi_i` with `i` from 1 on, the initial `m`, and the
/// logarithm of a parameter of the law of `phi_i`.
pub(crate) mod column {
    pub(crate) const A: usize = 1;
    pub(crate) const fn b(i: usize) -> usize {
        1 + i
    }
    pub(crate) const fn slip_distance<const N: usize>(i: usize) -> usize {
        N + i
    }
    pub(crate) const fn stiffness<const N: usize>() -> usize {
        2 * N
    }
    pub(crate) const fn initial_state<const N: usize>(i: usize) -> usize {
        2 * N + i
    }
    pub(crate) const fn initial_stress<const N: usize>() -> usize {
        3 * N
    }
    pub(crate) const fn law<const N: usize>(i: usize) -> usize {
        3 * N + i
    }
}

/// The model with `N - 1` states, at one velocity of the load point.
pub(crate) struct System<const N: usize> {
    pub(crate) a: f64,
    /// `b_i`, from 1 on.
    pub(crate) b: [f64; N],
    /// `V0/L_i` [1/s], from 1 on.
    pub(crate) rate: [f64; N],
    /// The laws of the states, from 0 on.
    pub(crate) laws: Vec<Law>,
    /// `c_i/b_i` of Nagata's law, from 1 on.
    pub(crate) weakening: [f64; N],
    /// `k V0` [1/s].
    pub(crate) stiffness: f64,
    /// `V_lp/V0`.
    pub(crate) load: f64,
}

/// The system at a point: `w`, its derivatives, `exp(w)` and the rates of the states.
pub(crate) struct Point<const N: usize, const W: usize> {
    pub(crate) w: [f64; W],
    pub(crate) faster: f64,
    pub(crate) rates: [Rate; N],
}

impl<const N: usize> System<N> {
    #[inline]
    pub(crate) fn point<const W: usize>(&self, y: &Unknowns<N, W>) -> Point<N, W> {
        let mut w = self.weighted(y);
        let ln_rate = w[0];
        if W > 1 {
            w[column::A] -= ln_rate / self.a;
            for i in 1..N {
                w[column::b(i)] -= y[i][0] / self.a;
            }
        }
        let faster = ln_rate.exp();
        let mut rates = [Rate::default(); N];
        for i in 1..N {
            rates[i] = self.laws[i - 1].rate(y[i][0], ln_rate, faster);
        }
        Point { w, faster, rates }
    }

    /// `(m - sum b_i phi_i)/a` of every column.
    #[inline]
    fn weighted<const W: usize>(&self, y: &Unknowns<N, W>) -> [f64; W] {
        let mut w = y[0];
        for i in 1..N {
            for c in 0..W {
                w[c] -= self.b[i] * y[i][c];
            }
        }
        w.map(|w| w / self.a)
    }

    /// The right-hand sides.
    #[inline]
    pub(crate) fn slope<const W: usize>(
        &self,
        y: &Unknowns<N, W>,
        at: &Point<N, W>,
    ) -> Unknowns<N, W> {
        let mut f = [[0.0; W]; N];
        let slowing = -self.stiffness * at.faster;
        for c in 1..W {
            f[0][c] = slowing * at.w[c];
        }
        f[0][0] = self.stiffness * (self.load - at.faster);
        if W > column::stiffness::<N>() {
            f[0][column::stiffness::<N>()] += f[0][0];
        }
        for i in 1..N {
            let Rate {
                value,
                by_w,
                by_phi,
                by_parameter,
            } = at.rates[i];
            for c in 1..W {
                f[i][c] = self.rate[i] * (by_w * at.w[c] + by_phi * y[i][c]);
            }
            f[i][0] = self.rate[i] * value;
            if W > 1 {
                f[i][column::slip_distance::<N>(i)] -= f[i][0];
            }
            if W > column::law::<N>(1) {
                f[i][column::law::<N>(i)] += self.rate[i] * by_parameter;
            }
            let stress = f[0];
            self.weaken(i, &mut f[i], &stress);
        }
        f
    }

    /// Subtracts the stress rate `m'` and its derivatives, times `c_i/b_i`, from the row of a state.
    #[inline]
    fn weaken<const W: usize>(&self, i: usize, row: &mut [f64; W], stress: &[f64; W]) {
        let weight = self.weakening[i];
        if weight == 0.0 {
            return;
        }
        for c in 0..W {
            row[c] -= weight * stress[c];
        }
        if W > 1 {
            row[column::b(i)] += weight / self.b[i] * stress[0];
        }
        if W > column::law::<N>(1) {
            row[column::law::<N>(i)] -= weight * stress[0];
        }
    }

    /// The largest rate of `w` and of the states [1/s].
    pub(crate) fn speed<const W: usize>(&self, y: &Unknowns<N, W>) -> f64 {
        let f = self.slope(y, &self.point(y));
        self.norm(&f)
    }

    /// The change in `m/a` or in a `phi`, the largest one.
    pub(crate) fn norm<const W: usize>(&self, y: &Unknowns<N, W>) -> f64 {
        // NaN must not vanish in a maximum.
        let mut norm = (y[0][0] / self.a).abs();
        for row in &y[1..] {
            if norm.is_nan() || row[0].is_nan() {
                return f64::NAN;
            }
            norm = norm.max(row[0].abs());
        }
        norm
    }

    /// Adds to the right-hand sides of the sensitivities their derivative along a step `moved` of the solution, which
    /// changes `w` by `ln_rate`.
    #[inline]
    pub(crate) fn couple<const W: usize>(
        &self,
        right: &mut Unknowns<N, W>,
        y: &Unknowns<N, W>,
        base: &Point<N, W>,
        curvature: &[Curvature; N],
        moved: &[f64; N],
        ln_rate: f64,
    ) {
        let slowing = -self.stiffness * base.faster;
        let mut second = [0.0; W];
        second[column::A] = -ln_rate / self.a;
        for i in 1..N {
            second[column::b(i)] = -moved[i] / self.a;
        }
        // The column 0 has been solved for: that of `stress` is only read.
        let mut stress = [0.0; W];
        stress[0] = slowing * ln_rate;
        for c in 1..W {
            stress[c] = slowing * (ln_rate * base.w[c] + second[c]);
        }
        if W > column::stiffness::<N>() {
            stress[column::stiffness::<N>()] += slowing * ln_rate;
        }
        for c in 1..W {
            right[0][c] += stress[c];
        }
        for i in 1..N {
            let (first, bend) = (&base.rates[i], &curvature[i]);
            let along_w = bend.by_w_w * ln_rate + bend.by_w_phi * moved[i];
            let along_phi = bend.by_w_phi * ln_rate + bend.by_phi_phi * moved[i];
            for c in 1..W {
                right[i][c] += self.rate[i]
                    * (along_w * base.w[c] + first.by_w * second[c] + along_phi * y[i][c]);
            }
            right[i][column::slip_distance::<N>(i)] -=
                self.rate[i] * (first.by_w * ln_rate + first.by_phi * moved[i]);
            if W > column::law::<N>(1) {
                right[i][column::law::<N>(i)] += self.rate[i]
                    * (bend.by_parameter_w * ln_rate + bend.by_parameter_phi * moved[i]);
            }
            let solved = right[i][0];
            self.weaken(i, &mut right[i], &stress);
            right[i][0] = solved;
        }
    }
}
