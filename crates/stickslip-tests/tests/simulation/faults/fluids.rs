//! Fluids and heat on a fault of many cells: restarts, volumes, both kinds of steps, and pressure beyond the normal stress.

use nalgebra::{DMatrix, Vector1};
use stickslip::bie::{Cells, Fault, FaultCells, FaultGeometry};
use stickslip::fields::{
    Diffusion, Dilatancy, Hydraulics, LeakOff, Line, PermeabilityEvolution, PoreFluid, RateHistory,
    ShearZone, ThermalPressurization, Well,
};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::integrate::Stepper;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    Contact, DenseNewton, GeneralizedAlpha, RungeKutta, Scene, Simulation, StepError, Steps,
};

use super::{AGING, MEDIUM, NORMAL, law};
use crate::Outcome;

const COUNT: usize = 80;
const LENGTH: f64 = 4e3;
const RATE: f64 = 1e-9;
const DAY: f64 = 86_400.0;

type Block = Contact<RegularizedDieterichRuina, Dieterich, 1>;

fn fault() -> Outcome<Fault> {
    Ok(Fault::half_space(
        Cells::new([0.0, LENGTH], COUNT)?,
        MEDIUM,
    )?)
}

/// A well in the middle whose rate [m^2/s] jumps after some days.
fn injection(rate: f64) -> Outcome<Diffusion> {
    let zone = Hydraulics {
        permeability: 1e-13.into(),
        viscosity: 1e-3.into(),
        storage: 1e-9.into(),
        thickness: 1.0.into(),
    };
    let rates =
        RateHistory::constant_between(&[(0.0, rate), (3.0 * DAY, 0.3 * rate), (5.0 * DAY, 0.0)])?;
    let line = Line::uniform([0.0, LENGTH], COUNT)?;
    Ok(Diffusion::new(line, &zone)?.with_well(Well::new(0.5 * LENGTH, rates))?)
}

/// The same with leak-off, dilatancy and permeability that slip raises.
fn coupled(rate: f64) -> Outcome<Diffusion> {
    let dilatancy = Dilatancy {
        coefficient: 1e-4,
        reference_velocity: RATE,
        slip_distance: 8e-3,
        initial_change: 0.0,
    };
    let leak_off = LeakOff {
        drainage_time: (30.0 * DAY).into(),
        far_pressure: 0.0.into(),
    };
    let evolution = PermeabilityEvolution {
        minimum: 5e-14.into(),
        maximum: 1e-12.into(),
        slip_distance: 0.01.into(),
        healing_time: (10.0 * DAY).into(),
    };
    Ok(injection(rate)?
        .with_dilatancy(dilatancy)?
        .with_leak_off(&leak_off)?
        .with_permeability_evolution(&evolution)?)
}

fn heat() -> Outcome<ThermalPressurization> {
    let zone = ShearZone {
        half_width: 0.01.into(),
        volumetric_heat_capacity: 2.7e6.into(),
        thermal_diffusivity: 1e-6.into(),
        initial_temperature: 400.0.into(),
    };
    let fluid = PoreFluid {
        hydraulic_diffusivity: 1e-5.into(),
        pressurization_coefficient: 1e5.into(),
    };
    Ok(ThermalPressurization::new(COUNT, zone, fluid)?)
}

/// Creep in balance.
fn scene<G: FaultGeometry<1>>(
    fault: &G,
    with: impl FnOnce(Block) -> Outcome<Block>,
) -> Outcome<Scene<G::Kernel, 1>> {
    let law = law(0.016);
    let steady = (law.a - law.b).mul_add((RATE / 1e-6).ln(), law.reference_friction);
    let part = stickslip::BoundaryPart::from(FaultGeometry::cells(fault));
    let contact = Contact::new(part, law, NORMAL)
        .with_state(AGING, LogTheta((AGING.slip_distance / RATE).ln()))
        .with_shear_stress(Vector1::new(steady * NORMAL));
    Ok(Scene::of_fault(fault, Vector1::new(RATE))?
        .with_velocity(vec![Vector1::new(RATE); COUNT])
        .with_contact(with(contact)?))
}

fn full(contact: Block) -> Outcome<Block> {
    Ok(contact.with_field(coupled(4e-6)?).with_field(heat()?))
}

/// A run goes on from a state with the same bits, and takes back a step.
#[test]
fn a_run_goes_on_with_the_same_bits() -> Outcome {
    let (first, rest) = (
        Steps::adaptive(1e-6).until(2.0 * DAY),
        Steps::adaptive(1e-6).until(6.0 * DAY),
    );
    let mut whole = RungeKutta::new(scene(&fault()?, full)?)?;
    whole.run(&first, |_| ())?;
    let kept = whole.snapshot().state().clone();
    whole.step(3e4)?;
    whole.undo();
    assert_eq!(whole.snapshot().state(), &kept);
    whole.restore(&kept)?;
    whole.run(&rest, |_| ())?;
    let mut again = RungeKutta::new(scene(&fault()?, full)?)?;
    again.restore(&kept)?;
    again.run(&rest, |_| ())?;
    assert_eq!(again.snapshot().state(), whole.snapshot().state());
    Ok(())
}

