//! Experiment.

use crate::common::{Fallible, Problem, REGIMES, block_on, slider_on};
use stickslip_fem::P1;
use stickslip_tnnmg::Tnnmg;

fn cycles<const C: usize>(problem: &Problem<C>) -> Result<usize, Box<dyn std::error::Error>> {
    let mut solver = Tnnmg::new(&problem.transfers);
    let mut v = problem.nearby(1e-4, 3);
    let goal = 1e-10 * problem.error(&v);
    let report = problem.solve(&mut solver, goal, &mut v)?;
    assert!(problem.error(&v) <= goal);
    Ok(report.cycles)
}

fn show<const D: usize>(space: &P1<D>) -> String {
    let counts: Vec<usize> = (0..space.hierarchy().level_count())
        .filter_map(|l| space.hierarchy().mesh(l))
        .map(|m| m.vertex_count())
        .collect();
    let sum: usize = counts.iter().sum();
    format!(
        "{counts:?} sum {:.2}",
        sum as f64 / counts[counts.len() - 1] as f64
    )
}

#[test]
fn experiment() -> Fallible {
    for level in 2..=7 {
        let space = P1::grid([5.0, 1.0], [5, 1])?.refined(level)?;
        let all: Result<Vec<_>, _> = REGIMES
            .iter()
            .map(|&r| cycles(&slider_on(&space, r, 2)?))
            .collect();
        println!("uniform {level}: {:?}", all?);
    }
    for least in [0.03, 0.01, 0.003, 0.001] {
        let start = std::time::Instant::now();
        let space = P1::grid([5.0, 1.0], [5, 1])?.graded(|x| least + 0.3 * x[1])?;
        println!(
            "contact {least}: {} in {:.2}",
            show(&space),
            start.elapsed().as_secs_f64()
        );
        let all: Result<Vec<_>, _> = REGIMES
            .iter()
            .map(|&r| cycles(&slider_on(&space, r, 2)?))
            .collect();
        println!("   {:?}", all?);
    }
    for least in [0.01, 0.001, 0.0001] {
        for refined in [0, 4] {
            let space = P1::grid([5.0, 1.0], [5, 1])?
                .refined(refined)?
                .graded(|x| least + 0.3 * (x[1].powi(2) + (x[0] - 2.5).powi(2)).sqrt())?;
            println!("tip {least} {refined}: {}", show(&space));
            let all: Result<Vec<_>, _> = REGIMES
                .iter()
                .map(|&r| cycles(&slider_on(&space, r, 2)?))
                .collect();
            println!("   {:?}", all?);
        }
    }
    for level in 1..=4 {
        let space = P1::grid([2.0, 1.0, 1.0], [2, 1, 1])?.refined(level)?;
        let all: Result<Vec<_>, _> = REGIMES
            .iter()
            .map(|&r| cycles(&block_on(&space, r, 2)?))
            .collect();
        println!("uniform {level}: {:?}", all?);
    }
    for (least, slope) in [(0.2, 0.7), (0.1, 0.7), (0.05, 0.7), (0.03, 1.0)] {
        let start = std::time::Instant::now();
        let space = P1::grid([2.0, 1.0, 1.0], [2, 1, 1])?.graded(|x| least + slope * x[2])?;
        println!(
            "contact {least}: {} in {:.2}",
            show(&space),
            start.elapsed().as_secs_f64()
        );
        let all: Result<Vec<_>, _> = REGIMES
            .iter()
            .map(|&r| cycles(&block_on(&space, r, 2)?))
            .collect();
        println!("   {:?}", all?);
    }
    for least in [0.1, 0.01, 0.001] {
        let space = P1::grid([2.0, 1.0, 1.0], [2, 1, 1])?.graded(|x| least + 0.7 * x.norm())?;
        println!("corner {least}: {}", show(&space));
        let all: Result<Vec<_>, _> = REGIMES
            .iter()
            .map(|&r| cycles(&block_on(&space, r, 2)?))
            .collect();
        println!("   {:?}", all?);
    }
    Ok(())
}
