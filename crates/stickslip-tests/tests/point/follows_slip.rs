//! Implicit steps on faults whose normal stress follows slip, and whose stiffness is not symmetric.

use nalgebra::{DMatrix, SVector, Vector1, Vector2};
use stickslip::bie::{
    Cells, DippingFault, FaultSystem, Medium, Placement, PlaneFault, Rectangles, Sense,
};
use stickslip::friction::{FrictionLaw, RegularizedDieterichRuina, Tresca};
use stickslip::state::{LogTheta, StateLaw};
use stickslip::{
    BackwardEuler, BoundaryPart, Contact, DenseNewton, ErrorControl, RateScheme, RungeKutta, Scene,
    Sdirk2, Simulation, Snapshot, StateUpdate, StepError, Steps,
};

use crate::Outcome;
use crate::clamping::{PULL, block, slid};

type Dense<const C: usize> = Scene<DMatrix<f64>, C>;

const ROCK: Medium = Medium {
    shear_modulus: 30e9,
    shear_wave_speed: 3464.0,
};
const RATE: f64 = 1e-9;
const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 0.02,
};

/// Numbers in (0, 1): fractions of multiples of the golden ratio.
fn numbers() -> impl Iterator<Item = f64> {
    (1..).map(|k| (f64::from(k) * 0.618_033_988_749_895).fract())
}

/// A rate-and-state contact that is loaded beyond steady sliding at `RATE`.
fn creeping<S: StateLaw<State = LogTheta> + Clone + Send + Sync + 'static, const C: usize>(
    part: impl Into<BoundaryPart>,
    state: S,
    normal_stress: f64,
    direction: SVector<f64, C>,
) -> Contact<RegularizedDieterichRuina, S, C> {
    let steady = LogTheta((LAW.slip_distance / RATE).ln());
    let shear = 1.04 * normal_stress * LAW.coefficient(RATE, steady);
    Contact::new(part, LAW, normal_stress)
        .with_state(state, steady)
        .with_shear_stress(direction * shear)
}

/// A fault down dip with a plate, under friction by the aging law, by the slip law with an effect of the normal stress, or
/// by Coulomb's, which may open.
fn line(dip: f64, top: f64, count: usize, sense: Sense, law: usize) -> Outcome<Dense<1>> {
    let cells = Cells::new([top, top + 10e3], count)?;
    let fault = DippingFault::new(cells, ROCK, 0.25, dip, sense)?;
    let scene = Scene::new(DMatrix::from(&fault.stiffness()))
        .with_viscosity(DMatrix::from(&fault.radiation_damping()));
    let (change, along) = (fault.normal_stiffness(), Vector1::new(1.0));
    if law == 2 {
        let contact = Contact::new(&fault, Tresca { coefficient: 0.5 }, 2e6)
            .with_shear_stress(along * 4e6)
            .allow_opening();
        return Ok(scene
            .with_normal_stress_change(change, along * 0.0)
            .with_contact(contact));
    }
    let scene = scene
        .with_load_history(fault.plate_loading(RATE))
        .with_normal_stress_change(change, along * RATE);
    Ok(if law == 0 {
        scene.with_contact(creeping(&fault, LAW.aging(), 20e6, along))
    } else {
        let contact = creeping(&fault, LAW.slip(), 20e6, along);
        scene.with_contact(contact.with_normal_stress_effect(0.2))
    })
}

/// Slip and normal stress of all cells.
fn seen<const C: usize>(at: &Snapshot<'_, C>) -> [Vec<f64>; 2] {
    let cells = || {
        at.contacts()
            .flat_map(|own| (0..own.len()).map(move |k| (own, k)))
    };
    [
        cells().map(|(own, k)| own.slip(k)).collect(),
        cells().map(|(own, k)| own.normal_stress(k)).collect(),
    ]
}

/// The differences of slip and of normal stress, relative to the largest slip and the largest change of normal stress.
fn apart(a: &[Vec<f64>; 2], b: &[Vec<f64>; 2], start: &[f64]) -> [f64; 2] {
    let most = |a: &[f64], b: &[f64]| {
        let pairs = a.iter().zip(b);
        pairs.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
    };
    let size = b[0].iter().fold(0.0_f64, |size, slip| size.max(*slip));
    [
        most(&a[0], &b[0]) / size,
        most(&a[1], &b[1]) / most(&b[1], start),
    ]
}

