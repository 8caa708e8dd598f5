//! Products of one matrix per mode, by SIMD.

use pulp::{Arch, Simd, WithSimd};
use realfft::num_complex::Complex;

use super::mode_matrices::{Double, ModeMatrices, Numbers, PANEL, Panel, padded};

/// Products of the modes from `first` on. `x` is by mode, then component, then row; `y` by mode, then component, then
/// row up to whole panels, first the real parts of a component, then the imaginary ones.
pub(crate) struct Product<'a> {
    pub(crate) blocks: &'a [ModeMatrices],
    pub(crate) rows: usize,
    pub(crate) first: usize,
    pub(crate) inputs: usize,
    pub(crate) outputs: usize,
    /// Begins with the last mode.
    pub(crate) backwards: bool,
    pub(crate) x: &'a [Complex<f64>],
    pub(crate) y: &'a mut [f64],
}

impl Product<'_> {
    pub(crate) fn run(self) {
        Arch::new().dispatch(self);
    }
}

impl WithSimd for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let width = 2 * padded(self.rows);
        let (of_x, of_y) = (self.inputs * self.rows, self.outputs * width);
        let count = self.x.len() / of_x;
        for n in 0..count {
            let place = if self.backwards { count - 1 - n } else { n };
            let x = &self.x[place * of_x..][..of_x];
            let y = &mut self.y[place * of_y..][..of_y];
            y.fill(0.0);
            for block in self.blocks {
                let [to, from] = block.components;
                let x = &x[from * self.rows..][..self.rows];
                let (real, imaginary) = y[to * width..][..width].split_at_mut(width / 2);
                let outputs = real.chunks_exact_mut(PANEL);
                let outputs = outputs.zip(imaginary.chunks_exact_mut(PANEL));
                let panels = block.of_mode(self.first + place).iter();
                for (panel, (real, imaginary)) in panels.zip(outputs) {
                    if block.odd {
                        add_panel::<S, true>(simd, block, panel, x, real, imaginary);
                    } else {
                        add_panel::<S, false>(simd, block, panel, x, real, imaginary);
                    }
                }
            }
        }
    }
}

/// Adds the products of a panel.
#[inline(always)]
fn add_panel<S: Simd, const ODD: bool>(
    simd: S,
    block: &ModeMatrices,
    panel: &Panel,
    x: &[Complex<f64>],
    real: &mut [f64],
    imaginary: &mut [f64],
) {
    let Panel { stored, rows, .. } = panel;
    let (before, behind) = (rows.start - stored.start, stored.end - rows.end);
    let double = &block.double[panel.double..][..rows.len()];
    let single = &block.single[panel.single..][..before + behind];
    let (before, behind) = single.split_at(before);
    let mut sums = [[[simd.splat_f64s(0.0); PANEL]; 2]; 2];
    add_rows::<S, _, ODD>(simd, before, &x[stored.start..rows.start], &mut sums);
    add_rows::<S, _, ODD>(simd, double, &x[rows.clone()], &mut sums);
    add_rows::<S, _, ODD>(simd, behind, &x[rows.end..stored.end], &mut sums);
    add_sums(simd, &sums, [real, imaginary]);
}

/// Adds the products of a panel in double precision.
#[inline(always)]
pub(super) fn add_whole_panel<S: Simd, const ODD: bool>(
    simd: S,
    panel: &[Double],
    x: &[Complex<f64>],
    real: &mut [f64],
    imaginary: &mut [f64],
) {
    let mut sums = [[[simd.splat_f64s(0.0); PANEL]; 2]; 2];
    add_rows::<S, _, ODD>(simd, panel, x, &mut sums);
    add_sums(simd, &sums, [real, imaginary]);
}

#[inline(always)]
fn add_sums<S: Simd>(simd: S, sums: &[[[S::f64s; PANEL]; 2]; 2], to: [&mut [f64]; 2]) {
    for (part, y) in to.into_iter().enumerate() {
        let (y, _) = S::as_mut_simd_f64s(y);
        for (n, y) in y.iter_mut().enumerate() {
            let sum = simd.add_f64s(sums[0][part][n], sums[1][part][n]);
            *y = simd.add_f64s(*y, sum);
        }
    }
}

/// Adds the products of some slipping rows, to sums of rows at even and at odd places.
#[inline(always)]
fn add_rows<S: Simd, N: Numbers, const ODD: bool>(
    simd: S,
    panel: &[N],
    x: &[Complex<f64>],
    sums: &mut [[[S::f64s; PANEL]; 2]; 2],
) {
    let vectors = PANEL / S::F64_LANES;
    let add = |sums: &mut [[S::f64s; PANEL]; 2], numbers: &N, x: Complex<f64>| {
        let numbers = numbers.numbers();
        let (numbers, _) = S::as_simd_f64s(&numbers);
        let (re, im) = factors::<ODD>(x);
        let (re, im) = (simd.splat_f64s(re), simd.splat_f64s(im));
        for n in 0..vectors {
            sums[0][n] = simd.mul_add_e_f64s(numbers[n], re, sums[0][n]);
            sums[1][n] = simd.mul_add_e_f64s(numbers[n], im, sums[1][n]);
        }
    };
    let (pairs, last) = x.as_chunks::<2>();
    let (panel_pairs, panel_last) = panel.as_chunks::<2>();
    for (x, panel) in pairs.iter().zip(panel_pairs) {
        for source in 0..2 {
            add(&mut sums[source], &panel[source], x[source]);
        }
    }
    for (x, numbers) in last.iter().zip(panel_last) {
        add(&mut sums[0], numbers, *x);
    }
}

/// `x`, or `i x`, as its real and imaginary part.
#[inline(always)]
fn factors<const ODD: bool>(x: Complex<f64>) -> (f64, f64) {
    if ODD { (-x.im, x.re) } else { (x.re, x.im) }
}
