//! Products of matrices of cells of a vertical plane, by two-dimensional Fourier transforms.

use nalgebra::{SMatrix, SVector};
use realfft::num_complex::Complex;

use super::Rectangles;
use super::assembly::{Weights, shear_weights};
use super::convolution::Convolution;
use super::dislocation::Rock;
use super::transform;
use super::whole_space::WholeSpace;

/// Powers of the depth.
const POWERS: usize = 3;

/// The matrix of cells of a vertical plane in a half space, by differences of columns `m` and rows `i`, `j`:
///
/// ```text
/// A = T(m, i - j) + H0(m, i + j) + z_i H1(m, i + j) + z_i^2 H2(m, i + j)
/// ```
///
/// with `T` of the whole space and the image parts `H`. It is exact: on a vertical plane the image of a corner lies at
/// the sum of both depths, and Okada's third part is linear in the depth of either. Products cost as much as some
/// transforms of the whole space, memory is proportional to the number of cells. A product rounds to some ten units
/// times the square of the number of rows, because `H2` is largest near the surface and is multiplied by the depth.
#[derive(Debug)]
pub(crate) struct Mirrored {
    direct: Convolution,
    /// `z_i`, in depths of the lowest row.
    depths: Vec<f64>,
    /// Images `[receiving component][slipping component]`.
    images: Vec<Image>,
}

#[derive(Debug)]
struct Image {
    /// Entries of each power, `[sum of rows][difference of columns]`, the latter on its period.
    entries: [Vec<f64>; POWERS],
    /// Spectra of each power, `[k_strike][k_dip]`.
    spectra: [Vec<Complex<f64>>; POWERS],
}

/// The memory of a product.
#[derive(Clone)]
pub(crate) struct Memory {
    plane: transform::Memory,
    /// Fields of a wave number along strike: slip of each component, then the powers of a force.
    slip: Vec<Complex<f64>>,
    force: Vec<Complex<f64>>,
}

impl Mirrored {
    pub(crate) fn new<const C: usize>(
        cells: &Rectangles,
        rock: &Rock,
        space: &WholeSpace,
        directions: &[[f64; 2]; C],
    ) -> Self {
        let down_dip = cells.down_dip();
        let counts = [cells.along_strike().count(), down_dip.count()];
        let direct = Convolution::of_differences(
            counts,
            [false; 2],
            directions,
            |apart| space.cells_apart(apart),
            space.cross_correction(),
        );
        let deepest = down_dip.center(counts[1] - 1);
        let mut own = Self {
            direct,
            depths: (0..counts[1])
                .map(|row| down_dip.center(row) / deepest)
                .collect(),
            images: Vec::new(),
        };
        let [length, rows] = own.direct.transform().lengths;
        let mut entries = vec![[(); POWERS].map(|()| vec![0.0; length * rows]); C * C];
        for of in shear_weights(space.area(), directions) {
            if !of.is_zero() {
                let [to, from] = of.components;
                add_image(cells, rock, &of, length, &mut entries[to * C + from]);
            }
        }
        for entries in entries {
            let spectra = [0, 1, 2].map(|power| own.direct.transform().spectrum(&entries[power]));
            own.images.push(Image { entries, spectra });
        }
        own
    }

    /// The memory of a product of so many components.
    pub(crate) fn memory(&self, components: usize) -> Memory {
        let [_, rows] = self.direct.transform().lengths;
        Memory {
            plane: self.direct.memory(components),
            slip: vec![Complex::default(); components * rows],
            force: vec![Complex::default(); POWERS * rows],
        }
    }

    /// `A_ij`.
    pub(crate) fn entry<const C: usize>(&self, i: usize, j: usize) -> SMatrix<f64, C, C> {
        let [columns, _] = self.direct.transform().counts;
        let [length, _] = self.direct.transform().lengths;
        let z = self.depths[i / columns];
        let apart = (i % columns + length - j % columns) % length;
        let place = (i / columns + j / columns) * length + apart;
        let image = SMatrix::from_fn(|a, b| {
            let [constant, linear, square] = &self.images[a * C + b].entries;
            constant[place] + z * (linear[place] + z * square[place])
        });
        self.direct.entry::<C>(i, j) + image
    }

