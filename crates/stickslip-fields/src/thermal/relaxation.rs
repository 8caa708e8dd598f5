//! Relaxation with a source that is linear in time, at one rate and at twice the rate.

use stickslip_core::lanes::{LANES, Numbers, elementary::exp_m1};

/// Below this, `z = rate dt`, the integrals are taken from their series; above it, cancellation costs 6 bits.
const SMALL: f64 = 1.0 / 64.0;

/// Above this every decay is over, and the square of `z` is a number.
const LARGE: f64 = 1e100;

/// The advance of `y' = -r y + s` over `dt` with a source from `s_0` to `s_1`: `y + decay` of what has been, and integrals
/// of the source.
///
/// ```text
/// y(dt) = (1 - D) y + P s_0 + (F - P) s_1
/// D = 1 - exp(-r dt),     F = int_0^dt exp(-r t) dt,     P = int_0^dt exp(-r t) t/dt dt
/// ```
///
/// At twice the rate (with `x = 2 t`, from 0 to `2 dt`) all three follow from sums of positive numbers and `1 - D`: nothing
/// is lost at any `r dt`, and a row of rates takes one exponential.
///
/// ```text
/// D' = D + D E,     F' = (F + F E)/2,     P' = (P + E (F + P))/4,     E = 1 - D
/// ```
#[derive(Clone, Copy)]
pub(super) struct Relaxation {
    pub(super) lost: f64,
    pub(super) held: f64,
    pub(super) first: f64,
}

impl Relaxation {
    #[inline(always)]
    pub(super) fn new(rate: f64, dt: f64) -> Self {
        let product = rate * dt;
        let z = if product > LARGE { LARGE } else { product };
        let lost = -exp_m1(-z);
        let inverse = 1.0 / z;
        let held = lost * inverse;
        let first = (held - (1.0 - lost)) * inverse;
        // int_0^1 exp(-z x) [1, x] dx, term by term; the next terms are below 1e-18.
        let held_small = 1.0
            - z * (1.0 / 2.0
                - z * (1.0 / 6.0
                    - z * (1.0 / 24.0
                        - z * (1.0 / 120.0 - z * (1.0 / 720.0 - z * (1.0 / 5_040.0))))));
        let first_small = 1.0 / 2.0
            - z * (1.0 / 3.0
                - z * (1.0 / 8.0
                    - z * (1.0 / 30.0
                        - z * (1.0 / 144.0 - z * (1.0 / 840.0 - z * (1.0 / 5_760.0))))));
        let is_small = z < SMALL;
        Self {
            lost,
            held: dt * if is_small { held_small } else { held },
            first: dt * if is_small { first_small } else { first },
        }
    }

    /// The same at twice the rate.
    #[inline(always)]
    pub(super) fn twice(self) -> Self {
        let Self { lost, held, first } = self;
        let decay = 1.0 - lost;
        Self {
            // Not `lost (2 - lost)`, which stays a rounding below 1.
            lost: lost + lost * decay,
            held: 0.5 * (held + held * decay),
            first: 0.25 * (first + decay * (held + first)),
        }
    }

    /// The factors of the memory and of both sources.
    #[inline(always)]
    pub(super) fn factors(self) -> [f64; 3] {
        [1.0 - self.lost, self.first, self.held - self.first]
    }

    /// The memory at the end of the step.
    #[inline(always)]
    pub(super) fn end(self, from: f64, source: [f64; 2]) -> f64 {
        end(self.factors(), from, source)
    }
}

/// The memory at the end of a step.
#[inline(always)]
pub(super) fn end([decay, first, last]: [f64; 3], from: f64, source: [f64; 2]) -> f64 {
    decay * from + (first * source[0] + last * source[1])
}

/// Relaxations of the nodes of a block.
pub(super) struct Row {
    lost: Numbers,
    held: Numbers,
    first: Numbers,
}

impl Row {
    #[inline(always)]
    pub(super) fn new() -> Self {
        let [lost, held, first] = [[0.0; LANES]; 3];
        Self { lost, held, first }
    }

    /// Starts `count` of them anew at a multiple of the rates.
    #[inline(always)]
    pub(super) fn start(&mut self, count: usize, factor: f64, rates: &Numbers, dt: f64) {
        for k in 0..count.min(LANES) {
            self.set(k, Relaxation::new(factor * rates[k], dt));
        }
    }

    #[inline(always)]
    pub(super) fn at(&self, k: usize) -> Relaxation {
        Relaxation {
            lost: self.lost[k],
            held: self.held[k],
            first: self.first[k],
        }
    }

    #[inline(always)]
    pub(super) fn set(&mut self, k: usize, to: Relaxation) {
        self.lost[k] = to.lost;
        self.held[k] = to.held;
        self.first[k] = to.first;
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// `[D, F, P]` for `dt = 1`: series of positive and negative terms below 1, closed forms above.
    fn exact(z: f64) -> [f64; 3] {
        if z > 1.0 {
            let decay = (-z).exp();
            return [
                1.0 - decay,
                (1.0 - decay) / z,
                (1.0 - decay - z * decay) / (z * z),
            ];
        }
        let (mut sums, mut term) = ([0.0; 3], 1.0);
        for n in (0..30).map(f64::from) {
            sums[0] += term * z / (n + 1.0);
            sums[1] += term / (n + 1.0);
            sums[2] += term / (n + 2.0);
            term *= -z / (n + 1.0);
        }
        sums
    }

    fn close(found: Relaxation, z: f64, bound: f64) -> bool {
        let found = [found.lost, found.held, found.first];
        (found.iter().zip(exact(z))).all(|(found, exact)| (found - exact).abs() <= bound * exact)
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2_000, ..ProptestConfig::default() })]

        #[test]
        fn relaxations_are_exact(exponent in -30.0..6.0_f64, near in 0.001..2.0_f64) {
            for z in [10_f64.powf(exponent), near, SMALL * near] {
                prop_assert!(close(Relaxation::new(z, 1.0), z, 4e-14), "{z}");
            }
        }

        #[test]
        fn doubled_rates_keep_their_digits(exponent in -30.0..2.0_f64) {
            let mut z = 10_f64.powf(exponent);
            let mut relaxation = Relaxation::new(z, 1.0);
            for _ in 0..LANES {
                relaxation = relaxation.twice();
                z *= 2.0;
                prop_assert!(close(relaxation, z, 1e-13), "{z}");
            }
        }
    }

    #[test]
    fn ends_of_the_range_are_numbers() {
        for (rate, dt) in [(0.0, 1e15), (1e300, 1e300), (1e-300, 1e-300), (1e30, 0.0)] {
            let [decay, first, last] = Relaxation::new(rate, dt).factors();
            assert!((0.0..=1.0).contains(&decay) && first >= 0.0 && last >= 0.0);
            assert!(first + last <= dt);
        }
    }
}
