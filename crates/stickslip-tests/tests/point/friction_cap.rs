//! Forced ruptures of any law: a cap of friction, on blocks in closed form and behind a front along a fault; an overstress.

use nalgebra::{SMatrix, Vector1};
use stickslip::bie::{Cells, Fault, Medium, Mode, Overstress};
use stickslip::friction::{ForcedCap, FrictionLaw, RegularizedDieterichRuina, StrongRateWeakening};
use stickslip::state::LogTheta;
use stickslip::{
    BoundaryPart, CentralDifferences, Contact, GeneralizedAlpha, Newmark, Point, RungeKutta, Scene,
    SceneError, Simulation, Steps,
};

use crate::Outcome;

type Operator = SMatrix<f64, 1, 1>;

const NORMAL: f64 = 1e6;
const PULL: f64 = 0.45e6;
const VISCOSITY: f64 = 1e6;
const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.010,
    b: 0.012,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 8e-3,
};
const CAP: ForcedCap = ForcedCap {
    rupture_time: 0.4,
    duration: 0.5,
    static_friction: 0.7,
    dynamic_friction: 0.2,
};

/// `x` with `F = pull/sigma`, at which the cap lets the block go.
fn release() -> f64 {
    let wanted = (PULL / NORMAL - 0.2) / 0.5;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..100 {
        let x: f64 = 0.5 * (low + high);
        if x * x * (2.0 - x) < wanted {
            low = x;
        } else {
            high = x;
        }
    }
    low
}

/// The integral over time of what the cap leaves of the pull, up to a time after the ramp \[Pa s\].
fn impulse(time: f64) -> f64 {
    let primitive = |x: f64| {
        (PULL - 0.2 * NORMAL) * x - 0.5 * NORMAL * (2.0 / 3.0 * x.powi(3) - 0.25 * x.powi(4))
    };
    CAP.duration * primitive(release()) + (PULL - 0.2 * NORMAL) * (time - 0.9)
}

/// A block that rests but for a creep of 1e-12 m/s, until the cap lets it go.
fn scene<L: FrictionLaw<State = LogTheta> + 'static>(law: L) -> Scene<Operator, 1> {
    below(law, CAP)
}

/// The same below another cap.
fn below<L: FrictionLaw<State = LogTheta> + 'static>(law: L, cap: ForcedCap) -> Scene<Operator, 1> {
    let aging = LAW.aging();
    let psi = LAW.in_psi().state_of_friction(PULL / NORMAL, 1e-12);
    let contact = Contact::new(BoundaryPart::point(1.0), law, NORMAL)
        .with_state(aging, LAW.aging_in_psi().log_theta(psi))
        .with_friction_cap(cap);
    Scene::new(Operator::zeros())
        .with_contact(contact)
        .with_load_history(|_, load| load[0][0] = PULL)
}

#[test]
fn a_block_with_viscosity_slips_by_the_closed_form() -> Outcome {
    let exact = impulse(1.2) / VISCOSITY;
    let damped = || scene(LAW).with_viscosity(Operator::new(VISCOSITY));
    let mut explicit = RungeKutta::new(damped())?;
    let steps = Steps::adaptive(1e-8).stopping_at([0.4, 0.9]).until(1.2);
    explicit.run(&steps, |at| {
        let own = at.contact(0);
        assert!(own.coefficient(0) <= CAP.cap(at.time));
    })?;
    let found = explicit.snapshot().contact(0).slip(0);
    assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact}");
    let by_steps = |count: u32| -> Outcome<f64> {
        let mut implicit = Simulation::new(damped(), GeneralizedAlpha::default(), Point)?;
        let steps = Steps::constant(1.2 / f64::from(count)).until(1.2);
        implicit.run(&steps, |_| ())?;
        Ok((implicit.snapshot().contact(0).slip(0) / exact - 1.0).abs())
    };
    let [coarse, fine] = [by_steps(150)?, by_steps(1200)?];
    // Of second order but for the release, which falls anywhere between two steps.
    assert!(coarse < 1e-4 && fine < 1e-5, "{coarse} {fine}");
    Ok(())
}

