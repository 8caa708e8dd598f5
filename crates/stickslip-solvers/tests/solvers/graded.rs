//! On graded meshes multigrid converges as on uniform ones, however deep they are refined.

use crate::common::{Fallible, Problem, REGIMES, Regime, block_on, slider_on};
use stickslip_fem::{FemError, P1};
use stickslip_solvers::Tnnmg;

/// The most cycles that reduce an error by ten orders of magnitude in any regime.
fn most_cycles<const C: usize>(
    problem: impl Fn(Regime) -> Result<Problem<C>, FemError>,
) -> Result<usize, Box<dyn std::error::Error>> {
    let mut most = 0;
    for regime in REGIMES {
        let problem = problem(regime)?;
        let mut solver = Tnnmg::new(&problem.transfers);
        let mut v = problem.nearby(1e-4, 3);
        let goal = 1e-10 * problem.error(&v);
        let report = problem.solve(&mut solver, goal, &mut v)?;
        assert!(problem.error(&v) <= goal, "{regime:?}");
        most = most.max(report.cycles);
    }
    Ok(most)
}

/// Half as many cycles again as on a uniform mesh may be the price of cells of all sizes; it must not grow with them.
const PRICE: f64 = 1.5;

#[test]
fn cycles_on_graded_strips_are_those_on_uniform_ones() -> Fallible {
    let strip = || P1::grid([5.0, 1.0], [5, 1]);
    let uniform = most_cycles(|regime| slider_on(&strip()?.refined(6)?, regime, 2))?;
    for least in [0.1, 0.01] {
        let contact = strip()?.graded(|x| least + x[1])?;
        let middle = strip()?.refined(3)?;
        let point = middle.graded(|x| least + (x[0] - 2.5).hypot(x[1]))?;
        for space in [contact, point] {
            let cycles = most_cycles(|regime| slider_on(&space, regime, 2))?;
            println!(
                "{} vertices, {cycles} cycles, {uniform} uniform",
                space.vertex_count()
            );
            assert!(
                cycles as f64 <= PRICE * uniform as f64,
                "{least}: {cycles} for {uniform}"
            );
        }
    }
    Ok(())
}

#[test]
fn cycles_on_graded_blocks_are_those_on_uniform_ones() -> Fallible {
    let block = || P1::grid([2.0, 1.0, 1.0], [2, 1, 1]);
    let uniform = most_cycles(|regime| block_on(&block()?.refined(3)?, regime, 2))?;
    let contact = block()?.graded(|x| 0.06 + x[2])?;
    let points = [0.1, 0.01].map(|least| block()?.graded(|x| least + x.norm()));
    for space in [Ok(contact)].into_iter().chain(points) {
        let space = space?;
        let cycles = most_cycles(|regime| block_on(&space, regime, 2))?;
        println!(
            "{} vertices, {cycles} cycles, {uniform} uniform",
            space.vertex_count()
        );
        assert!(
            cycles as f64 <= PRICE * uniform as f64,
            "{cycles} for {uniform}"
        );
    }
    Ok(())
}
