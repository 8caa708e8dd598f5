//! The helpers of several tests: a solver, plane waves with their derivatives, irregular meshes, shapes of cells, numbers.

use std::collections::BTreeSet;

use nalgebra::{SMatrix, SVector, Vector2, Vector3};
use stickslip_fem::{BlockMatrix, Constraints, Hierarchy, Mesh};

/// The u with (A u)_free = load_free and u_held = prescribed_held, by conjugate gradients down to rounding.
pub(crate) fn solve<const C: usize>(
    matrix: &BlockMatrix<C>,
    load: &[SVector<f64, C>],
    constraints: &Constraints<C>,
    prescribed: &[SVector<f64, C>],
) -> Vec<SVector<f64, C>> {
    let held = constraints.as_slice();
    let product = |x: &[SVector<f64, C>]| -> Vec<SVector<f64, C>> {
        let rows = matrix.outer_iterator().zip(held);
        rows.map(|(row, held)| {
            let sum: SVector<f64, C> = row.iter().map(|(q, block)| block * x[q]).sum();
            SVector::from_fn(|c, _| if held[c] { 0.0 } else { sum[c] })
        })
        .collect()
    };
    let dot = |a: &[SVector<f64, C>], b: &[SVector<f64, C>]| -> f64 {
        a.iter().zip(b).map(|(a, b)| a.dot(b)).sum()
    };
    let mut u = prescribed.to_vec();
    for (u, held) in u.iter_mut().zip(held) {
        (0..C).filter(|&c| !held[c]).for_each(|c| u[c] = 0.0);
    }
    let free = |x: &SVector<f64, C>, held: &[bool; C]| {
        SVector::from_fn(|c, _| if held[c] { 0.0 } else { x[c] })
    };
    let known = product(&u);
    let mut residual: Vec<_> = (load.iter().zip(held).zip(&known))
        .map(|((load, held), known)| free(load, held) - known)
        .collect();
    let mut direction = residual.clone();
    let (start, mut square) = (dot(&residual, &residual), dot(&residual, &residual));
    while square > 1e-28 * start {
        let image = product(&direction);
        let length = square / dot(&direction, &image);
        for k in 0..u.len() {
            u[k] += direction[k] * length;
            residual[k] -= image[k] * length;
        }
        let next = dot(&residual, &residual);
        for (direction, residual) in direction.iter_mut().zip(&residual) {
            *direction = residual + *direction * (next / square);
        }
        square = next;
    }
    u
}

/// u_i(x) = sin(k_i . x + c_i) with wave vectors k_i, rows of `waves`.
pub(crate) struct PlaneWaves<const D: usize, const C: usize> {
    pub(crate) waves: SMatrix<f64, C, D>,
    pub(crate) phases: SVector<f64, C>,
}

impl<const D: usize, const C: usize> PlaneWaves<D, C> {
    pub(crate) fn new() -> Self {
        Self {
            waves: SMatrix::from_fn(|i, j| [1.9, -1.3, 0.8, 2.1, 1.1][(2 * i + j) % 5]),
            phases: SVector::from_fn(|i, _| 0.4 + 0.5 * i as f64),
        }
    }

    fn angle(&self, x: &SVector<f64, D>) -> SVector<f64, C> {
        self.waves * x + self.phases
    }

    pub(crate) fn value(&self, x: &SVector<f64, D>) -> SVector<f64, C> {
        self.angle(x).map(f64::sin)
    }

    pub(crate) fn gradient(&self, x: &SVector<f64, D>) -> SMatrix<f64, C, D> {
        let angle = self.angle(x);
        SMatrix::from_fn(|i, j| angle[i].cos() * self.waves[(i, j)])
    }

    pub(crate) fn laplacian(&self, x: &SVector<f64, D>) -> SVector<f64, C> {
        let angle = self.angle(x);
        SVector::from_fn(|i, _| -angle[i].sin() * self.waves.row(i).norm_squared())
    }
}

