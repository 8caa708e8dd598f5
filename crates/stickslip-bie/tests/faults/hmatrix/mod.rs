//! Hierarchical matrices: their error, their products, and what they refuse.

mod accuracy;
mod products;
mod refusals;
mod triangles;

use stickslip_bie::hmatrix::{Approximation, Entries, Extent, HMatrix, HMatrixError};

/// Points, and the numbers of a pair by their places: rows times columns.
pub(crate) struct Points<F> {
    pub(crate) places: Vec<[f64; 3]>,
    pub(crate) shape: [usize; 2],
    pub(crate) pair: F,
}

impl<F: Fn([f64; 3], [f64; 3], &mut [f64]) + Sync> Entries for Points<F> {
    fn shape(&self) -> [usize; 2] {
        self.shape
    }

    fn block(&self, receiver: usize, source: usize, block: &mut [f64]) {
        (self.pair)(self.places[receiver], self.places[source], block);
    }
}

impl<F: Fn([f64; 3], [f64; 3], &mut [f64]) + Sync> Points<F> {
    pub(crate) fn compress(&self, with: &Approximation) -> Result<HMatrix, HMatrixError> {
        HMatrix::new(self, &boxes(&self.places), with)
    }
}

pub(crate) fn boxes(places: &[[f64; 3]]) -> Vec<Extent> {
    let boxes = places.iter().map(|&place| Extent::of_points([place]));
    boxes.collect()
}

/// Places on a rough sheet, `count` by `count`.
pub(crate) fn sheet(count: usize) -> Vec<[f64; 3]> {
    let place = |k: usize| {
        let [x, y] = [k / count, k % count].map(|i| i as f64 / count as f64);
        [x, y, 0.03 * (9.0 * x + 1.0).sin() * (7.0 * y).cos()]
    };
    (0..count * count).map(place).collect()
}

/// Second derivatives of the distance softened at short range: as stresses decay, times `numbers` smooth factors.
pub(crate) fn smooth(receiver: [f64; 3], source: [f64; 3], block: &mut [f64]) {
    let d = [0, 1, 2].map(|i| receiver[i] - source[i]);
    let squared = 1e-4 + d.iter().map(|x| x * x).sum::<f64>();
    for (n, number) in block.iter_mut().enumerate() {
        let [i, j] = [n % 3, n / 3 % 3];
        let delta = if i == j { 1.0 } else { 0.0 };
        *number = (delta - 3.0 * d[i] * d[j] / squared) / (squared * squared.sqrt());
    }
}

/// Numbers that look random.
pub(crate) fn noise(count: usize) -> Vec<f64> {
    (0..count)
        .map(|k| ((k * k + 3 * k) as f64 * 0.7312).sin())
        .collect()
}

/// `A x` by the matrix, by receiver.
pub(crate) fn product(matrix: &HMatrix, x: &[f64]) -> Vec<f64> {
    let ([of_receiver, of_source], [receivers, _]) = (matrix.shape(), matrix.cells());
    let mut y = vec![f64::NAN; of_receiver * receivers];
    let columns = |source: usize| &x[of_source * source..of_source * (source + 1)];
    matrix.product(&mut matrix.scratch(), columns, |receiver, rows| {
        y[of_receiver * receiver..of_receiver * (receiver + 1)].copy_from_slice(rows);
    });
    y
}

/// `A x` pair by pair.
pub(crate) fn exact(
    entries: &impl Entries,
    [receivers, sources]: [usize; 2],
    x: &[f64],
) -> Vec<f64> {
    let [of_receiver, of_source] = entries.shape();
    let mut y = vec![0.0; of_receiver * receivers];
    let mut pair = vec![0.0; of_receiver * of_source];
    for (receiver, y) in y.chunks_exact_mut(of_receiver).enumerate() {
        for source in 0..sources {
            entries.block(receiver, source, &mut pair);
            for (y, row) in y.iter_mut().zip(pair.chunks_exact(of_source)) {
                let x = &x[of_source * source..];
                *y += row.iter().zip(x).map(|(a, x)| a * x).sum::<f64>();
            }
        }
    }
    y
}

pub(crate) fn norm(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The norm of `a - b`, as a share of that of `b`.
pub(crate) fn error(a: &[f64], b: &[f64]) -> f64 {
    norm(a.iter().zip(b).map(|(a, b)| a - b)) / norm(b.iter().copied()).max(f64::MIN_POSITIVE)
}

/// The error of all far pairs in the Frobenius norm, as a share of their norm; near pairs must be exact.
pub(crate) fn far_error(matrix: &mut HMatrix, entries: &impl Entries) -> f64 {
    let [receivers, sources] = matrix.cells();
    let count = entries.shape().iter().product();
    let (mut stored, mut pair) = (vec![0.0; count], vec![0.0; count]);
    let (mut errors, mut numbers) = (Vec::new(), Vec::new());
    for (receiver, source) in (0..receivers).flat_map(|i| (0..sources).map(move |j| (i, j))) {
        entries.block(receiver, source, &mut pair);
        matrix.block(receiver, source, &mut stored);
        if matrix.add([receiver, 0], [source, 0], 0.0).is_ok() {
            assert_eq!(stored, pair, "{receiver} {source}");
        } else {
            errors.extend(stored.iter().zip(&pair).map(|(a, b)| a - b));
            numbers.extend_from_slice(&pair);
        }
    }
    norm(errors) / norm(numbers).max(f64::MIN_POSITIVE)
}
