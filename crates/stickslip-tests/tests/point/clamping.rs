//! Normal stress that follows the displacement.

use nalgebra::{DMatrix, SMatrix, SVector, Vector1, Vector2};
use stickslip::friction::{DieterichRuina, Tresca};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BoundaryPart, Contact, DenseNewton, GeneralizedAlpha, NormalStressChange, Point, RungeKutta,
    Scene, SceneError, Simulation, StepError, Steps,
};

use crate::Outcome;

/// A normal stress change per displacement [Pa/m], at one vertex.
struct Wedge(f64);

impl<const C: usize> NormalStressChange<C> for Wedge {
    fn vertex_count(&self) -> usize {
        1
    }

    fn add(&self, scale: f64, displacement: &[SVector<f64, C>], normal_stress: &mut [f64]) {
        normal_stress[0] += scale * self.0 * displacement[0][0];
    }
}

const STIFFNESS: f64 = 1e6;
const DAMPING: f64 = 1e5;
const COEFFICIENT: f64 = 0.5;
const NORMAL: f64 = 1e4;
pub(crate) const PULL: f64 = 0.1;

/// A block on a spring that is pulled at `PULL`, from the stress at which it begins to slide; a plate at `plate`.
pub(crate) fn block(wedge: f64, plate: f64, opens: bool) -> Scene<SMatrix<f64, 1, 1>, 1> {
    let friction = Tresca {
        coefficient: COEFFICIENT,
    };
    let mut contact = Contact::new(BoundaryPart::point(1.0), friction, NORMAL);
    if opens {
        contact = contact.allow_opening();
    }
    Scene::new(SMatrix::<f64, 1, 1>::new(STIFFNESS))
        .with_viscosity(SMatrix::<f64, 1, 1>::new(DAMPING))
        .with_contact(contact)
        .with_normal_stress_change(Wedge(wedge), Vector1::new(plate))
        .with_load_history(|time, load| load[0][0] = COEFFICIENT * NORMAL + STIFFNESS * PULL * time)
}

/// The displacement of the block in time: Coulomb friction under `sigma_0 + N (u - V_p t)`: `eta u' + (k + f N) u = (k V + f N V_p) t`, with the solution
/// `c (t - T (1 - exp(-t/T)))`, `T = eta/(k + f N)`, `c = (k V + f N V_p)/(k + f N)`.
pub(crate) fn slid(wedge: f64, plate: f64, time: f64) -> f64 {
    let growth = STIFFNESS + COEFFICIENT * wedge;
    let decay = DAMPING / growth;
    let rate = (STIFFNESS * PULL + COEFFICIENT * wedge * plate) / growth;
    rate * (time - decay * -(-time / decay).exp_m1())
}

#[test]
fn a_wedge_slides_as_its_closed_form() -> Outcome {
    for (wedge, plate) in [(4e5, 0.0), (-4e5, 0.0), (8e5, 0.05), (0.0, 0.1)] {
        let mut motion = RungeKutta::new(block(wedge, plate, false))?;
        motion.run(&Steps::adaptive(1e-10).until(0.3), |at| {
            let u = at.displacement[0][0];
            let left = (u - slid(wedge, plate, at.time)).abs();
            assert!(left < 1e-10 * PULL, "{wedge} {}", at.time);
            let normal = NORMAL + wedge * (u - plate * at.time);
            let found = at.contact(0).normal_stress(0);
            assert!((found - normal).abs() < 1e-12 * NORMAL, "{wedge}");
        })?;
    }
    Ok(())
}

/// A tension ends the run with the last accepted state; a contact that may open slides against its damper alone.
#[test]
fn tension_is_an_error_or_opens_the_contact() -> Outcome {
    let mut motion = RungeKutta::new(block(-1e6, 0.0, false))?;
    let failure = motion
        .run(&Steps::adaptive(1e-8).until(1.0), |_| ())
        .err()
        .ok_or("no tension")?;
    assert!(
        matches!(failure.cause, StepError::Tension { .. }),
        "{failure}"
    );
    assert!(motion.snapshot().displacement[0][0] < NORMAL / 1e6);

    let mut motion = RungeKutta::new(block(-1e6, 0.0, true))?;
    let mut opened = None;
    motion.run(&Steps::adaptive(1e-10).until(1.0), |at| {
        if at.contact(0).normal_stress(0) == 0.0 {
            opened.get_or_insert((at.time, at.displacement[0][0]));
        }
    })?;
    let (begin, from) = opened.ok_or("never open")?;
    // eta u' + k u = f sigma_0 + k V t from there on.
    let (t, decay) = (1.0 - begin, DAMPING / STIFFNESS);
    let settled = |time: f64| COEFFICIENT * NORMAL / STIFFNESS + PULL * (time - decay);
    let exact = settled(1.0) + (from - settled(begin)) * (-t / decay).exp();
    let slid = motion.snapshot().displacement[0][0];
    assert!((slid - exact).abs() < 1e-9, "{slid} {exact}");
    Ok(())
}

