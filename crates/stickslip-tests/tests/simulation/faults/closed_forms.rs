//! Motions of faults that are known.

use nalgebra::{DMatrix, Vector1};
use stickslip::bie::{Cells, Fault, Medium, Mode};
use stickslip::friction::Tresca;
use stickslip::integrate::Stepper;
use stickslip::state::LogTheta;
use stickslip::{
    BackwardEuler, Components, Contact, DenseNewton, ErrorControl, Run, RungeKutta, Scene,
    Simulation, Steps,
};

use super::{AGING, MEDIUM, NORMAL, PLATE, fault, law, whole};
use crate::Outcome;

/// A drop `d` below the shear stress at once moves the fault at `2 d/(rho c_s)`, until waves come back from its ends.
#[test]
fn a_sudden_stress_drop_is_radiated() -> Outcome {
    let fault = whole(Cells::new([0.0, 100e3], 50)?)?;
    let (drop, coefficient) = (3e6, 0.6);
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(
            Contact::new(&fault, Tresca { coefficient }, NORMAL)
                .with_shear_stress(Vector1::new(coefficient * NORMAL + drop)),
        );
    let mut motion = RungeKutta::new(scene)?;
    let density = MEDIUM.shear_modulus / MEDIUM.shear_wave_speed.powi(2);
    let exact = 2.0 * drop / (density * MEDIUM.shear_wave_speed);
    let contact = motion.snapshot().contact(0);
    for k in 0..contact.len() {
        assert!((contact.slip_rate(k) / exact - 1.0).abs() < 1e-12);
    }
    // The fault stiffens as it slips: 2 mu/(pi length) on a cell, over 1e-3 s.
    motion.step(1e-3)?;
    let slip = motion.snapshot().contact(0).slip(25);
    let stiffening = 2.0 * MEDIUM.shear_modulus / 2e3 * 1e-3 * exact / drop;
    assert!((slip / (exact * 1e-3) - 1.0).abs() < stiffening, "{slip:e}");
    Ok(())
}

/// A fault that slips as fast as the plate below slips on.
#[test]
fn a_fault_that_follows_the_plate_is_not_stressed() -> Outcome {
    let fault = fault()?;
    let friction = law(0.02);
    let steady = LogTheta((AGING.slip_distance / PLATE).ln());
    let strength = NORMAL * (0.6 + 0.005 * (PLATE / 1e-6).ln());
    let radiated = 0.5 * MEDIUM.shear_modulus / MEDIUM.shear_wave_speed * PLATE;
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_load_history(fault.plate_loading(PLATE))
        .with_contact(
            Contact::new(&fault, friction, NORMAL)
                .with_state(AGING, steady)
                .with_shear_stress(Vector1::new(strength + radiated)),
        );
    let mut motion = RungeKutta::new(scene)?;
    motion.run(&Steps::adaptive(1e-6).until(1e9), |_| ())?;
    let contact = motion.snapshot().contact(0);
    // The law without a cut-off differs from the one with it by a (Vm/V)^2, far below rounding.
    for k in 0..contact.len() {
        assert!((contact.slip_rate(k) / PLATE - 1.0).abs() < 1e-6, "{k}");
        assert!((contact.slip(k) - 1.0).abs() < 1e-6, "{k}");
    }
    Ok(())
}

/// While the stress is what it was, `V theta^(b/a)` stays: `theta' = 1 - V theta/L` is an equation of its own, here
/// `theta' = 1 - (theta/theta_0)^(1 - b/a) V_0 theta_0/L`.
#[test]
fn slip_rate_and_state_follow_each_other_under_a_constant_stress() -> Outcome {
    // Cells so long that slip of micrometres does not matter.
    let fault = whole(Cells::new([-1e9, 1e9], 3)?)?;
    let (friction, rate, end) = (law(0.010), 1e-9_f64, 4095.0);
    let start = 8e3_f64;
    let stress = NORMAL
        * friction.a
        * (rate / 2e-6 * ((0.6 + 0.015 * (1e-6 * start / 8e-3).ln()) / friction.a).exp()).asinh();
    let radiated = 0.5 * MEDIUM.shear_modulus / MEDIUM.shear_wave_speed * rate;
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(
            Contact::new(&fault, friction, NORMAL)
                .with_state(AGING, LogTheta(start.ln()))
                .with_shear_stress(Vector1::new(stress + radiated)),
        );
    let mut motion = RungeKutta::new(scene)?;
    let plan = Steps::adaptive(1e-9)
        .with_error_control(ErrorControl::default())
        .until(end);
    Run::run(&mut motion, &plan, |_| ())?;
    // The equation by Heun's method in 1e5 steps: an error of some (end/theta_0/1e5)^2.
    let ratio = 0.015 / friction.a;
    let slope = |theta: f64| 1.0 - rate * start / 8e-3 * (theta / start).powf(1.0 - ratio);
    let (mut theta, dt) = (start, end / 1e5);
    for _ in 0..100_000 {
        let first = slope(theta);
        theta += 0.5 * dt * (first + slope(theta + dt * first));
    }
    let contact = motion.snapshot().contact(0);
    let exact = rate * (theta / start).powf(-ratio);
    assert!((contact.state(1) - theta.ln()).abs() < 1e-7);
    // eta V and slip add some 1e-9 of a sigma.
    assert!((contact.slip_rate(1) / exact).ln().abs() < 1e-6);
    Ok(())
}

