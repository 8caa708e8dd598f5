//! Linear interpolation from scattered points.

use nalgebra::{Matrix4, SVector, Vector4};

use crate::simplex::MAX_CORNERS;

/// Finds weights `w` of points `z_j` around the origin: `sum w_j = 1`, `sum w_j z_j = 0`.
///
/// If the points enclose the origin, the weights are not negative and minimise `sum w_j |z_j|^2`. They are those of the
/// Delaunay simplex of the origin, by its duality with the lower hull of the points lifted to a paraboloid. Outside the
/// hull the nearest of its points is taken, and the smallest weights extrapolate the rest.
///
/// The linear programme is solved by the simplex method on a table of D + 1 rows.
#[derive(Debug, Default)]
pub(super) struct Weights {
    /// One column per point, then those of the slacks: `+e_k` and `-e_k` of each coordinate, and `e_0` of the sum.
    columns: Vec<[f64; MAX_CORNERS]>,
    costs: Vec<f64>,
    weights: Vec<f64>,
}

/// The cost of a slack, where points cost at most 1: far more than any of them is worth.
const SLACK: f64 = 1e4;
/// The zero tolerance of the table, for points at distances up to 1, and the accepted error of weights.
const ROUNDING: f64 = 1e-10;
/// The distance from the hull of the points from which other points than those of the programme contribute.
const BESIDE: f64 = 1e-8;
/// A share of the moments of points that changes no weight by more than rounding does.
const REGULAR: f64 = 1e-12;
/// The largest sum of the absolute weights: the limit of extrapolation.
const LARGEST: f64 = 2.0;
/// The largest number of simplex steps; about ten are typical.
const STEPS: usize = 100;

impl Weights {
    /// Whether there are weights of bounded size.
    pub(super) fn find<const D: usize>(
        &mut self,
        around: impl Iterator<Item = SVector<f64, D>> + Clone,
    ) -> bool {
        let scale = around
            .clone()
            .fold(0.0, |far: f64, z| far.max(z.norm()))
            .recip();
        self.columns.clear();
        self.costs.clear();
        for z in around {
            let z = z * scale;
            self.columns.push(std::array::from_fn(|k| match k {
                0 => 1.0,
                k if k <= D => z[k - 1],
                _ => 0.0,
            }));
            self.costs.push(z.norm_squared());
        }
        let count = self.costs.len();
        self.weights.clear();
        self.weights.resize(count, 0.0);
        let points = self.columns.clone();
        if !self.programme::<D>(count) {
            return false;
        }
        let missed = self.missed(&points);
        if missed.amax() > ROUNDING {
            // Beside the hull. What rounding did in the table is set right by the same points.
            self.correct::<D>(&points, &missed, missed.amax() > BESIDE);
        }
        self.missed(&points).amax() <= ROUNDING
            && self.weights.iter().map(|w| w.abs()).sum::<f64>() <= LARGEST
    }

    /// The weights of the points, in their order.
    pub(super) fn found(&self) -> impl Iterator<Item = f64> + '_ {
        self.weights.iter().copied()
    }

    /// Solves the linear programme; false if it takes too many steps.
    fn programme<const D: usize>(&mut self, count: usize) -> bool {
        let unit =
            |row: usize, sign: f64| std::array::from_fn(|k| if k == row { sign } else { 0.0 });
        self.columns.push(unit(0, 1.0));
        for row in 1..=D {
            self.columns.push(unit(row, 1.0));
            self.columns.push(unit(row, -1.0));
        }
        self.costs.resize(self.columns.len(), SLACK);
        let mut basis: [usize; MAX_CORNERS] = std::array::from_fn(|row| match row {
            0 => count,
            row => count + 2 * row - 1,
        });
        let mut values = [0.0; MAX_CORNERS];
        values[0] = 1.0;
        for step in 0.. {
            if step == STEPS {
                return false;
            }
            let prices: [f64; MAX_CORNERS] = std::array::from_fn(|row| {
                if row <= D {
                    self.costs[basis[row]]
                } else {
                    0.0
                }
            });
            let reduced = |j: usize| {
                let column = self.columns[j].iter().zip(prices);
                self.costs[j] - column.map(|(entry, price)| entry * price).sum::<f64>()
            };
            // Bland's rule ends where the steepest descent may go in circles.
            let better = |j: &usize| reduced(*j) < -ROUNDING * SLACK;
            let entering = if step < STEPS / 2 {
                (0..self.costs.len())
                    .filter(better)
                    .min_by(|&i, &j| reduced(i).total_cmp(&reduced(j)))
            } else {
                (0..self.costs.len()).find(better)
            };
            let Some(entering) = entering else {
                break;
            };
            let column = self.columns[entering];
            let limits = (0..=D)
                .filter(|&row| column[row] > ROUNDING)
                .map(|row| (values[row] / column[row], row));
            // Among equals slacks go first.
            let least = limits.min_by(|a, b| a.0.total_cmp(&b.0).then(basis[b.1].cmp(&basis[a.1])));
            let Some((_, leaving)) = least else {
                return false;
            };
            basis[leaving] = entering;
            for other in &mut self.columns {
                let share = other[leaving] / column[leaving];
                for row in 0..=D {
                    other[row] -= share * column[row];
                }
                other[leaving] = share;
            }
            let share = values[leaving] / column[leaving];
            for row in 0..=D {
                values[row] -= share * column[row];
            }
            values[leaving] = share;
        }
        for row in 0..=D {
            if let Some(weight) = self.weights.get_mut(basis[row]) {
                *weight = values[row].max(0.0);
            }
        }
        true
    }

    /// The defect of the weights: `(1, 0) - sum w_j (1, z_j)`.
    fn missed(&self, points: &[[f64; MAX_CORNERS]]) -> Vector4<f64> {
        let weighted = points.iter().zip(&self.weights);
        weighted.fold(Vector4::x(), |missed, (point, weight)| {
            missed - Vector4::from(*point) * *weight
        })
    }

    /// Adds the smallest weights that remove the defect, smaller for farther points: of all points, or of those with a
    /// weight.
    fn correct<const D: usize>(
        &mut self,
        points: &[[f64; MAX_CORNERS]],
        missed: &Vector4<f64>,
        all: bool,
    ) {
        let near = |cost: f64, weight: f64| {
            if all || weight > 0.0 {
                (cost + REGULAR).recip()
            } else {
                0.0
            }
        };
        let mut moments = Matrix4::<f64>::zeros();
        for ((point, cost), weight) in points.iter().zip(&self.costs).zip(&self.weights) {
            let point = Vector4::from(*point);
            moments += point * point.transpose() * near(*cost, *weight);
        }
        // Directions in which there are no points stay as they are.
        let share = REGULAR * moments.trace();
        let Some(factor) = (moments + Matrix4::identity() * share).cholesky() else {
            return;
        };
        // Twice, since the first solution is that of a matrix that is a little larger.
        let mut multipliers = factor.solve(missed);
        multipliers += factor.solve(&(missed - moments * multipliers));
        for ((point, cost), weight) in points.iter().zip(&self.costs).zip(&mut self.weights) {
            *weight += near(*cost, *weight) * Vector4::from(*point).dot(&multipliers);
        }
    }
}
