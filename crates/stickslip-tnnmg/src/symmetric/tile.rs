//! Tiles of a dense matrix, and products with one.

use pulp::Simd;

/// Rows and columns of a tile: a tile, 8 KiB, and what it is multiplied with stay in the fastest cache.
pub(super) const TILE: usize = 32;

/// Where an entry is stored, in a tile on or below the diagonal.
#[inline(always)]
pub(super) fn place(row: usize, column: usize) -> usize {
    let (i, j) = (row / TILE, column / TILE);
    (i * (i + 1) / 2 + j) * TILE * TILE + column % TILE * TILE + row % TILE
}

/// `y += T x` of a tile.
#[inline(always)]
pub(super) fn add_product<S: Simd>(simd: S, tile: &[f64], x: &[f64; TILE], y: &mut [f64; TILE]) {
    let (ys, _) = S::as_mut_simd_f64s(y);
    for (column, &x) in tile.chunks_exact(TILE).zip(x) {
        let (column, _) = S::as_simd_f64s(column);
        let x = simd.splat_f64s(x);
        for (y, &entry) in ys.iter_mut().zip(column) {
            *y = simd.mul_add_e_f64s(entry, x, *y);
        }
    }
}

/// `y += T^T x` of a tile.
#[inline(always)]
pub(super) fn add_transposed_product<S: Simd>(
    simd: S,
    tile: &[f64],
    x: &[f64; TILE],
    y: &mut [f64; TILE],
) {
    let (xs, _) = S::as_simd_f64s(x);
    for (column, y) in tile.chunks_exact(TILE).zip(y) {
        let (column, _) = S::as_simd_f64s(column);
        let mut sums = [simd.splat_f64s(0.0); 2];
        for (i, (&entry, &x)) in column.iter().zip(xs).enumerate() {
            sums[i % 2] = simd.mul_add_e_f64s(entry, x, sums[i % 2]);
        }
        *y += simd.reduce_sum_f64s(simd.add_f64s(sums[0], sums[1]));
    }
}

/// `y += T x`, and `T^T z`, in one pass.
#[inline(always)]
pub(super) fn add_products<S: Simd>(
    simd: S,
    tile: &[f64],
    x: &[f64; TILE],
    y: &mut [f64; TILE],
    z: &[f64; TILE],
) -> [f64; TILE] {
    let mut transposed = [0.0; TILE];
    let (ys, _) = S::as_mut_simd_f64s(y);
    let (zs, _) = S::as_simd_f64s(z);
    for ((column, &x), sum) in tile.chunks_exact(TILE).zip(x).zip(&mut transposed) {
        let (column, _) = S::as_simd_f64s(column);
        let x = simd.splat_f64s(x);
        let mut sums = [simd.splat_f64s(0.0); 2];
        for (i, ((y, &entry), &z)) in ys.iter_mut().zip(column).zip(zs).enumerate() {
            *y = simd.mul_add_e_f64s(entry, x, *y);
            sums[i % 2] = simd.mul_add_e_f64s(entry, z, sums[i % 2]);
        }
        *sum = simd.reduce_sum_f64s(simd.add_f64s(sums[0], sums[1]));
    }
    transposed
}
