//! Any input is fitted or refused.

use proptest::prelude::*;
use stickslip_lab::{Evolution, Fit, Healing, LoadHistory, Loss, Record, Trend};

use crate::Noise;

fn fail(error: impl std::fmt::Display) -> TestCaseError {
    TestCaseError::fail(error.to_string())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Readings of any kind and unit, at times of any origin, have a history with finite steps in order, or are refused.
    #[test]
    fn any_readings_have_a_history_in_order(
        count in 2_usize..60,
        kind in 0_u8..6,
        seed in any::<u64>(),
        unit in -12_i32..12,
        origin in prop::option::of(0_i32..12),
        initial in prop::option::of(Just(1.0)),
    ) {
        let mut random = Noise::new(seed);
        let mut time = origin.map_or(0.0, |power| 10_f64.powi(power));
        let (mut times, mut readings, mut x) = (Vec::new(), Vec::new(), 0.0);
        for n in 0..count {
            time += random.uniform() + 1e-3;
            x += match kind {
                0 => random.normal(),
                1 => random.uniform(),
                2 => (3.0 * random.uniform()).floor(),
                3 => 0.0,
                4 => 1.0,
                _ if n % 7 == 0 => 1e6 * random.normal(),
                _ => random.uniform(),
            };
            times.push(time);
            readings.push(x * 10_f64.powi(unit));
        }
        // A load point that rests at first is refused.
        if let Ok(load) = LoadHistory::measured(&times, &readings, None, initial) {
            let steps = load.steps();
            prop_assert!(steps.iter().all(|step| step.0.is_finite() && step.1.is_finite()));
            prop_assert!(steps.windows(2).all(|pair| pair[1].0 >= pair[0].0), "{steps:?}");
            let friction = times.iter().map(|_| 0.6 + 0.01 * random.normal()).collect();
            let record = Record::new(times, friction).map_err(fail)?;
            if let Ok(healing) = Healing::of(&record, &load) {
                prop_assert!(healing.holds.iter().all(|hold| hold.duration > 0.0));
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// A record that has nothing to do with its history, with any options, has a fit that prints, or an error that says why.
    #[test]
    fn any_record_is_fitted_or_refused(
        count in 2_usize..80,
        kind in 0_u8..4,
        first in 0_usize..4,
        seed in any::<u64>(),
        [offset, beginning, huber, stiffness, trend] in any::<[bool; 5]>(),
    ) {
        let mut random = Noise::new(seed);
        let (mut times, mut readings, mut friction) = (Vec::new(), Vec::new(), Vec::new());
        let mut x = 0.0;
        for n in 0..count {
            x += [1e-6, 1e-5, 0.0, 3e-6][(4 * n / count + first) % 4];
            times.push(n as f64);
            readings.push(x + 1e-8 * random.normal());
            friction.push(match kind {
                0 => 0.6 + 0.01 * random.normal(),
                1 => 0.6 + 1e3 * x,
                2 if n == count / 2 => 5.0,
                2 => 0.6,
                _ => 0.6 + 0.01 * (3.0 * random.uniform()).floor(),
            });
        }
        let record = Record::new(times.clone(), friction).map_err(fail)?;
        let mut fit = Fit::new(&[Evolution::Slip]);
        if offset {
            fit = fit.with_step_offset();
        }
        if beginning {
            fit = fit.with_free_initial_state();
        }
        if huber {
            fit = fit.with_loss(Loss::Huber);
        }
        if stiffness {
            fit = fit.with_stiffness(1500.0);
        }
        if trend {
            fit = fit.with_trend(Trend::Time);
        }
        if let Ok(load) = LoadHistory::measured(&times, &readings, None, None) {
            let text = match fit.run(&record, &load) {
                Ok(fitted) => fitted.to_string(),
                Err(error) => error.to_string(),
            };
            prop_assert!(!text.is_empty());
        }
    }
}
