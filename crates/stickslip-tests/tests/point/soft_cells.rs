//! Cells of little strength beside strong ones, in explicit steps.

use nalgebra::{DMatrix, Vector1};
use stickslip::bie::{Cells, Fault, Medium, Mode};
use stickslip::friction::{FrictionLaw, RegularizedDieterichRuina};
use stickslip::integrate::Stepper;
use stickslip::state::LogTheta;
use stickslip::{
    BoundaryPart, Contact, DenseNewton, GeneralizedAlpha, Run, RungeKutta, Scene, Simulation, Steps,
};

use crate::Outcome;

const YEAR: f64 = 3.155_76e7;
const ROCK: Medium = Medium {
    shear_modulus: 32.04e9,
    shear_wave_speed: 3464.0,
};
const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.015,
    b: 0.010,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 0.01,
};
const RATE: f64 = 1e-9;
const NORMAL: f64 = 50e6;

/// A creeping fault of 10 km, on some cells of which the normal stress falls to a floor within half a year.
struct Patch {
    count: usize,
    soft: std::ops::Range<usize>,
    floor: f64,
}

impl Patch {
    fn fault(&self) -> Outcome<Fault> {
        let cells = Cells::new([-5e3, 5e3], self.count)?;
        Ok(Fault::whole_space(cells, ROCK, Mode::Antiplane)?)
    }

    fn contact(
        &self,
        fault: &Fault,
    ) -> Contact<RegularizedDieterichRuina, stickslip::state::Dieterich, 1> {
        let state = LogTheta((LAW.slip_distance / RATE).ln());
        let damping = 0.5 * ROCK.shear_modulus / ROCK.shear_wave_speed;
        let shear = NORMAL * LAW.coefficient(RATE, state) + damping * RATE;
        let (soft, floor) = (self.soft.clone(), self.floor);
        Contact::new(fault, LAW, NORMAL)
            .with_state(LAW.aging(), state)
            .with_shear_stress(Vector1::new(shear))
            .with_normal_stress_history(move |time, stress| {
                stress.fill(NORMAL);
                stress[soft.clone()].fill((NORMAL * (1.0 - time / (0.5 * YEAR))).max(floor));
            })
            .allow_opening()
    }

    fn explicit(&self) -> Outcome<RungeKutta<1>> {
        let fault = self.fault()?;
        let scene = Scene::new(fault.stiffness())
            .with_viscosity(fault.radiation_damping())
            .with_load_history(fault.plate_loading(RATE))
            .with_contact(self.contact(&fault));
        Ok(RungeKutta::new(scene)?)
    }

    /// Slip and slip rates after a year, by implicit steps with a dense matrix.
    fn implicit(&self) -> Outcome<[Vec<f64>; 2]> {
        let fault = self.fault()?;
        let scene = Scene::new(DMatrix::from(&fault.stiffness()))
            .with_viscosity(DMatrix::from(&fault.radiation_damping()))
            .with_load_history(fault.plate_loading(RATE))
            .with_contact(self.contact(&fault))
            .with_velocity(vec![Vector1::new(RATE); self.count]);
        let mut motion = Simulation::new(scene, GeneralizedAlpha::default(), DenseNewton::new())?;
        motion.run(&Steps::adaptive(1e-4).until(YEAR), |_| ())?;
        let at = motion.snapshot();
        Ok([at.displacement, at.velocity].map(|field| field.iter().map(|x| x[0]).collect()))
    }
}

/// One cell or several, open or at a few kilopascals, in numbers of cells for either way of balance: a few hundred steps,
/// and slip and slip rates elsewhere as by implicit steps.
#[test]
fn soft_cells_do_not_limit_the_steps() -> Outcome {
    let patches = [
        (24, 11..12, -1e6),
        (24, 5..8, 1e3),
        (70, 30..31, 0.0),
        (30, 20..26, 1e4),
    ];
    for (count, soft, floor) in patches {
        let patch = Patch { count, soft, floor };
        let mut motion = patch.explicit()?;
        let plan = Steps::adaptive(1e-4).until(YEAR).with_max_steps(500);
        motion.run(&plan, |_| ())?;
        let [slip, rates] = patch.implicit()?;
        let at = motion.snapshot();
        for k in 0..count {
            let off = (at.displacement[k][0] / slip[k] - 1.0).abs();
            assert!(off < 2e-4, "{count}, {floor}: slip {k} off by {off:e}");
            // Of soft cells it is the mean rate of the last step.
            if !patch.soft.contains(&k) {
                let off = (at.velocity[k][0] / rates[k] - 1.0).abs();
                assert!(off < 5e-4, "{count}, {floor}: slip rate {k} off by {off:e}");
            }
        }
    }
    Ok(())
}