/// The momentum of a block with mass is the impulse, also by the law as a stranger's, without closed forms.
#[test]
fn a_block_with_mass_gains_the_impulse() -> Outcome {
    struct Own;
    impl FrictionLaw for Own {
        type State = LogTheta;
        fn coefficient(&self, slip_rate: f64, state: LogTheta) -> f64 {
            LAW.coefficient(slip_rate, state)
        }
        fn coefficient_rate_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
            LAW.coefficient_rate_slope(slip_rate, state)
        }
        fn potential(&self, slip_rate: f64, state: LogTheta) -> f64 {
            LAW.potential(slip_rate, state)
        }
    }
    let mass = 1e5;
    let exact = impulse(1.2) / mass;
    let steps = Steps::constant(1e-3).until(1.2);
    let own = || scene(Own).with_mass(Operator::new(mass));
    let mut implicit = Simulation::new(own(), Newmark::default(), Point)?;
    implicit.run(&steps, |_| ())?;
    let mut explicit = Simulation::new(own(), CentralDifferences, Point)?;
    explicit.run(&steps, |_| ())?;
    for at in [implicit.snapshot(), explicit.snapshot()] {
        let found = at.contact(0).slip_rate(0);
        // Central differences have the velocity of half a step before.
        assert!((found / exact - 1.0).abs() < 2e-3, "{found} {exact}");
    }
    Ok(())
}

/// A run goes on from the middle of the ramp by the same bits, and not below another cap.
#[test]
fn a_run_goes_on_from_the_ramp() -> Outcome {
    use crate::checkpoint::Place;
    use stickslip::Checkpoint;
    use stickslip::record::FileError;

    let place = Place::new("cap")?;
    let of = || RungeKutta::new(scene(LAW).with_viscosity(Operator::new(VISCOSITY)));
    let steps = |time| Steps::adaptive(1e-6).until(time);
    let mut whole = of()?;
    whole.run(&steps(0.75), |_| ())?;
    let file = Checkpoint::at(place.file("ramp"));
    file.save(&whole.snapshot(), &())?;
    let mut other = of()?;
    file.restore::<(), 1>(&mut other)?;
    whole.run(&steps(1.0), |_| ())?;
    other.run(&steps(1.0), |_| ())?;
    let slips = [&whole, &other].map(|own| own.snapshot().contact(0).slip(0));
    assert!(slips[0].to_bits() == slips[1].to_bits() && slips[0] > 0.0);

    let later = ForcedCap {
        rupture_time: 0.5,
        ..CAP
    };
    let scene = below(LAW, later).with_viscosity(Operator::new(VISCOSITY));
    let refused = file.restore::<(), 1>(&mut RungeKutta::new(scene)?);
    let named = |error: &FileError| error.to_string().contains("cap of friction");
    assert!(refused.as_ref().is_err_and(named), "{refused:?}");
    Ok(())
}

const MEDIUM: Medium = Medium {
    shear_modulus: 32.04e9,
    shear_wave_speed: 3464.0,
};
const FLASH: StrongRateWeakening = StrongRateWeakening {
    a: 0.01,
    b: 0.014,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 0.4,
    weakened_friction: 0.2,
    weakening_velocity: 0.1,
};
/// Shear stress and normal stress \[Pa\] of the faults below.
const STRESS: [f64; 2] = [40e6, 120e6];

