//! Tiles of a dense matrix, and products with one.

/// Rows and columns of a tile: a tile, 8 KiB, and what it is multiplied with stay in the fastest cache.
pub(super) const TILE: usize = 32;
/// Sums that run side by side.
const LANES: usize = 8;

/// Where an entry is stored, in a tile on or below the diagonal.
#[inline(always)]
pub(super) fn place(row: usize, column: usize) -> usize {
    let (i, j) = (row / TILE, column / TILE);
    (i * (i + 1) / 2 + j) * TILE * TILE + column % TILE * TILE + row % TILE
}

/// `y += T x` of a tile.
#[inline(always)]
pub(super) fn add_product(tile: &[f64], x: &[f64; TILE], y: &mut [f64; TILE]) {
    for (column, x) in tile.chunks_exact(TILE).zip(x) {
        for (y, entry) in y.iter_mut().zip(column) {
            *y += entry * x;
        }
    }
}

/// `y += T^T x` of a tile.
#[inline(always)]
pub(super) fn add_transposed_product(tile: &[f64], x: &[f64; TILE], y: &mut [f64; TILE]) {
    for (column, y) in tile.chunks_exact(TILE).zip(y) {
        let mut lanes = [0.0; LANES];
        for i in (0..TILE).step_by(LANES) {
            for l in 0..LANES {
                lanes[l] += column[i + l] * x[i + l];
            }
        }
        *y += lanes.iter().sum::<f64>();
    }
}

/// `y += T x`, and `T^T z`, in one pass.
#[inline(always)]
pub(super) fn add_products(
    tile: &[f64],
    x: &[f64; TILE],
    y: &mut [f64; TILE],
    z: &[f64; TILE],
) -> [f64; TILE] {
    let mut transposed = [0.0; TILE];
    for ((column, x), sum) in tile.chunks_exact(TILE).zip(x).zip(&mut transposed) {
        let mut lanes = [0.0; LANES];
        for i in (0..TILE).step_by(LANES) {
            for l in 0..LANES {
                y[i + l] += column[i + l] * x;
                lanes[l] += column[i + l] * z[i + l];
            }
        }
        *sum = lanes.iter().sum();
    }
    transposed
}
