//! A step of the model and of its sensitivities by a Rosenbrock method.
//!
//! RODAS has 6 stages and order 4, is L-stable, and has an embedded solution and a dense output of order 3. Source: E.
//! Hairer, G. Wanner, *Solving Ordinary Differential Equations II* (1996), Sec. IV.7. Its stages of the variational
//! equations take the exact Jacobian of the augmented system, so that they are the derivatives of the stages.

use crate::law::Rate;
use crate::system::{Point, System, Unknowns};

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

impl<const N: usize> System<N> {
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
                self.couple(right, y, &base, &curvature, moved, ln_rate);
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
            column[i] =
                system.rate[i] * by_w + system.weakening[i] * system.stiffness * base.faster;
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
