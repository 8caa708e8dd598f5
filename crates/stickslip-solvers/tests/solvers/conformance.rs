//! Every solver of this crate obeys the contract, and solvers that break it are told how.

use nalgebra::SVector;
use stickslip_solvers::{
    BlockGaussSeidel, BlockMatrix, Condensed, Energy, LinearStep, NonsmoothSolver, SampleFriction,
    SolveError, SolveReport, SolverViolation, Stopping, Tnnmg, check_nonsmooth_solver,
};

#[test]
fn condensation_obeys() -> Result<(), SolverViolation> {
    check_nonsmooth_solver::<1, _>(|_| Condensed::new())?;
    check_nonsmooth_solver::<2, _>(|_| Condensed::new())?;
    check_nonsmooth_solver::<3, _>(|_| Condensed::new())
}

fn sweeps_obey<const C: usize>() -> Result<(), SolverViolation> {
    check_nonsmooth_solver::<C, _>(|_| BlockGaussSeidel::new())?;
    check_nonsmooth_solver::<C, _>(|transfers| Tnnmg::new(transfers))?;
    check_nonsmooth_solver::<C, _>(|transfers| {
        let solver = Tnnmg::new(transfers).with_linear_step(LinearStep::Cycle);
        Box::new(solver) as Box<dyn NonsmoothSolver<BlockMatrix<C>, C>>
    })
}

#[test]
fn solvers_that_sweep_obey() -> Result<(), SolverViolation> {
    sweeps_obey::<1>()?;
    sweeps_obey::<2>()?;
    sweeps_obey::<3>()
}

/// The defect added to a good solver.
#[derive(Clone, Copy, PartialEq)]
enum Fault {
    Nothing,
    StopsEarly,
    Climbs,
    MovesFixed,
    Remembers,
    CutsFields,
    SwallowsNan,
    CountsNothing,
    GivesUp,
}

/// A good solver with one fault.
struct Spoiled {
    fault: Fault,
    good: Condensed<2>,
    last: Option<Vec<SVector<f64, 2>>>,
}

impl NonsmoothSolver<BlockMatrix<2>, 2> for Spoiled {
    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<2>, 2>) -> Result<(), SolveError> {
        self.last = None;
        match self.good.prepare(energy) {
            Err(SolveError::SizeMismatch { .. }) if self.fault == Fault::CutsFields => Ok(()),
            result => result,
        }
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<2>, 2>,
        stopping: &Stopping<'_, BlockMatrix<2>>,
        v: &mut [SVector<f64, 2>],
    ) -> Result<SolveReport, SolveError> {
        let one = SolveReport {
            iterations: 1,
            ..SolveReport::default()
        };
        let result = self.good.minimize(energy, stopping, v);
        match (self.fault, &result) {
            (Fault::GivesUp, _) => Err(SolveError::NotConverged {
                iterations: 1,
                change: 1.0,
                tolerance: stopping.tolerance,
            }),
            (Fault::SwallowsNan, Err(SolveError::NotFinite { .. }))
            | (Fault::CutsFields, Err(SolveError::SizeMismatch { .. })) => Ok(one),
            (Fault::CountsNothing, Ok(_)) => Ok(SolveReport::default()),
            (Fault::StopsEarly, Ok(_)) => {
                v[20][0] += 1e-9;
                result
            }
            (Fault::Climbs, Ok(_)) => {
                v[20][0] += 10.0;
                result
            }
            (Fault::MovesFixed, Ok(_)) => {
                v[40][1] *= 1.0 + 1e-15;
                result
            }
            (Fault::Remembers, Ok(_)) => {
                // Right the first time; then drawn to where it was before.
                if let Some(last) = &self.last {
                    v[20][0] += 1e-9 * (1.0 + last[20][0]);
                }
                self.last = Some(v.to_vec());
                result
            }
            _ => result,
        }
    }
}

fn verdict(fault: Fault) -> Result<(), SolverViolation> {
    check_nonsmooth_solver::<2, _>(|_| Spoiled {
        fault,
        good: Condensed::new(),
        last: None,
    })
}

#[test]
fn broken_solvers_are_told_how() {
    use SolverViolation as V;
    let friction = SampleFriction::Tresca;
    assert_eq!(verdict(Fault::Nothing), Ok(()));
    let early = verdict(Fault::StopsEarly);
    assert!(
        matches!(early, Err(V::Differs { from: "the minimiser", distance, tolerance, .. }) if distance > tolerance),
        "{early:?}"
    );
    let climbs = verdict(Fault::Climbs);
    assert!(
        matches!(climbs, Err(V::Value { what: "energy of the result", found, bound, .. }) if found > bound),
        "{climbs:?}"
    );
    let moved = verdict(Fault::MovesFixed);
    assert!(
        matches!(
            moved,
            Err(V::FixedMoved {
                vertex: 40,
                component: 1,
                ..
            })
        ),
        "{moved:?}"
    );
    let remembers = verdict(Fault::Remembers);
    assert!(
        matches!(
            remembers,
            Err(V::Differs {
                from: "the result from another start",
                ..
            })
        ),
        "{remembers:?}"
    );
    let cuts = verdict(Fault::CutsFields);
    assert!(
        matches!(
            cuts,
            Err(V::LengthAccepted {
                field: "load",
                expected: 45,
                found: 44
            })
        ),
        "{cuts:?}"
    );
    assert_eq!(
        verdict(Fault::SwallowsNan),
        Err(V::NotANumberAccepted { vertex: 0 })
    );
    assert_eq!(
        verdict(Fault::CountsNothing),
        Err(V::Value {
            friction,
            what: "number of iterations reported",
            found: 0.0,
            requirement: "at least",
            bound: 1.0
        })
    );
    let gives_up = verdict(Fault::GivesUp);
    assert!(matches!(gives_up, Err(V::Failed { .. })), "{gives_up:?}");
}
