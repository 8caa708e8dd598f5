//! Histories of displacements as gauges measure them.

use proptest::prelude::*;
use stickslip_lab::{Evolution, Healing, LoadHistory, Parameters, Record};

use crate::{Noise, Outcome, one_state};

/// What a gauge adds to the displacement.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gauge {
    /// The standard deviation \[m\].
    pub(crate) noise: f64,
    /// The correlation of neighbouring errors.
    pub(crate) together: f64,
    /// The quantum \[m\]; 0 for none.
    pub(crate) quantum: f64,
}

impl Gauge {
    pub(crate) fn white(noise: f64) -> Self {
        Self {
            noise,
            together: 0.0,
            quantum: 0.0,
        }
    }

    pub(crate) fn reads(self, load: &LoadHistory, times: &[f64], seed: u64) -> Vec<f64> {
        let exact: Vec<f64> = times.iter().map(|&time| load.displacement(time)).collect();
        self.adds_to(&exact, seed)
    }

    /// The readings of exact values.
    pub(crate) fn adds_to(self, exact: &[f64], seed: u64) -> Vec<f64> {
        let mut random = Noise::new(seed);
        let mut error = random.normal();
        let fresh = (1.0 - self.together * self.together).sqrt();
        let read = exact.iter().map(|exact| {
            error = self.together * error + fresh * random.normal();
            let value = exact + self.noise * error;
            if self.quantum > 0.0 {
                (value / self.quantum).round() * self.quantum
            } else {
                value
            }
        });
        read.collect()
    }
}

/// Steps up and down, and a hold, at times between samples.
fn protocol() -> Outcome<LoadHistory> {
    let changes = [
        (100.3, 1e-5),
        (150.7, 0.0),
        (250.2, 3e-6),
        (350.1, 1e-5),
        (400.45, 1e-6),
    ];
    Ok(LoadHistory::new(1e-6, &changes)?)
}

/// Samples every `1/rate` seconds, for 500 s.
fn every(rate: f64) -> Vec<f64> {
    let count = (500.0 * rate) as u32;
    (0..=count).map(|n| f64::from(n) / rate).collect()
}

/// The history of the readings has the same steps, at times within five standard errors: a line of `n` samples has at its
/// end the variance `4 sigma^2/n`, and two lines whose slopes differ by `dV` meet at a time with that of both over `dV^2`.
fn meets(load: &LoadHistory, exact: &LoadHistory, rate: f64, noise: f64) -> bool {
    let (steps, exact) = (load.steps(), exact.steps());
    let mut met = steps.len() == exact.len();
    for (k, (step, exact_step)) in steps.iter().zip(&exact).enumerate().skip(1) {
        let end = exact.get(k + 1).map_or(500.0, |next| next.0);
        let begin = if k > 1 { exact[k - 1].0 } else { 0.0 };
        let samples = [exact_step.0 - begin, end - exact_step.0].map(|time| rate * time);
        let variance = 4.0 * noise * noise * (1.0 / samples[0] + 1.0 / samples[1]);
        let error = variance.sqrt() / (exact_step.1 - exact[k - 1].1).abs();
        met &= (step.0 - exact_step.0).abs() <= 5.0 * error + 1e-9;
    }
    met
}

/// From exact readings to noise that is one to ten times the displacement between samples, at 1 to 100 Hz.
#[test]
fn steps_are_found_whatever_the_noise_and_the_rate() -> Outcome {
    let exact = protocol()?;
    for rate in [1.0, 10.0, 100.0] {
        let times = every(rate);
        for noise in [0.0, 1e-9, 1e-8, 1e-7, 1e-6] {
            let mut met = 0;
            for seed in 0..20 {
                let readings = Gauge::white(noise).reads(&exact, &times, seed);
                let load = LoadHistory::measured(&times, &readings, None, None)?;
                met += usize::from(meets(&load, &exact, rate, noise));
            }
            // Five standard errors are exceeded by one corner of a million, and `n^-2` is the chance of a wrong one.
            assert!(met == 20, "{rate} Hz, {noise:e} m: {met} of 20");
        }
    }
    Ok(())
}

