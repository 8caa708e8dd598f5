//! Cycles on faults along polylines.

use std::ops::ControlFlow;

use nalgebra::Vector1;
use stickslip::bie::{Cells, DippingFault, FaultGeometry, Mode, SegmentFault, Segments, Sense};
use stickslip::problems::bp1::{self, AGING, MEDIUM, NORMAL_STRESS, PLATE_RATE};
use stickslip::state::LogTheta;
use stickslip::{BoundaryPart, Contact, Operator, RungeKutta, Scene, StepError, Steps};

use crate::Outcome;

const YEAR: f64 = 3.155_76e7;
const IN_PLANE: Mode = Mode::InPlane {
    poisson_ratio: 0.25,
};

/// The benchmark BP3 with the friction of its distances down dip, on any fault.
fn scene<Op: Operator<1>>(
    fault: &impl FaultGeometry<1, Kernel = Op>,
    distances: &[f64],
) -> Outcome<Scene<Op, 1>> {
    let laws = distances.iter().map(|&distance| bp1::friction(distance));
    let states = (distances.iter()).map(|&distance| LogTheta(bp1::initial_log_theta(distance)));
    let part = BoundaryPart::from(fault.cells());
    let contact = Contact::per_vertex(part, laws.collect::<Vec<_>>(), NORMAL_STRESS)
        .with_state(AGING, states.collect::<Vec<_>>())
        .with_shear_stress(Vector1::new(bp1::shear_stress()));
    let plate = Vector1::new(PLATE_RATE);
    Ok(Scene::of_fault(fault, plate)?
        .with_contact(contact)
        .with_velocity(vec![plate; distances.len()]))
}

/// The times at which the slip rate 7.5 km down dip passes 1e-3 m/s \[years\], and the normal stress there before.
fn events<Op: Operator<1>>(
    fault: &impl FaultGeometry<1, Kernel = Op>,
    distances: &[f64],
    years: f64,
) -> Outcome<Vec<[f64; 2]>> {
    let mut motion = RungeKutta::new(scene(fault, distances)?)?;
    let seen = distances.iter().position(|&distance| distance > 7.3e3);
    let seen = seen.ok_or("a short fault")?;
    let (mut fast, mut events) = (false, Vec::new());
    motion.run(&Steps::adaptive(1e-5).until(years * YEAR), |at| {
        let slip_rate = at.velocity[seen][0];
        if slip_rate > 1e-3 && !fast {
            events.push([at.time / YEAR, at.contact(0).normal_stress(seen)]);
        }
        fast = slip_rate > if fast { 1e-4 } else { 1e-3 };
        ControlFlow::<()>::Continue(())
    })?;
    Ok(events)
}

/// The products differ by rounding and the tolerance of low ranks.
#[test]
fn a_straight_thrust_of_segments_is_a_dipping_fault() -> Outcome {
    let cells = Cells::new([0.0, 40e3], 100)?;
    let planar = DippingFault::new(cells, MEDIUM, 0.25, 60.0, Sense::Thrust)?;
    let known = events(&planar, &cells.map(|distance| distance), 330.0)?;
    let segments = Segments::down([(60.0, 40e3)], 400.0)?;
    let fault = SegmentFault::half_space(segments, MEDIUM, IN_PLANE)?;
    let found = events(&fault, &fault.cells().distances(), 330.0)?;
    assert!(
        known.len() >= 2 && found.len() == known.len(),
        "{known:?} {found:?}"
    );
    for (found, known) in found.iter().zip(&known) {
        assert!((found[0] - known[0]).abs() < 0.05, "{found:?} {known:?}");
        assert!((found[1] - known[1]).abs() < 2e-3 * NORMAL_STRESS);
    }
    Ok(())
}

