//! Quadrature on simplices: all weights positive, exact for polynomials of degree 5, 4, 5 on segments,
//! triangles and tetrahedra.
//!
//! Sources: Gauss; D. Dunavant, Int. J. Numer. Meth. Eng. 21 (1985); N. Walkington, "Quadrature on simplices
//! of arbitrary dimension" (2000).

use crate::simplex::MAX_CORNERS;

/// A point in barycentric coordinates and its share of the volume.
pub(crate) struct Node {
    pub(crate) at: [f64; MAX_CORNERS],
    pub(crate) weight: f64,
}

/// The rule on the simplex of this dimension, 1, 2 or 3.
pub(crate) fn rule(dimension: usize) -> &'static [Node] {
    match dimension {
        1 => SEGMENT,
        2 => TRIANGLE,
        _ => TETRAHEDRON,
    }
}

const fn node(weight: f64, at: [f64; MAX_CORNERS]) -> Node {
    Node { at, weight }
}

const HALF: f64 = 0.5;
/// sqrt(15) / 10.
const G: f64 = 0.387_298_334_620_741_7;
const SEGMENT: &[Node] = &[
    node(5.0 / 18.0, [HALF - G, HALF + G, 0.0, 0.0]),
    node(8.0 / 18.0, [HALF, HALF, 0.0, 0.0]),
    node(5.0 / 18.0, [HALF + G, HALF - G, 0.0, 0.0]),
];

const A: f64 = 0.445_948_490_915_964_9;
const A1: f64 = 1.0 - 2.0 * A;
const WA: f64 = 0.223_381_589_678_011_47;
const B: f64 = 0.091_576_213_509_770_74;
const B1: f64 = 1.0 - 2.0 * B;
const WB: f64 = 0.109_951_743_655_321_87;
const TRIANGLE: &[Node] = &[
    node(WA, [A1, A, A, 0.0]),
    node(WA, [A, A1, A, 0.0]),
    node(WA, [A, A, A1, 0.0]),
    node(WB, [B1, B, B, 0.0]),
    node(WB, [B, B1, B, 0.0]),
    node(WB, [B, B, B1, 0.0]),
];

const S: f64 = 0.310_885_919_263_300_6;
const S1: f64 = 1.0 - 3.0 * S;
const WS: f64 = 0.112_687_925_718_015_85;
const Q: f64 = 0.092_735_250_310_891_23;
const Q1: f64 = 1.0 - 3.0 * Q;
const WQ: f64 = 0.073_493_043_116_361_95;
const R: f64 = 0.045_503_704_125_649_65;
const R1: f64 = HALF - R;
const WR: f64 = 0.042_546_020_777_081_47;
const TETRAHEDRON: &[Node] = &[
    node(WS, [S1, S, S, S]),
    node(WS, [S, S1, S, S]),
    node(WS, [S, S, S1, S]),
    node(WS, [S, S, S, S1]),
    node(WQ, [Q1, Q, Q, Q]),
    node(WQ, [Q, Q1, Q, Q]),
    node(WQ, [Q, Q, Q1, Q]),
    node(WQ, [Q, Q, Q, Q1]),
    node(WR, [R, R, R1, R1]),
    node(WR, [R, R1, R, R1]),
    node(WR, [R, R1, R1, R]),
    node(WR, [R1, R, R, R1]),
    node(WR, [R1, R, R1, R]),
    node(WR, [R1, R1, R, R]),
];

#[cfg(test)]
mod tests {
    use super::*;

    fn factorial(n: u32) -> f64 {
        (1..=n).map(f64::from).product()
    }

    /// The mean of b_0^i b_1^j b_2^k b_3^l over the simplex is d! i! j! k! l! / (d + i + j + k + l)!.
    #[test]
    fn integrates_monomials_exactly() {
        for (dimension, degree) in [(1, 5), (2, 4), (3, 5)] {
            for code in 0..6_u32.pow(4) {
                let powers = [code % 6, code / 6 % 6, code / 36 % 6, code / 216];
                let total: u32 = powers.iter().sum();
                if total > degree
                    || powers[dimension as usize + 1..]
                        .iter()
                        .any(|&power| power > 0)
                {
                    continue;
                }
                let monomial = |at: &[f64; 4]| {
                    at.iter()
                        .zip(powers)
                        .map(|(b, power)| b.powi(power as i32))
                        .product::<f64>()
                };
                let mean: f64 = rule(dimension as usize)
                    .iter()
                    .map(|node| node.weight * monomial(&node.at))
                    .sum();
                let exact = factorial(dimension) * powers.map(factorial).iter().product::<f64>()
                    / factorial(dimension + total);
                assert!(
                    (mean - exact).abs() < 1e-15,
                    "dimension {dimension}, powers {powers:?}: {mean} for {exact}"
                );
            }
        }
    }
}
