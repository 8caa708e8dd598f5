//! The energy balance of planes: work of the plate = energy stored + dissipated by friction and radiation.

use nalgebra::Vector1;
use stickslip::bie::{Cells, PlaneFault, Rectangles};
use stickslip::record::{Balance, EnergyLedger};
use stickslip::state::LogTheta;
use stickslip::{Contact, ContactView, RungeKutta, Scene, Steps};

use super::{AGING, MEDIUM, NORMAL, PLATE, law};
use crate::Outcome;

const POISSON_RATIO: f64 = 0.25;

fn cells(down: [f64; 2], size: f64) -> Outcome<Rectangles> {
    let count = |length: f64| (length / size) as usize;
    Ok(Rectangles::new(
        Cells::new([-8e3, 8e3], count(16e3))?,
        Cells::new(down, count(down[1] - down[0]))?,
    ))
}

/// A plane that slips along strike, weakens in an ellipse of 12 km x 8 km and strengthens around it, and starts close to
/// an event.
fn motion(fault: &PlaneFault<1>) -> Outcome<RungeKutta<1>> {
    let middle = fault.cells().down_dip().ends().iter().sum::<f64>() / 2.0;
    let inside = |[x, y]: [f64; 2]| (x / 6e3).hypot((y - middle) / 4e3) < 1.0;
    let weight = |at| if inside(at) { 0.010 } else { 0.025 };
    let laws = fault.cells().map(|at| law(weight(at)));
    let shear = fault.cells().map(|[x, y]| {
        let bump = 1.0 + 0.1 * (-((x + 2e3) / 2e3).powi(2) - ((y - middle) / 2e3).powi(2)).exp();
        Vector1::new(bump * NORMAL * (0.6 + (weight([x, y]) - 0.015) * (PLATE / 1e-6).ln()))
    });
    let steady = LogTheta((AGING.slip_distance / PLATE).ln());
    let contact = Contact::per_vertex(fault, laws, NORMAL)
        .with_state(AGING, steady)
        .with_shear_stress(shear);
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_load_history(fault.plate_loading(Vector1::new(PLATE))?)
        .with_contact(contact);
    Ok(RungeKutta::new(scene)?)
}

/// The dissipation of a run through an event, computed in three ways.
struct Run {
    balance: Balance,
    /// The sum over the steps of the mean of the law's tractions times slip \[J\].
    by_slip: f64,
    /// The power of friction by the trapezoidal rule in time \[J\].
    by_power: f64,
    peak: f64,
}

/// The strength of the law at each cell \[N\], and the power that friction dissipates \[W\].
fn friction(contact: &ContactView<'_, 1>) -> (Vec<f64>, f64) {
    let forces = (0..contact.len()).map(|k| contact.strength(k) * contact.weight(k));
    let forces: Vec<f64> = forces.collect();
    let power = (0..contact.len()).map(|k| forces[k] * contact.slip_rate(k));
    let power = power.sum();
    (forces, power)
}

fn run(fault: &PlaneFault<1>, tolerance: f64) -> Outcome<Run> {
    let mut motion = motion(fault)?;
    let start = motion.snapshot();
    let mut ledger = EnergyLedger::new(&start);
    let (mut forces, mut power) = friction(&start.contact(0));
    let (mut time, mut slips) = (0.0, vec![0.0; forces.len()]);
    let (mut by_slip, mut by_power, mut peak) = (0.0, 0.0, 0.0_f64);
    motion.run(&Steps::adaptive(tolerance).until(1e8), |at| {
        ledger.record(&at);
        let contact = at.contact(0);
        let (new_forces, new_power) = friction(&contact);
        for k in 0..contact.len() {
            let slip = contact.slip(k);
            by_slip += 0.5 * (forces[k] + new_forces[k]) * (slip - slips[k]);
            slips[k] = slip;
        }
        by_power += 0.5 * (power + new_power) * (at.time - time);
        (forces, power, time) = (new_forces, new_power, at.time);
        peak = peak.max(contact.max_slip_rate());
    })?;
    Ok(Run {
        balance: ledger.balance(&motion.snapshot()),
        by_slip,
        by_power,
        peak,
    })
}

/// In a whole space the matrix is symmetric: the ledger closes to rounding at any tolerance, and its friction is that of
/// the law. The power of friction over time, by the trapezoidal rule, misses it by the square of the steps: by
/// `tolerance^(2/5)` in the limit of steps of order five, of which a fourth root is asked.
#[test]
fn the_ledger_of_a_plane_closes() -> Outcome {
    let fault = PlaneFault::whole_space(cells([-5e3, 5e3], 500.0)?, MEDIUM, POISSON_RATIO)?;
    let fault = fault.with_rake(0.0)?;
    let mut gaps = [0.0; 2];
    for (gap, tolerance) in gaps.iter_mut().zip([1e-3, 1e-6]) {
        let run = run(&fault, tolerance)?;
        let balance = run.balance;
        // An event has come and gone, and friction has taken most of what the plate gave.
        assert!(run.peak > 0.1, "{}", run.peak);
        assert!(balance.friction > 0.5 * balance.loads, "{balance:?}");
        let scale = balance.friction;
        assert!(balance.left_over.abs() < 1e-12 * scale, "{balance:?}");
        assert!((run.by_slip / scale - 1.0).abs() < 1e-10, "{balance:?}");
        let dissipated = run.by_power + balance.viscosity;
        *gap = ((balance.loads - balance.stored - dissipated) / scale).abs();
    }
    assert!(
        gaps[0] < 0.01 && gaps[1] < gaps[0] * 1e-3_f64.powf(0.25),
        "{gaps:?}"
    );
    Ok(())
}

/// In a half space stress at the centres of cells is not reciprocal: what the ledger leaves over is the work of the
/// matrix' skew part, and falls with the square of the cells.
#[test]
fn in_a_half_space_the_skew_part_is_left_over() -> Outcome {
    let left_over = |size: f64| -> Outcome<f64> {
        let cells = cells([0.0, 10e3], size)?;
        let fault = PlaneFault::half_space(cells, 90.0, MEDIUM, POISSON_RATIO)?;
        let balance = run(&fault.with_rake(0.0)?, 1e-4)?.balance;
        Ok((balance.left_over / balance.friction).abs())
    };
    let [coarse, fine] = [left_over(1e3)?, left_over(500.0)?];
    assert!(coarse < 1e-4 && fine > 1e-9, "{coarse:e} {fine:e}");
    assert!(fine < coarse / 2.0, "{coarse:e} {fine:e}");
    Ok(())
}
