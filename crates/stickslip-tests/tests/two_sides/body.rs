//! What holds for the whole body: work and energy, equal tractions on both sides, restarts, pre-stress, boundary data.

use nalgebra::Matrix2;
use stickslip::fem::{P1, elasticity, mass};
use stickslip::friction::Tresca;
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::record::EnergyLedger;
use stickslip::state::LogTheta;
use stickslip::{
    Components, Condensed, Contact, GeneralizedAlpha, Newmark, NormalStress, Scene, SceneError,
    Simulation, Steps,
};

use crate::{ELASTIC, Outcome, largest, mirrored, square};

type Body = Simulation<2>;

/// The lower block held at its bottom, the upper one driven at its top, the pressure from the deformation.
fn held_below(space: &P1<2>) -> Outcome<Body> {
    let paper = PippingSlider::default();
    let [top, bottom] = [1.0, -1.0].map(|y| space.trace(move |x| x[1] == y));
    let contact = Contact::between(
        &space.part("plus")?,
        &space.part("minus")?,
        FRICTION,
        NormalStress::from_body(NORMAL_STRESS),
    )
    .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = Scene::new(elasticity(space, &paper.elastic)?)
        .with_mass(mass(space, paper.density)?)
        .prescribe_velocity(&top?, Components::ALL, |time| {
            [10.0 * load_velocity(time), 0.0]
        })
        .fix(&bottom?, Components::ALL)
        .with_contact(contact);
    Ok(Simulation::new(
        scene,
        Newmark::default(),
        Condensed::new(),
    )?)
}

const STEP: f64 = END / 1e4;

/// Work of the drive, friction and energy agree through an event; the two sides press on each other with opposite
/// forces, and so do the parts that hold the body; and a restart takes the same steps, bit for bit.
#[test]
fn work_reactions_and_restart_through_an_event() -> Outcome {
    let space = mirrored(2)?;
    let mut body = held_below(&space)?;
    let mut ledger = EnergyLedger::new(&body.snapshot());
    let (mut peak, mut contraction, mut saved) = (0.0_f64, 0.0_f64, None);
    for step in 0..3000 {
        body.step(STEP)?;
        ledger.record(&body.snapshot());
        let at = body.snapshot();
        peak = peak.max(at.max_slip_rate());
        contraction = contraction.max(at.report.contraction);
        if step == 2000 {
            saved = Some(at.state().clone());
        }
    }
    assert!(peak > 1e-3, "no event: {peak:e}");
    assert!(contraction < 0.5, "{contraction}");
    let sums = ledger.balance(&body.snapshot());
    let turned_over = sums.friction.abs() + sums.moved.abs();
    assert!(sums.left_over.abs() < 1e-6 * turned_over, "{sums:?}");
    let at = body.snapshot();
    let [plus, minus] = ["plus", "minus"].map(|side| space.part(side));
    let [plus, minus] = [at.reaction(&plus?)?, at.reaction(&minus?)?];
    assert!(plus[1] > 0.0 && (plus + minus).amax() <= 1e-12 * plus[1]);
    let end = at.state().clone();
    let mut again = held_below(&space)?;
    again.restore(&saved.ok_or("nothing saved")?)?;
    for _ in 2001..3000 {
        again.step(STEP)?;
    }
    assert_eq!(*again.snapshot().state(), end);
    Ok(())
}

