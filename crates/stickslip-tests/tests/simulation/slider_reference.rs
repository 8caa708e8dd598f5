//! The paper's slider against an independent implementation: another language, the interior
//! eliminated, Newton's method on the frictional boundary; checked there against two more codes.

use crate::Outcome;
use crate::common::reference::Sample;
use crate::common::reference::{FOUR, Reference, THREE};
use crate::common::{STEP, Sliding, Solver, body, centre, paper_slider, relative};

/// Rows of the independent implementation's history at three refinements: time [s], displacement
/// [m], velocity [m/s], `alpha`, velocity problems.
const HISTORY: [(f64, f64, f64, f64, usize); 20] = [
    (
        0.039,
        -1.817828861594e-7,
        4.168605557207e-29,
        -3.341802796182,
        2,
    ),
    (
        1.0515,
        -1.817828861594e-7,
        8.231305245701e-31,
        4.434563176784e-2,
        2,
    ),
    (
        2.0655,
        -1.817828861594e-7,
        8.111038368505e-30,
        7.221404961053e-1,
        2,
    ),
    (
        3.078,
        -1.817828861594e-7,
        1.031192211363e-27,
        1.122014827510,
        2,
    ),
    (
        4.0905,
        -1.817828861594e-7,
        1.177312912586e-24,
        1.406910857921,
        2,
    ),
    (
        5.103,
        -1.817828861594e-7,
        2.370141911296e-21,
        1.628388382494,
        2,
    ),
    (
        6.117,
        -1.817828861587e-7,
        5.133971426241e-18,
        1.809848172169,
        3,
    ),
    (
        7.1295,
        -1.817828846547e-7,
        1.148087815270e-14,
        1.963175214794,
        3,
    ),
    (
        8.142,
        -1.817794290205e-7,
        2.647295088970e-11,
        2.096089973961,
        3,
    ),
    (
        9.1545,
        -1.736426908289e-7,
        6.252866350187e-8,
        2.212588048555,
        3,
    ),
    (
        9.981,
        6.069933990424e-6,
        6.576495654309e-5,
        1.678074657700,
        6,
    ),
    (
        10.0185,
        9.377717063914e-6,
        1.179938633955e-4,
        1.351582060539,
        7,
    ),
    (
        10.056,
        1.608456911907e-5,
        2.731549382901e-4,
        6.826256048756e-1,
        8,
    ),
    (
        10.0935,
        4.094546237306e-5,
        1.729904502747e-3,
        -1.848798956145,
        14,
    ),
    (
        10.131,
        2.190259369116e-4,
        3.370662593230e-3,
        -5.928065696411,
        17,
    ),
    (
        10.1685,
        2.372155820294e-4,
        1.945569519511e-5,
        -3.431993869427,
        14,
    ),
    (
        11.181,
        3.846021862909e-4,
        1.276400883641e-5,
        -1.772981172860,
        5,
    ),
    (
        12.1935,
        5.375986463384e-4,
        2.489955882330e-4,
        -2.603228965690,
        8,
    ),
    (
        13.2075,
        8.146298587644e-4,
        1.585583413081e-5,
        -2.291725842531,
        5,
    ),
    (
        14.22,
        9.543169832522e-4,
        6.690475085043e-5,
        -1.758922132594,
        6,
    ),
];

/// Iterations are those of TNNMG's cycles; condensation has none.
fn whole_run(reference: &Reference, solver: Solver) -> Outcome<Vec<Sample>> {
    let body = body(reference.refinements);
    let space = body.space()?;
    let mut slider = paper_slider(&body, &space, solver, 1e-10)?;
    let x0 = centre(&space)?;
    let (initial, digit) = reference.initial;
    let start = slider.snapshot().displacement[x0][0];
    assert!((start - initial).abs() <= digit, "u(0) = {start:e}");

    let samples = reference.follow(&mut slider, x0)?;
    let problems = || samples.iter().map(|s| s.report.coupling_iterations);
    let mean = problems().sum::<usize>() as f64 / samples.len() as f64;
    assert!((mean - reference.mean_iterations).abs() <= 0.02, "{mean}");
    let max = problems().max().unwrap_or(0);
    assert!(max.abs_diff(reference.max_iterations) <= 1, "{max}");
    let cycles: usize = samples.iter().map(|s| s.report.solver_iterations).sum();
    let cycles = cycles as f64 / samples.len() as f64;
    assert!(cycles < reference.cycles, "{cycles} cycles a step");
    Ok(samples)
}

#[test]
fn three_refinements_reproduce_table_and_history() -> Outcome {
    let samples = whole_run(&THREE, Solver::Tnnmg)?;
    for (time, displacement, velocity, state, iterations) in HISTORY {
        let sample = &samples[(time / STEP).round() as usize - 1];
        assert!((sample.time - time).abs() < 1e-12 * time);
        let problem = format!("t = {time}: {sample:?}");
        assert!(
            relative(sample.displacement, displacement) < 1e-8,
            "{problem}"
        );
        assert!(relative(sample.velocity, velocity) < 1e-7, "{problem}");
        assert!((sample.state - state).abs() < 1e-7, "{problem}");
        let problems = sample.report.coupling_iterations;
        assert!(problems.abs_diff(iterations) <= 1, "{problem}");
    }
    Ok(())
}

#[test]
fn four_refinements_reproduce_the_table() -> Outcome {
    whole_run(&FOUR, Solver::Condensed).map(|_| ())
}

/// The two solvers share nothing but the local minimisation.
///
/// With the tolerance 1e-11 of the coupling they agree at every step, also while the slider creeps
/// at 1e-30 m/s.
#[test]
fn gauss_seidel_and_tnnmg_agree_through_the_first_event() -> Outcome {
    let body = body(2);
    let space = body.space()?;
    let x0 = centre(&space)?;
    let mut fast = paper_slider(&body, &space, Solver::Tnnmg, 1e-11)?;
    let mut plain = paper_slider(&body, &space, Solver::GaussSeidel, 1e-11)?;
    let motion = |slider: &Sliding| {
        let at = slider.snapshot();
        (at.displacement[x0][0], at.velocity[x0][0])
    };
    let (start, _) = motion(&fast);
    let (mut peak, mut worst) = (0_f64, (0_f64, 0_f64));
    for _ in 0..6900 {
        fast.step(STEP)?;
        plain.step(STEP)?;
        let ((u, v), (u_plain, v_plain)) = (motion(&fast), motion(&plain));
        // On its way u passes through zero.
        worst.0 = worst.0.max((u - u_plain).abs() / u.abs().max(start.abs()));
        worst.1 = worst.1.max(relative(v, v_plain));
        peak = peak.max(v);
    }
    assert!(peak > 5e-3, "no event: {peak:e}");
    assert!(worst.0 < 1e-9 && worst.1 < 1e-9, "{worst:?}");
    Ok(())
}
