//! Static responses and modes are those of dense matrices.

use nalgebra::{DMatrix, DVector, SVector, Vector2};
use stickslip_fem::{Assembled, Mesh, P1, antiplane, elasticity, mass};
use stickslip_solvers::{BlockMatrix, Mode, Operator, SolveError, StaticResponses};

use crate::common::{DENSITY, ELASTIC, Fallible, Numbers, dense};

/// The residual of a mode that is taken, relative to its eigenvalue: by as much that is off at most.
const RESIDUAL: f64 = 1e-2;

/// A body with its base as boundary, and its top held.
struct Body<const C: usize> {
    stiffness: BlockMatrix<C>,
    mass: BlockMatrix<C>,
    boundary: Vec<usize>,
    fixed: Vec<[bool; C]>,
}

/// The free unknowns inside and on the boundary, as rows of dense matrices.
struct Split {
    inside: Vec<usize>,
    boundary: Vec<usize>,
    /// `E`.
    extension: DMatrix<f64>,
    /// `A_II^-1`.
    inverse: DMatrix<f64>,
    schur: DMatrix<f64>,
}

fn block(matrix: &DMatrix<f64>, rows: &[usize], columns: &[usize]) -> DMatrix<f64> {
    matrix.select_rows(rows).select_columns(columns)
}

impl<const C: usize> Body<C> {
    /// The components in `closed` are fixed on the base, too.
    fn new<const D: usize>(
        space: &P1<D>,
        (stiffness, mass): (Assembled<C>, Assembled<C>),
        closed: [bool; C],
    ) -> Result<Self, stickslip_fem::FemError> {
        let top = space.trace(|x| x[D - 1] == 1.0)?;
        let base = space.trace(|x| x[D - 1] == 0.0)?;
        let mut fixed = vec![[false; C]; space.vertex_count()];
        base.vertices().iter().for_each(|&p| fixed[p] = closed);
        top.vertices().iter().for_each(|&p| fixed[p] = [true; C]);
        Ok(Self {
            stiffness: stiffness.into_matrix(),
            mass: mass.into_matrix(),
            boundary: base.vertices().to_vec(),
            fixed,
        })
    }

    fn slider(level: usize) -> Result<Body<2>, stickslip_fem::FemError> {
        let space = P1::grid([5.0, 1.0], [5, 1])?.refined(level)?;
        let operators = (elasticity(&space, &ELASTIC)?, mass(&space, DENSITY)?);
        Body::new(&space, operators, [false, true])
    }

    fn solid() -> Result<Body<3>, stickslip_fem::FemError> {
        let space = P1::grid([2.0, 1.0, 1.0], [4, 2, 2])?;
        let operators = (elasticity(&space, &ELASTIC)?, mass(&space, DENSITY)?);
        Body::new(&space, operators, [false, false, true])
    }

    fn responses(&self) -> Result<StaticResponses<C>, SolveError> {
        StaticResponses::new(&self.stiffness, &self.boundary, &self.fixed, 1 << 30)
    }

    fn split(&self) -> Split {
        let free = |&i: &usize| !self.fixed[i / C][i % C];
        let is_inside = |&i: &usize| !self.boundary.contains(&(i / C));
        let all: Vec<usize> = (0..C * self.fixed.len()).filter(free).collect();
        let (inside, boundary): (Vec<_>, Vec<_>) = all.into_iter().partition(is_inside);
        let full = dense(&self.stiffness);
        let inverse = block(&full, &inside, &inside).try_inverse();
        let inverse = inverse.expect("held");
        let across = block(&full, &inside, &boundary);
        let followed = -(&inverse * &across);
        let schur = block(&full, &boundary, &boundary) + across.transpose() * &followed;
        let mut extension = DMatrix::zeros(full.nrows(), boundary.len());
        for (k, &i) in inside.iter().enumerate() {
            extension.row_mut(i).copy_from(&followed.row(k));
        }
        for (k, &i) in boundary.iter().enumerate() {
            extension[(i, k)] = 1.0;
        }
        Split {
            inside,
            boundary,
            extension,
            inverse,
            schur,
        }
    }

