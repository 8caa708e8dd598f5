//! The energy balance of Newmark's scheme with friction.
//!
//! With the average acceleration, `u_n - u_o = dt/2 (v_n + v_o)` and `v_n - v_o = dt/2 (a_n + a_o)`.
//! Testing the mean of the two equations of motion with the way `u_n - u_o` therefore gives, with
//! nothing neglected,
//!
//! ```text
//! change of (v.M v + u.A u)/2 = (u_n - u_o) . ( mean load - mean friction + mean reaction )
//! ```
//!
//! with the frictional force `w sigma_n mu(V, alpha) v/V` at each of the two times.
#![cfg(all(feature = "fem", feature = "tnnmg"))]

mod common;

use nalgebra::Vector2;
use stickslip::fem::{body_force, elasticity, mass};
use stickslip::friction::FrictionLaw;
use stickslip::problems::{FRICTION, NORMAL_STRESS, Slider};
use stickslip::state::LogTheta;
use stickslip::{Operator, Snapshot};

use common::{Outcome, STEP, Solver, body, paper_slider};

type Field = Vec<Vector2<f64>>;

/// What the balance needs of one time.
struct Moment {
    displacement: Field,
    /// Kinetic and elastic energy [J/m].
    energy: f64,
    /// Load and reactions of the moved boundary [N/m].
    drive: Field,
    /// Frictional forces by the law [N/m].
    friction: Field,
    /// The largest difference of the law's force and the one that acts.
    defect: f64,
}

#[test]
fn energy_changes_by_work_and_dissipation() -> Outcome {
    let body = body(2);
    let space = body.space()?;
    let stiffness = elasticity(&space, &body.elastic)?;
    let mass = mass(&space, body.density)?;
    let load = body_force(&space, |_| Vector2::new(0.0, -body.density * body.gravity));
    let bottom = Slider::bottom(&space)?;
    let top = space.trace(|x| x[1] == 1.0)?;
    let zeros = || vec![Vector2::<f64>::zeros(); space.vertex_count()];

    let moment = |at: &Snapshot<'_, 2>| {
        let mut residual = load.clone();
        mass.multiply_add(-1.0, at.acceleration, &mut residual);
        stiffness.multiply_add(-1.0, at.displacement, &mut residual);
        let (mut drive, mut friction) = (load.clone(), zeros());
        for &p in top.vertices() {
            drive[p] -= residual[p];
            residual[p] = Vector2::zeros();
        }
        for (k, &p) in bottom.vertices().iter().enumerate() {
            let mu = FRICTION.coefficient(at.slip_rate(k), LogTheta(at.states.state(k)));
            let sign = at.velocity[p][0].signum();
            friction[p][0] = bottom.weights()[k] * NORMAL_STRESS * mu * sign;
            // The support from below does no work.
            residual[p] = Vector2::new(residual[p][0] - friction[p][0], 0.0);
        }
        Moment {
            displacement: at.displacement.to_vec(),
            energy: 0.5 * (mass.quadratic(at.velocity) + stiffness.quadratic(at.displacement)),
            drive,
            friction,
            defect: residual.iter().map(|r| r.amax()).fold(0.0, f64::max),
        }
    };

    let mut slider = paper_slider(&body, &space, Solver::Tnnmg, 1e-13)?;
    let mut before: Option<Moment> = None;
    let (mut peak, mut started, mut dissipated, mut supplied) = (0_f64, 0.0, 0.0, 0.0);
    for _ in 0..6900 {
        slider.step(STEP)?;
        let at = slider.snapshot();
        let now = moment(&at);
        peak = peak.max(at.max_slip_rate());
        // The first time at which friction follows the law: the initial state is at rest.
        let Some(old) = before.replace(now) else {
            started = before.as_ref().map_or(0.0, |first| first.energy);
            continue;
        };
        let Some(now) = &before else { continue };
        assert!(now.defect < 1e-6, "t = {}: {:e} N", at.time, now.defect);
        let work = |force: fn(&Moment) -> &Field| -> f64 {
            let (new, old_force) = (force(now), force(&old));
            (0..new.len())
                .map(|p| {
                    let way = now.displacement[p] - old.displacement[p];
                    0.5 * way.dot(&(new[p] + old_force[p]))
                })
                .sum()
        };
        let (drive, friction) = (work(|m| &m.drive), work(|m| &m.friction));
        let imbalance = now.energy - old.energy - drive + friction;
        // The tolerance of the solver, and rounding of the energies.
        let allowed = 1e-10 * (drive.abs() + friction.abs()) + 2e-14 * now.energy;
        assert!(
            imbalance.abs() < allowed,
            "t = {}: {imbalance:e} of {drive:e}, {friction:e}, {:e}",
            at.time,
            now.energy
        );
        dissipated += friction;
        supplied += drive;
    }
    let ended = before.map_or(0.0, |last| last.energy);
    assert!(peak > 5e-3, "no event");
    assert!(dissipated > 0.1 * supplied, "{dissipated} of {supplied}");
    let imbalance = ended - started - supplied + dissipated;
    assert!(imbalance.abs() < 1e-12 * supplied, "{imbalance:e}");
    Ok(())
}