    /// Passes on `(A x)_i` of each cell. Allocates nothing.
    pub(crate) fn product<const C: usize>(
        &self,
        memory: &mut Memory,
        x: &[SVector<f64, C>],
        mut show: impl FnMut(usize, SVector<f64, C>),
    ) {
        let transform = self.direct.transform();
        let [columns, rows] = transform.counts;
        debug_assert_eq!(x.len(), columns * rows);
        for c in 0..C {
            transform.forward(&mut memory.plane, c, |i| x[i][c]);
        }
        let length = transform.lengths[1];
        for wave in 0..memory.plane.modes[0].len() / length {
            let place = wave * length;
            for (c, slip) in memory.slip.chunks_exact_mut(length).enumerate() {
                slip.copy_from_slice(&memory.plane.modes[c][place..][..length]);
            }
            for a in 0..C {
                self.force_of_wave::<C>(a, place, &memory.slip, &mut memory.force);
                transform.columns_to_rows(&mut memory.force, &mut memory.plane.scratch);
                let (constant, others) = memory.force.split_at(length);
                let (linear, square) = others.split_at(length);
                let modes = &mut memory.plane.modes[a][place..][..rows];
                for (i, (mode, &z)) in modes.iter_mut().zip(&self.depths).enumerate() {
                    *mode = constant[i] + (linear[i] + square[i] * z) * z;
                }
            }
        }
        for c in 0..C {
            transform.rows_to_products(&mut memory.plane, c);
        }
        for i in 0..columns * rows {
            show(i, SVector::from_fn(|c, _| memory.plane.products[c][i]));
        }
    }

    /// The modes of a force by its powers of depth, at a wave number along strike. Sums of rows see slip mirrored.
    fn force_of_wave<const C: usize>(
        &self,
        a: usize,
        place: usize,
        slip: &[Complex<f64>],
        force: &mut [Complex<f64>],
    ) {
        let length = slip.len() / C;
        force.fill(Complex::default());
        for (b, slip) in slip.chunks_exact(length).enumerate() {
            let direct = &self.direct.spectrum(a, b)[place..][..length];
            for ((force, spectrum), slip) in force.iter_mut().zip(direct).zip(slip) {
                *force += slip * spectrum;
            }
            let spectra = &self.images[a * C + b].spectra;
            for (force, spectrum) in force.chunks_exact_mut(length).zip(spectra) {
                let spectrum = &spectrum[place..][..length];
                force[0] += spectrum[0] * slip[0];
                let mirrored = slip[1..].iter().rev();
                for ((force, spectrum), slip) in
                    force[1..].iter_mut().zip(&spectrum[1..]).zip(mirrored)
                {
                    *force += spectrum * slip;
                }
            }
        }
    }
}

/// Adds the image part of a block, from its corners by the sum of depths.
fn add_image(
    cells: &Rectangles,
    rock: &Rock,
    of: &Weights,
    length: usize,
    entries: &mut [Vec<f64>; POWERS],
) {
    let (along, down_dip) = (cells.along_strike(), cells.down_dip());
    let rows = down_dip.count();
    let deepest = down_dip.center(rows - 1);
    let row = |sum: usize| -> Vec<[f64; POWERS]> {
        let depth = 2.0 * down_dip.ends()[0] + (sum as f64 + 0.5) * down_dip.length();
        (0..=along.count())
            .map(|column| {
                let xi = (column as f64 - 0.5) * along.length();
                // A polynomial of degree 2 in the receiver's depth, from three depths.
                let at = |share: f64| of.of_image(rock, [xi, depth, 0.0], -share * depth);
                let [first, second, third] = [at(0.0), at(0.5), at(1.0)];
                let scale = deepest / depth;
                [
                    first,
                    scale * (-3.0 * first + 4.0 * second - third),
                    scale * scale * (2.0 * first - 4.0 * second + 2.0 * third),
                ]
            })
            .collect()
    };
    let mirrored = if of.odd { -1.0 } else { 1.0 };
    let mut upper = row(0);
    for sum in 0..2 * rows - 1 {
        let lower = row(sum + 1);
        for (power, entries) in entries.iter_mut().enumerate() {
            let of_edge = |column: usize| lower[column][power] - upper[column][power];
            let line = &mut entries[sum * length..][..length];
            for apart in 0..along.count() {
                let value = of_edge(apart + 1) - of_edge(apart);
                if apart > 0 {
                    line[apart] += value;
                    line[length - apart] += mirrored * value;
                } else if !of.odd {
                    line[0] += value;
                }
            }
        }
        upper = lower;
    }
}
