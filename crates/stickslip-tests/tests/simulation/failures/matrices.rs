//! Matrices that are no symmetric operators on fields are refused, whichever of a scene's they are.

use nalgebra::{DMatrix, SMatrix, Vector2};
use stickslip::fem::{Elastic, P1, elasticity, mass};
use stickslip::solvers::{MatrixDefect, MeshMismatch};
use stickslip::{
    BackwardEuler, BlockGaussSeidel, BlockMatrix, DenseNewton, Matrix, Operator, Scene, SceneError,
    Simulation,
};

use crate::Outcome;

const ELASTIC: Elastic = Elastic {
    young_modulus: 5e7,
    poisson_ratio: 0.3,
};

fn space() -> Outcome<P1<2>> {
    Ok(P1::grid([2.0, 1.0], [2, 2])?)
}

/// A scene with a matrix in each role, the others in order.
fn scenes(matrix: &BlockMatrix<2>) -> Outcome<[(&'static str, Scene<BlockMatrix<2>, 2>); 3]> {
    let body = || -> Outcome<_> { Ok(Scene::new(elasticity(&space()?, &ELASTIC)?)) };
    Ok([
        ("stiffness matrix", Scene::new(matrix.clone())),
        ("mass matrix", body()?.with_mass(matrix.clone())),
        (
            "viscosity matrix",
            body()?
                .with_viscosity(elasticity(&space()?, &ELASTIC)?)
                .with_viscosity(matrix.clone()),
        ),
    ])
}

fn error_of<Op: Operator<2> + 'static>(
    scene: Scene<Op, 2>,
    solver: impl stickslip::NonsmoothSolver<Op, 2> + 'static,
) -> Outcome<SceneError> {
    let made = Simulation::new(scene, BackwardEuler, solver);
    super::one_line(made.err().ok_or("the matrix was accepted")?)
}

#[test]
fn what_is_no_operator_is_refused() -> Outcome {
    let whole = elasticity(&space()?, &ELASTIC)?.into_matrix();
    let size = whole.rows();
    let (mut starts, columns, blocks) = whole.clone().into_raw_storage();
    starts.push(columns.len() as u32);
    let tall = BlockMatrix::new((size + 1, size), starts, columns.clone(), blocks);
    let wide = BlockMatrix::new((1, size), vec![0, 1], vec![0], vec![SMatrix::identity()]);
    let by_columns = whole.to_csc();
    let not_square = |rows, columns| MatrixDefect::NotSquare { rows, columns };
    for (matrix, defect) in [
        (tall, not_square(size + 1, size)),
        (wide, not_square(1, size)),
        (by_columns, MatrixDefect::ByColumns),
    ] {
        for (what, scene) in scenes(&matrix)? {
            let error = error_of(scene, BlockGaussSeidel::new())?;
            assert_eq!(error, SceneError::Matrix { what, defect });
        }
    }
    let what = "stiffness matrix";
    for (matrix, defect) in [
        (DMatrix::zeros(4, 6), not_square(4, 6)),
        (
            DMatrix::identity(5, 5),
            MatrixDefect::NoBlocks {
                rows: 5,
                components: 2,
            },
        ),
    ] {
        let error = error_of(Scene::new(matrix), DenseNewton::new())?;
        assert_eq!(error, SceneError::Matrix { what, defect });
    }
    Ok(())
}

/// An entry that its mirror image lacks, by a thousandth of what the material resists, wherever it is.
#[test]
fn asymmetry_is_seen() -> Outcome {
    let whole = elasticity(&space()?, &ELASTIC)?.into_matrix();
    let spoilt = |place: usize, component: usize| {
        let mut matrix = whole.clone();
        matrix.data_mut()[place][(component, 1 - component)] += 1e-3 * ELASTIC.young_modulus;
        matrix
    };
    for place in 0..whole.nnz() {
        for matrix in [0, 1].map(|component| spoilt(place, component)) {
            let error = error_of(Scene::new(matrix), BlockGaussSeidel::new())?;
            let seen = matches!(error, SceneError::NotSymmetric { .. });
            assert!(seen, "block {place}: {error}");
        }
    }
    for (expected, scene) in scenes(&spoilt(1, 0))? {
        match error_of(scene, BlockGaussSeidel::new())? {
            SceneError::NotSymmetric { what, .. } => assert_eq!(what, expected),
            error => return Err(error.into()),
        }
    }
    Ok(())
}

/// A multiple knows the mesh, and is one.
#[test]
fn damping_by_mass_and_stiffness_is_of_its_mesh() -> Outcome {
    let (space, other) = (space()?, P1::grid([3.0, 1.0], [2, 2])?);
    let (stiffness, inertia) = (elasticity(&space, &ELASTIC)?, mass(&space, 5e3)?);
    let v = space.interpolate(|x| Vector2::new(x[1], 2.0 * x[0]));
    let twice = &stiffness * 2.0;
    let power = stiffness.quadratic(&v);
    assert_eq!(twice.quadratic(&v), 2.0 * power);
    let body = || Scene::new(stiffness.clone()).with_mass(inertia.clone());
    let damped = body()
        .with_viscosity(&stiffness * 1e-3)
        .with_viscosity(&inertia * 0.1);
    Simulation::new(damped, BackwardEuler, BlockGaussSeidel::new())?;
    let foreign = body().with_viscosity(&elasticity(&other, &ELASTIC)? * 1e-3);
    let [expected, found] = [&space, &other].map(|space| space.mesh().identity());
    let error = MeshMismatch::new("viscosity matrix", expected, found);
    assert_eq!(
        error_of(foreign, BlockGaussSeidel::new())?,
        SceneError::Mesh(error)
    );
    Ok(())
}
