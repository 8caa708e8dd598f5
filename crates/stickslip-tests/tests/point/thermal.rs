//! Thermal pressurization of one patch of a fault: recurrence, orders, and a temperature.

use nalgebra::{DMatrix, Matrix1, Vector1};
use stickslip::bie::{Cells, Fault, FaultGeometry, Medium, Mode};
use stickslip::fields::{PoreFluid, ShearZone, ThermalPressurization};
use stickslip::friction::{FrictionLaw, RegularizedDieterichRuina};
use stickslip::integrate::Stepper;
use stickslip::record::EventCatalogue;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BoundaryPart, Contact, GeneralizedAlpha, Point, RungeKutta, Scene, Simulation, Snapshot, Steps,
};

use crate::Outcome;

const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 8e-3,
};
const AGING: Dieterich = Dieterich {
    slip_distance: 8e-3,
};
const NORMAL_STRESS: f64 = 50e6;
const STIFFNESS: f64 = 3.30904165e6;
const DAMPING: f64 = 0.5 * 32.04e9 / 3464.0;
const PLATE: f64 = 1e-9;
const YEAR: f64 = 31_557_600.0;

/// A shear zone of this half width [m].
fn pressurized(vertices: usize, half_width: f64) -> Outcome<ThermalPressurization> {
    let zone = ShearZone {
        half_width: half_width.into(),
        volumetric_heat_capacity: 2.7e6.into(),
        thermal_diffusivity: 1e-6.into(),
        initial_temperature: 483.15.into(),
    };
    let fluid = PoreFluid {
        hydraulic_diffusivity: 1e-4.into(),
        pressurization_coefficient: 1e5.into(),
    };
    Ok(ThermalPressurization::new(vertices, zone, fluid)?)
}

/// The patch that begins at a slip rate and a state.
fn patch(half_width: f64, slip_rate: f64, theta: f64) -> Outcome<Scene<Matrix1<f64>, 1>> {
    let state = LogTheta(theta.ln());
    let friction = LAW.coefficient(slip_rate, state);
    let stress = NORMAL_STRESS * friction + DAMPING * slip_rate;
    let contact = Contact::new(BoundaryPart::point(1.0), LAW, NORMAL_STRESS)
        .with_state(AGING, state)
        .with_shear_stress(Vector1::new(stress))
        .with_field(pressurized(1, half_width)?);
    Ok(Scene::new(Matrix1::new(STIFFNESS))
        .with_viscosity(Matrix1::new(DAMPING))
        .with_contact(contact)
        .with_velocity(vec![Vector1::new(slip_rate)])
        .with_load_history(|time, load| load[0][0] = STIFFNESS * PLATE * time))
}

/// The recurrence [years] by error control, and the accepted steps.
fn recurrence(tolerance: f64) -> Outcome<(f64, usize)> {
    let mut cycle = RungeKutta::new(patch(1e-2, 1e-10, 8e-3 / PLATE)?)?;
    let at = cycle.snapshot();
    let mut events = EventCatalogue::new(&at, 0, [1e-3, 1e-4], 32.04e9, 8)?;
    let steps = Steps::adaptive(tolerance).until(800.0 * YEAR);
    let report = cycle.run(&steps, |at| events.record(&at))?;
    let events = events.events();
    assert!(events.iter().all(|event| event.pressure_change > 1e6));
    let [.., before, last] = events else {
        return Err(format!("{events:?}").into());
    };
    Ok(((last.onset - before.onset) / YEAR, report.accepted))
}

/// The error control sees the field: the recurrence follows the tolerance, in as many steps as where the stage form was
/// tried first (in 530 years). By an independent code, LSODA with the 48 modes as unknowns, it is 259.494943 years.
#[test]
fn recurrence_follows_the_tolerance() -> Outcome {
    let (exact, _) = recurrence(1e-9)?;
    assert!((exact / 259.494943 - 1.0).abs() < 2e-5, "{exact}");
    for (tolerance, error, most) in [(1e-3, 5e-5, 1269), (1e-4, 2e-5, 1311), (1e-6, 1e-6, 1995)] {
        let (found, accepted) = recurrence(tolerance)?;
        assert!(
            (found / exact - 1.0).abs() < error,
            "{tolerance:e}: {found} {exact}"
        );
        assert!(
            2 * accepted * 530 < 3 * most * 800,
            "{tolerance:e}: {accepted}"
        );
    }
    Ok(())
}

/// Slip, pore pressure and temperature.
fn numbers<const C: usize>(at: &Snapshot<'_, C>) -> [f64; 3] {
    let contact = at.contact(0);
    let temperature = contact
        .reading("temperature")
        .map_or(f64::NAN, |all| all[0]);
    [contact.slip(0), contact.pore_pressure(0), temperature]
}

