//! Wrong input, slopes that no minimiser exists for, and lost iterations.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::{ConvexPotential, Interval, LocalModel};
use stickslip_solvers::{Condensed, Energy, NonsmoothSolver, SolveError};

use crate::common::{Fallible, Problem, Regime, antiplane, gives_up, slider};

/// `phi(v) = -k v^2/2`: what is left when a strongly weakening state is eliminated.
struct Weakening(f64);

impl ConvexPotential<1> for Weakening {
    fn value(&self, v: &SVector<f64, 1>) -> f64 {
        -0.5 * self.0 * v[0] * v[0]
    }
    fn slope_along(&self, v: &SVector<f64, 1>, d: &SVector<f64, 1>) -> Interval {
        let slope = -self.0 * v[0] * d[0];
        Interval {
            lower: slope,
            upper: slope,
        }
    }
    fn local_model(&self, v: &SVector<f64, 1>) -> LocalModel<1> {
        LocalModel {
            gradient: v * -self.0,
            hessian: SMatrix::from([[-self.0]]),
            smooth: [true],
        }
    }
    fn minimize(&self, block: &SMatrix<f64, 1, 1>, force: &SVector<f64, 1>) -> SVector<f64, 1> {
        force / (block[(0, 0)] - self.0)
    }
}

/// The message a caller can act on: where, and in which iteration.
#[test]
fn a_slope_steeper_than_the_body_is_reported() -> Fallible {
    let problem = antiplane(2, Regime::Slip, 1)?;
    let size = problem.vertices.len();
    let minimize = |slope: &dyn Fn(usize) -> f64| -> Result<_, SolveError> {
        let potentials: Vec<_> = (0..size).map(|k| Weakening(slope(k))).collect();
        let energy = Energy {
            operator: &problem.operator,
            load: &problem.load,
            potentials: &potentials,
            vertices: &problem.vertices,
            fixed: &problem.fixed,
        };
        let mut solver = Condensed::new();
        solver.prepare(&energy)?;
        let mut v = problem.at_rest();
        solver.minimize(&energy, &problem.stopping(1e-10 * problem.size()), &mut v)
    };
    let vertex = 9;
    assert_eq!(
        minimize(&|k| if k == vertex { 1e12 } else { 0.0 }),
        Err(SolveError::NotConvex {
            vertex: problem.vertices[vertex],
            iteration: 1
        })
    );
    // A slope that the body can carry does no harm.
    minimize(&|_| 1.0)?;
    Ok(())
}

#[test]
fn wrong_input_is_an_error() -> Fallible {
    let answer = |spoil: &dyn Fn(&mut Problem<2>)| -> Result<_, Box<dyn std::error::Error>> {
        let mut problem = slider(1, Regime::Mixed, 1)?;
        let mut v = problem.at_rest();
        spoil(&mut problem);
        let before = v.clone();
        let result = problem.solve(&mut Condensed::new(), 1e-9, &mut v);
        if result.is_err() {
            assert_eq!(v, before);
        }
        Ok(result)
    };
    let size = slider(1, Regime::Mixed, 1)?.load.len();
    let mismatch = |expected, found| Err(SolveError::SizeMismatch { expected, found });
    assert_eq!(
        answer(&|p| p.load.truncate(size - 1))?,
        mismatch(size, size - 1)
    );
    assert_eq!(
        answer(&|p| p.fixed.push([false; 2]))?,
        mismatch(size, size + 1)
    );
    assert_eq!(answer(&|p| p.potentials.truncate(3))?, mismatch(11, 3));
    let unsorted = answer(&|p| p.vertices.swap(3, 4))?;
    assert!(matches!(
        unsorted,
        Err(SolveError::UnsortedVertices { position: 4, .. })
    ));
    for value in [f64::NAN, f64::INFINITY] {
        for vertex in [0, 1, 2, 7, 30] {
            let spoiled = answer(&|p| p.load[vertex] = SVector::from([value; 2]))?;
            assert!(
                matches!(spoiled, Err(SolveError::NotFinite { iteration: 1, .. })),
                "{spoiled:?}"
            );
        }
    }
    assert!(answer(&|p| p.operator.data_mut()[17].fill(f64::NAN))?.is_err());
    let negative = answer(&|p| {
        let place = p.operator.iter().position(|(_, (i, j))| (i, j) == (7, 7));
        p.operator.data_mut()[place.expect("stored")] = -SMatrix::identity();
    })?;
    assert_eq!(negative, Err(SolveError::IndefiniteBlock { vertex: 7 }));
    let indefinite = answer(&|p| {
        let places: Vec<_> = p.operator.iter().map(|(_, (i, j))| i != j).collect();
        for (block, _) in p
            .operator
            .data_mut()
            .iter_mut()
            .zip(places)
            .filter(|(_, off)| *off)
        {
            *block *= -20.0;
        }
    })?;
    assert!(
        matches!(
            indefinite,
            Err(SolveError::IndefiniteMatrix {
                what: "operator",
                ..
            })
        ),
        "{indefinite:?}"
    );
    Ok(())
}

/// After a failed preparation the solver refuses to go on with what it had before.
#[test]
fn a_failed_preparation_leaves_nothing_to_solve_with() -> Fallible {
    let problem = slider(1, Regime::Mixed, 1)?;
    let mut broken = slider(1, Regime::Mixed, 1)?;
    broken.operator.data_mut().fill(SMatrix::zeros());
    let mut solver = Condensed::new();
    solver.prepare(&problem.energy())?;
    assert!(solver.prepare(&broken.energy()).is_err());
    let mut v = problem.at_rest();
    let stopping = problem.stopping(1e-9);
    assert!(
        solver
            .minimize(&problem.energy(), &stopping, &mut v)
            .is_err()
    );
    solver.prepare(&problem.energy())?;
    solver.minimize(&problem.energy(), &stopping, &mut v)?;
    assert_eq!(solver.counters().factorizations, 1);
    Ok(())
}

#[test]
fn too_few_iterations() -> Fallible {
    gives_up(&slider(2, Regime::Slip, 1)?, &mut Condensed::new(), 1e-13)
}

#[test]
fn messages_carry_their_numbers() {
    let text = SolveError::MemoryLimit {
        unknowns: 7,
        needed: 99,
        allowed: 42,
    }
    .to_string();
    assert!(
        ["7", "99", "42"].iter().all(|part| text.contains(part)),
        "{text}"
    );
    let text = SolveError::NotConvex {
        vertex: 3,
        iteration: 2,
    }
    .to_string();
    assert!(["3", "2"].iter().all(|part| text.contains(part)), "{text}");
}