/// An open cell that no other one moves, under a load that grows: `K u = l - eta l'/K`, at any step.
#[test]
fn an_open_cell_follows_its_load() -> Outcome {
    let (stiffness, damping, load_rate) = (1e8, 5e6, 3.0);
    let state = LogTheta((LAW.slip_distance / RATE).ln());
    let shear = NORMAL * LAW.coefficient(RATE, state) + damping * RATE;
    let part = BoundaryPart {
        vertices: vec![0, 1],
        weights: vec![1.0; 2],
        ..BoundaryPart::point(1.0)
    };
    let contact = Contact::new(part, LAW, NORMAL)
        .with_state(LAW.aging(), state)
        .with_shear_stress(vec![Vector1::new(shear), Vector1::new(0.0)])
        .with_normal_stress_history(|_, stress| stress[1] = 0.0)
        .allow_opening();
    let scene = Scene::new(DMatrix::from_diagonal_element(2, 2, stiffness))
        .with_viscosity(DMatrix::from_diagonal_element(2, 2, damping))
        .with_load_history(move |time, load| {
            load[0][0] = stiffness * RATE * time;
            load[1][0] = load_rate * time;
        })
        .with_contact(contact);
    let mut motion = RungeKutta::new(scene)?;
    let (mut longest, mut before) = (0.0_f64, 0.0);
    let plan = Steps::adaptive(1e-4).until(YEAR).with_max_steps(500);
    motion.run(&plan, |at| {
        longest = longest.max(at.time - before);
        before = at.time;
        if at.time > 100.0 * damping / stiffness {
            let exact = (load_rate * at.time - damping * load_rate / stiffness) / stiffness;
            let slid = at.displacement[1][0];
            assert!((slid / exact - 1.0).abs() < 1e-3, "{slid:e} {exact:e}");
        }
    })?;
    assert!(longest > 1e6 * damping / stiffness, "{longest}");
    Ok(())
}

/// A run that is restored in the middle takes the steps of an uninterrupted one.
#[test]
fn restored_runs_repeat_their_steps() -> Outcome {
    let patch = Patch {
        count: 24,
        soft: 9..12,
        floor: 0.0,
    };
    let plan = Steps::adaptive(1e-4).until(0.9 * YEAR);
    let mut motion = patch.explicit()?;
    let mut middle = None;
    motion.run(&plan, |at| {
        if middle.is_none() && at.time > 0.7 * YEAR {
            middle = Some(at.state().clone());
        }
    })?;
    let end = motion.state().clone();
    let mut again = patch.explicit()?;
    again.restore(&middle.ok_or("no step")?)?;
    again.run(&plan, |_| ())?;
    assert_eq!(again.state().displacement, end.displacement);
    assert_eq!(again.state().velocity, end.velocity);
    Ok(())
}

/// Times inside of steps with implicit cells: slip grows through them, and the steps have the bits of those without.
#[test]
fn samples_inside_of_steps_change_no_step() -> Outcome {
    let patch = Patch {
        count: 80,
        soft: 30..50,
        floor: 1e2,
    };
    let steps = Steps::adaptive(1e-4).until(0.6 * YEAR);
    let times: Vec<f64> = (0..=500)
        .map(|k| 0.6 * YEAR * f64::from(k) / 500.0)
        .collect();
    let mut slips = Vec::new();
    let mut sampled = patch.explicit()?;
    sampled.run_sampled(
        &steps,
        &times,
        |at| slips.push(at.displacement[40][0]),
        |_| (),
    )?;
    let mut plain = patch.explicit()?;
    plain.run(&steps, |_| ())?;
    assert_eq!(Stepper::state(&sampled), Stepper::state(&plain));
    assert_eq!(slips.len(), times.len());
    assert!(slips.windows(2).all(|pair| pair[1] > pair[0]));
    Ok(())
}
