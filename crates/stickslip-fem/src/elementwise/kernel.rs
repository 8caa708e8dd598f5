//! The forces of four chains of cells at once.

use super::lanes::{Lanes, Row};

// Loops, not closures: these would not be compiled for the wide registers.

/// The vertices of four chains or cells, by vertex: places among the vertices of their group.
pub(super) type Corners<const K: usize> = [[u16; 4]; K];

/// The position of a vertex \[m\], and the vector of the field there: side by side, for the cache.
pub(super) type Site = [Row; 2];

/// Lamé's parameters of four cells \[Pa\].
pub(super) type Lame = [Row; 2];

/// The vertex that all cells of a chain share.
const ORIGIN: usize = 2;

/// The vertices of a cell of a chain but the origin.
#[inline(always)]
const fn vertex(cell: usize, k: usize) -> usize {
    if cell + k < ORIGIN {
        cell + k
    } else {
        cell + k + 1
    }
}

/// Adds the forces `A u` of the first `LIVE` of four chains of `N` cells to those at their vertices.
///
/// With edges `e_k = x_k - x_0` of a cell and their cofactors `c_k = det(J) grad N_k`, `k = 1..D`,
///
/// ```text
/// H = sum of (u_k - u_0) c_k^T,    S = w (lambda tr H I + mu (H + H^T)),    f_k = S c_k,    w = 1/(D! |det J|)
/// ```
///
/// and `w` is the volume over `det(J)^2`: there is one division. `x_0` is the vertex that the cells of a chain share; its force is
/// minus the sum of the others. Positions, vectors and forces of a vertex are read once for all of its cells in the chain.
#[inline(always)]
pub(super) fn add_forces<
    L: Lanes<F>,
    const D: usize,
    const N: usize,
    const K: usize,
    const LIVE: usize,
    const F: usize,
>(
    lanes: L,
    corners: [&Corners<K>; F],
    lame: [[&Lame; F]; N],
    sites: &[Site],
    forces: &mut [Row],
) {
    let zero = lanes.splat(0.0);
    let edges = differences::<L, D, N, K, F, 0>(lanes, corners, sites);
    let steps = differences::<L, D, N, K, F, 1>(lanes, corners, sites);
    let mut force = [[zero; 3]; K];
    add_cell::<L, D, K, F, 0>(lanes, lame[0], &edges, &steps, &mut force);
    if N > 1 {
        add_cell::<L, D, K, F, 1>(lanes, lame[1], &edges, &steps, &mut force);
        add_cell::<L, D, K, F, 2>(lanes, lame[2], &edges, &steps, &mut force);
    }
    let mut origin = [zero; 3];
    for v in 0..N + D {
        if v != ORIGIN {
            for i in 0..D {
                origin[i] = lanes.sub(origin[i], force[v][i]);
            }
            scatter::<L, K, LIVE, F>(lanes, corners, v, force[v], forces);
        }
    }
    scatter::<L, K, LIVE, F>(lanes, corners, ORIGIN, origin, forces);
}

/// Adds the forces of the cells `CELL` of four chains to those at their vertices but the origin.
#[inline(always)]
fn add_cell<L: Lanes<F>, const D: usize, const K: usize, const F: usize, const CELL: usize>(
    lanes: L,
    lame: [&Lame; F],
    edges: &[[L::Number; 3]; K],
    steps: &[[L::Number; 3]; K],
    force: &mut [[L::Number; 3]; K],
) {
    let (cofactors, weight) = geometry::<L, D, K, F, CELL>(lanes, edges);
    let mut h = [[lanes.splat(0.0); 3]; 3];
    for i in 0..D {
        for j in 0..D {
            h[i][j] = lanes.mul(steps[vertex(CELL, 0)][i], cofactors[0][j]);
            for k in 1..D {
                h[i][j] = lanes.mul_add(steps[vertex(CELL, k)][i], cofactors[k][j], h[i][j]);
            }
        }
    }
    let stress = stress::<L, D, F>(lanes, lame, weight, &h);
    for k in 0..D {
        let force = &mut force[vertex(CELL, k)];
        // The last vertex of each cell is new.
        let new = CELL == 0 || k + 1 == D;
        for i in 0..D {
            for j in 0..D {
                force[i] = if new && j == 0 {
                    lanes.mul(stress[i][j], cofactors[k][j])
                } else {
                    lanes.mul_add(stress[i][j], cofactors[k][j], force[i])
                };
            }
        }
    }
}