/// With a correlation of .95 there is one independent error in 39 samples.
#[test]
fn correlated_noise_is_no_step() -> Outcome {
    let exact = protocol()?;
    for rate in [10.0, 100.0] {
        let times = every(rate);
        let mut met = 0;
        for seed in 0..20 {
            let gauge = Gauge {
                together: 0.95,
                ..Gauge::white(3e-7)
            };
            let readings = gauge.reads(&exact, &times, seed);
            let load = LoadHistory::measured(&times, &readings, None, None)?;
            met += usize::from(meets(&load, &exact, rate / 39.0, 3e-7));
        }
        assert!(met >= 18, "{rate} Hz: {met} of 20");
    }
    Ok(())
}

/// The ripple of a machine, twenty times the noise, is no step: the corners are late or early by no more than its height over the
/// change of the velocity.
#[test]
fn ripple_is_no_step() -> Outcome {
    let exact = protocol()?;
    for rate in [10.0, 100.0, 1000.0] {
        let times = every(rate);
        for (height, frequency) in [(2e-7, 1.3), (2e-7, 0.21), (1e-6, 3.0)] {
            let mut readings = Gauge::white(1e-8).reads(&exact, &times, 7);
            for (reading, time) in readings.iter_mut().zip(&times) {
                *reading += height * (std::f64::consts::TAU * frequency * time).sin();
            }
            let load = LoadHistory::measured(&times, &readings, None, None)?;
            let (steps, exact) = (load.steps(), exact.steps());
            assert_eq!(
                steps.len(),
                exact.len(),
                "{rate} {height:e} {frequency}: {steps:?}"
            );
            for (k, (step, other)) in steps.iter().zip(&exact).enumerate().skip(1) {
                let late = (step.0 - other.0).abs() * (other.1 - exact[k - 1].1).abs();
                assert!(late < height, "{rate} {height:e} {frequency}: {step:?}");
            }
        }
    }
    Ok(())
}

/// A gauge that repeats a value until the next one has errors of half a quantum: the corners are late or early by at most
/// two quanta over the change of the velocity.
#[test]
fn steps_of_the_gauge_are_no_steps() -> Outcome {
    let exact = protocol()?;
    for rate in [1.0, 10.0, 100.0] {
        let times = every(rate);
        for quantum in [1e-7, 1e-6] {
            for noise in [0.0, 0.03, 0.1, 0.3] {
                let gauge = Gauge {
                    quantum,
                    ..Gauge::white(noise * quantum)
                };
                let readings = gauge.reads(&exact, &times, 3);
                let load = LoadHistory::measured(&times, &readings, None, None)?;
                let (steps, exact) = (load.steps(), exact.steps());
                assert_eq!(steps.len(), exact.len(), "{rate} Hz, {gauge:?}: {steps:?}");
                for (k, (step, other)) in steps.iter().zip(&exact).enumerate().skip(1) {
                    let late = (step.0 - other.0).abs() * (other.1 - exact[k - 1].1).abs();
                    assert!(late < 2.0 * quantum, "{rate} Hz, {gauge:?}: {step:?}");
                }
            }
        }
    }
    Ok(())
}