/// Adaptive implicit steps end where explicit ones of a tight tolerance do, with few iterations.
fn agrees<const C: usize>(make: &dyn Fn() -> Outcome<Dense<C>>, until: f64) -> Outcome {
    let mut explicit = RungeKutta::new(make()?)?;
    let [_, start] = seen(&explicit.snapshot());
    explicit.run(&Steps::adaptive(1e-8).until(until), |_| ())?;
    let exact = seen(&explicit.snapshot());
    let mut implicit = Simulation::new(make()?, Sdirk2, DenseNewton::new())?;
    let (mut most, mut contraction) = (0, 0.0_f64);
    implicit.run(&Steps::adaptive(1e-4).until(until), |at| {
        most = most.max(at.report.reaction_iterations);
        contraction = contraction.max(at.report.contraction);
    })?;
    let [slip, stress] = apart(&seen(&implicit.snapshot()), &exact, &start);
    assert!(slip < 1e-3 && stress < 1e-3, "{slip:e} {stress:e}");
    // Of a step and its halves, each of two stages.
    assert!(
        (6..=120).contains(&most) && contraction < 1.0,
        "{most} {contraction}"
    );
    Ok(())
}

#[test]
fn implicit_steps_end_as_explicit_ones_on_lines() -> Outcome {
    let mut random = numbers();
    let mut next = || random.next().unwrap_or(0.5);
    for law in [0, 1, 2, 0, 1, 2] {
        let dip = 10.0 + 75.0 * next();
        let top = if next() < 0.5 { 0.0 } else { 3e3 * next() };
        let count = 10 + (10.0 * next()) as usize;
        let sense = if next() < 0.5 {
            Sense::Thrust
        } else {
            Sense::Normal
        };
        let until = if law == 2 { 60.0 } else { 2e7 };
        agrees(&|| line(dip, top, count, sense, law), until)
            .map_err(|error| format!("dip {dip}, top {top}, law {law}: {error}"))?;
    }
    Ok(())
}

#[test]
fn implicit_steps_end_as_explicit_ones_on_planes() -> Outcome {
    let mut random = numbers();
    let mut next = || random.next().unwrap_or(0.5);
    let plane = |dip: f64| {
        let along = Cells::new([-4e3, 4e3], 5)?;
        let cells = Rectangles::new(along, Cells::new([0.0, 4e3], 3)?);
        PlaneFault::half_space(cells, dip, ROCK, 0.25)
    };
    let first = plane(20.0 + 50.0 * next())?;
    let rate = Vector2::new(0.6, 0.8) * RATE;
    agrees(
        &|| {
            Ok(Scene::new(DMatrix::from(&first.stiffness()))
                .with_viscosity(DMatrix::from(&first.radiation_damping()))
                .with_load_history(first.plate_loading(rate)?)
                .with_normal_stress_change(first.normal_stiffness(), rate)
                .with_contact(creeping(&first, LAW.aging(), 20e6, Vector2::new(0.6, 0.8))))
        },
        2e7,
    )?;
    // Two planes that dip towards each other.
    let placement = |strike: f64, x: f64| Placement {
        strike,
        origin: [x, 0.0],
    };
    let planes = [
        (plane(40.0)?.with_rake(90.0)?, placement(0.0, -6e3)),
        (plane(60.0)?.with_rake(60.0)?, placement(180.0, 6e3)),
    ];
    let system = FaultSystem::new(planes)?;
    let rate = Vector1::new(RATE);
    agrees(
        &|| {
            let mut scene = Scene::new(DMatrix::from(&system.stiffness()))
                .with_viscosity(DMatrix::from(&system.radiation_damping()))
                .with_load_history(system.plate_loading(&[rate, rate])?)
                .with_normal_stress_change(system.normal_stiffness(), rate);
            for number in 0..2 {
                let section = system.section(number, |_| true)?;
                let normal_stress = 20e6 + 10e6 * number as f64;
                let contact = creeping(&section, LAW.aging(), normal_stress, Vector1::new(1.0));
                scene = scene.with_contact(contact);
            }
            Ok(scene)
        },
        2e7,
    )
}

