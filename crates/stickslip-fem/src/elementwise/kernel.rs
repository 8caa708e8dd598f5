//! The forces of four cells at once.

use super::lanes::{Lanes, Row};

// Loops, not closures: these would not be compiled for the wide registers.

/// The corners of four cells, by corner: positions among the vertices of their group.
pub(super) type Corners = [[u16; 4]; 4];

/// Lamé's parameters of four cells \[Pa\].
pub(super) type Lame = [Row; 2];

/// Adds the forces `A u` of the first `LIVE` of four cells to those at their vertices.
///
/// With edges `e_k = x_k - x_0` and their cofactors `c_k = det(J) grad N_k`, `k = 1..D`,
///
/// ```text
/// H = sum of (u_k - u_0) c_k^T,    S = w (lambda tr H I + mu (H + H^T)),    f_k = S c_k,    w = 1/(D! det J)
/// ```
///
/// and `f_0 = -(f_1 + .. + f_D)`: `w` is the volume over `det(J)^2`, and there is one division.
#[inline(always)]
pub(super) fn add_forces<L: Lanes, const D: usize, const LIVE: usize>(
    lanes: L,
    corners: &Corners,
    lame: &Lame,
    positions: &[Row],
    field: &[Row],
    forces: &mut [Row],
) {
    let (cofactors, weight) = geometry::<L, D>(lanes, corners, positions);
    let steps = edges::<L, D>(lanes, corners, field);
    let zero = lanes.splat(0.0);
    let mut h = [[zero; 3]; 3];
    for i in 0..D {
        for j in 0..D {
            h[i][j] = lanes.mul(steps[0][i], cofactors[0][j]);
            for k in 1..D {
                h[i][j] = lanes.mul_add(steps[k][i], cofactors[k][j], h[i][j]);
            }
        }
    }
    let stress = stress::<L, D>(lanes, lame, weight, &h);
    let mut first = [zero; 3];
    for k in 0..D {
        let mut force = [zero; 3];
        for i in 0..D {
            force[i] = lanes.mul(stress[i][0], cofactors[k][0]);
            for j in 1..D {
                force[i] = lanes.mul_add(stress[i][j], cofactors[k][j], force[i]);
            }
            first[i] = lanes.sub(first[i], force[i]);
        }
        scatter::<L, LIVE>(lanes, &corners[k + 1], force, forces);
    }
    scatter::<L, LIVE>(lanes, &corners[0], first, forces);
}

/// The differences of the vectors at corners `1..D` from that at corner 0.
#[inline(always)]
fn edges<L: Lanes, const D: usize>(lanes: L, corners: &Corners, rows: &[Row]) -> [[L::Four; 3]; 3] {
    let origin = at(lanes, &corners[0], rows);
    let mut edges = [origin; 3];
    for k in 0..D {
        let end = at(lanes, &corners[k + 1], rows);
        for i in 0..D {
            edges[k][i] = lanes.sub(end[i], origin[i]);
        }
    }
    edges
}

/// The vectors at one corner of each cell, by components.
#[inline(always)]
fn at<L: Lanes>(lanes: L, corner: &[u16; 4], rows: &[Row]) -> [L::Four; 3] {
    lanes.columns([
        &rows[usize::from(corner[0])],
        &rows[usize::from(corner[1])],
        &rows[usize::from(corner[2])],
        &rows[usize::from(corner[3])],
    ])
}

/// The cofactors of the edges, and `1/(D! det J)`.
#[inline(always)]
fn geometry<L: Lanes, const D: usize>(
    lanes: L,
    corners: &Corners,
    positions: &[Row],
) -> ([[L::Four; 3]; 3], L::Four) {
    let e = edges::<L, D>(lanes, corners, positions);
    let mut cofactors = e;
    if D == 2 {
        let zero = lanes.splat(0.0);
        cofactors[0] = [e[1][1], lanes.sub(zero, e[1][0]), zero];
        cofactors[1] = [lanes.sub(zero, e[0][1]), e[0][0], zero];
    } else {
        for k in 0..3 {
            let (p, q) = ((k + 1) % 3, (k + 2) % 3);
            for i in 0..3 {
                let (r, s) = ((i + 1) % 3, (i + 2) % 3);
                let other = lanes.mul(e[p][s], e[q][r]);
                cofactors[k][i] = lanes.mul_sub(e[p][r], e[q][s], other);
            }
        }
    }
    let mut determinant = lanes.mul(e[0][0], cofactors[0][0]);
    for i in 1..D {
        determinant = lanes.mul_add(e[0][i], cofactors[0][i], determinant);
    }
    let factorial = if D == 2 { 2.0 } else { 6.0 };
    let weight = lanes.div(lanes.splat(1.0 / factorial), determinant);
    (cofactors, weight)
}

/// `w (lambda tr H I + mu (H + H^T))`.
#[inline(always)]
fn stress<L: Lanes, const D: usize>(
    lanes: L,
    lame: &Lame,
    weight: L::Four,
    h: &[[L::Four; 3]; 3],
) -> [[L::Four; 3]; 3] {
    let mut trace = h[0][0];
    for i in 1..D {
        trace = lanes.add(trace, h[i][i]);
    }
    let lambda = lanes.mul(lanes.load(&lame[0]), weight);
    let mu = lanes.mul(lanes.load(&lame[1]), weight);
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

/// Adds vectors to those at one corner of each cell.
#[inline(always)]
fn scatter<L: Lanes, const LIVE: usize>(
    lanes: L,
    corners: &[u16; 4],
    columns: [L::Four; 3],
    rows: &mut [Row],
) {
    let vectors = lanes.rows(columns);
    for l in 0..LIVE {
        lanes.add_to(&mut rows[usize::from(corners[l])], vectors[l]);
    }
}