/// The velocities before the first step and of every slide are those of all samples: with the standard error
/// `sigma/t (12/n)^(1/2)` of a line.
#[test]
fn the_initial_velocity_is_that_of_the_slide() -> Outcome {
    let (exact, times) = (protocol()?, every(10.0));
    let error = 1e-7 / 100.3 * (12.0_f64 / 1003.0).sqrt();
    for seed in 0..20 {
        let readings = Gauge::white(1e-7).reads(&exact, &times, seed);
        let load = LoadHistory::measured(&times, &readings, None, None)?;
        let initial = load.velocity(-1.0);
        assert!((initial - 1e-6).abs() < 5.0 * error, "{seed}: {initial:e}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Any protocol of steps and holds, of 200 samples or more per piece and with noise of up to a hundredth of the
    /// displacement of a piece, is met: to six standard deviations of the end of a line, and to the largest difference `d`
    /// that the criterion does not defend. Over 200 samples it adds `200 d^2/12` to the sum of squares, at most `4 ln n` times
    /// the variance.
    #[test]
    fn any_protocol_is_met(
        steps in prop::collection::vec((-1.0_f64..1.0, 0.2_f64..1.0, any::<bool>()), 1..6),
        level in -4.0_f64..-2.0,
        seed in any::<u64>(),
    ) {
        let (mut velocity, mut time) = (1e-5_f64, 1e-4 / 1e-5);
        let mut changes = Vec::new();
        for (sign, decades, hold) in steps {
            let factor = 10_f64.powf(2.0 * sign.signum() * decades);
            let up = velocity * factor;
            velocity = if (1e-7..=1e-3).contains(&up) { up } else { velocity / factor };
            if hold {
                changes.push((time, 0.0));
                time += 10.0;
            }
            changes.push((time, velocity));
            time += 1e-4 / velocity;
        }
        let exact = LoadHistory::new(1e-5, &changes).and_then(|load| load.ending(time));
        let exact = exact.map_err(|error| TestCaseError::fail(error.to_string()))?;
        let times = exact.samples(200);
        let noise = 1e-4 * 10_f64.powf(level);
        let readings = Gauge::white(noise).reads(&exact, &times, seed);
        let load = LoadHistory::measured(&times, &readings, None, None);
        let load = load.map_err(|error| TestCaseError::fail(error.to_string()))?;
        let undefended = (48.0 * (times.len() as f64).ln() / 200.0).sqrt();
        let bound = noise * (6.0 * (4.0_f64 / 200.0).sqrt() + undefended);
        for &time in &times {
            let error = (load.displacement(time) - exact.displacement(time)).abs();
            prop_assert!(error < bound, "{time}: {error:e} of {bound:e}, {:?}", load.steps());
        }
    }
}

/// Healing of a record whose displacement was measured is that of the exact history, also of a machine that takes a fifth of
/// a second to start and to stop, and of a hold of four samples.
#[test]
fn healing_of_a_measured_displacement_is_that_of_the_history() -> Outcome {
    let parameters = one_state();
    let exact = LoadHistory::slide_hold_slide(1e-5, &[3.0, 30.0, 300.0, 3000.0], 3e-4)?;
    let ramped = |time: f64| {
        let over = (0..20).map(|n| exact.displacement(time - 0.2 * (f64::from(n) + 0.5) / 20.0));
        over.sum::<f64>() / 20.0
    };
    for rate in [1.0, 10.0] {
        let times: Vec<f64> = (0..=(3480.0 * rate) as u32)
            .map(|n| f64::from(n) / rate)
            .collect();
        let friction = parameters.curve(&[Evolution::Aging], &exact, &times)?;
        let record = Record::new(times.clone(), friction)?;
        let healing = Healing::of(&record, &exact)?.rate;
        for noise in [0.0, 1e-9, 1e-8, 1e-7] {
            let sharp = Gauge::white(noise).reads(&exact, &times, 5);
            let soft = times.iter().zip(&sharp);
            let soft = soft.map(|(&time, x)| x + ramped(time) - exact.displacement(time));
            for readings in [sharp.clone(), soft.collect()] {
                let load = LoadHistory::measured(&times, &readings, None, None)?;
                let found = Healing::of(&record, &load)?;
                assert_eq!(found.holds.len(), 4, "{rate} {noise:e} {:?}", load.steps());
                let relative = found.rate / healing - 1.0;
                assert!(relative.abs() < 1e-2, "{rate} {noise:e}: {relative}");
            }
        }
    }
    Ok(())
}

/// Velocities that repeat the last one, or differ in the last digit, and holds that creep are no other history.
#[test]
fn repeated_velocities_and_creep_do_not_matter() -> Outcome {
    let parameters = Parameters {
        stiffness: 3e3,
        ..one_state()
    };
    let plain = [(30.0, 0.0), (60.0, 1e-5), (90.0, 0.0), (390.0, 1e-5)];
    let exact = LoadHistory::new(1e-5, &plain)?.ending(420.0)?;
    let times = exact.samples(200);
    let record = Record::new(
        times.clone(),
        parameters.curve(&[Evolution::Aging], &exact, &times)?,
    )?;
    let healing = Healing::of(&record, &exact)?;
    let last = 1e-5 * (1.0 + f64::EPSILON);
    for creep in [0.0, 1e-20, 1e-12, 1e-9, -1e-12] {
        let changes = [
            (10.0, 1e-5),
            (20.0, last),
            (30.0, creep),
            (40.0, 0.5 * creep),
            (60.0, last),
            (70.0, 1e-5),
            (90.0, creep),
            (390.0, 1e-5),
            (400.0, last),
        ];
        let load = LoadHistory::new(1e-5, &changes)?.ending(420.0)?;
        let found = Healing::of(&record, &load)?;
        assert_eq!(
            (&found.holds, found.rate),
            (&healing.holds, healing.rate),
            "{creep:e}"
        );
        assert!(load.has_hold(0.0, 420.0) && !load.has_hold(0.0, 30.0));
    }
    Ok(())
}
