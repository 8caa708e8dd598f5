//! Histories of the load point, records and holds.

use stickslip_lab::{Evolution, Fit, Fitted, Healing, LoadHistory, Parameters, Record};

use crate::fits::assert_within;

use crate::{Noise, Outcome, one_state};

/// Displacements read with an error of at most the resolution have a history that meets all of them, with few pieces.
#[test]
fn a_measured_history_meets_its_samples() -> Outcome {
    let exact = LoadHistory::new(1e-6, &[(100.0, 1e-5), (150.0, 0.0), (250.0, 3e-6)])?;
    let times: Vec<f64> = (0..400).map(f64::from).collect();
    let resolution = 1e-7;
    let mut noise = Noise::new(2);
    let displacements: Vec<f64> = (times.iter())
        .map(|&time| exact.displacement(time) + resolution * (noise.uniform() - 0.5))
        .collect();
    let load = LoadHistory::measured(&times, &displacements, resolution, Some(1e-6))?;
    for (&time, &displacement) in times.iter().zip(&displacements) {
        let error = (load.displacement(time) - displacement).abs();
        assert!(error <= resolution * (1.0 + 1e-9), "{time}: {error:e}");
    }
    // Without resolution a velocity per pair of samples.
    let every = LoadHistory::measured(&times, &displacements, 0.0, Some(1e-6))?;
    for pair in times.windows(2) {
        let change = every.displacement(pair[1]) - every.displacement(pair[0]);
        let (from, to) = (pair[0] as usize, pair[1] as usize);
        assert!((change - displacements[to] + displacements[from]).abs() < 1e-15);
    }
    // The same friction as by the exact history, to the stress of the resolution: k times 1e-7 m, twice.
    let parameters = one_state();
    let curve = |load: &LoadHistory| parameters.curve(&[Evolution::Aging], load, &times);
    let differences = curve(&exact)?.into_iter().zip(curve(&load)?);
    let largest = differences.fold(0.0_f64, |largest, (x, y)| largest.max((x - y).abs()));
    assert!(
        largest < 2.0 * parameters.stiffness * 2.0 * resolution,
        "{largest:e}"
    );
    Ok(())
}

#[test]
fn a_history_by_displacement_is_one_by_time() -> Outcome {
    let steps = [(1e-4, 1e-5), (3e-4, 2e-6)];
    let load = LoadHistory::by_displacement(1e-6, &steps)?;
    for (x, time) in [
        (0.0, -100.0),
        (1e-4, 0.0),
        (2e-4, 10.0),
        (3e-4, 20.0),
        (3.2e-4, 30.0),
    ] {
        assert!((load.time(x) - time).abs() < 1e-9, "{x}: {}", load.time(x));
        assert!((load.displacement(time) - x).abs() < 1e-15, "{time}");
    }
    let steps = LoadHistory::velocity_steps(&[1e-6, 1e-5, 1e-6], 1e-4)?;
    let exact = [0.0, 50.0, 100.0, 105.0, 110.0, 160.0, 210.0];
    let samples = steps.samples(2);
    assert_eq!(samples.len(), exact.len());
    let differences = samples
        .iter()
        .zip(exact)
        .map(|(time, exact)| (time - exact).abs());
    assert!(differences.fold(0.0, f64::max) < 1e-9);
    Ok(())
}

/// On a rigid machine the sample rests in a hold of the aging law: `theta` grows by its duration `t`, and the peak
/// is `b ln(1 + V t/L)` above the level. Reload is over within `a/k` = 1 nm, relaxation towards rest is `a ln(1 + k V t/a)`.
#[test]
fn healing_is_that_of_the_aging_law() -> Outcome {
    let parameters = Parameters {
        stiffness: 1e7,
        ..one_state()
    };
    let (velocity, durations) = (1e-5, [10.0, 100.0, 1000.0, 10_000.0]);
    let load = LoadHistory::slide_hold_slide(velocity, &durations, 2e-4)?;
    // Samples of the reload every 0.4 nm, then every micrometre.
    let mut times = load.samples(200);
    for hold in 0..durations.len() {
        let reload = 20.0 * (hold + 1) as f64 + durations[..=hold].iter().sum::<f64>();
        times.extend((0..4000).map(|n| reload + 4e-5 * f64::from(n)));
    }
    times.sort_by(f64::total_cmp);
    let friction = parameters.curve(&[Evolution::Aging], &load, &times)?;
    let healing = Healing::of(&Record::new(times, friction)?, &load)?;
    let state = parameters.states[0];
    for (hold, duration) in healing.holds.iter().zip(durations) {
        assert!((hold.duration / duration - 1.0).abs() < 1e-9);
        let exact = state.b * (1.0 + velocity * duration / state.slip_distance).ln();
        // Slip while the slip rate rises by orders of magnitude: some `a/k` of `L` each.
        assert!(
            (hold.healing() - exact).abs() < 3e-3 * exact,
            "{hold:?}, {exact}"
        );
        assert!(hold.relaxation() > 0.0);
    }
    // Beyond `L/V` = 1.2 s a decade heals `b ln 10`, less by the ratio of the two.
    let decade = state.b * std::f64::consts::LN_10;
    assert!(
        (healing.rate / decade - 1.0).abs() < 0.03,
        "{} {decade}",
        healing.rate
    );
    Ok(())
}