/// A body under a uniform pre-stress in equilibrium does not move where friction holds its fault, and bears the
/// tractions of that stress there.
#[test]
fn a_prestress_is_resolved_on_the_fault() -> Outcome {
    let mesh = square(8)?
        .with_surface_where("fault", |x| x[1] == x[0] && x[0].abs() <= 1.0)?
        .split("fault")?;
    let space = P1::new(mesh).refined(1)?;
    let stress = Matrix2::new(-0.5, 0.1, 0.1, -0.7);
    let run = |coefficient| -> Outcome<[f64; 2]> {
        let contact = Contact::between(
            &space.part("fault+")?,
            &space.part("fault-")?,
            Tresca { coefficient },
            NormalStress::from_body(0.0),
        )
        .with_prestress(move |_| {
            [
                [stress[(0, 0)], stress[(0, 1)], 0.0],
                [stress[(1, 0)], stress[(1, 1)], 0.0],
                [0.0; 3],
            ]
        });
        let sides = [-2.0, 2.0].map(|x0| space.trace(move |x| x[0] == x0));
        let [left, right] = sides;
        let scene = Scene::new(elasticity(&space, &ELASTIC)?)
            .fix(&left?, Components::ALL)
            .fix(&right?, Components::ALL)
            .with_contact(contact);
        let mut body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
        body.step(1.0)?;
        let at = body.snapshot();
        let fault = at.contact(0);
        let middle = fault.len() / 2;
        let normal = nalgebra::Vector2::new(-1.0, 1.0) / 2_f64.sqrt();
        let pressure = -normal.dot(&(stress * normal));
        assert!((fault.normal_stress(middle) - pressure).abs() < 0.05);
        let along = nalgebra::Vector2::new(1.0, 1.0) / 2_f64.sqrt();
        Ok([
            largest(at.displacement.iter().copied()),
            fault.slip_vector(middle).dot(&along),
        ])
    };
    // The shear stress along the fault is (S_yy - S_xx)/2 = -.1: the upper side moves down along it.
    assert_eq!(run(0.6)?[0], 0.0);
    assert!(run(0.05)?[1] < -1e-3);
    Ok(())
}

/// A component that is prescribed on the plus side alone, where the minus side is prescribed in another one.
#[test]
fn half_of_a_pair_cannot_be_prescribed() -> Outcome {
    let space = mirrored(1)?;
    let plus = space.part("plus")?;
    let minus = space.part("minus")?;
    let contact = Contact::between(&plus, &minus, Tresca { coefficient: 0.6 }, 1.0);
    let scene = Scene::new(elasticity(&space, &ELASTIC)?)
        .fix(&plus, Components::X)
        .fix(&minus, Components::Y)
        .with_contact(contact);
    let refused = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new());
    assert!(matches!(
        refused,
        Err(SceneError::HalfHeld { component: 0, .. })
    ));
    Ok(())
}

/// Ends of a fault at driven sides: the plus side is driven alone, and its pairs have their unknown below.
#[test]
fn a_fault_ends_at_a_driven_side() -> Outcome {
    let space = mirrored(2)?;
    let side = space.trace(|x| x[0] == 0.0 && x[1] >= 0.0);
    let upper: Vec<usize> = side?
        .vertices()
        .iter()
        .copied()
        .filter(|&p| {
            let x = space.mesh().vertices()[p];
            x[1] > 0.0
                || space
                    .part("plus")
                    .is_ok_and(|part| part.vertices().contains(&p))
        })
        .collect();
    let whole = space.trace(|x| x[1] == -1.0)?;
    let part = stickslip::BoundaryPart {
        weights: vec![1.0; upper.len()],
        vertices: upper,
        points: Vec::new(),
        normals: Vec::new(),
        opposite: None,
        ..stickslip::BoundaryPart::from(&whole)
    };
    let contact = Contact::between(
        &space.part("plus")?,
        &space.part("minus")?,
        Tresca { coefficient: 0.1 },
        1e-3,
    );
    let scene = Scene::new(elasticity(&space, &ELASTIC)?)
        .fix(&whole, Components::ALL)
        .prescribe_velocity(part, Components::ALL, |_| [1.0, 0.0])
        .with_contact(contact);
    let mut body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    body.run(&Steps::constant(0.01).count(10), |_| ())?;
    let at = body.snapshot();
    let fault = at.contact(0);
    // All of the upper block slides to +x, and at the driven end by 0.1 less what the lower block gives.
    let slips: Vec<f64> = (0..fault.len()).map(|k| fault.slip_vector(k)[0]).collect();
    assert!(
        slips.iter().all(|&slip| slip > 0.09 && slip < 0.101),
        "{slips:?}"
    );
    Ok(())
}