/// The complementary error function, by Simpson's rule on its integral: what is left of it beyond 6 is 2e-17.
fn erfc(x: f64) -> f64 {
    let (count, step) = (2000, (6.0 - x).max(0.0) / 2000.0);
    let sum: f64 = (0..=count)
        .map(|i| {
            let weight = [2.0, 4.0][i % 2] - f64::from(u8::from(i == 0 || i == count));
            weight * (-(x + i as f64 * step).powi(2)).exp()
        })
        .sum();
    2.0 / std::f64::consts::PI.sqrt() * sum * step / 3.0
}

/// A line source at constant overpressure `p*` in a fault under constant friction `f`: slip ends at `a = lambda sqrt(4
/// alpha t)`, where `(1 - tau_0/(f sigma_0)) sigma_0/p* = (2/pi) int_0^(pi/2) erfc(lambda sin u) du`, and is
/// `(f p* a/mu) D(x/a)` (R. Viesca, J. Fluid Mech. 919 (2021)). Half of the fault by images.
#[test]
fn a_fluid_drives_a_crack_that_stays_similar_to_itself() -> Outcome {
    let (lambda, friction, normal, pressure) = (1.025_244_054_9, 0.6, 50e6, 5e6);
    // The left-hand side is 0.4.
    let shear = friction * (normal - 0.4 * pressure);
    let quarter = std::f64::consts::FRAC_PI_2;
    let mean: f64 = (0..500)
        .map(|i| erfc(lambda * (quarter * (f64::from(i) + 0.5) / 500.0).sin()) / 500.0)
        .sum();
    assert!((mean - 0.4).abs() < 1e-6, "{mean}");
    // sqrt(4 alpha) = 1 m/s^(1/2).
    let (count, end) = (300, 1e4_f64);
    let front = lambda * end.sqrt();
    let fault = Fault::half_space(Cells::new([0.0, 1.5 * front], count)?, MEDIUM)?;
    let centers = fault.cells().map(|x| x);
    let scene = Scene::new(DMatrix::from(&fault.stiffness())).with_contact(
        Contact::new(
            &fault,
            Tresca {
                coefficient: friction,
            },
            normal,
        )
        .with_shear_stress(Vector1::new(shear))
        .with_normal_stress_history(move |time, stress| {
            for (stress, x) in stress.iter_mut().zip(&centers) {
                let reach = time.max(0.0).sqrt();
                *stress -= pressure * if reach > 0.0 { erfc(x / reach) } else { 0.0 };
            }
        }),
    );
    let mut crack = Simulation::new(scene, BackwardEuler, DenseNewton::new())?;
    crack.run(&Steps::constant(end / 4.0).until(end), |_| ())?;
    let contact = crack.snapshot().contact(0);
    // The front is known to some cells, slip to the share of a cell in the crack: of first order.
    let length = fault.cells().length();
    let reached = (0..count).take_while(|&k| contact.slip(k) > 0.0).count() as f64 * length;
    assert!((reached - front).abs() < 2.0 * length, "{reached} {front}");
    let scale = friction * pressure * front / MEDIUM.shear_modulus;
    for (x, exact) in [
        (0.0, 0.53709431),
        (0.2, 0.46358284),
        (0.4, 0.32870255),
        (0.6, 0.18576162),
        (0.8, 0.06601876),
    ] {
        let place = (0..count).min_by(|&a, &b| {
            let off = |k: usize| (fault.cells().center(k) - x * front).abs();
            off(a).total_cmp(&off(b))
        });
        let k = place.ok_or("no cell")?;
        let off = (fault.cells().center(k) / front - x).abs();
        let slip = contact.slip(k) / scale;
        // The steepest that D is there, and a cell of 200.
        assert!(
            (slip - exact).abs() < 1.5 * off + 0.01 * exact,
            "{x}: {slip} {exact}"
        );
    }
    Ok(())
}

/// A crack under Coulomb's friction that radiation damps comes to rest: to wait for twice and four times as long takes some
/// steps more, and no slip.
#[test]
fn a_crack_at_rest_takes_no_steps() -> Outcome {
    let cells = 64;
    for tolerance in [1e-3, 1e-4, 1e-6] {
        let run = |end: f64| -> Outcome<(usize, f64)> {
            let rock = Medium {
                shear_modulus: 1.0,
                shear_wave_speed: 1.0,
            };
            let fault = Fault::periodic(Cells::new([-2.0, 2.0], cells)?, rock, Mode::Antiplane)?;
            let (left, right) = (fault.section([-2.0, -1.0])?, fault.section([1.0, 2.0])?);
            let crack = fault.section([-1.0, 1.0])?;
            let contact = Contact::new(&crack, Tresca { coefficient: 0.5 }, 1.0)
                .with_shear_stress(Vector1::new(1.5));
            let scene = Scene::new(fault.stiffness())
                .with_viscosity(fault.radiation_damping())
                .with_contact(contact)
                .fix(&left, Components::ALL)
                .fix(&right, Components::ALL);
            let mut crack = RungeKutta::new(scene)?;
            let steps = Steps::adaptive(tolerance).with_max_steps(20_000).until(end);
            let report = crack.run(&steps, |_| ())?;
            let slip = crack.snapshot().displacement[cells / 2][0];
            Ok((report.accepted + report.rejected, slip))
        };
        let [(some, _), (more, slip), (most, later)] = [run(20.0)?, run(40.0)?, run(80.0)?];
        let counts = [some, more, most];
        assert!(
            2 * more < 3 * some && most <= more + 50,
            "{tolerance:e}: {counts:?}"
        );
        assert!(
            (later - slip).abs() <= 10.0 * tolerance * slip,
            "{slip}, {later}"
        );
    }
    Ok(())
}