/// Slide-hold-slide is fitted as any sequence.
#[test]
fn slide_hold_slide_is_fitted() -> Outcome {
    let truth = one_state();
    let load = LoadHistory::slide_hold_slide(1e-5, &[3.0, 30.0, 300.0], 3e-4)?;
    let times = load.samples(150);
    let laws = [Evolution::Aging];
    let friction = Noise::new(4).added_to(&truth.curve(&laws, &load, &times)?, 1e-3);
    let record = Record::new(times, friction)?;
    let fit = stickslip_lab::Fit::new(&laws)
        .with_reference_velocity(1e-6)
        .with_stiffness(truth.stiffness);
    let found = fit.run(&record, &load)?;
    // One velocity: mu0 is known at this velocity alone, and with a - b elsewhere.
    for estimate in &found.estimates {
        let error = (estimate.value - estimate.parameter.of(&truth)).abs();
        assert!(error <= 4.0 * estimate.standard_error, "{found}");
    }
    Ok(())
}

/// Truth of the fits below.
fn slow() -> Parameters {
    Parameters {
        reference_velocity: 1e-5,
        ..one_state()
    }
}

/// Slides of 30 s, with holds of 30 s and 300 s that creep, and velocities that repeat the last one or differ in the last digit.
fn creeping(creep: f64, repeated: bool) -> Outcome<LoadHistory> {
    let last = 1e-5 * (1.0 + f64::EPSILON);
    let mut changes: Vec<(f64, f64)> = vec![
        (30.0, creep),
        (60.0, 1e-5),
        (90.0, creep),
        (390.0, 1e-5),
        (420.0, 1e-6),
    ];
    if repeated {
        let more = [
            (10.0, 1e-5),
            (20.0, last),
            (70.0, last),
            (80.0, 1e-5),
            (430.0, 1e-6),
            (440.0, 1e-6),
        ];
        changes.extend(more);
        changes.sort_by(|one, other| one.0.total_cmp(&other.0));
    }
    Ok(LoadHistory::new(1e-5, &changes)?.ending(600.0)?)
}

/// A fit with velocities that are repeated, exactly or but for the last digit, has the bits of that without.
#[test]
fn repeated_velocities_do_not_matter_in_fits() -> Outcome {
    let plain = creeping(0.0, false)?;
    let times = plain.samples(150);
    let clean = slow().curve(&[Evolution::Aging], &plain, &times)?;
    let record = Record::new(times, Noise::new(9).added_to(&clean, 5e-4))?;
    let fit = Fit::new(&[Evolution::Aging]);
    let (one, two) = (
        fit.run(&record, &plain)?,
        fit.run(&record, &creeping(0.0, true)?)?,
    );
    assert_eq!((&one.estimates, one.work), (&two.estimates, two.work));
    assert_eq!((&one.warnings, &one.load), (&two.warnings, &two.load));
    Ok(())
}

/// Holds that creep at 1e-20 to 1e-9 m/s are holds: the parameters of their records are within four standard errors, as those
/// without creep, which they tend to.
#[test]
fn creep_does_not_matter_in_fits() -> Outcome {
    let times = creeping(0.0, false)?.samples(150);
    let fit = Fit::new(&[Evolution::Aging]).with_step_offset();
    let run = |creep: f64| -> Outcome<Fitted> {
        let load = creeping(creep, true)?;
        let clean = slow().curve(&[Evolution::Aging], &load, &times)?;
        let record = Record::new(times.clone(), Noise::new(9).added_to(&clean, 5e-4))?;
        Ok(fit.run(&record, &load)?)
    };
    let plain = run(0.0)?;
    for creep in [1e-20, 1e-16, 1e-12, 1e-10, 1e-9, -1e-12, -1e-9] {
        let found = run(creep)?;
        assert_within(&found, &slow());
        let velocities =
            |fitted: &Fitted| fitted.load.iter().map(|slide| slide.1).collect::<Vec<_>>();
        assert_eq!(
            velocities(&found),
            [1e-5, 0.0, 1e-5, 0.0, 1e-5, 1e-6],
            "{creep:e}"
        );
        for (one, other) in plain.estimates.iter().zip(&found.estimates) {
            // The creep itself moves the load point by k 300 s, 4.5e-4 of friction at 1e-9 m/s, which the curve has, too.
            let difference = (one.value - other.value).abs();
            assert!(
                difference < 0.3 * one.standard_error,
                "{creep:e}: {one:?} {other:?}"
            );
            assert!((other.standard_error / one.standard_error - 1.0).abs() < 0.1);
        }
    }
    Ok(())
}
