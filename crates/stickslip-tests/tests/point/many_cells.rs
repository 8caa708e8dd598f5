//! Faults of many cells: friction that is computed for several of them at once, on lines and planes.

use nalgebra::{SVector, Vector1, Vector2};
use stickslip::bie::{Cells, DippingFault, Fault, Medium, PlaneFault, Rectangles, Sense};
use stickslip::friction::{FrictionError, FrictionLaw, RegularizedDieterichRuina, Response};
use stickslip::integrate::Stepper;
use stickslip::state::{Dieterich, LogTheta, Ruina, StateLaw};
use stickslip::{Contact, RungeKutta, Scene, Steps};

use crate::Outcome;

const MEDIUM: Medium = Medium {
    shear_modulus: 32.04e9,
    shear_wave_speed: 3464.0,
};
const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 8e-3,
};
const PLATE: f64 = 1e-9;

/// The same law under another name, which is computed node by node.
#[derive(Debug, Clone, Copy)]
struct NodeByNode(RegularizedDieterichRuina);

impl FrictionLaw for NodeByNode {
    type State = LogTheta;

    fn coefficient(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.0.coefficient(slip_rate, state)
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.0.coefficient_rate_slope(slip_rate, state)
    }

    fn response(&self, slip_rate: f64, state: LogTheta) -> Response {
        self.0.response(slip_rate, state)
    }

    fn potential(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.0.potential(slip_rate, state)
    }

    fn slip_rate(&self, viscosity: f64, drive: f64, state: LogTheta) -> f64 {
        self.0.slip_rate(viscosity, drive, state)
    }

    fn validate(&self) -> Result<(), FrictionError> {
        self.0.validate()
    }
}

/// Slip rates, states and slips of a fault of 100 cells with a weak spot after some years.
fn after<L, S>(law: impl Fn(RegularizedDieterichRuina) -> L, evolution: S) -> Outcome<Vec<[f64; 3]>>
where
    L: FrictionLaw<State = LogTheta> + 'static,
    S: StateLaw<State = LogTheta> + 'static,
{
    let fault = Fault::half_space(Cells::new([0.0, 20e3], 100)?, MEDIUM)?;
    let a = |z: f64| if z < 12e3 { 0.010 } else { 0.025 };
    let laws = fault
        .cells()
        .map(|z| law(RegularizedDieterichRuina { a: a(z), ..LAW }));
    let shear = fault.cells().map(|z| {
        let bump = 1.0 + 0.03 * (-((z - 6e3) / 2e3).powi(2)).exp();
        Vector1::new(bump * 50e6 * (0.6 + (a(z) - 0.015) * (PLATE / 1e-6).ln()))
    });
    let contact = Contact::per_vertex(&fault, laws, 50e6)
        .with_state(evolution, LogTheta((8e-3 / PLATE).ln()))
        .with_shear_stress(shear);
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_load_history(fault.plate_loading(PLATE))
        .with_contact(contact);
    let mut motion = RungeKutta::new(scene)?;
    motion.run(&Steps::adaptive(1e-9).until(3e8), |_| ())?;
    let at = motion.snapshot();
    let contact = at.contact(0);
    let one = |k| [contact.slip_rate(k).ln(), contact.state(k), contact.slip(k)];
    Ok((0..100).map(one).collect())
}

/// To the error of the steps.
#[test]
fn many_cells_slide_as_each_by_itself() -> Outcome {
    let close = |many: Vec<[f64; 3]>, each: Vec<[f64; 3]>| {
        for (many, each) in many.iter().flatten().zip(each.iter().flatten()) {
            assert!(
                (many - each).abs() < 1e-6 * each.abs().max(1.0),
                "{many} {each}"
            );
        }
    };
    let aging = Dieterich {
        slip_distance: 8e-3,
    };
    close(after(|law| law, aging)?, after(NodeByNode, aging)?);
    let slip = Ruina {
        slip_distance: 8e-3,
    };
    close(after(|law| law, slip)?, after(NodeByNode, slip)?);
    Ok(())
}