/// The largest error through the window, as a share of the largest values.
fn error(found: &[[f64; 3]], expected: &[[f64; 3]]) -> f64 {
    let largest = |i: usize| expected.iter().map(|at| at[i]).fold(0.0, f64::max);
    let scales: [f64; 3] = std::array::from_fn(largest);
    let apart = found.iter().zip(expected);
    let shares = apart.flat_map(|(a, b)| (0..3).map(move |i| (a[i] - b[i]).abs() / scales[i]));
    shares.fold(0.0, f64::max)
}

/// An event from 1 mm/s through its peak, by the steps of an error control, each divided.
struct Window {
    half_width: f64,
    steps: Vec<f64>,
}

impl Window {
    fn new(half_width: f64) -> Outcome<Self> {
        let mut motion = RungeKutta::new(patch(half_width, 1e-3, 100.0)?)?;
        let mut times = vec![0.0];
        let mut peak = 0.0_f64;
        motion.run(&Steps::adaptive(1e-4).until(1e3), |at| {
            times.push(at.time);
            peak = peak.max(at.max_slip_rate());
            if at.max_slip_rate() < 0.5 * peak {
                return std::ops::ControlFlow::Break(());
            }
            std::ops::ControlFlow::Continue(())
        })?;
        assert!(peak > 1.0);
        let steps = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        Ok(Self { half_width, steps })
    }

    fn explicit(&self, parts: usize) -> Outcome<Vec<[f64; 3]>> {
        let mut motion = RungeKutta::new(patch(self.half_width, 1e-3, 100.0)?)?;
        let mut found = Vec::new();
        for dt in &self.steps {
            (0..parts).try_for_each(|_| motion.step(dt / parts as f64).map(drop))?;
            found.push(numbers(&motion.snapshot()));
        }
        Ok(found)
    }

    fn implicit(&self, parts: usize) -> Outcome<Vec<[f64; 3]>> {
        let scene = patch(self.half_width, 1e-3, 100.0)?;
        let mut motion = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
        let mut found = Vec::new();
        for dt in &self.steps {
            for _ in 0..parts {
                let report = motion.step(dt / parts as f64)?;
                assert!(report.contraction < 1.0, "{report:?}");
            }
            found.push(numbers(&motion.snapshot()));
        }
        Ok(found)
    }
}

/// Error orders of both kinds of steps, against explicit steps of a 64th.
#[test]
fn field_and_mechanics_together_are_of_second_order() -> Outcome {
    for (half_width, explicit) in [(1e-2, 2.5), (1e-3, 1.9)] {
        let window = Window::new(half_width)?;
        let expected = window.explicit(64)?;
        let orders = |errors: &[f64]| -> Vec<f64> {
            errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect()
        };
        let mut errors = Vec::new();
        for parts in [2, 4, 8, 16] {
            errors.push(error(&window.explicit(parts)?, &expected));
        }
        assert!(
            orders(&errors).iter().all(|&own| own > explicit),
            "{errors:?}"
        );
        errors.clear();
        for parts in [4, 8, 16, 32] {
            errors.push(error(&window.implicit(parts)?, &expected));
        }
        assert!(orders(&errors).iter().all(|&own| own > 1.9), "{errors:?}");
    }
    Ok(())
}

/// Cells that are solved many at a time see the heat of each by itself: 70 patches that do not see one another.
#[test]
fn many_cells_heat_as_each_by_itself() -> Outcome {
    const COUNT: usize = 70;
    let window = Window::new(1e-2)?;
    let expected = window.explicit(2)?;
    let medium = Medium {
        shear_modulus: 32.04e9,
        shear_wave_speed: 3464.0,
    };
    let cells = Cells::new([0.0, COUNT as f64], COUNT)?;
    let fault = Fault::whole_space(cells, medium, Mode::Antiplane)?;
    let state = LogTheta(100.0_f64.ln());
    let stress = NORMAL_STRESS * LAW.coefficient(1e-3, state) + DAMPING * 1e-3;
    let part = BoundaryPart::from(FaultGeometry::cells(&fault));
    let contact = Contact::new(part, LAW, NORMAL_STRESS)
        .with_state(AGING, state)
        .with_shear_stress(Vector1::new(stress))
        .with_field(pressurized(COUNT, 1e-2)?);
    let each = |value: f64| DMatrix::from_diagonal_element(COUNT, COUNT, value);
    let scene = Scene::new(each(STIFFNESS))
        .with_viscosity(each(DAMPING))
        .with_contact(contact)
        .with_velocity(vec![Vector1::new(1e-3); COUNT])
        .with_load_history(|time, load| load.fill(Vector1::new(STIFFNESS * PLATE * time)));
    let mut motion = RungeKutta::new(scene)?;
    for (dt, expected) in window.steps.iter().zip(&expected) {
        (0..2).try_for_each(|_| motion.step(0.5 * dt).map(drop))?;
        let found = numbers(&motion.snapshot());
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9 * expected.abs().max(1.0));
        }
    }
    Ok(())
}