    /// Schur complement, congruence and substitutions.
    fn check_responses(&self) -> Fallible {
        let mut responses = self.responses()?;
        let split = self.split();
        let rows: Vec<usize> = (responses.owners().iter())
            .map(|&(vertex, c)| C * vertex + c)
            .collect();
        assert_eq!(
            (rows, responses.interior()),
            (split.boundary.clone(), split.inside.len())
        );
        let count = split.boundary.len();
        let stiffness = DMatrix::from_vec(count, count, responses.stiffness());
        let rounding = 1e-12 * split.schur.amax();
        assert!((stiffness - &split.schur).amax() < rounding);
        // Any operator of the pattern, one that is not definite, too.
        let mixed = BlockMatrix::combination(&[(1.0, &self.mass), (-1e-4, &self.stiffness)]);
        for operator in [&self.mass, &mixed] {
            let expected = split.extension.transpose() * dense(operator) * &split.extension;
            let found = DMatrix::from_vec(count, count, responses.condensed(operator)?);
            assert!((found - &expected).amax() < 1e-12 * expected.amax());
        }
        let mut numbers = Numbers(7);
        let forces: Vec<SVector<f64, C>> = (self.fixed.iter())
            .map(|_| SVector::from_fn(|_, _| numbers.next()))
            .collect();
        let flat = DVector::from_iterator(
            C * forces.len(),
            forces.iter().flat_map(|force| force.iter().copied()),
        );
        let mut onto = vec![0.0; count];
        responses.project(&self.stiffness, &forces, &mut onto)?;
        let expected = split.extension.transpose() * &flat;
        assert!((DVector::from_vec(onto) - expected).amax() < 1e-12);
        let y = DVector::from_fn(count, |_, _| numbers.next());
        let mut expected = &split.extension * &y;
        let mut field = vec![SVector::zeros(); forces.len()];
        responses.extend(&self.stiffness, None, y.as_slice(), &mut field)?;
        assert!(apart(&field, &expected) < 1e-12);
        let answer = &split.inverse * flat.select_rows(&split.inside);
        for (k, &i) in split.inside.iter().enumerate() {
            expected[i] += answer[k];
        }
        responses.extend(&self.stiffness, Some(&forces), y.as_slice(), &mut field)?;
        assert!(apart(&field, &expected) < 1e-12);
        Ok(())
    }

    /// All modes up to a share of the spectrum, against nalgebra's eigenvalues.
    fn check_modes(&self, share: f64) -> Fallible {
        let split = self.split();
        let root = split.inverse.clone().cholesky().expect("held").l();
        let (inertia, full) = (dense(&self.mass), dense(&self.stiffness));
        let inner = root.transpose() * block(&inertia, &split.inside, &split.inside) * &root;
        let mut expected: Vec<f64> = (inner.symmetric_eigenvalues().iter())
            .map(|value| value.recip().sqrt())
            .collect();
        expected.sort_by(f64::total_cmp);
        let wanted = (share * (expected.len() - 1) as f64) as usize;
        // Between two of them.
        let up_to = match expected.get(wanted + 1) {
            Some(next) if share < 1.0 => 0.5 * (expected[wanted] + next),
            _ => f64::INFINITY,
        };
        let modes = self.responses()?.modes(&self.mass, up_to)?;
        let kept = expected.partition_point(|&omega| omega <= up_to);
        assert_eq!(modes.found.len(), kept);
        match (modes.next, expected.get(kept)) {
            (Some(found), Some(next)) => assert!((found / next - 1.0).abs() < 1e-3),
            (found, expected) => assert_eq!(found, expected.copied()),
        }
        let shapes = DMatrix::from_fn(full.nrows(), kept, |i, k| {
            modes.found[k].shape[i / C][i % C]
        });
        for (i, row) in shapes.row_iter().enumerate() {
            assert!(split.inside.contains(&i) || row.amax() == 0.0);
        }
        let products = shapes.transpose() * &inertia * &shapes;
        assert!((products - DMatrix::identity(kept, kept)).amax() < 1e-9);
        // After Temple and Kato: of `mu = omega^-2`, the square of the residual by the distance to the next one.
        let mu = |k: usize| expected[k].powi(-2);
        for (k, mode) in modes.found.iter().enumerate() {
            let others = (0..expected.len()).filter(|&other| other != k);
            let gap = others.map(|other| (mu(k) - mu(other)).abs());
            let gap = gap.fold(f64::INFINITY, f64::min);
            let off = RESIDUAL.powi(2) * mu(k) / (gap - RESIDUAL * mu(k)).max(0.0);
            let off = (mode.angular_frequency / expected[k] - 1.0).abs() - off;
            assert!(off < 1e-10, "mode {k}: {off:e}");
            let shape = shapes.column(k);
            let stress =
                block(&full, &split.inside, &split.inside) * shape.select_rows(&split.inside);
            let momentum = (&inertia * shape).select_rows(&split.inside);
            let left = &stress - momentum * mode.angular_frequency.powi(2);
            // As an energy: `L^-1` of what is left over `L^-1` of the stress.
            let energy = |x: &DVector<f64>| x.dot(&(&split.inverse * x)).sqrt();
            assert!(
                energy(&left) < 1.01 * RESIDUAL * energy(&stress),
                "mode {k}"
            );
        }
        self.check_between(&modes.found)
    }

