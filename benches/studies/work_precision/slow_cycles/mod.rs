//! A hundred events of a slowly loaded slider: when, and at what cost?

mod cycles;
mod settings;

use std::sync::Mutex;
use std::thread;
use std::time::Instant;
use stickslip_cli::onsets::Onsets;

use stickslip::fem::P1;
use stickslip::problems::pipping_slider::PippingSlider;
use stickslip::{Condensed, ErrorControl, Simulation, Steps};
use stickslip_cli::cli::Problem;

pub(crate) use cycles::{Cycles, NAME, table, write};
use settings::{Run, SETTINGS, Scheme, Setting, VISCOUS};

/// An event begins where the slip rate at `x0` passes this [m/s], 1e4 times that of loading, and
/// has been below [`REARM`] since the last.
const THRESHOLD: f64 = 1e-4;
const REARM: f64 = 1e-6;
/// The time after an event \[s\] within which a passage of the threshold is a wave of the event.
const QUIET: f64 = 1e3;
/// The end of all runs \[s\], and of those that have to be quick.
const UNTIL: f64 = 1e7;
const QUICK_UNTIL: f64 = 1.1e6;
/// The first step \[s\].
const FIRST_STEP: f64 = 10.0;
/// So many runs at a time.
const THREADS: usize = 2;

/// Runs both bodies by all schemes; the viscous one by two of them over two events, if it has to be
/// quick.
pub(crate) fn measure(quick: bool) -> Result<Vec<Cycles>, Problem> {
    let space = VISCOUS.space()?;
    let of = |setting: &'static Setting| setting.runs.iter().map(move |&run| (setting, run));
    let mut plans: Vec<_> = SETTINGS.iter().flat_map(of).collect();
    if quick {
        let schemes = [Scheme::Sdirk2, Scheme::Alpha(0.5)];
        plans.retain(|(setting, run)| {
            let wanted = run.motion == 1.0 && run.tolerance == 1e-2;
            setting.slider == VISCOUS && wanted && schemes.contains(&run.scheme)
        });
    }
    let until = if quick { QUICK_UNTIL } else { UNTIL };
    let queue = Mutex::new(plans.iter().enumerate());
    let take = || queue.lock().map_or(None, |mut queue| queue.next());
    let work = || -> Result<Vec<(usize, Cycles)>, String> {
        let mut done = Vec::new();
        while let Some((number, &(setting, run))) = take() {
            let cycles = cycles(setting, run, &space, until);
            let cycles = cycles.map_err(|problem| problem.to_string())?;
            cycles.print();
            done.push((number, cycles));
        }
        Ok(done)
    };
    let mut done = Vec::with_capacity(plans.len());
    thread::scope(|scope| -> Result<(), Problem> {
        let workers: [_; THREADS] = std::array::from_fn(|_| scope.spawn(work));
        for worker in workers {
            done.extend(worker.join().map_err(|_| "a run has panicked")??);
        }
        Ok(())
    })?;
    done.sort_by_key(|(number, _)| *number);
    Ok(done.into_iter().map(|(_, cycles)| cycles).collect())
}

/// One run, assembly included.
fn cycles(
    setting: &'static Setting,
    run: Run,
    space: &P1<2>,
    until: f64,
) -> Result<Cycles, Problem> {
    let begin = Instant::now();
    let centre = PippingSlider::centre(space).ok_or("the mesh has no vertex at x0")?;
    let scene = setting.slider.scene(space)?;
    let mut simulation = Simulation::new(scene, run.scheme.rate_scheme(), Condensed::new())?;
    let steps = Steps::adaptive(run.tolerance)
        .with_error_control(ErrorControl {
            motion: run.motion,
            ..ErrorControl::default()
        })
        .with_first_step(FIRST_STEP)
        .in_powers_of_two()
        .stopping_at([setting.slider.ramp])
        .with_max_steps(run.max_steps)
        .until(until);
    let mut slips = Onsets::new(THRESHOLD, REARM);
    let (mut count, mut reached) = (0, 0.0);
    let result = simulation.run(&steps, |at| {
        slips.record(at.time, at.velocity[centre].norm());
        (count, reached) = (count + 1, at.time);
    });
    let mut events: Vec<f64> = Vec::new();
    for &time in slips.times() {
        if events.last().is_none_or(|last| time > last + QUIET) {
            events.push(time);
        }
    }
    Ok(Cycles {
        body: setting.name,
        scheme: run.scheme.name(),
        motion: run.motion,
        tolerance: run.tolerance,
        events,
        steps: count,
        reached,
        seconds: begin.elapsed().as_secs_f64(),
        failure: result.err().map(|failure| failure.to_string()),
    })
}
