//! A step of the model and of its sensitivities by a Rosenbrock method.
//!
//! The unknowns are `m = mu - mu0` and `phi_i = ln(V0 theta_i/L_i)`, with `w = ln(V/V0) = (m - sum b_i phi_i)/a`:
//!
//! ```text
//! m' = k V0 (V_lp/V0 - exp(w)),   phi_i' = (V0/L_i) G_i(phi_i, w)
//! ```
//!
//! RODAS has 6 stages and order 4, is L-stable, and has an embedded solution and a dense output of order 3. Source: E.
//! Hairer, G. Wanner, *Solving Ordinary Differential Equations II* (1996), Sec. IV.7. Its stages of the variational
//! equations take the exact Jacobian of the augmented system, so that they are the derivatives of the stages.

use crate::evolution::{Law, Rate};

const GAMMA: f64 = 0.25;
const STAGES: usize = 6;
/// The weights of earlier stages in the arguments of the stages 2 to 5.
const A: [[f64; 4]; 5] = [
    [0.0; 4],
    [1.544, 0.0, 0.0, 0.0],
    [0.9466785280815826, 0.2557011698983284, 0.0, 0.0],
    [
        3.314825187068521,
        2.896124015972201,
        0.9986419139977817,
        0.0,
    ],
    [
        1.221224509226641,
        6.019134481288629,
        12.53708332932087,
        -0.687886036105895,
    ],
];
/// The weights of earlier stages on the right-hand sides, times the step.
const C: [[f64; 5]; 6] = [
    [0.0; 5],
    [-5.6688, 0.0, 0.0, 0.0, 0.0],
    [-2.430093356833875, -0.2063599157091915, 0.0, 0.0, 0.0],
    [
        -0.1073529058151375,
        -9.594562251023355,
        -20.47028614809616,
        0.0,
        0.0,
    ],
    [
        7.496443313967647,
        -10.24680431464352,
        -33.99990352819905,
        11.7089089320616,
        0.0,
    ],
    [
        8.083246795921522,
        -7.981132988064893,
        -31.52159432874371,
        16.31930543123136,
        -6.058818238834054,
    ],
];
/// The weights of the stages in the dense output.
const D: [[f64; 5]; 2] = [
    [
        10.12623508344586,
        -7.487995877610167,
        -34.80091861555747,
        -7.992771707568823,
        1.025137723295662,
    ],
    [
        -0.6762803392801253,
        6.087714651680015,
        16.43084320892478,
        24.76722511418386,
        -6.594389125716872,
    ],
];

/// The unknowns `m`, `phi_1`, .. and in the columns from 1 on their derivatives in the parameters.
pub(crate) type Unknowns<const N: usize, const W: usize> = [[f64; W]; N];

/// The columns of the derivatives: `a`, `b_i`, `ln L_i`, `ln k` and the initial `phi_i`, with `i` from 1 on.
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
    /// `k V0` [1/s].
    pub(crate) stiffness: f64,
    /// `V_lp/V0`.
    pub(crate) load: f64,
}

/// A step with its dense output.
pub(crate) struct Step<const N: usize, const W: usize> {
    pub(crate) end: Unknowns<N, W>,
    /// The error in `w` or in a `phi`.
    pub(crate) error: f64,
    dense: [[f64; W]; 2],
}

impl<const N: usize, const W: usize> Step<N, W> {
    /// `m` and its derivatives at a share of the step from `start`.
    pub(crate) fn at(&self, start: &[f64; W], share: f64) -> [f64; W] {
        let rest = 1.0 - share;
        std::array::from_fn(|c| {
            let bend = self.dense[0][c] + share * self.dense[1][c];
            start[c] * rest + share * (self.end[0][c] + rest * bend)
        })
    }
}

/// What a point determines: `w`, its derivatives, `exp(w)` and the rates of the states.
struct Point<const N: usize, const W: usize> {
    w: [f64; W],
    faster: f64,
    rates: [Rate; N],
}

