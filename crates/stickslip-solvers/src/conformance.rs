//! The contract of a nonsmooth solver as a check of any implementation.

mod family;
mod sample;
mod violation;

pub use family::SampleFriction;
pub use violation::SolverViolation;

use nalgebra::SVector;

use crate::{
    BlockMatrix, Energy, NonsmoothSolver, Prolongation, SolveError, SolveReport, Stopping,
};

use family::{Sample, transfers};

/// The number of tolerances between a result and the minimiser that is accepted: errors are estimated.
const MARGIN: f64 = 3.0;

/// The accuracy of a measured change, relative: couplings then decide as by the whole field.
const MEASURED: f64 = 1e-6;

/// The rounding error of an energy, relative to it.
const ROUNDING: f64 = 1e-13;

/// Checks a solver against the contract of [`NonsmoothSolver`], on grids of 45 vertices with `C` components and known
/// minimisers.
///
/// `build` makes the solver, given the transfers between three nested grids, coarsest first. It makes one solver for
/// each of Tresca's friction, Dieterich and Ruina's and kinks away from rest. Each solver then gets several operators,
/// starts from rest and from afar, a call with too few iterations, fields of wrong lengths and loads that are not
/// numbers.
///
/// ```
/// # #[cfg(feature = "condensed")] {
/// use stickslip_solvers::{Condensed, check_nonsmooth_solver};
///
/// check_nonsmooth_solver::<2, _>(|_transfers| Condensed::new())?;
/// # }
/// # Ok::<(), stickslip_solvers::SolverViolation>(())
/// ```
///
/// # Errors
/// The first [`SolverViolation`] found.
pub fn check_nonsmooth_solver<const C: usize, S>(
    mut build: impl FnMut(&[Prolongation]) -> S,
) -> Result<(), SolverViolation>
where
    S: NonsmoothSolver<BlockMatrix<C>, C>,
{
    let transfers = transfers();
    for friction in [
        SampleFriction::Tresca,
        SampleFriction::DieterichRuina,
        SampleFriction::Kinked,
    ] {
        let mut solver = build(&transfers);
        for (mass, seed) in [(1e4, 1), (1e6, 2)] {
            let sample = Sample::<C>::new(friction, mass, seed);
            let check = Check { friction, sample };
            check.prepared(&mut solver)?;
            check.two_starts(&mut solver)?;
            check.in_parts(&mut solver)?;
            check.not_a_number(&mut solver)?;
            check.interrupted(&mut solver)?;
        }
        lengths(friction, || build(&transfers))?;
    }
    Ok(())
}

/// One problem and its name.
struct Check<const C: usize> {
    friction: SampleFriction,
    sample: Sample<C>,
}

impl<const C: usize> Check<C> {
    fn failed(&self, error: SolveError) -> SolverViolation {
        SolverViolation::Failed {
            friction: self.friction,
            error,
        }
    }

    fn prepared<S>(&self, solver: &mut S) -> Result<(), SolverViolation>
    where
        S: NonsmoothSolver<BlockMatrix<C>, C>,
    {
        (solver.prepare(&self.sample.energy())).map_err(|error| self.failed(error))
    }

