//! The rule of the fixed point, on maps whose multiplier is known.

use std::error::Error;

use stickslip_solvers::SolveError;

use super::sealed::Sealed;
use super::{Coupling, CouplingReport, FixedPoint, StepMaps};
use crate::StepError;

type Outcome = Result<(), Box<dyn Error>>;

/// One state, one rate: `S(v) = multiplier v` and `R(alpha) = alpha`, with the fixed point 0.
///
/// Solving exactly, the error of the state is multiplied by `1 - omega (1 - multiplier)` in an
/// iteration with the relaxation `omega`.
struct Line {
    multiplier: f64,
    velocity: f64,
    state: f64,
    proposed: f64,
    relaxations: Vec<f64>,
    asked: Vec<f64>,
    leads: Vec<f64>,
    changes: Vec<f64>,
    /// The velocity problem that fails.
    fails_at: usize,
    memory: [f64; 4],
}

impl Line {
    /// Starts from velocity 1 and the state that belongs to it.
    fn new(multiplier: f64) -> Self {
        Self {
            multiplier,
            velocity: 1.0,
            state: 1.0,
            proposed: f64::NAN,
            relaxations: Vec::new(),
            asked: Vec::new(),
            leads: Vec::new(),
            changes: Vec::new(),
            fails_at: usize::MAX,
            memory: [0.0; 4],
        }
    }

    /// Couples to a tolerance with the default rule.
    fn coupled(&mut self, tolerance: f64) -> Result<CouplingReport, StepError> {
        FixedPoint::default().couple(self, tolerance)
    }
}

impl Sealed for Line {}

impl StepMaps for Line {
    fn propose_states(&mut self) -> Result<f64, StepError> {
        self.proposed = self.multiplier * self.velocity;
        Ok((self.proposed - self.state).abs())
    }

    fn relax_states(&mut self, relaxation: f64) {
        self.relaxations.push(relaxation);
        self.state += relaxation * (self.proposed - self.state);
    }

    /// No rule of these tests asks for it.
    fn secant_factor(&self) -> f64 {
        f64::NAN
    }

    /// Exact, wherever it starts.
    fn solve_rates(&mut self, lead: f64, tolerance: f64) -> Result<f64, StepError> {
        self.leads.push(lead);
        self.asked.push(tolerance);
        if self.asked.len() == self.fails_at {
            return Err(StepError::StepSize { dt: -7.0 });
        }
        let change = (self.state - self.velocity).abs();
        self.velocity = self.state;
        self.changes.push(change);
        Ok(change)
    }

    fn solve_once(&mut self, tolerance: f64) -> Result<(), StepError> {
        self.solve_rates(0.0, tolerance).map(|_| ())
    }

    fn rate_rounding(&mut self) -> Result<f64, StepError> {
        Ok(1e-12 * self.velocity.abs())
    }

    /// There is no step before.
    fn extrapolate_rates(&mut self) {}

    /// The fixed point of `v = multiplier v` is zero; nothing solves a multiplier of one.
    fn solve_coupled(&mut self, _: f64) -> Result<(), StepError> {
        if self.multiplier >= 1.0 {
            return Err(StepError::Solver(SolveError::IndefiniteBlock { vertex: 0 }));
        }
        self.velocity = 0.0;
        Ok(())
    }

    fn memory(&mut self) -> &mut [f64; 4] {
        &mut self.memory
    }
}

/// Whether the numbers are those expected, to rounding.
fn same(numbers: &[f64], expected: &[f64]) -> bool {
    numbers.len() == expected.len()
        && numbers
            .iter()
            .zip(expected)
            .all(|(a, b)| (a - b).abs() < 1e-14)
}

/// Up to a multiplier of one half every step is a full one: after `k` solves the velocity is the
/// `k`-th power, and the changes are `m^(k-1) (1 - m)`.
#[test]
fn fast_contractions_are_not_relaxed() -> Outcome {
    for (multiplier, tolerance) in [(0.5, 1e-10), (0.4, 1e-3), (0.1, 1e-10), (-0.3, 1e-8)] {
        let mut line = Line::new(multiplier);
        let report = line.coupled(tolerance)?;
        let change = |k: usize| multiplier.abs().powi(k as i32 - 1) * (1.0 - multiplier);
        let count = (2..).find(|&k| change(k) <= tolerance).unwrap_or(0);
        assert_eq!(report.iterations, count, "multiplier {multiplier}");
        assert_eq!(line.changes.len(), count);
        assert!(line.relaxations.iter().all(|&relaxation| relaxation == 1.0));
        let last = line.changes.last().ok_or("no change")?;
        assert!((last / change(count) - 1.0).abs() < 1e-6);
        // The state of the final velocity is in use.
        assert!((line.state / (multiplier * line.velocity) - 1.0).abs() < 1e-12);
    }
    Ok(())
}

/// A slip rate that grows by a thousand in each iteration is no fixed point, however far below the tolerance it is, and
/// however roughly the first problems are solved.
#[test]
fn growth_below_the_tolerance_is_not_accepted() {
    for last_second_change in [0.0, 1e3] {
        let mut line = Line::new(1e3);
        (line.velocity, line.state) = (1e-30, 1e-30);
        line.memory[0] = last_second_change;
        let coupling = FixedPoint::default().with_max_iterations(6);
        let refused = coupling.couple(&mut line, 1e-10);
        assert!(
            matches!(refused, Err(StepError::NotCoupled { change, .. }) if change < 1e-10),
            "{refused:?}"
        );
    }
}