/// The fluid that is injected is stored, in pores that dilate, or has leaked; no step crosses a jump of the rate.
#[test]
fn the_volume_closes_at_every_step() -> Outcome {
    let mut motion = RungeKutta::new(scene(&fault()?, full)?)?;
    let mut times = Vec::new();
    motion.run(&Steps::adaptive(1e-5).until(20.0 * DAY), |at| {
        times.push(at.time);
        let totals = at.contact(0).totals();
        let total = |name: &str| -> f64 {
            let of_name = totals.iter().filter(|(reading, _)| reading.name == name);
            of_name.map(|(_, value)| value).sum()
        };
        let injected = 4e-6
            * (at.time.min(3.0 * DAY) + 0.3 * (at.time.clamp(3.0 * DAY, 5.0 * DAY) - 3.0 * DAY));
        assert!((total("injected_volume") / injected - 1.0).abs() < 1e-12);
        let parts = [
            "stored_volume",
            "leaked_volume",
            "drained_volume",
            "pore_volume",
        ];
        let sum: f64 = parts.into_iter().map(total).sum();
        assert!(
            (sum / injected - 1.0).abs() < 1e-11,
            "{totals:?} {injected}"
        );
    })?;
    assert!(times.contains(&(3.0 * DAY)) && times.contains(&(5.0 * DAY)));
    let at = motion.snapshot();
    let contact = at.contact(0);
    let permeability = contact.reading("permeability").ok_or("no permeability")?;
    assert!(
        permeability.iter().any(|&k| k > 1.5e-13),
        "{permeability:?}"
    );
    let temperature = contact.reading("temperature").ok_or("no temperature")?;
    assert!(temperature.iter().all(|&t| t > 400.0));
    Ok(())
}

/// The fault with a dense matrix.
struct Dense(Fault);

impl FaultGeometry<1> for Dense {
    type Kernel = DMatrix<f64>;

    fn cells(&self) -> FaultCells {
        FaultGeometry::cells(&self.0)
    }

    fn stiffness(&self) -> DMatrix<f64> {
        DMatrix::from(&FaultGeometry::stiffness(&self.0))
    }

    fn radiation_damping(&self) -> DMatrix<f64> {
        DMatrix::from(&FaultGeometry::radiation_damping(&self.0))
    }
}

#[test]
fn explicit_and_implicit_steps_agree() -> Outcome {
    let end = 8.0 * DAY;
    let mut explicit = RungeKutta::new(scene(&fault()?, full)?)?;
    explicit.run(&Steps::adaptive(1e-7).until(end), |_| ())?;
    let mut errors = Vec::new();
    for count in [160.0, 320.0] {
        let mut implicit = Simulation::new(
            scene(&Dense(fault()?), full)?,
            GeneralizedAlpha::default(),
            DenseNewton::new(),
        )?;
        implicit.run(&Steps::constant(end / count).until(end), |_| ())?;
        let (a, b) = (explicit.snapshot(), implicit.snapshot());
        let (a, b) = (a.contact(0), b.contact(0));
        let all = 0..COUNT;
        let largest = all.clone().map(|k| a.slip(k)).fold(0.0, f64::max);
        let apart = all.map(|k| (a.slip(k) - b.slip(k)).abs() / largest);
        errors.push(apart.fold(0.0, f64::max));
    }
    assert!(
        errors[1] < 1e-3 && errors[1] < 0.3 * errors[0],
        "{errors:?}"
    );
    Ok(())
}

/// A well that lifts the pressure beyond the normal stress ends the run with both; a contact that opens, or keeps a least
/// normal stress, goes on, and counts its vertices.
#[test]
fn pressure_beyond_the_normal_stress_is_told() -> Outcome {
    let lift = 4e-4;
    let end = Steps::adaptive(1e-5).until(3.0 * DAY);
    let refused = |contact: Block| Ok(contact.with_field(injection(lift)?));
    let mut motion = RungeKutta::new(scene(&fault()?, refused)?)?;
    let failure = motion.run(&end, |_| ()).err().ok_or("no failure")?;
    let StepError::PorePressure {
        vertex,
        pore_pressure,
        normal_stress,
        by_slip: false,
    } = failure.cause
    else {
        return Err(failure.into());
    };
    assert!(vertex == COUNT / 2 || vertex + 1 == COUNT / 2);
    assert!(pore_pressure > normal_stress && (normal_stress / NORMAL - 1.0).abs() < 1e-12);
    for least in [None, Some(1e6)] {
        let goes_on = |contact: Block| {
            let contact = contact.with_field(injection(lift)?);
            Ok(match least {
                None => contact.allow_opening(),
                Some(least) => contact.with_least_normal_stress(least),
            })
        };
        let mut motion = RungeKutta::new(scene(&fault()?, goes_on)?)?;
        motion.run(&end, |_| ())?;
        let at = motion.snapshot();
        let contact = at.contact(0);
        let beyond =
            (0..COUNT).filter(|&k| contact.pore_pressure(k) > NORMAL - least.unwrap_or(0.0));
        let count = beyond.clone().count();
        assert!(count > 0 && at.report.at_least_normal_stress == count);
        for k in beyond {
            assert_eq!(contact.effective_normal_stress(k), least.unwrap_or(0.0));
            assert!((contact.normal_stress(k) / NORMAL - 1.0).abs() < 1e-12);
        }
    }
    Ok(())
}