    /// Checks an operator between modes and the boundary.
    fn check_between(&self, modes: &[Mode<C>]) -> Fallible {
        let (split, size) = (self.split(), C * self.fixed.len());
        let shapes: Vec<_> = modes.iter().map(|mode| mode.shape.clone()).collect();
        let dense_shapes = DMatrix::from_fn(size, shapes.len(), |i, k| shapes[k][i / C][i % C]);
        let mixed = BlockMatrix::combination(&[(1.0, &self.mass), (1e-4, &self.stiffness)]);
        for operator in [&self.mass, &self.stiffness, &mixed] {
            let between = self.responses()?.between(operator, &shapes)?;
            let forces = dense(operator) * &dense_shapes;
            let (height, width) = (split.boundary.len(), shapes.len());
            let boundary = DMatrix::from_vec(height, width, between.boundary);
            // Sums of as many products as there are unknowns.
            let rounding = 1e-14 * size as f64 * forces.amax();
            let expected = split.extension.transpose() * &forces;
            assert!((boundary - expected).amax() < rounding);
            let expected = dense_shapes.transpose() * &forces;
            assert!((between.fields - expected).amax() < rounding * dense_shapes.amax());
        }
        Ok(())
    }
}

fn apart<const C: usize>(field: &[SVector<f64, C>], expected: &DVector<f64>) -> f64 {
    let numbers = field.iter().flat_map(|x| x.iter());
    let apart = numbers.zip(expected).map(|(a, b)| (a - b).abs());
    apart.fold(0.0, f64::max) / expected.amax()
}

fn layer() -> Result<Body<1>, stickslip_fem::FemError> {
    let space = P1::grid([3.0, 1.0], [12, 6])?;
    let operators = (antiplane(&space, 2e7)?, mass(&space, DENSITY)?);
    Body::new(&space, operators, [false])
}

#[test]
fn responses_are_those_of_a_dense_schur_complement() -> Fallible {
    layer()?.check_responses()?;
    Body::<2>::slider(1)?.check_responses()?;
    Body::<3>::solid()?.check_responses()
}

#[test]
fn modes_are_those_of_dense_matrices() -> Fallible {
    for share in [0.05, 0.4, 1.0] {
        layer()?.check_modes(share)?;
        Body::<2>::slider(1)?.check_modes(share)?;
        Body::<3>::solid()?.check_modes(share)?;
    }
    // 574 unknowns: by iteration.
    Body::<2>::slider(3)?.check_modes(0.02)?;
    Body::<2>::slider(3)?.check_modes(0.15)
}

/// A bound that follows from the lowest frequency is that bound.
#[test]
fn modes_up_to_a_multiple_of_the_lowest() -> Fallible {
    for level in [2, 3] {
        let body = Body::<2>::slider(level)?;
        let lowest = body.responses()?.modes(&body.mass, 1e-9)?.next;
        let lowest = lowest.ok_or("no mode")?;
        let expected = body.responses()?.modes(&body.mass, 4.0 * lowest)?;
        let found = (body.responses()?).modes_from(&body.mass, |lowest| 4.0 * lowest)?;
        assert!(expected.found.len() > 3);
        assert_eq!(found.found.len(), expected.found.len());
        for (found, expected) in found.found.iter().zip(&expected.found) {
            let (found, expected) = (found.angular_frequency, expected.angular_frequency);
            assert!((found / expected - 1.0).abs() < RESIDUAL);
        }
    }
    Ok(())
}