    /// Calls the solver, and checks the properties of converged and interrupted results alike.
    fn call<S>(
        &self,
        solver: &mut S,
        stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<Result<SolveReport, SolveError>, SolverViolation>
    where
        S: NonsmoothSolver<BlockMatrix<C>, C>,
    {
        let energy = self.sample.energy();
        let (start, before) = (v.to_vec(), energy.value(v));
        let result = solver.minimize(&energy, stopping, v);
        for (vertex, fixed) in self.sample.fixed.iter().enumerate() {
            for component in (0..C).filter(|&c| fixed[c]) {
                let (before, after) = (start[vertex][component], v[vertex][component]);
                if before != after {
                    return Err(SolverViolation::FixedMoved {
                        vertex,
                        component,
                        before,
                        after,
                    });
                }
            }
        }
        let after = energy.value(v);
        let rise = after - before;
        if rise.is_nan() || rise > ROUNDING * (before.abs() + after.abs()) {
            return Err(SolverViolation::Value {
                friction: self.friction,
                what: "energy of the result",
                found: after,
                requirement: "at most",
                bound: before,
            });
        }
        Ok(result)
    }

    /// Solves from `v`, and compares with the known minimiser.
    fn solved<S>(&self, solver: &mut S, v: &mut [SVector<f64, C>]) -> Result<(), SolverViolation>
    where
        S: NonsmoothSolver<BlockMatrix<C>, C>,
    {
        let stopping = self.sample.stopping();
        let result = self.call(solver, &stopping, v)?;
        let report = result.map_err(|error| self.failed(error))?;
        let distance = self.sample.distance(v, &self.sample.exact);
        if distance.is_nan() || distance > MARGIN * stopping.tolerance {
            return Err(SolverViolation::Differs {
                friction: self.friction,
                from: "the minimiser",
                distance,
                tolerance: stopping.tolerance,
            });
        }
        if report.iterations == 0 {
            return Err(SolverViolation::Value {
                friction: self.friction,
                what: "number of iterations reported",
                found: 0.0,
                requirement: "at least",
                bound: 1.0,
            });
        }
        Ok(())
    }

    fn two_starts<S>(&self, solver: &mut S) -> Result<(), SolverViolation>
    where
        S: NonsmoothSolver<BlockMatrix<C>, C>,
    {
        let (mut first, mut second) = (self.sample.start(0.0, 0), self.sample.start(1.0, 3));
        self.solved(solver, &mut first)?;
        let stopping = self.sample.stopping();
        let result = self.call(solver, &stopping, &mut second)?;
        result.map_err(|error| self.failed(error))?;
        let distance = self.sample.distance(&first, &second);
        if distance.is_nan() || distance > 2.0 * MARGIN * stopping.tolerance {
            return Err(SolverViolation::Differs {
                friction: self.friction,
                from: "the result from another start",
                distance,
                tolerance: stopping.tolerance,
            });
        }
        Ok(())
    }

    /// Condenses the load first, minimises after another load and extends to the body: the minimiser is the same, and
    /// so is the norm of the distance from another start.
    fn in_parts<S>(&self, solver: &mut S) -> Result<(), SolverViolation>
    where
        S: NonsmoothSolver<BlockMatrix<C>, C>,
    {
        let (energy, stopping) = (self.sample.energy(), self.sample.stopping());
        let mut at_once = self.sample.start(1.0, 3);
        (solver.minimize(&energy, &stopping, &mut at_once)).map_err(|error| self.failed(error))?;
        let Some(parts) = solver.frictional() else {
            return Ok(());
        };
        let mut v = self.sample.start(1.0, 3);
        let mut start = v.clone();
        let load: Vec<_> = energy.load.iter().map(|load| load * 2.0).collect();
        let other = Energy {
            load: &load,
            ..energy
        };
        let mut change = vec![SVector::zeros(); v.len()];
        let mut solved = || {
            parts.condense(&other, &v)?;
            parts.condense(&energy, &v)?;
            parts.minimize_condensed(&energy, &stopping, &mut v)?;
            for &vertex in energy.vertices {
                change[vertex] = v[vertex] - start[vertex];
            }
            parts.extend(&mut v)?;
            parts.extend(&mut start)?;
            let extended = parts.change_norm(&energy, stopping.norm, &change)?;
            parts.measure(&energy, stopping.norm);
            let measured = parts.change_norm(&energy, stopping.norm, &change)?;
            Ok([extended, measured])
        };
        let measured: [f64; 2] = solved().map_err(|error| self.failed(error))?;
        let distance = self.sample.distance(&v, &at_once);
        if distance.is_nan() || distance > 2.0 * MARGIN * stopping.tolerance {
            return Err(SolverViolation::Differs {
                friction: self.friction,
                from: "the result at once",
                distance,
                tolerance: stopping.tolerance,
            });
        }
        let expected = self.sample.distance(&v, &start);
        for found in measured {
            let off = (found - expected).abs();
            if off.is_nan() || off > MEASURED * expected {
                return Err(SolverViolation::Value {
                    friction: self.friction,
                    what: "measured norm of a change",
                    found,
                    requirement: "equal to",
                    bound: expected,
                });
            }
        }
        Ok(())
    }

    /// Loads that are not numbers, at frictional, inner and driven vertices; then a good one again.
    fn not_a_number<S>(&self, solver: &mut S) -> Result<(), SolverViolation>
    where
        S: NonsmoothSolver<BlockMatrix<C>, C>,
    {
        let sample = &self.sample;
        for vertex in [0, sample.load.len() / 2] {
            let mut load = sample.load.clone();
            load[vertex].fill(f64::NAN);
            let energy = Energy {
                load: &load,
                ..sample.energy()
            };
            let mut v = sample.start(0.0, 0);
            if solver.minimize(&energy, &sample.stopping(), &mut v).is_ok() {
                return Err(SolverViolation::NotANumberAccepted { vertex });
            }
        }
        self.solved(solver, &mut sample.start(0.0, 0))
    }

    /// One iteration only, to a tolerance out of reach: the energy must not rise.
    fn interrupted<S>(&self, solver: &mut S) -> Result<(), SolverViolation>
    where
        S: NonsmoothSolver<BlockMatrix<C>, C>,
    {
        let stopping = Stopping {
            max_iterations: 1,
            tolerance: f64::MIN_POSITIVE,
            relative: 0.0,
            ..self.sample.stopping()
        };
        for size in [1e-3, 1.0] {
            let mut v = self.sample.start(size, 5);
            for _ in 0..5 {
                match self.call(solver, &stopping, &mut v)? {
                    Ok(_) | Err(SolveError::NotConverged { .. }) => {}
                    Err(error) => return Err(self.failed(error)),
                }
            }
        }
        Ok(())
    }
}

/// Fields that are one entry too short must be refused by a preparation, or by a minimisation.
fn lengths<const C: usize, S>(
    friction: SampleFriction,
    mut build: impl FnMut() -> S,
) -> Result<(), SolverViolation>
where
    S: NonsmoothSolver<BlockMatrix<C>, C>,
{
    let sample = Sample::<C>::new(friction, 1e4, 1);
    let (size, frictional) = (sample.load.len(), sample.vertices.len());
    let (good, fewer) = (sample.energy(), &sample.potentials[1..]);
    for (field, expected, energy, start) in [
        (
            "load",
            size,
            Energy {
                load: &sample.load[1..],
                ..good
            },
            size,
        ),
        (
            "fixed",
            size,
            Energy {
                fixed: &sample.fixed[1..],
                ..sample.energy()
            },
            size,
        ),
        (
            "potentials",
            frictional,
            Energy {
                potentials: &fewer,
                ..sample.energy()
            },
            size,
        ),
        ("start", size, sample.energy(), size - 1),
    ] {
        let mut solver = build();
        let mut v = sample.start(0.0, 0);
        let refused = (solver.prepare(&energy))
            .and_then(|()| solver.minimize(&energy, &sample.stopping(), &mut v[..start]))
            .is_err();
        if !refused {
            return Err(SolverViolation::LengthAccepted {
                field,
                expected,
                found: expected - 1,
            });
        }
    }
    Ok(())
}
