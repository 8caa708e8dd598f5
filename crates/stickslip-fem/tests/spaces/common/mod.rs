//! What several tests need: a direct solver, plane waves with their derivatives, an irregular mesh.

use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};
use nalgebra::{SMatrix, SVector, Vector2, Vector3};
use stickslip_fem::{BlockMatrix, Constraints, Mesh};

/// The u with (A u)_free = load_free and u_held = prescribed_held, by sparse Cholesky.
pub(crate) fn solve<const C: usize>(
    matrix: &BlockMatrix<C>,
    load: &[SVector<f64, C>],
    constraints: &Constraints<C>,
    prescribed: &[SVector<f64, C>],
) -> Vec<SVector<f64, C>> {
    let held = constraints.as_slice();
    let mut free = 0;
    let number: Vec<[Option<usize>; C]> = held
        .iter()
        .map(|held| {
            held.map(|held| {
                free += usize::from(!held);
                (!held).then(|| free - 1)
            })
        })
        .collect();
    let mut triplets = Vec::new();
    let mut rhs = Mat::<f64>::zeros(free, 1);
    for (p, row) in matrix.outer_iterator().enumerate() {
        for i in 0..C {
            let Some(k) = number[p][i] else { continue };
            rhs[(k, 0)] += load[p][i];
            for (q, block) in row.iter() {
                for j in 0..C {
                    match number[q][j] {
                        Some(l) => triplets.push(Triplet::new(k, l, block[(i, j)])),
                        None => rhs[(k, 0)] -= block[(i, j)] * prescribed[q][j],
                    }
                }
            }
        }
    }
    let matrix = SparseColMat::<usize, f64>::try_new_from_triplets(free, free, &triplets).unwrap();
    let x = matrix.sp_cholesky(Side::Lower).unwrap().solve(&rhs);
    let mut u = prescribed.to_vec();
    for (u, number) in u.iter_mut().zip(&number) {
        for (u, number) in u.iter_mut().zip(number) {
            if let Some(k) = number {
                *u = x[(*k, 0)];
            }
        }
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
