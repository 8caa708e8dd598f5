use crate::{Noise, Outcome, STIFFNESS, one_state, sequence, times, two_states};
use std::time::Instant;
use stickslip_lab::{Evolution, Fit, LoadHistory, Parameters, Record, StateParameters};

#[test]
fn explore() -> Outcome {
    let (mut bad, mut errors, mut n, mut ms, mut worst) = ([0; 4], 0, 0, 0.0, 0.0f64);
    let only: Option<u64> = std::env::var("SEED").ok().and_then(|s| s.parse().ok());
    for seed in 0..400u64 {
        if only.is_some_and(|o| o != seed) {
            continue;
        }
        let mut r = Noise::new(1000 + seed);
        let mut log = |lo: f64, hi: f64| lo * (hi / lo).powf(r.uniform());
        let a = log(0.003, 0.02);
        let b = a * log(0.3, 2.0);
        let l = log(2e-6, 6e-5);
        let k = log(200.0, 2e4);
        let two = seed % 2 == 1;
        let law = if seed % 4 < 2 {
            Evolution::Aging
        } else {
            Evolution::Slip
        };
        let ratio = log(5.0, 30.0);
        let share = log(0.3, 1.0);
        let states = if two {
            vec![
                StateParameters::steady(b * share, l),
                StateParameters::steady(b * (1.0 - share), l * ratio),
            ]
        } else {
            vec![StateParameters::steady(b, l)]
        };
        let truth = Parameters {
            a,
            states,
            stiffness: k,
            ..one_state()
        };
        if truth.critical_stiffness() > 0.7 * k {
            continue;
        }
        let laws = vec![law; truth.states.len()];
        let (load, times) = (sequence()?, times());
        let clean = match truth.curve(&laws, &load, &times) {
            Ok(c) => c,
            Err(e) => {
                println!("truth {e} {truth:?}");
                continue;
            }
        };
        for noise in [0.0, 1e-3] {
            let data = Noise::new(seed).added_to(&clean, noise);
            let squares: f64 = clean.iter().zip(&data).map(|(x, y)| (x - y).powi(2)).sum();
            let record = Record::new(times.clone(), data)?;
            for free in [false, true] {
                let mut fit = Fit::new(&laws);
                if !free {
                    fit = fit.with_stiffness(k);
                }
                let clock = Instant::now();
                n += 1;
                match fit.run(&record, &load) {
                    Ok(f) => {
                        if f.rms.powi(2) * 1000.0 > squares * 1.0001 + 1e-12 {
                            bad[usize::from(free) + 2 * usize::from(two)] += 1;
                            println!(
                                "BAD seed {seed} noise {noise} {law:?} free {free} rms {:e} vs {:e} off {:e} truth {truth:?}\n{f}",
                                f.rms,
                                (squares / 1000.0).sqrt(),
                                f.offset
                            );
                        }
                    }
                    Err(e) => {
                        errors += 1;
                        println!("ERR seed {seed} noise {noise} free {free} {e} {truth:?}");
                    }
                }
                let t = clock.elapsed().as_secs_f64() * 1e3;
                if t > worst {
                    worst = t;
                    println!("worst {t} ms seed {seed} free {free} two {two}");
                }
                ms += t;
            }
        }
    }
    println!(
        "{n} fits, bad {bad:?}, errors {errors}, mean {} ms worst {worst}",
        ms / n as f64
    );
    let _ = STIFFNESS;
    let _ = two_states();
    Ok(())
}