/// A matrix that is not symmetric has the products of its kernel.
#[test]
fn the_matrix_of_a_kernel_moves_as_the_kernel() -> Outcome {
    let cells = Cells::new([0.0, 10e3], 19)?;
    let fault = DippingFault::new(cells, ROCK, 0.25, 30.0, Sense::Thrust)?;
    let contact = || {
        Contact::new(&fault, Tresca { coefficient: 0.3 }, 30e6)
            .with_shear_stress(Vector1::new(10e6))
    };
    let mut kernel = RungeKutta::new(
        Scene::new(fault.stiffness())
            .with_viscosity(fault.radiation_damping())
            .with_contact(contact()),
    )?;
    let dense = || {
        Scene::new(DMatrix::from(&fault.stiffness()))
            .with_viscosity(DMatrix::from(&fault.radiation_damping()))
            .with_contact(contact())
    };
    let mut explicit = RungeKutta::new(dense())?;
    let mut implicit = Simulation::new(dense(), Sdirk2, DenseNewton::new())?;
    kernel.run(&Steps::adaptive(1e-8).until(60.0), |_| ())?;
    explicit.run(&Steps::adaptive(1e-8).until(60.0), |_| ())?;
    implicit.run(&Steps::adaptive(1e-4).until(60.0), |_| ())?;
    let slip = |at: Snapshot<'_, 1>| seen(&at)[0].clone();
    let exact = slip(kernel.snapshot());
    // At rest balance decides the slip.
    for (other, tolerance) in [
        (slip(explicit.snapshot()), 1e-6),
        (slip(implicit.snapshot()), 1e-6),
    ] {
        for (a, b) in other.iter().zip(&exact) {
            assert!((a / b - 1.0).abs() < tolerance, "{a} {b}");
        }
    }
    Ok(())
}

/// Errors of constant steps fall as the order of the scheme says.
#[test]
fn constant_steps_keep_their_order() -> Outcome {
    let until = 4e5;
    let make = || line(35.0, 0.0, 12, Sense::Thrust, 0);
    let mut explicit = RungeKutta::new(make()?)?;
    let [_, start] = seen(&explicit.snapshot());
    explicit.run(&Steps::adaptive(1e-10).until(until), |_| ())?;
    let exact = seen(&explicit.snapshot());
    /// A scheme, and its order.
    type Ordered = (fn() -> Box<dyn RateScheme>, f64);
    let schemes: [Ordered; 2] = [
        (|| Box::new(BackwardEuler), 1.0),
        (|| Box::new(Sdirk2), 2.0),
    ];
    for (scheme, order) in schemes {
        let mut errors = Vec::new();
        for count in [40, 80, 160] {
            let mut implicit = Simulation::new(make()?, scheme(), DenseNewton::new())?
                .with_state_update(StateUpdate::BackwardEuler);
            implicit.run(
                &Steps::constant(until / f64::from(count)).until(until),
                |_| (),
            )?;
            errors.push(apart(&seen(&implicit.snapshot()), &exact, &start));
        }
        for pair in errors.windows(2) {
            for k in 0..2 {
                let observed = (pair[0][k] / pair[1][k]).log2();
                assert!(
                    (observed - order).abs() < 0.2,
                    "{order}: {observed}, {errors:?}"
                );
            }
        }
    }
    Ok(())
}

/// A thrust that opens at the surface slides to rest in some dozens of steps; the opened cells have no normal stress.
#[test]
fn a_thrust_that_opens_comes_to_rest() -> Outcome {
    for (normal_stress, shear, opens) in [(30e6, 10e6, false), (1e6, 2e6, true)] {
        let fault = DippingFault::new(
            Cells::new([0.0, 10e3], 20)?,
            ROCK,
            0.25,
            30.0,
            Sense::Thrust,
        )?;
        let contact = Contact::new(&fault, Tresca { coefficient: 0.3 }, normal_stress)
            .with_shear_stress(Vector1::new(shear))
            .allow_opening();
        let scene = Scene::new(DMatrix::from(&fault.stiffness()))
            .with_viscosity(DMatrix::from(&fault.radiation_damping()))
            .with_normal_stress_change(fault.normal_stiffness(), Vector1::new(0.0))
            .with_contact(contact);
        let mut motion = Simulation::new(scene, Sdirk2, DenseNewton::new())?;
        let report = motion.run(&Steps::adaptive(1e-4).until(60.0), |_| ())?;
        let at = motion.snapshot();
        assert!(
            report.accepted < 300 && at.max_slip_rate() < 1e-6,
            "{}",
            report.accepted
        );
        // Shown is that of the end of the step.
        let mut change = vec![0.0; 20];
        (fault.normal_stiffness()).multiply_add(1.0, at.displacement, &mut change);
        let mut opened = 0;
        for (k, change) in change.iter().enumerate() {
            let (stress, shown) = (normal_stress + change, at.contact(0).normal_stress(k));
            assert!(
                (shown - stress.max(0.0)).abs() < 1e-8 * normal_stress,
                "{k} {shown} {stress}"
            );
            opened += usize::from(shown == 0.0);
        }
        assert_eq!(opened > 0, opens);
    }
    Ok(())
}