/// A square of 12 x 12 cells in a whole space, under an oblique load on its middle, at rest otherwise.
fn square(poisson_ratio: f64, load: Vector2<f64>) -> Outcome<Vec<Vector2<f64>>> {
    let cells = Rectangles::new(
        Cells::new([-600.0, 600.0], 12)?,
        Cells::new([-600.0, 600.0], 12)?,
    );
    let fault = PlaneFault::whole_space(cells, MEDIUM, poisson_ratio)?;
    let shear = cells.map(|[x, y]| load * (-(x * x + y * y) / 9e4).exp());
    let contact = Contact::new(&fault, LAW, 25e6)
        .with_state(
            Dieterich {
                slip_distance: 8e-3,
            },
            LogTheta(10.0),
        )
        .with_shear_stress(shear);
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(contact);
    let mut motion = RungeKutta::new(scene)?;
    motion.run(&Steps::adaptive(1e-6).until(1e3), |_| ())?;
    let at = motion.snapshot();
    Ok((0..144)
        .map(|k| SVector::from(at.displacement[k]))
        .collect())
}

/// Without coupling of both components slip follows the traction; a turn of the load turns all of it.
#[test]
fn slip_follows_the_traction() -> Outcome {
    let load = Vector2::new(14e6, 9e6);
    let slip = square(0.0, load)?;
    let direction = load.normalize();
    let most = slip.iter().map(Vector2::norm).fold(0.0, f64::max);
    assert!(most > 1e-4, "{most:e}");
    for slip in &slip {
        let across = slip.perp(&direction);
        assert!(across.abs() <= 1e-8 * slip.norm(), "{slip:?}");
    }
    // Along an axis of symmetry also with coupling, in the middle rows by symmetry of both sides.
    let along = square(0.25, Vector2::new(16e6, 0.0))?;
    for row in 0..6 {
        for column in 0..12 {
            let (one, other) = (along[row * 12 + column], along[(11 - row) * 12 + column]);
            assert!((one[0] - other[0]).abs() < 1e-10 * most);
            assert!((one[1] + other[1]).abs() < 1e-10 * most);
        }
    }
    let across = square(0.25, Vector2::new(0.0, 16e6))?;
    for row in 0..12 {
        for column in 0..12 {
            let (one, turned) = (along[row * 12 + column], across[column * 12 + row]);
            assert!((one - Vector2::new(turned[1], turned[0])).norm() < 1e-9 * most);
        }
    }
    Ok(())
}

/// The scene of the benchmark BP3 with cells of 400 m.
fn thrust() -> Outcome<RungeKutta<1>> {
    let fault = DippingFault::new(
        Cells::new([0.0, 40e3], 100)?,
        MEDIUM,
        0.25,
        60.0,
        Sense::Thrust,
    )?;
    let a = |z: f64| 0.010 + 0.015 * ((z - 15e3) / 3e3).clamp(0.0, 1.0);
    let laws = fault
        .cells()
        .map(|z| RegularizedDieterichRuina { a: a(z), ..LAW });
    let aging = Dieterich {
        slip_distance: 8e-3,
    };
    let contact = Contact::per_vertex(&fault, laws, 50e6)
        .with_state(aging, LogTheta((8e-3 / PLATE).ln()))
        .with_shear_stress(Vector1::new(26.5e6));
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_load_history(fault.plate_loading(PLATE))
        .with_normal_stress_change(fault.normal_stiffness(), Vector1::new(PLATE))
        .with_contact(contact);
    Ok(RungeKutta::new(scene)?)
}

/// The normal stress of a thrust is `sigma_0 + N (D - V_p t)`, and a run that is restored goes on with the same bits.
#[test]
fn a_thrust_clamps_itself_and_is_restored() -> Outcome {
    let fault = DippingFault::new(
        Cells::new([0.0, 40e3], 100)?,
        MEDIUM,
        0.25,
        60.0,
        Sense::Thrust,
    )?;
    let normal = fault.normal_stiffness();
    let mut motion = thrust()?;
    let steps = Steps::adaptive(1e-5);
    motion.run(&steps.clone().until(1e8), |_| ())?;
    let state = motion.snapshot().state().clone();
    let mut restored = thrust()?;
    restored.restore(&state)?;
    motion.run(&steps.clone().until(2e9), |_| ())?;
    restored.run(&steps.until(2e9), |_| ())?;
    let at = motion.snapshot();
    assert!(at.state() == restored.snapshot().state());
    let time = at.time;
    let moved: Vec<_> = at
        .displacement
        .iter()
        .map(|d| d - Vector1::new(PLATE * time))
        .collect();
    let mut change = vec![0.0; 100];
    normal.multiply_add(1.0, &moved, &mut change);
    for (k, change) in change.iter().enumerate() {
        let found = at.contact(0).normal_stress(k);
        assert!((found - 50e6 - change).abs() < 1e-9 * 50e6, "{k}");
        assert!(k > 5 || change.abs() > 1e-6 * 50e6, "{k}: {change}");
    }
    Ok(())
}
