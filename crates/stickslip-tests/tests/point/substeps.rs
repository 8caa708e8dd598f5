//! Constant steps that fail, split into substeps.

use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
use stickslip::{FixedPoint, Newmark, Point, Simulation, StateUpdate, Steps};

use crate::Outcome;

/// A spring that is unstable in the steps asked for: the paper's coupling gives some of them up.
fn block() -> Outcome<Simulation<1>> {
    let slider = SpringSlider {
        stiffness: 2e7,
        normal_stress: NORMAL_STRESS,
        mass: 5e3,
        damping: 0.0,
        load: LoadPath::steady(1e-4),
    };
    let scene = slider.steady(FRICTION, AGING, 1.1e-4)?;
    Ok(Simulation::new(scene, Newmark::default(), Point)?
        .with_coupling(FixedPoint::paper().with_max_iterations(12))
        .with_state_update(StateUpdate::BackwardEuler)
        .with_tolerance(1e-13)?)
}

const NORMAL_STRESS: f64 = 1e6;

#[test]
fn a_step_that_fails_is_split_and_counted() -> Outcome {
    let plan = Steps::constant(0.02).until(10.0);
    let alone = plan.clone().without_substeps();
    let failure = block()?.run(&alone, |_| ()).err().ok_or("no step failed")?;
    let mut split = block()?;
    let mut times = vec![0.0];
    let report = split.run(&plan, |at| times.push(at.time))?;
    assert!(
        report.substepped > 0 && report.accepted == 500,
        "{report:?}"
    );
    assert_eq!(split.snapshot().time, 10.0);
    // The first part is within the step that failed without substeps.
    let step = |n: usize| 0.02 * n as f64;
    let first = (1..)
        .find(|&n| (times[n] - step(n)).abs() > 1e-12)
        .ok_or("no part")?;
    assert_eq!(failure.step, first);
    assert!(step(first - 1) < times[first] && times[first] < step(first));
    // Parts are shown between the steps of the plan, which all are there.
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
    for n in 0..=500 {
        let time = 0.02 * f64::from(n);
        assert!(times.iter().any(|at| (at - time).abs() < 1e-12), "{time}");
    }
    assert_eq!(times.len(), 501 + report.substeps - report.substepped);
    Ok(())
}

/// Where nothing fails a plan takes the same steps with substeps and without, to the bit.
#[test]
fn substeps_change_nothing_where_no_step_fails() -> Outcome {
    let (mut plain, mut split) = (block()?, block()?);
    let plan = Steps::constant(1e-4).count(100);
    plain.run(&plan.clone().without_substeps(), |_| ())?;
    let report = split.run(&plan.with_substeps(), |_| ())?;
    assert_eq!((report.substepped, report.substeps), (0, 0));
    assert_eq!(plain.state(), split.state());
    Ok(())
}