/// Shown is the normal stress of the displacement, that of an extrapolated step, too.
#[test]
fn an_extrapolated_step_shows_its_normal_stress() -> Outcome {
    let (until, cells) = (4e5, Cells::new([0.0, 10e3], 12)?);
    let change = DippingFault::new(cells, ROCK, 0.25, 35.0, Sense::Thrust)?.normal_stiffness();
    let mut explicit = RungeKutta::new(line(35.0, 0.0, 12, Sense::Thrust, 0)?)?;
    explicit.run(&Steps::adaptive(1e-8).until(until), |_| ())?;
    let exact = seen(&explicit.snapshot())[0].clone();
    let scene = line(35.0, 0.0, 12, Sense::Thrust, 0)?;
    let mut motion = Simulation::new(scene, BackwardEuler, DenseNewton::new())?
        .with_state_update(StateUpdate::BackwardEuler);
    let control = ErrorControl {
        levels: 3,
        extrapolate: true,
        ..ErrorControl::default()
    };
    let plan = Steps::adaptive(1e-4).with_error_control(control);
    motion.run(&plan.until(until), |at| {
        let mut stresses = vec![20e6; 12];
        let moved = at.displacement.iter();
        let moved: Vec<_> = moved.map(|u| u.add_scalar(-RATE * at.time)).collect();
        change.multiply_add(1.0, &moved, &mut stresses);
        for (k, stress) in stresses.into_iter().enumerate() {
            assert!((at.contact(0).normal_stress(k) - stress).abs() < 1e-6);
        }
    })?;
    for (slip, exact) in seen(&motion.snapshot())[0].iter().zip(&exact) {
        assert!((slip / exact - 1.0).abs() < 1e-3, "{slip} {exact}");
    }
    Ok(())
}

#[test]
fn a_restored_state_continues_with_the_same_bits() -> Outcome {
    for law in [0, 2] {
        let plan = |until: f64| Steps::adaptive(1e-3).until(until);
        let ends = if law == 0 { [1e7, 2e7] } else { [1.0, 20.0] };
        let make = || line(25.0, 0.0, 12, Sense::Thrust, law);
        let mut first = Simulation::new(make()?, Sdirk2, DenseNewton::new())?;
        first.run(&plan(ends[0]), |_| ())?;
        let mut second = Simulation::new(make()?, Sdirk2, DenseNewton::new())?;
        second.restore(first.state())?;
        first.run(&plan(ends[1]), |_| ())?;
        second.run(&plan(ends[1]), |_| ())?;
        assert_eq!(first.state(), second.state());
    }
    Ok(())
}

/// A block on a wedge contracts in short steps, and slides as its closed form; a long step is refused, by the sign of the
/// wedge as a map that does not contract, or as a slip that opens the contact.
#[test]
fn long_steps_on_a_steep_wedge_are_refused() -> Outcome {
    for wedge in [4e6, -4e6] {
        let mut motion = Simulation::new(block(wedge, 0.0, false), Sdirk2, stickslip::Point)?;
        let before = motion.state().clone();
        match motion.step(10.0).err().ok_or("taken")?.cause {
            // `f N / k` of a step so long that viscosity does not count.
            StepError::NotContracting { contraction, .. } => {
                assert!(
                    wedge > 0.0 && (1.5..=2.0).contains(&contraction),
                    "{contraction}"
                );
            }
            StepError::Tension { normal_stress, .. } => {
                assert!(wedge < 0.0 && normal_stress < 0.0, "{normal_stress}");
            }
            cause => return Err(cause.into()),
        }
        assert_eq!(motion.state(), &before);
    }
    for (wedge, plate) in [(4e6, 0.0), (4e5, 0.05), (-4e5, 0.0)] {
        let mut motion = Simulation::new(block(wedge, plate, false), Sdirk2, stickslip::Point)?;
        motion.run(&Steps::adaptive(1e-8).until(0.3), |at| {
            let exact = slid(wedge, plate, at.time);
            let left = (at.displacement[0][0] - exact).abs();
            assert!(left < 1e-5 * PULL, "{wedge} {left}");
        })?;
    }
    Ok(())
}
