//! Loops over many numbers, several of them per instruction.
//!
//! A pass is a loop over blocks of [`LANES`] numbers without a branch per number. With the feature `simd` it is compiled
//! for the widest registers of the processor as well, and chosen as the program runs. Bits do not depend on it: no
//! operation is fused, and numbers do not see each other.
//!
//! ```
//! use stickslip_core::lanes::{Parameter, Pass, elementary, run};
//!
//! /// `to = exp(-scale x)`
//! struct Decay<'a> {
//!     scale: &'a Parameter,
//!     x: &'a [f64],
//!     to: &'a mut [f64],
//! }
//!
//! impl Pass for Decay<'_> {
//!     #[inline(always)]
//!     fn block(&mut self, first: usize, count: usize) {
//!         let mut spare = None;
//!         let scale = self.scale.load(first, &mut spare);
//!         for k in 0..count {
//!             self.to[first + k] = elementary::exp(-scale[k] * self.x[first + k]);
//!         }
//!     }
//! }
//!
//! let (scale, mut to) = (Parameter::new([2.0].into_iter()), [0.0; 3]);
//! run(3, Decay { scale: &scale, x: &[0.0, 1.0, 2.0], to: &mut to });
//! assert!((to[1] - (-2.0_f64).exp()).abs() < 1e-15);
//! ```

pub mod elementary;

/// The numbers in a block: a multiple of those in a register of any width.
pub const LANES: usize = 64;

/// A block of numbers.
pub type Numbers = [f64; LANES];

/// A loop over blocks of numbers.
pub trait Pass {
    /// Computes the numbers from the `first` on, `count <= LANES` of them. Mark this function and
    /// those that it calls `#[inline(always)]`.
    fn block(&mut self, first: usize, count: usize);
}

/// Computes `count` numbers by a pass, in the widest registers with the feature `simd`.
#[inline]
pub fn run(count: usize, pass: impl Pass) {
    #[cfg(feature = "simd")]
    pulp::Arch::new().dispatch(Blocks { count, pass });
    #[cfg(not(feature = "simd"))]
    Blocks { count, pass }.run();
}

struct Blocks<P> {
    count: usize,
    pass: P,
}

impl<P: Pass> Blocks<P> {
    #[inline(always)]
    fn run(mut self) {
        for first in (0..self.count).step_by(LANES) {
            self.pass.block(first, LANES.min(self.count - first));
        }
    }
}

#[cfg(feature = "simd")]
impl<P: Pass> pulp::WithSimd for Blocks<P> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.run();
    }
}

/// A number of each node, or one of all.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter(Values);

#[derive(Debug, Clone, PartialEq)]
enum Values {
    Uniform(Box<Numbers>),
    Each(Vec<f64>),
}

impl Parameter {
    /// The numbers of all nodes; a single one is that of every node.
    pub fn new(values: impl Iterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.collect();
        Self(match values[..] {
            [value] => Values::Uniform(Box::new([value; LANES])),
            _ => Values::Each(values),
        })
    }

    /// The numbers of the nodes from the `first` on, in `spare` if they do not fill a block; those behind the last node
    /// are any.
    #[inline(always)]
    pub fn load<'a>(&'a self, first: usize, spare: &'a mut Option<Numbers>) -> &'a Numbers {
        match &self.0 {
            Values::Uniform(values) => values,
            Values::Each(values) => load(&values[first..], spare),
        }
    }
}

/// A block of the first numbers, in `spare` if they do not fill one; those behind the last one repeat the first.
#[inline(always)]
pub fn load<'a>(from: &'a [f64], spare: &'a mut Option<Numbers>) -> &'a Numbers {
    if let Some(block) = from.first_chunk() {
        return block;
    }
    let mut block = [from.first().copied().unwrap_or_default(); LANES];
    block[..from.len()].copy_from_slice(from);
    spare.insert(block)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `ln(exp(scale x) + 2 x)`.
    struct Mixed<'a> {
        scale: &'a Parameter,
        x: &'a [f64],
        to: &'a mut [f64],
    }

    #[inline(always)]
    fn mixed(scale: f64, x: f64) -> f64 {
        elementary::ln(elementary::exp(scale * x) + 2.0 * x)
    }

    impl Pass for Mixed<'_> {
        #[inline(always)]
        fn block(&mut self, first: usize, count: usize) {
            let mut spare = [None; 2];
            let [of_scale, of_x] = &mut spare;
            let (scale, x) = (
                self.scale.load(first, of_scale),
                load(&self.x[first..], of_x),
            );
            let mut to = [0.0; LANES];
            for k in 0..LANES {
                to[k] = mixed(scale[k], x[k]);
            }
            self.to[first..first + count].copy_from_slice(&to[..count]);
        }
    }

    /// The same bits in registers of any width as of one number after the other, in blocks and in what is left.
    #[test]
    fn bits_do_not_depend_on_the_width() {
        const COUNT: usize = 5 * LANES + 17;
        let x: [f64; COUNT] = std::array::from_fn(|k| 1e-3 + (k * 37 % COUNT) as f64 * 0.1);
        let scales = x.map(|x| 1.7 - 0.03 * x);
        for scale in [
            Parameter::new(scales.into_iter()),
            Parameter::new([0.3].into_iter()),
        ] {
            let mut to = [0.0; COUNT];
            let pass = Mixed {
                scale: &scale,
                x: &x,
                to: &mut to,
            };
            run(COUNT, pass);
            for (k, to) in to.into_iter().enumerate() {
                let mut spare = None;
                let [scale, ..] = *scale.load(k, &mut spare);
                assert_eq!(to.to_bits(), mixed(scale, x[k]).to_bits(), "{k}");
            }
        }
    }
}
