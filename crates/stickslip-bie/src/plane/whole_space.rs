//! The stress of rectangular cells on their plane in a whole space.

use std::f64::consts::{LN_2, PI};

use super::Rectangles;

/// Three numbers of a symmetric block: strike with strike, dip with dip, strike with dip.
pub(crate) type Block = [f64; 3];

/// The part of a block that acts between directions, each as components along strike and up dip.
pub(crate) fn between(block: &Block, [a, b]: [f64; 2], [c, d]: [f64; 2]) -> f64 {
    a * c * block[0] + b * d * block[1] + (a * d + b * c) * block[2]
}

/// Cells of one size on a plane in a whole space.
///
/// Slip `Dx` on a cell causes, summed over its corners at distances `X`, `Y`, `r = sqrt(X^2 + Y^2)`,
///
/// ```text
/// tau_x = -(mu/(4 pi)) sum +- [ r/(X Y) + (nu/(1 - nu)) Y/(X r) ],    tau_y = (mu/(4 pi)) (nu/(1 - nu)) sum +- 1/r
/// ```
///
/// from the potential of a shear dislocation in the plane. Exact at the centres for slip that is constant on cells. For
/// smooth slip `tau_x` is of second order in the size of the cells. `tau_y` is of first order, because the centres
/// see the spectrum of `kx ky/k` less `kx ky M/(2 pi)`, with the Madelung sum `M` of the lattice. Second differences of
/// the four diagonal neighbours restore it: [`cross_correction`](Self::cross_correction).
#[derive(Debug, Clone, Copy)]
pub(crate) struct WholeSpace {
    pub(crate) shear_modulus: f64,
    /// `nu/(1 - nu)`.
    pub(crate) ratio: f64,
    /// The size of a cell along strike and down dip.
    pub(crate) size: [f64; 2],
}

impl WholeSpace {
    pub(crate) fn new(cells: &Rectangles, shear_modulus: f64, poisson_ratio: f64) -> Self {
        Self {
            shear_modulus,
            ratio: poisson_ratio / (1.0 - poisson_ratio),
            size: [cells.along_strike().length(), cells.down_dip().length()],
        }
    }

    pub(crate) fn area(&self) -> f64 {
        self.size[0] * self.size[1]
    }

    /// The force on a cell per slip of a rectangle, from the distances of its centre from the lower and the upper edge:
    /// in both directions, signed, the second down dip. Slip is along strike and up dip.
    pub(crate) fn rectangle(&self, x: [f64; 2], y: [f64; 2]) -> Block {
        let mut sums = [0.0; 3];
        for (i, x) in x.into_iter().enumerate() {
            for (j, y) in y.into_iter().enumerate() {
                let sign = if i == j { 1.0 } else { -1.0 };
                let r = x.hypot(y);
                let common = r / (x * y);
                sums[0] += sign * (common + self.ratio * y / (x * r));
                sums[1] += sign * (common + self.ratio * x / (y * r));
                sums[2] += sign * self.ratio / r;
            }
        }
        let factor = self.area() * self.shear_modulus / (4.0 * PI);
        sums.map(|sum| factor * sum)
    }

    /// The force on a cell per slip of a cell so many cells before it, along strike and down dip.
    pub(crate) fn cells_apart(&self, apart: [isize; 2]) -> Block {
        let [x, y] = [0, 1].map(|axis| {
            let distance = apart[axis].unsigned_abs() as f64;
            [
                (distance + 0.5) * self.size[axis],
                (distance - 0.5) * self.size[axis],
            ]
        });
        let mut block = self.rectangle(x, y);
        // Odd in both directions.
        block[2] *= (apart[0].signum() * apart[1].signum()) as f64;
        block
    }

    /// The force between diagonal neighbours that makes the cross term of second order, at the neighbour beyond in
    /// both directions; times the signs of the directions at the others.
    pub(crate) fn cross_correction(&self) -> f64 {
        // The area of the cell on which the force acts cancels the area of the second difference.
        0.125 * self.shear_modulus * self.ratio * madelung(self.size) / (2.0 * PI)
    }
}

/// `-sum (-1)^(m + n)/sqrt((m/hx)^2 + (n/hy)^2)` over all pairs of integers but (0, 0): 1.6155426 h for squares.
///
/// As the integral of `(2/sqrt(pi)) (1 - theta4(s^2/hx^2) theta4(s^2/hy^2))` from 0 on. With `h` the larger of both,
/// that of `1 - theta4(s^2/h^2)` is `2 h ln 2`; what is left vanishes at 0 with all derivatives and decays as
/// `exp(-s^2/h'^2)` with the smaller one: the trapezoidal rule converges faster than any power.
pub(crate) fn madelung(size: [f64; 2]) -> f64 {
    let (least, most) = (size[0].min(size[1]), size[0].max(size[1]));
    let step = least / 32.0;
    let value = |i: u32| {
        let s = f64::from(i) * step;
        theta4((s / most).powi(2)) * (1.0 - theta4((s / least).powi(2)))
    };
    let sum: f64 = (1..=208).map(value).sum();
    2.0 * most * LN_2 + 2.0 / PI.sqrt() * step * sum
}

/// `sum (-1)^n exp(-n^2 x)` over all integers, `x > 0`.
fn theta4(x: f64) -> f64 {
    if x >= 1.0 {
        let term = |n: i32| {
            let sign = if n % 2 == 0 { 2.0 } else { -2.0 };
            sign * (-f64::from(n * n) * x).exp()
        };
        1.0 + (1..=6).map(term).sum::<f64>()
    } else {
        // Poisson's sum formula.
        let term = |n: i32| (-(PI * (f64::from(n) + 0.5)).powi(2) / x).exp();
        2.0 * (PI / x).sqrt() * (0..=3).map(term).sum::<f64>()
    }
}