impl<const N: usize> System<N> {
    #[inline]
    fn point<const W: usize>(&self, y: &Unknowns<N, W>) -> Point<N, W> {
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
    fn slope<const W: usize>(&self, y: &Unknowns<N, W>, at: &Point<N, W>) -> Unknowns<N, W> {
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
            } = at.rates[i];
            for c in 1..W {
                f[i][c] = self.rate[i] * (by_w * at.w[c] + by_phi * y[i][c]);
            }
            f[i][0] = self.rate[i] * value;
            if W > 1 {
                f[i][column::slip_distance::<N>(i)] -= f[i][0];
            }
        }
        f
    }

    /// The largest rate of `w` and of the states [1/s].
    pub(crate) fn speed<const W: usize>(&self, y: &Unknowns<N, W>) -> f64 {
        let f = self.slope(y, &self.point(y));
        self.norm(&f)
    }

    /// The change in `m/a` or in a `phi`, the largest one.
    fn norm<const W: usize>(&self, y: &Unknowns<N, W>) -> f64 {
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

    /// One step of length `h` \[s\].
    pub(crate) fn step<const W: usize>(&self, y: &Unknowns<N, W>, h: f64) -> Step<N, W> {
        let base = self.point(y);
        let linear = Linear::new(self, &base, h);
        let mut curvature = [Default::default(); N];
        if W > 1 {
            for i in 1..N {
                curvature[i] = self.laws[i - 1].curvature(y[i][0], base.w[0], base.faster);
            }
        }
        let mut u = [[[0.0; W]; N]; STAGES];
        let mut argument = *y;
        for stage in 0..STAGES {
            let mut right = if stage == 0 {
                self.slope(y, &base)
            } else {
                if stage < 5 {
                    argument = *y;
                    for (weight, u) in A[stage].iter().zip(&u[..stage]) {
                        add(&mut argument, *weight, u);
                    }
                } else {
                    add(&mut argument, 1.0, &u[4]);
                }
                self.slope(&argument, &self.point(&argument))
            };
            for (weight, u) in C[stage].iter().zip(&u[..stage]) {
                add(&mut right, weight / h, u);
            }
            u[stage] = linear.solve(right, |right, moved, ln_rate| {
                // The derivative of the sensitivities' right-hand side along the step of the solution.
                let slowing = -self.stiffness * base.faster;
                let mut second = [0.0; W];
                second[column::A] = -ln_rate / self.a;
                for i in 1..N {
                    second[column::b(i)] = -moved[i] / self.a;
                }
                for c in 1..W {
                    right[0][c] += slowing * (ln_rate * base.w[c] + second[c]);
                }
                if W > column::stiffness::<N>() {
                    right[0][column::stiffness::<N>()] += slowing * ln_rate;
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
                }
            });
        }
        let mut end = argument;
        add(&mut end, 1.0, &u[5]);
        let dense = D.map(|weights| {
            let mut sum = [0.0; W];
            for (weight, u) in weights.iter().zip(&u) {
                for c in 0..W {
                    sum[c] += weight * u[0][c];
                }
            }
            sum
        });
        Step {
            end,
            error: self.norm(&u[5]),
            dense,
        }
    }
}

fn add<const N: usize, const W: usize>(
    to: &mut Unknowns<N, W>,
    weight: f64,
    from: &Unknowns<N, W>,
) {
    for i in 0..N {
        for c in 0..W {
            to[i][c] += weight * from[i][c];
        }
    }
}

/// `I/(gamma h) - J`, a diagonal matrix minus `column x row`, inverted by the formula of Sherman and Morrison.
struct Linear<const N: usize> {
    /// The reciprocal diagonal.
    diagonal: [f64; N],
    /// The gradient of `w`.
    row: [f64; N],
    /// The diagonal's solution for the column, over one minus its product with the row.
    column: [f64; N],
}

impl<const N: usize> Linear<N> {
    fn new<const W: usize>(system: &System<N>, base: &Point<N, W>, h: f64) -> Self {
        let mut diagonal = [GAMMA * h; N];
        let mut row = [1.0 / system.a; N];
        let mut column = [-system.stiffness * base.faster; N];
        for i in 1..N {
            let Rate { by_w, by_phi, .. } = base.rates[i];
            diagonal[i] = 1.0 / (1.0 / (GAMMA * h) - system.rate[i] * by_phi);
            row[i] = -system.b[i] / system.a;
            column[i] = system.rate[i] * by_w;
        }
        let mut product = 0.0;
        for i in 0..N {
            column[i] *= diagonal[i];
            product += row[i] * column[i];
        }
        Self {
            diagonal,
            row,
            column: column.map(|x| x / (1.0 - product)),
        }
    }

    /// Solves for the solution first, and after `couple` has added to the columns of its derivatives for these.
    #[inline]
    fn solve<const W: usize>(
        &self,
        mut right: Unknowns<N, W>,
        couple: impl FnOnce(&mut Unknowns<N, W>, &[f64; N], f64),
    ) -> Unknowns<N, W> {
        let mut along = 0.0;
        for i in 0..N {
            right[i][0] *= self.diagonal[i];
            along += self.row[i] * right[i][0];
        }
        for i in 0..N {
            right[i][0] += self.column[i] * along;
        }
        if W > 1 {
            let moved: [f64; N] = std::array::from_fn(|i| right[i][0]);
            let ln_rate = (0..N).map(|i| self.row[i] * moved[i]).sum();
            couple(&mut right, &moved, ln_rate);
            let mut along = [0.0; W];
            for i in 0..N {
                for c in 1..W {
                    right[i][c] *= self.diagonal[i];
                    along[c] += self.row[i] * right[i][c];
                }
            }
            for i in 0..N {
                for c in 1..W {
                    right[i][c] += self.column[i] * along[c];
                }
            }
        }
        right
    }
}