/// A mass on other vertices is no mass of this body.
#[test]
fn operators_of_another_pattern_are_refused() -> Fallible {
    let (body, other) = (Body::<2>::slider(1)?, Body::<2>::slider(2)?);
    let expected = Some(SolveError::SizeMismatch {
        expected: body.stiffness.nnz(),
        found: other.mass.nnz(),
    });
    let mut responses = body.responses()?;
    assert_eq!(responses.modes(&other.mass, 1.0).err(), expected);
    assert_eq!(responses.condensed(&other.mass).err(), expected);
    assert_eq!(responses.between(&other.mass, &[]).err(), expected);
    let short = [vec![SVector::zeros(); 3]];
    assert!(matches!(
        responses.between(&body.mass, &short),
        Err(SolveError::SizeMismatch { found: 3, .. })
    ));
    Ok(())
}

/// Equal bodies beside one another: every frequency is there as often as there are bodies.
#[test]
fn modes_of_equal_bodies_are_all_found() -> Fallible {
    modes_of_bodies(3, &[210.0, 300.0, 450.0, 800.0, 1600.0])?;
    // More than one start can find.
    modes_of_bodies(11, &[300.0, 450.0])
}

fn modes_of_bodies(bodies: usize, frequencies: &[f64]) -> Fallible {
    let (columns, rows) = (12, 12);
    let (mut points, mut cells) = (Vec::new(), Vec::new());
    for body in 0..bodies {
        let first = points.len();
        for j in 0..=rows {
            for i in 0..=columns {
                let x = 2.0 * body as f64 + i as f64 / columns as f64;
                points.push(Vector2::new(x, j as f64 / rows as f64));
            }
        }
        let at = |i: usize, j: usize| (first + j * (columns + 1) + i) as u32;
        for (i, j) in (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))) {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            cells.extend([a, b, c, a, c, d]);
        }
    }
    let space = P1::new(Mesh::new(points, cells)?);
    let operators = (antiplane(&space, 2e7)?, mass(&space, DENSITY)?);
    let body = Body::new(&space, operators, [false])?;
    let one = P1::grid([1.0, 1.0], [columns, rows])?;
    let operators = (antiplane(&one, 2e7)?, mass(&one, DENSITY)?);
    let one = Body::new(&one, operators, [false])?;
    for &up_to in frequencies {
        let modes = body.responses()?.modes(&body.mass, up_to)?.found;
        let of_one = one.responses()?.modes(&one.mass, up_to)?.found;
        assert!(!of_one.is_empty());
        assert_eq!(modes.len(), bodies * of_one.len(), "{up_to} 1/s");
        for (k, mode) in modes.iter().enumerate() {
            let expected = of_one[k / bodies].angular_frequency;
            assert!(
                (mode.angular_frequency / expected - 1.0).abs() < 1e-4,
                "mode {k}"
            );
        }
    }
    Ok(())
}

/// An interior that nothing holds has no static response, wherever rounding leaves its last pivot.
#[test]
fn an_interior_that_nothing_holds_is_refused() -> Fallible {
    for cells in 1..12 {
        let space = P1::grid([1.0, 1.0], [cells, cells])?;
        let (stiffness, size) = (elasticity(&space, &ELASTIC)?, space.vertex_count());
        // One vertex alone lets the body turn around it.
        let responses = StaticResponses::new(&stiffness, &[0], &vec![[false; 2]; size], 1 << 30);
        let Err(error) = responses else {
            return Err(format!("{cells} cells: taken").into());
        };
        assert!(
            matches!(error, SolveError::RigidBodyMode { .. }),
            "{cells} cells: {error}"
        );
    }
    Ok(())
}

#[test]
fn a_boundary_out_of_order_is_refused() -> Fallible {
    let mut body = layer()?;
    body.boundary.swap(3, 4);
    let error = body.responses().err();
    let (vertex, position) = (body.boundary[4], 4);
    assert_eq!(
        error,
        Some(SolveError::UnsortedVertices { vertex, position })
    );
    body.boundary = vec![body.fixed.len()];
    let error = body.responses().err();
    let (vertex, position) = (body.fixed.len(), 0);
    assert_eq!(
        error,
        Some(SolveError::UnsortedVertices { vertex, position })
    );
    Ok(())
}
