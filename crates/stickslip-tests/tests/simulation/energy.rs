//! The energy balance of Newmark's scheme with friction, without and with Kelvin-Voigt viscosity.
//!
//! With the average acceleration, `u_n - u_o = dt/2 (v_n + v_o)` and `v_n - v_o = dt/2 (a_n + a_o)`.
//! Testing the mean of the two equations of motion with the way `u_n - u_o` therefore gives, with
//! nothing neglected,
//!
//! ```text
//! change of (v.M v + u.A u)/2 = (u_n - u_o) . ( mean load - mean friction - mean viscosity + mean reaction )
//! ```
//!
//! with the frictional force `w sigma_n mu(V, alpha) v/V` and the viscous force `C v` at each of the two
//! times.

use nalgebra::Vector2;
use stickslip::fem::{body_force, elasticity, mass};
use stickslip::friction::FrictionLaw;
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::LogTheta;
use stickslip::{BlockMatrix, Contact, Matrix, Newmark, Operator, Simulation, Snapshot, Tnnmg};

use crate::Outcome;
use crate::common::{STEP, body};

type Field = Vec<Vector2<f64>>;

/// Stress of viscosity over that of elasticity, at the same rate [s].
const VISCOUS_TIME: f64 = 1e-3;

/// The terms of the balance at one time.
struct Moment {
    displacement: Field,
    /// Kinetic and elastic energy [J/m].
    energy: f64,
    /// Load and reactions of the moved boundary [N/m].
    drive: Field,
    /// Frictional forces by the law [N/m].
    friction: Field,
    /// `C v` [N/m].
    viscosity: Field,
    /// The largest difference of the law's force and the one that acts.
    defect: f64,
    /// The largest difference of these forces and those that the library shows.
    shown_defect: f64,
}

#[test]
fn energy_changes_by_work_and_dissipation() -> Outcome {
    let [friction, viscosity] = shares_of_the_loss(0.0)?;
    assert!(friction > 0.1, "{friction}");
    assert_eq!(viscosity, 0.0);
    Ok(())
}

#[test]
fn viscosity_takes_its_share() -> Outcome {
    let [friction, viscosity] = shares_of_the_loss(VISCOUS_TIME)?;
    assert!(friction > 0.1, "{friction}");
    assert!(viscosity > 1e-3, "{viscosity}");
    Ok(())
}

/// Runs the slider through its first event with the viscosity `C = time A`, balances every step and the
/// whole, and returns what friction and viscosity took, as shares of what was supplied.
fn shares_of_the_loss(time: f64) -> Outcome<[f64; 2]> {
    let body = body(2);
    let space = body.space()?;
    let stiffness = elasticity(&space, &body.elastic)?;
    let mass = mass(&space, body.density)?;
    let damping = BlockMatrix::combination(&[(time, &stiffness)]);
    let load = body_force(&space, |_| Vector2::new(0.0, -body.density * body.gravity));
    let bottom = PippingSlider::bottom(&space)?;
    let top = space.trace(|x| x[1] == 1.0)?;
    let zeros = || vec![Vector2::<f64>::zeros(); space.vertex_count()];

    let moment = |at: &Snapshot<'_, 2>| -> Outcome<Moment> {
        let mut residual = load.clone();
        mass.multiply_add(-1.0, at.acceleration, &mut residual);
        stiffness.multiply_add(-1.0, at.displacement, &mut residual);
        let mut viscosity = zeros();
        damping.multiply_add(1.0, at.velocity, &mut viscosity);
        for (residual, viscosity) in residual.iter_mut().zip(&viscosity) {
            *residual -= viscosity;
        }
        let (mut drive, mut friction) = (load.clone(), zeros());
        let mut shown_defect = 0_f64;
        for &p in top.vertices() {
            let shown = at.reaction_at(p)? + residual[p];
            shown_defect = shown_defect.max(shown.amax());
            drive[p] -= residual[p];
            residual[p] = Vector2::zeros();
        }
        for (k, &p) in bottom.vertices().iter().enumerate() {
            let contact = at.contact(0);
            let mu = FRICTION.coefficient(contact.slip_rate(k), LogTheta(contact.state(k)));
            let sign = at.velocity[p][0].signum();
            friction[p][0] = bottom.weights()[k] * NORMAL_STRESS * mu * sign;
            let shown = contact.traction(k) * contact.weight(k) - friction[p];
            let support = at.reaction_at(p)?[1] + residual[p][1];
            shown_defect = shown_defect.max(shown.amax()).max(support.abs());
            // The support from below does no work.
            residual[p] = Vector2::new(residual[p][0] - friction[p][0], 0.0);
        }
        Ok(Moment {
            displacement: at.displacement.to_vec(),
            energy: 0.5 * (mass.quadratic(at.velocity) + stiffness.quadratic(at.displacement)),
            drive,
            friction,
            viscosity,
            defect: residual.iter().map(|r| r.amax()).fold(0.0, f64::max),
            shown_defect,
        })
    };

    let contact = Contact::new(&bottom, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let mut scene = body.scene(&space)?.with_contact(contact);
    if time > 0.0 {
        scene = scene.with_viscosity(damping.clone());
    }
    let solver = Tnnmg::new(space.transfers());
    let mut slider =
        Simulation::new(scene, Newmark::default(), solver)?.with_absolute_tolerance(1e-13)?;
    let mut before: Option<Moment> = None;
    let (mut peak, mut started, mut supplied, mut lost) = (0_f64, 0.0, 0.0, [0.0; 2]);
    for _ in 0..6900 {
        slider.step(STEP)?;
        let at = slider.snapshot();
        let now = moment(&at)?;
        peak = peak.max(at.max_slip_rate());
        // The first time at which friction follows the law: the initial state is at rest.
        let Some(old) = before.replace(now) else {
            started = before.as_ref().map_or(0.0, |first| first.energy);
            continue;
        };
        let Some(now) = &before else { continue };
        let defects = [now.defect, now.shown_defect];
        assert!(
            defects.iter().all(|&defect| defect < 1e-6),
            "t = {}: {defects:?} N",
            at.time
        );
        let work = |force: fn(&Moment) -> &Field| -> f64 {
            let (new, old_force) = (force(now), force(&old));
            (0..new.len())
                .map(|p| {
                    let way = now.displacement[p] - old.displacement[p];
                    0.5 * way.dot(&(new[p] + old_force[p]))
                })
                .sum()
        };
        let [drive, friction, viscosity] = [
            work(|moment| &moment.drive),
            work(|moment| &moment.friction),
            work(|moment| &moment.viscosity),
        ];
        let imbalance = now.energy - old.energy - drive + friction + viscosity;
        // The tolerance of the solver, and rounding of the energies.
        let terms = drive.abs() + friction.abs() + viscosity.abs();
        assert!(
            imbalance.abs() < 1e-10 * terms + 2e-14 * now.energy,
            "t = {}: {imbalance:e} of {drive:e}, {friction:e}, {viscosity:e}, {:e}",
            at.time,
            now.energy
        );
        supplied += drive;
        lost[0] += friction;
        lost[1] += viscosity;
    }
    let ended = before.map_or(0.0, |last| last.energy);
    assert!(peak > 5e-3, "no event");
    let imbalance = ended - started - supplied + lost[0] + lost[1];
    assert!(imbalance.abs() < 1e-12 * supplied, "{imbalance:e}");
    Ok(lost.map(|lost| lost / supplied))
}