/// The state of a contact with the effect of Linker and Dieterich sees the change as if it were given in time:
/// `theta sigma^(alpha/b)` evolves as without it. Here both follow one displacement.
#[test]
fn a_state_follows_the_change() -> Outcome {
    let friction = DieterichRuina {
        a: 0.015,
        b: 0.010,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 1e-3,
    };
    let aging = Dieterich {
        slip_distance: 1e-3,
    };
    let (rate, wedge, until) = (1e-4, 2e6, 20.0);
    let run = |follows: bool| -> Outcome<f64> {
        let mut contact = Contact::new(BoundaryPart::point(1.0), friction, 1e4)
            .with_state(aging, LogTheta((1e-3_f64 / rate).ln()))
            .with_normal_stress_effect(0.3 / 0.010);
        if !follows {
            contact = contact
                .with_normal_stress_history(move |time, stress| stress[0] += wedge * rate * time);
        }
        // A damper so stiff that it moves the contact at `rate` whatever friction does.
        let mut scene = Scene::new(SMatrix::<f64, 1, 1>::new(0.0))
            .with_viscosity(SMatrix::<f64, 1, 1>::new(1e15))
            .with_contact(contact)
            .with_load(vec![Vector1::new(1e15 * rate)]);
        if follows {
            scene = scene.with_normal_stress_change(Wedge(wedge), Vector1::new(0.0));
        }
        let mut motion = RungeKutta::new(scene)?;
        motion.run(&Steps::adaptive(1e-10).until(until), |_| ())?;
        Ok(motion.snapshot().contact(0).state(0))
    };
    let [follows, given] = [run(true)?, run(false)?];
    assert!((follows - given).abs() < 1e-7, "{follows} {given}");
    // Without evolution the state would fall by the effect times ln(sigma/sigma_0); it recovers to its steady value.
    assert!((given - (1e-3_f64 / rate).ln()).abs() > 1e-2, "{given}");
    Ok(())
}

#[test]
fn what_has_no_energy_is_refused() -> Outcome {
    let surface = BoundaryPart {
        points: vec![[0.0; 3]],
        normals: vec![[0.0, -1.0, 0.0]],
        dimension: 2,
        ..BoundaryPart::point(1.0)
    };
    let free = Contact::new(surface, Tresca { coefficient: 0.5 }, NORMAL);
    let scene = Scene::new(SMatrix::<f64, 2, 2>::identity() * STIFFNESS)
        .with_contact(free.with_free_normal())
        .with_normal_stress_change(Wedge(1.0), Vector2::zeros());
    let refused = Simulation::new(scene, GeneralizedAlpha::default(), Point);
    assert!(matches!(
        refused.err(),
        Some(SceneError::Unsupported {
            by: SceneError::IMPLICIT,
            ..
        })
    ));
    let skew = || DMatrix::from_row_slice(2, 2, &[2.0, 1.0, 0.0, 2.0]);
    let massive = Scene::<DMatrix<f64>, 1>::new(skew()).with_mass(DMatrix::identity(2, 2));
    let refused = Simulation::new(massive, GeneralizedAlpha::default(), DenseNewton::new());
    assert!(matches!(
        refused.err(),
        Some(SceneError::NotSymmetric { .. })
    ));
    let scene = Scene::new(SMatrix::<f64, 2, 2>::new(2.0, 1.0, 0.0, 2.0));
    let refused = Simulation::new(scene, GeneralizedAlpha::default(), Point);
    assert!(matches!(
        refused.err(),
        Some(SceneError::NotSymmetric { .. })
    ));
    for wrong in [f64::NAN, f64::INFINITY] {
        for scene in [block(wrong, 1.0, false), block(1.0, wrong, false)] {
            let refused = RungeKutta::new(scene).err();
            assert!(matches!(refused, Some(SceneError::Value { .. })), "{wrong}");
        }
    }
    Ok(())
}