impl<const D: usize> PlaneWaves<D, D> {
    /// grad div u = - sum over i of sin(angle_i) k_ii k_i.
    pub(crate) fn gradient_of_divergence(&self, x: &SVector<f64, D>) -> SVector<f64, D> {
        let angle = self.angle(x);
        (0..D)
            .map(|i| self.waves.row(i).transpose() * (-angle[i].sin() * self.waves[(i, i)]))
            .sum()
    }
}

/// A pentagon around two inner vertices: no two angles equal.
pub(crate) fn irregular_2d() -> Mesh<2> {
    let points = [
        (0.0, 0.0),
        (2.1, 0.2),
        (2.6, 1.7),
        (1.2, 2.5),
        (-0.4, 1.3),
        (0.9, 1.1),
        (1.6, 1.4),
    ];
    let cells = [
        [0, 1, 5],
        [1, 6, 5],
        [1, 2, 6],
        [2, 3, 6],
        [3, 5, 6],
        [3, 4, 5],
        [4, 0, 5],
    ];
    Mesh::new(
        points.map(|(x, y)| Vector2::new(x, y)).to_vec(),
        cells.concat(),
    )
    .unwrap()
}

/// An irregular tetrahedron cut into four around an inner vertex.
pub(crate) fn irregular_3d() -> Mesh<3> {
    let points = [
        (0.0, 0.0, 0.0),
        (1.7, 0.1, 0.2),
        (0.3, 1.4, -0.1),
        (0.2, 0.4, 1.2),
        (0.6, 0.5, 0.35),
    ];
    let cells = [[4, 1, 2, 3], [0, 4, 2, 3], [0, 1, 4, 3], [0, 1, 2, 4]];
    Mesh::new(
        points.map(|(x, y, z)| Vector3::new(x, y, z)).to_vec(),
        cells.concat(),
    )
    .unwrap()
}

pub(crate) fn levels<const D: usize>(hierarchy: &Hierarchy<D>) -> Vec<&Mesh<D>> {
    (0..hierarchy.level_count())
        .map(|level| hierarchy.mesh(level).unwrap())
        .collect()
}

pub(crate) fn volume<const D: usize>(mesh: &Mesh<D>) -> f64 {
    (0..mesh.cell_count()).map(|cell| mesh.volume(cell)).sum()
}

/// Squared edge lengths over the longest one, sorted, in units of 1e-9: equal for similar cells.
fn shape<const D: usize>(mesh: &Mesh<D>, cell: &[u32]) -> Vec<i64> {
    let x = |k: usize| mesh.vertices()[cell[k] as usize];
    let mut lengths: Vec<f64> = (0..=D)
        .flat_map(|i| (0..i).map(move |j| (x(i) - x(j)).norm_squared()))
        .collect();
    lengths.sort_by(f64::total_cmp);
    lengths
        .iter()
        .map(|length| (1e9 * length / lengths[lengths.len() - 1]).round() as i64)
        .collect()
}

pub(crate) fn shapes<const D: usize>(mesh: &Mesh<D>) -> BTreeSet<Vec<i64>> {
    mesh.cells().map(|cell| shape(mesh, cell)).collect()
}

/// Volume over (longest edge)^D of the worst cell.
pub(crate) fn regularity<const D: usize>(mesh: &Mesh<D>) -> f64 {
    let longest = |cell: &[u32]| {
        let x = |k: usize| mesh.vertices()[cell[k] as usize];
        (0..=D)
            .flat_map(|i| (0..i).map(move |j| (x(i) - x(j)).norm()))
            .fold(0.0, f64::max)
    };
    mesh.cells()
        .enumerate()
        .map(|(k, cell)| mesh.volume(k) / longest(cell).powi(D as i32))
        .fold(f64::INFINITY, f64::min)
}

/// Numbers in [0, 1) that are the same in every run: Knuth's linear congruential generator.
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = (self.0)
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}
