//! A body whose operators are dense matrices, by the dense Newton method.

use nalgebra::DMatrix;
use stickslip::fem::{Assembled, P1, antiplane, mass};
use stickslip::problems::pipping_slider::{AGING, FRICTION};
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, Components, Condensed, Contact, DenseNewton, Matrix, Newmark, NonsmoothSolver,
    Operator, Scene, Simulation, Steps,
};

use crate::Outcome;
use crate::common::distance;

fn dense(matrix: &BlockMatrix<1>) -> DMatrix<f64> {
    let mut full = DMatrix::zeros(matrix.vertex_count(), matrix.vertex_count());
    for (block, (i, j)) in matrix.iter() {
        full[(i as usize, j as usize)] = block[(0, 0)];
    }
    full
}

/// The same motion as with sparse matrices and condensation.
#[test]
fn a_dense_body_moves_as_the_sparse_one() -> Outcome {
    fn run<Op: Operator<1> + 'static>(
        space: &P1<2>,
        [stiffness, inertia]: [Op; 2],
        solver: impl NonsmoothSolver<Op, 1> + 'static,
    ) -> Outcome<Simulation<1>> {
        let (bottom, top) = (space.trace(|x| x[1] == 0.0)?, space.trace(|x| x[1] == 1.0)?);
        let scene = Scene::new(stiffness)
            .with_mass(inertia)
            .with_contact(Contact::new(&bottom, FRICTION, 1e4).with_state(AGING, LogTheta(0.0)))
            .prescribe_velocity(&top, Components::ALL, |time| [1e-3 * time]);
        let body = Simulation::new(scene, Newmark::default(), solver)?;
        let mut body = body.with_absolute_tolerance(1e-13)?;
        body.run(&Steps::constant(2e-3).until(1.0), |_| ())?;
        assert!(body.snapshot().max_slip_rate() > 1e-5);
        Ok(body)
    }
    let space = P1::grid([1.0, 1.0], [4, 4])?;
    let matrices = [antiplane(&space, 4e7)?, mass(&space, 2e3)?].map(Assembled::into_matrix);
    let full = matrices.each_ref().map(dense);
    let dense = run(&space, full, DenseNewton::new())?;
    let sparse = run(&space, matrices, Condensed::new())?;
    let (dense, sparse) = (dense.snapshot(), sparse.snapshot());
    assert!(distance(dense.velocity, sparse.velocity) < 1e-12);
    assert!(distance(dense.displacement, sparse.displacement) < 1e-14);
    Ok(())
}