/// Places, slip rates, coefficients of friction and states of a fault of cells of 100 m after 1.5 s, with caps and an overstress.
fn forced(caps: Option<fn(f64) -> ForcedCap>, overstress: f64) -> Outcome<Vec<[f64; 4]>> {
    let fault = Fault::whole_space(Cells::new([-10e3, 10e3], 200)?, MEDIUM, Mode::Antiplane)?;
    let places = fault.cells().map(|z| z);
    let [shear, normal] = STRESS;
    let mut contact = Contact::new(&fault, FLASH, normal)
        .with_state(
            FLASH.evolution(),
            FLASH.state_of_friction(shear / normal, 1e-16),
        )
        .with_shear_stress(Vector1::new(shear));
    if let Some(cap) = caps {
        let each: Vec<_> = places.iter().map(|z| cap(z.abs())).collect();
        contact = contact.with_friction_cap(each);
    }
    let patch = Overstress::new(overstress, 3e3, 1.0)?;
    let distances: Vec<_> = places.iter().map(|z| z.abs()).collect();
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(contact)
        .with_load_history(patch.load(&distances, Vector1::new(100.0)));
    let mut rupture = RungeKutta::new(scene)?;
    rupture.run(&Steps::adaptive(1e-6).until(1.5), |_| ())?;
    let at = rupture.snapshot();
    let own = at.contact(0);
    let one = |(k, z): (usize, &f64)| [*z, own.slip_rate(k), own.coefficient(k), own.state(k)];
    Ok(places.iter().enumerate().map(one).collect())
}

/// A front at 2 km/s out to 4 km, friction down to 0.25 within 400 m behind it; a symmetric fault.
#[test]
fn friction_falls_behind_a_front() -> Outcome {
    let cap = |r: f64| match r {
        0.0..4e3 => ForcedCap::behind_front(r, 2e3, 400.0, [0.6, 0.25]),
        _ => ForcedCap::none(),
    };
    let cells = forced(Some(cap), 0.0)?;
    for [z, rate, coefficient, state] in &cells {
        assert!(*coefficient <= cap(z.abs()).cap(1.5) && state.is_finite());
        if z.abs() < 2.5e3 {
            assert!(
                *rate > 0.1 && *coefficient <= 0.25,
                "{z} {rate} {coefficient}"
            );
        }
        // Ahead of the front and of the stress that it throws forward.
        if z.abs() > 8e3 {
            assert!(*rate < 1e-9, "{z} {rate}");
        }
    }
    for (left, right) in cells.iter().zip(cells.iter().rev()) {
        assert!(
            (left[1] / right[1] - 1.0).abs() < 1e-3,
            "{left:?} {right:?}"
        );
    }
    // Caps that never hold change nothing.
    let none = forced(Some(|_| ForcedCap::none()), 50e6)?;
    assert_eq!(none, forced(None, 50e6)?);
    // The overstress alone, 50 MPa within 3 km in 1 s, lets its patch go, with the law of any state.
    assert!(none.iter().any(|cell| cell[1] > 0.1) && none[0][1] < 1e-9);
    Ok(())
}

#[test]
fn unusable_caps_are_refused() {
    let scene = |caps: Vec<ForcedCap>| {
        let contact = Contact::new(BoundaryPart::point(1.0), LAW, NORMAL)
            .with_state(LAW.aging(), LogTheta(0.0))
            .with_friction_cap(caps);
        let scene = Scene::new(Operator::new(1e9)).with_contact(contact);
        RungeKutta::new(scene.with_viscosity(Operator::new(1.0))).map(|_| ())
    };
    assert!(scene(vec![CAP]).is_ok());
    assert!(matches!(
        scene(vec![CAP; 2]),
        Err(SceneError::Length {
            expected: 1,
            found: 2,
            ..
        })
    ));
    let wrong = ForcedCap {
        duration: 0.0,
        ..CAP
    };
    assert!(matches!(scene(vec![wrong]), Err(SceneError::Friction(_))));
    let twice = Contact::<_, _, 1>::new(BoundaryPart::point(1.0), LAW, NORMAL)
        .with_state(LAW.aging(), LogTheta(0.0))
        .with_friction_cap(CAP)
        .with_friction_cap(CAP);
    let refused = RungeKutta::new(Scene::new(Operator::new(1e9)).with_contact(twice));
    assert!(matches!(
        refused.map(|_| ()),
        Err(SceneError::Repeated { .. })
    ));
}
