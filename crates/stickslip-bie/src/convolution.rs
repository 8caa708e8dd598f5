//! Products of Toeplitz and Hankel matrices with vectors, by Fourier transforms.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::SVector;
use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

/// Transforms of one length, and the memory for a product.
pub(crate) struct Transform {
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    memory: Mutex<Memory>,
}

#[derive(Clone)]
struct Memory {
    values: Vec<f64>,
    modes: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl Transform {
    /// Transforms of length `length`.
    pub(crate) fn new(length: usize) -> Self {
        let mut planner = RealFftPlanner::new();
        let (forward, inverse) = (
            planner.plan_fft_forward(length),
            planner.plan_fft_inverse(length),
        );
        let scratch = forward.get_scratch_len().max(inverse.get_scratch_len());
        let memory = Memory {
            values: forward.make_input_vec(),
            modes: forward.make_output_vec(),
            scratch: vec![Complex::default(); scratch],
        };
        Self {
            forward,
            inverse,
            memory: Mutex::new(memory),
        }
    }

    /// The length of a period.
    pub(crate) fn length(&self) -> usize {
        self.forward.len()
    }

    /// The modes of real numbers, one per frequency from 0 on.
    pub(crate) fn modes(&self, mut values: Vec<f64>) -> Vec<Complex<f64>> {
        let mut modes = self.forward.make_output_vec();
        let done = self.forward.process(&mut values, &mut modes);
        debug_assert!(done.is_ok(), "{done:?}");
        modes
    }

    /// The real numbers of a period from these modes.
    pub(crate) fn values(&self, mut modes: Vec<Complex<f64>>) -> Vec<f64> {
        let mut values = self.inverse.make_output_vec();
        let done = self.inverse.process(&mut modes, &mut values);
        debug_assert!(done.is_ok(), "{done:?}");
        let share = (self.length() as f64).recip();
        values.iter_mut().for_each(|value| *value *= share);
        values
    }

    /// Passes on the product at each entry of `x`: a convolution with the modes `toeplitz` and a correlation with the
    /// modes `hankel`, none if that is empty. Allocates nothing.
    pub(crate) fn product(
        &self,
        toeplitz: &[f64],
        hankel: &[Complex<f64>],
        x: &[SVector<f64, 1>],
        mut show: impl FnMut(usize, f64),
    ) {
        // Whatever a product that panicked has left there is overwritten.
        let mut memory = self.memory.lock().unwrap_or_else(PoisonError::into_inner);
        let Memory {
            values,
            modes,
            scratch,
        } = &mut *memory;
        let (filled, rest) = values.split_at_mut(x.len());
        for (value, x) in filled.iter_mut().zip(x) {
            *value = x[0];
        }
        rest.fill(0.0);
        let done = self.forward.process_with_scratch(values, modes, scratch);
        debug_assert!(done.is_ok(), "{done:?}");
        if hankel.is_empty() {
            for (mode, share) in modes.iter_mut().zip(toeplitz) {
                *mode *= share;
            }
        } else {
            for ((mode, share), mirrored) in modes.iter_mut().zip(toeplitz).zip(hankel) {
                *mode = *mode * share + mirrored * mode.conj();
            }
        }
        // Real by symmetry; the inverse refuses what rounding might leave.
        let last = modes.len() - 1;
        modes[0].im = 0.0;
        if self.length().is_multiple_of(2) {
            modes[last].im = 0.0;
        }
        let done = self.inverse.process_with_scratch(modes, values, scratch);
        debug_assert!(done.is_ok(), "{done:?}");
        let share = (self.length() as f64).recip();
        for (i, value) in values[..x.len()].iter().enumerate() {
            show(i, share * value);
        }
    }
}

impl Clone for Transform {
    fn clone(&self) -> Self {
        let memory = self.memory.lock().unwrap_or_else(PoisonError::into_inner);
        Self {
            forward: Arc::clone(&self.forward),
            inverse: Arc::clone(&self.inverse),
            memory: Mutex::new(memory.clone()),
        }
    }
}

impl fmt::Debug for Transform {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "Transform({})", self.length())
    }
}

/// The least even number with no prime factor above 5 that is not below `least`: a fast length of transforms.
pub(crate) fn fast_length(least: usize) -> usize {
    let is_smooth = |mut n: usize| {
        for prime in [2, 3, 5] {
            while n.is_multiple_of(prime) {
                n /= prime;
            }
        }
        n == 1
    };
    let mut length = least.max(2).next_multiple_of(2);
    while !is_smooth(length) {
        length += 2;
    }
    length
}
