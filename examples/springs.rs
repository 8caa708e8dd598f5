//! Quasi-static spring slider: stick-slip below the critical stiffness, a sweep in threads.
//!
//! Steady sliding is unstable on springs softer than the critical stiffness, `(b - a) sigma_n / L`. Each thread
//! takes the next stiffness from a queue; scenes and simulations are `Send`, so that they may be built anywhere.

use std::error::Error;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
use stickslip::{RungeKutta, Steps};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, DARK, Panel, Points};

/// The times at which the block begins to slip at 0.1 mm/s on a spring of so many critical stiffnesses.
fn events(share: f64) -> Result<Vec<f64>, Box<dyn Error + Send + Sync>> {
    let normal_stress = 1e6;
    let (a, b, slip_distance) = (FRICTION.a, FRICTION.b, FRICTION.slip_distance);
    let critical = SpringSlider::critical_stiffness(normal_stress, a, b, slip_distance);
    let slider = SpringSlider {
        stiffness: share * critical,
        normal_stress,
        mass: 0.0,
        damping: 5e6,
        load: LoadPath::steady(1e-6),
    };
    let (mut events, mut slips) = (Vec::new(), false);
    let mut block = RungeKutta::new(slider.steady(FRICTION, AGING, 1.1e-6)?)?;
    block.run(&Steps::adaptive(1e-6).until(3000.0), |at| {
        let rate = at.max_slip_rate();
        if rate > 1e-4 && !slips {
            events.push(at.time);
        }
        slips = rate > 1e-4 || slips && rate > 1e-5;
    })?;
    Ok(events)
}

fn main() -> Result<(), Box<dyn Error>> {
    let shares: Vec<f64> = (1..=24).map(|n| 0.05 * f64::from(n)).collect();
    let next = AtomicUsize::new(0);
    let (sender, results) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(2, usize::from) {
            let (sender, next, shares) = (sender.clone(), &next, &shares);
            scope.spawn(move || {
                while let Some(&share) = shares.get(next.fetch_add(1, Ordering::Relaxed)) {
                    sender
                        .send((share, events(share)))
                        .expect("somebody listens");
                }
            });
        }
    });
    drop(sender);

    let mut table: Vec<_> = results.into_iter().collect();
    table.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    println!("stiffness / critical   events   recurrence [s]");
    let mut recurrences = Points::new();
    for (share, events) in table {
        let events = events.map_err(|error| error.to_string())?;
        let recurrence = events.windows(2).last().map(|pair| pair[1] - pair[0]);
        println!(
            "{share:20.2} {:8} {:16.1?}",
            events.len(),
            recurrence.unwrap_or(f64::NAN)
        );
        if share > 1.0 {
            assert!(
                events.is_empty(),
                "an event on a spring of {share} critical stiffnesses"
            );
        } else if let Some(recurrence) = recurrence {
            recurrences.push((share, recurrence));
        }
    }
    // The softer the spring, the longer it takes to be loaded.
    assert!(recurrences.len() > 10 && recurrences.is_sorted_by(|a, b| a.1 > b.1));

    let panel = Panel::new("stiffness over critical stiffness", "recurrence [s]")
        .with("", DARK, 2, recurrences.clone())
        .with_dots("", DARK, recurrences);
    let output = Output::create(Path::new("out/springs"), &[])?;
    plot::draw(&output.path("springs.png"), &[panel])?;
    println!("springs.png in {}", output.folder().display());
    Ok(())
}