/// A listric thrust, of a dip that falls from 60 degrees at 5 km to 30 degrees at 20 km: by an independent program its first
/// event is after 254.697 years with cells of 200 m.
#[test]
fn a_listric_thrust_breaks_later() -> Outcome {
    let dip = |distance: f64| 60.0 - 30.0 * ((distance - 5e3) / 15e3).clamp(0.0, 1.0);
    let segments = Segments::by_dip([0.0; 2], 40e3, 200.0, dip)?;
    let fault = SegmentFault::half_space(segments, MEDIUM, IN_PLANE)?;
    let found = events(&fault, &fault.cells().distances(), 256.0)?;
    assert_eq!(found.len(), 1);
    assert!((found[0][0] - 254.697).abs() < 0.3, "{found:?}");
    Ok(())
}

/// At a sharp bend the normal stress vanishes in the cell above it, after 137.35 years by an independent program with cells of
/// 200 m: the failure names cell, time and bend.
#[test]
fn a_sharp_bend_loses_its_normal_stress() -> Outcome {
    let segments = Segments::down([(60.0, 8e3), (50.0, 32e3)], 200.0)?;
    let fault = SegmentFault::half_space(segments, MEDIUM, IN_PLANE)?;
    let mut motion = RungeKutta::new(scene(&fault, &fault.cells().distances())?)?;
    let ended = motion.run(&Steps::adaptive(1e-6).until(200.0 * YEAR), |_| ());
    let failure = ended.err().ok_or("no failure")?;
    assert!(matches!(
        failure.cause,
        StepError::Tension { vertex: 39, .. }
    ));
    assert!((failure.time / YEAR - 137.35).abs() < 0.3, "{failure}");
    let place = failure.place.ok_or("no place")?;
    assert!((place.bend.ok_or("no bend")? - 10.0).abs() < 1e-9);
    let message = failure.to_string();
    assert!(message.contains("vertex 39"), "{message}");
    assert!(
        message.ends_with("where the fault bends by 10.000 degrees"),
        "{message}"
    );
    // Straight faults have no bend.
    let straight = Segments::down([(60.0, 8e3)], 200.0)?;
    let straight = SegmentFault::half_space(straight, MEDIUM, IN_PLANE)?;
    let change = straight.normal_stress_change().ok_or("no change")?;
    assert_eq!(change.bend(3), None);
    Ok(())
}

/// Two faults as contacts of their own, one below the other, under one plate velocity.
#[test]
fn two_faults_creep_with_their_plate() -> Outcome {
    let upper = Segments::down([(40.0, 6e3)], 500.0)?;
    let lower = upper.map_points(|[x, z]| [x + 6e3, z])?;
    let fault = SegmentFault::half_space(upper.with(&lower)?, MEDIUM, IN_PLANE)?;
    let rates = fault.along([-1e-9, 0.0, 0.0])?;
    let law = stickslip::friction::RegularizedDieterichRuina {
        a: 0.02,
        ..bp1::friction(0.0)
    };
    let steady = LogTheta((AGING.slip_distance / rates[0][0]).ln());
    let shear = 50e6 * stickslip::friction::FrictionLaw::coefficient(&law, rates[0][0], steady);
    let mut scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_load_history(fault.back_slip(&rates)?)
        .with_normal_stress_change(fault.normal_stiffness(), rates.clone());
    for number in 0..2 {
        let section = fault.cells().section_of(number)?;
        assert_eq!(section.vertices().len(), 12);
        let contact = Contact::new(&section, law, 50e6)
            .with_state(AGING, steady)
            .with_shear_stress(Vector1::new(shear));
        scene = scene.with_contact(contact);
    }
    let mut motion = RungeKutta::new(scene)?;
    motion.run(&Steps::adaptive(1e-6).until(10.0 * YEAR), |_| ())?;
    let at = motion.snapshot();
    // Nothing is stressed: all cells keep their rates, up to radiation damping.
    for (velocity, rate) in at.velocity.iter().zip(&rates) {
        assert!(
            (velocity - rate).norm() < 1e-3 * rate.norm(),
            "{velocity} {rate}"
        );
    }
    assert!((at.contact(1).normal_stress(3) - 50e6).abs() < 1e3);
    Ok(())
}