/// The differences of the vectors at the vertices of chains from that at the origin.
#[inline(always)]
fn differences<
    L: Lanes<F>,
    const D: usize,
    const N: usize,
    const K: usize,
    const F: usize,
    const ROW: usize,
>(
    lanes: L,
    corners: [&Corners<K>; F],
    sites: &[Site],
) -> [[L::Number; 3]; K] {
    let origin = at::<L, K, F, ROW>(lanes, corners, ORIGIN, sites);
    let mut differences = [origin; K];
    for v in 0..N + D {
        if v != ORIGIN {
            let end = at::<L, K, F, ROW>(lanes, corners, v, sites);
            for i in 0..D {
                differences[v][i] = lanes.sub(end[i], origin[i]);
            }
        }
    }
    differences
}

/// The vectors at one vertex of each chain, by components.
#[inline(always)]
fn at<L: Lanes<F>, const K: usize, const F: usize, const ROW: usize>(
    lanes: L,
    corners: [&Corners<K>; F],
    v: usize,
    sites: &[Site],
) -> [L::Number; 3] {
    let mut all = [[&sites[0][ROW]; 4]; F];
    for f in 0..F {
        for l in 0..4 {
            all[f][l] = &sites[usize::from(corners[f][v][l])][ROW];
        }
    }
    lanes.columns(all)
}

/// The cofactors of the edges of a cell, and `1/(D! |det J|)`.
#[inline(always)]
fn geometry<L: Lanes<F>, const D: usize, const K: usize, const F: usize, const CELL: usize>(
    lanes: L,
    edges: &[[L::Number; 3]; K],
) -> ([[L::Number; 3]; 3], L::Number) {
    let zero = lanes.splat(0.0);
    let mut cofactors = [[zero; 3]; 3];
    if D == 2 {
        let (e, f) = (edges[vertex(CELL, 0)], edges[vertex(CELL, 1)]);
        cofactors[0] = [f[1], lanes.sub(zero, f[0]), zero];
        cofactors[1] = [lanes.sub(zero, e[1]), e[0], zero];
    } else {
        for k in 0..3 {
            let (p, q) = (vertex(CELL, (k + 1) % 3), vertex(CELL, (k + 2) % 3));
            for i in 0..3 {
                let (r, s) = ((i + 1) % 3, (i + 2) % 3);
                let other = lanes.mul(edges[p][s], edges[q][r]);
                cofactors[k][i] = lanes.mul_sub(edges[p][r], edges[q][s], other);
            }
        }
    }
    let e = edges[vertex(CELL, 0)];
    let mut determinant = lanes.mul(e[0], cofactors[0][0]);
    for i in 1..D {
        determinant = lanes.mul_add(e[i], cofactors[0][i], determinant);
    }
    let factorial = if D == 2 { 2.0 } else { 6.0 };
    let weight = lanes.div(lanes.splat(1.0 / factorial), lanes.abs(determinant));
    (cofactors, weight)
}

/// `w (lambda tr H I + mu (H + H^T))`.
#[inline(always)]
fn stress<L: Lanes<F>, const D: usize, const F: usize>(
    lanes: L,
    lame: [&Lame; F],
    weight: L::Number,
    h: &[[L::Number; 3]; 3],
) -> [[L::Number; 3]; 3] {
    let mut trace = h[0][0];
    for i in 1..D {
        trace = lanes.add(trace, h[i][i]);
    }
    let lambda = lanes.mul(lanes.load(lame.map(|lame| &lame[0])), weight);
    let mu = lanes.mul(lanes.load(lame.map(|lame| &lame[1])), weight);
    let pressure = lanes.mul(lambda, trace);
    let mut stress = *h;
    for i in 0..D {
        stress[i][i] = lanes.mul_add(mu, lanes.add(h[i][i], h[i][i]), pressure);
        for j in i + 1..D {
            stress[i][j] = lanes.mul(mu, lanes.add(h[i][j], h[j][i]));
            stress[j][i] = stress[i][j];
        }
    }
    stress
}

/// Adds vectors to those at one vertex of each chain.
#[inline(always)]
fn scatter<L: Lanes<F>, const K: usize, const LIVE: usize, const F: usize>(
    lanes: L,
    corners: [&Corners<K>; F],
    v: usize,
    columns: [L::Number; 3],
    rows: &mut [Row],
) {
    let vectors = lanes.rows(columns);
    for f in 0..F {
        for l in 0..LIVE {
            lanes.add_to(&mut rows[usize::from(corners[f][v][l])], vectors[f][l]);
        }
    }
}