/// Above one half, the third state and all later ones are relaxed: the factor becomes
/// `(1 + m)/2`, itself above one half, so that the rule never lets go.
#[test]
fn slow_contractions_stay_relaxed() -> Outcome {
    let (multiplier, tolerance) = (0.8_f64, 1e-9);
    let mut line = Line::new(multiplier);
    let report = line.coupled(tolerance)?;
    let factor = 0.5 * (1.0 + multiplier);
    let change = |k: usize| match k {
        1 => 1.0 - multiplier,
        2 => multiplier * (1.0 - multiplier),
        _ => multiplier.powi(2) * factor.powi(k as i32 - 3) * 0.5 * (1.0 - multiplier),
    };
    let count = (2..).find(|&k| change(k) <= tolerance).unwrap_or(0);
    assert_eq!(report.iterations, count);
    let changes: Vec<f64> = (1..=count).map(change).collect();
    assert!(same(&line.changes, &changes));
    let mut relaxations = vec![0.5; count];
    relaxations[..2].fill(1.0);
    relaxations.push(1.0);
    assert_eq!(line.relaxations, relaxations);
    assert_eq!(line.state, multiplier * line.velocity);
    Ok(())
}

/// With -0.8 half a step contracts by a tenth, which releases the rule for one full step, which
/// contracts by -0.8, which triggers it again.
#[test]
fn the_rule_lets_go_where_half_a_step_contracts() -> Outcome {
    let mut line = Line::new(-0.8);
    let report = line.coupled(1e-6)?;
    let relaxations: Vec<f64> = (1..=report.iterations)
        .map(|k| if k > 2 && k % 2 == 1 { 0.5 } else { 1.0 })
        .chain([1.0])
        .collect();
    assert_eq!(line.relaxations, relaxations);
    let mut expected = vec![1.8];
    let mut velocity = -0.8;
    for k in 2..=report.iterations {
        let next = if k > 2 && k % 2 == 1 { 0.1 } else { -0.8 } * velocity;
        expected.push(f64::abs(next - velocity));
        velocity = next;
    }
    assert!(same(&line.changes, &expected));
    let (last, before) = (expected.pop(), expected.pop());
    assert!(last <= Some(1e-6) && before > Some(1e-6));
    Ok(())
}

/// A state that is right from the start shows no change at all, and is still solved twice.
#[test]
fn the_first_difference_is_never_accepted() -> Outcome {
    let mut line = Line::new(0.0);
    line.velocity = 0.0;
    line.state = 0.0;
    assert_eq!(
        line.coupled(1e-10)?,
        CouplingReport {
            iterations: 2,
            ..CouplingReport::default()
        }
    );
    assert_eq!(line.changes, [0.0, 0.0]);
    Ok(())
}

/// The last velocity problem is solved to a twentieth of the tolerance, the ones before to no more
/// than 0.3 % of the change last seen.
#[test]
fn the_solver_is_asked_for_what_the_rule_can_see() -> Outcome {
    let finest = 0.05_f64 * 1e-10;
    let mut line = Line::new(0.3);
    line.coupled(1e-10)?;
    assert!(line.asked.len() > 10);
    for (asked, change) in line.asked[1..].iter().zip(&line.changes) {
        assert!((finest..=finest.max(3e-3 * change)).contains(asked));
    }
    assert_eq!(line.asked.last(), Some(&finest));
    Ok(())
}

/// From the third velocity problem on, the start follows the geometric series of the changes.
#[test]
fn the_start_is_led_by_the_ratio_of_the_changes() -> Outcome {
    let multiplier = 0.4;
    let mut line = Line::new(multiplier);
    line.coupled(1e-8)?;
    assert!(line.leads.len() > 10 && line.leads[..2] == [0.0, 0.0]);
    assert!(
        line.leads[2..]
            .iter()
            .all(|lead| (lead - multiplier).abs() < 1e-6)
    );
    Ok(())
}

/// The change of the second velocity problem, which tells the next step how well to solve the first ones.
#[test]
fn the_second_change_is_remembered_by_accepted_steps_only() -> Outcome {
    let mut line = Line::new(0.3);
    line.memory[0] = 7.0;
    line.fails_at = 3;
    assert!(line.coupled(1e-10).is_err());
    assert_eq!(line.memory, [7.0, 0.0, 0.0, 0.0]);
    let mut line = Line::new(0.3);
    line.memory[0] = 7.0;
    line.coupled(1e-10)?;
    assert_eq!(line.asked[..2], [3e-3 * 7.0; 2]);
    assert_eq!(line.memory, [line.changes[1], 0.0, 0.0, 0.0]);
    Ok(())
}

/// With -3 half a step is a reflection: a cycle of two states, which the rule cannot leave.
#[test]
fn a_cycle_of_two_is_reported() -> Outcome {
    let mut line = Line::new(-3.0);
    let failure = line.coupled(1e-10).err().ok_or("coupled")?;
    let StepError::NotCoupled {
        iterations,
        change,
        tolerance,
    } = failure
    else {
        return Err("another failure".into());
    };
    assert_eq!((iterations, tolerance), (200, 1e-10));
    assert_eq!(
        (line.changes.len(), Some(&change)),
        (200, line.changes.last())
    );
    assert!(change > 1.0);
    Ok(())
}

#[test]
fn a_failing_velocity_problem_ends_the_coupling() {
    let mut line = Line::new(0.3);
    line.fails_at = 3;
    assert_eq!(line.coupled(1e-10), Err(StepError::StepSize { dt: -7.0 }));
    assert_eq!(line.changes.len(), 2);
}
