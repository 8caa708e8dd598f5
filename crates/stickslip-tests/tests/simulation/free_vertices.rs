//! Vertices without friction, whose step is one pass over memory: the bits, reactions and errors of solving for all vertices.

use nalgebra::{SVector, Vector2};
use proptest::prelude::*;
use stickslip::fem::{
    Elastic, Impedance, P1, Trace, Viscous, dashpot, element_stiffness_by_cell, lumped_mass_by_cell,
};
use stickslip::problems::pipping_slider::{AGING, FRICTION};
use stickslip::solvers::{ElementOperator, Energy, SolveError, SolveReport, Stopping};
use stickslip::state::LogTheta;
use stickslip::{
    CentralDifferences, Components, Contact, Coupling, Diagonal, FixedPoint, Monolithic,
    NonsmoothSolver, Scene, Simulation, Staggered, Steps,
};

use crate::Outcome;

/// The solver of explicit steps, without a word on which vertices are free.
#[derive(Clone, Default)]
struct OfAll(Diagonal<2>);

impl NonsmoothSolver<ElementOperator<2>, 2> for OfAll {
    fn prepare(&mut self, energy: &Energy<'_, ElementOperator<2>, 2>) -> Result<(), SolveError> {
        self.0.prepare(energy)
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, ElementOperator<2>, 2>,
        stopping: &Stopping<'_, ElementOperator<2>>,
        v: &mut [SVector<f64, 2>],
    ) -> Result<SolveReport, SolveError> {
        self.0.minimize(energy, stopping, v)
    }
}

fn rock(cell: usize) -> Elastic {
    Elastic {
        young_modulus: 2.5 + (cell % 7) as f64,
        poisson_ratio: 0.05 * (cell % 9) as f64,
    }
}

/// How a body slides.
#[derive(Debug, Clone)]
struct Setting {
    cells: [usize; 2],
    /// The length of edges at the base; that of the cells if it is longer.
    edge: f64,
    levels: usize,
    /// The relaxation time of a viscosity by the product of the stiffness; of one by its own for negative ones.
    relaxation: Option<f64>,
    weight: bool,
    /// Loads that depend on time: none, one of all vertices, one of fixed shape at some, or both.
    pull: usize,
    held: bool,
    coupling: usize,
    speed: f64,
    /// A time, and a load at a vertex from then on; of fixed shape or not.
    poison: Option<(f64, f64, bool)>,
}

impl Default for Setting {
    fn default() -> Self {
        Self {
            cells: [8, 4],
            edge: 0.1,
            levels: 3,
            relaxation: None,
            weight: true,
            pull: 0,
            held: true,
            coupling: 0,
            speed: 0.1,
            poison: None,
        }
    }
}

fn settings() -> impl Strategy<Value = Setting> {
    let viscosity = prop::option::of(-1e-3..1e-3);
    let body = (1..5usize, 1..4usize, 0.05..0.5, 1..4usize, viscosity);
    let data = (
        any::<bool>(),
        0..4usize,
        any::<bool>(),
        0..5usize,
        1e-6..1.0,
    );
    (body, data).prop_map(|(body, data)| {
        let (nx, ny, edge, levels, relaxation) = body;
        let (weight, pull, held, coupling, speed) = data;
        Setting {
            cells: [nx, ny],
            edge,
            levels,
            relaxation,
            weight,
            pull,
            held,
            coupling,
            speed,
            poison: None,
        }
    })
}

fn coupling(number: usize) -> Box<dyn Coupling> {
    match number {
        0 => Box::new(Monolithic::default()),
        1 => Box::new(Staggered::default()),
        2 => Box::new(Staggered::with_passes(3)),
        3 => Box::new(FixedPoint::paper()),
        _ => Box::new(FixedPoint::accelerated()),
    }
}

/// A body with smaller cells near its base.
fn body(setting: &Setting) -> Outcome<P1<2>> {
    let space = P1::grid([2.0, 1.0], setting.cells)?;
    Ok(space.graded(|x| setting.edge * (1.0 + 8.0 * x[1]))?)
}

/// A body that slides on its base, with dashpots on its top.
fn sliding(
    setting: &Setting,
    solver: impl NonsmoothSolver<ElementOperator<2>, 2> + 'static,
) -> Outcome<Simulation<2>> {
    let space = body(setting)?;
    let side = |at: fn(&Vector2<f64>) -> bool| -> Outcome<Trace<2>> { Ok(space.trace(at)?) };
    let (base, top) = (side(|x| x[1] == 0.0)?, side(|x| x[1] == 1.0)?);
    let mass = lumped_mass_by_cell(&space, |_, cell| 1.0 + (cell % 5) as f64)?;
    let stiffness = element_stiffness_by_cell(&space, |_, cell| rock(cell))?;
    let stiffness = stiffness.with_local_steps(&space, &mass, base.vertices(), setting.levels)?;
    let speed = setting.speed;
    let mut scene = Scene::new(stiffness.clone())
        .with_mass(mass)
        .with_viscosity(dashpot(&space, &top, |_| Impedance {
            normal: 3.0,
            tangential: 2.0,
        })?)
        .with_contact(Contact::new(&base, FRICTION, 0.1).with_state(AGING, LogTheta(0.0)))
        .with_velocity(space.interpolate(|x| Vector2::new(speed * (0.1 + x[1]), 0.0)));
    if let Some(time) = setting.relaxation {
        scene = match time < 0.0 {
            false => scene.with_viscosity(&stiffness * time),
            true => scene.with_viscosity(stiffness.viscosity_by_cell(|cell| Viscous {
                shear_viscosity: -time * (cell % 3) as f64,
                bulk_viscosity: 0.0,
            })?),
        };
    }
    if setting.weight {
        scene = scene.with_load(space.interpolate(|x| Vector2::new(0.0, -0.01 * (1.0 + x[0]))));
    }
    if setting.pull >= 2 {
        let pull = space.interpolate(|x| Vector2::new(0.02 * (x[0] - 1.0).max(0.0), 0.0));
        scene = scene.with_scaled_load(pull, |time| 1.0 + time.sin());
    }
    if setting.pull % 2 == 1 {
        scene = scene.with_load_history(|time, load| {
            for (i, load) in load.iter_mut().enumerate() {
                load[0] += 0.01 * (time + i as f64).sin();
            }
        });
    }
    if let Some((from, value, scaled)) = setting.poison {
        let poison = move |time| if time > from { value } else { 0.0 };
        scene = if scaled {
            let mut unit = vec![Vector2::zeros(); space.vertex_count()];
            unit[20] = Vector2::repeat(1.0);
            scene.with_scaled_load(unit, poison)
        } else {
            scene.with_load_history(move |time, load| load[20][1] = poison(time))
        };
    }
    if setting.held {
        let end = side(|x| x[0] == 2.0)?;
        scene = scene.prescribe_velocity(&end, Components::from([true, false]), move |time| {
            [speed * (1.0 + time), 0.0]
        });
    }
    let body = Simulation::new(scene, CentralDifferences, solver)?;
    Ok(body.with_coupling(coupling(setting.coupling)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_step_has_the_bits_of_all_vertices(setting in settings(), share in 0.2..0.95) {
        let mut own = sliding(&setting, Diagonal::new()).expect("a scene");
        let mut all = sliding(&setting, OfAll::default()).expect("a scene");
        let limit = limit(&setting).expect("a limit");
        for factor in [share, 0.5 * share] {
            let steps = Steps::constant(factor * limit).count(8);
            let ended = own.run(&steps, |_| ()).map(|_| ()).map_err(|error| error.to_string());
            prop_assert_eq!(ended, all.run(&steps, |_| ()).map(|_| ()).map_err(|error| error.to_string()));
            prop_assert_eq!(own.state(), all.state());
            for vertex in 0..own.state().velocity.len() {
                let reactions = [&own, &all].map(|body| body.snapshot().reaction_at(vertex).expect("a vertex"));
                prop_assert_eq!(reactions[0], reactions[1]);
            }
        }
    }
}

/// The largest step of a body.
fn limit(setting: &Setting) -> Outcome<f64> {
    let mut body = sliding(setting, OfAll::default())?;
    let _ = body.step(f64::MAX);
    Ok(body.step_limit().ok_or("the scheme is explicit")?)
}

/// A load that is not finite any more is found where it is; the step before stays.
#[test]
fn what_is_not_finite_is_named() -> Outcome {
    let dt = 0.5 * limit(&Setting::default())?;
    let values = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    for (value, scaled) in values
        .into_iter()
        .flat_map(|value| [(value, false), (value, true)])
    {
        let setting = Setting {
            poison: Some((4.5 * dt, value, scaled)),
            ..Setting::default()
        };
        let mut own = sliding(&setting, Diagonal::new())?;
        let mut all = sliding(&setting, OfAll::default())?;
        let steps = Steps::constant(dt).count(4);
        own.run(&steps, |_| ())?;
        all.run(&steps, |_| ())?;
        let before = own.state().clone();
        let ended = [own.step(dt), all.step(dt)].map(|taken| format!("{:?}", taken.map(|_| ())));
        let named = ended[0].starts_with("Err(") && ended[0].contains("vertex: 20,");
        assert!(named, "{}", ended[0]);
        assert_eq!(ended[0], ended[1]);
        assert_eq!(own.state(), &before);
    }
    Ok(())
}

/// The default setting has vertices on which no force acts in some steps, fixed ones among them.
#[test]
fn some_vertices_are_idle() -> Outcome {
    let setting = Setting::default();
    let space = body(&setting)?;
    let base = space.trace(|x| x[1] == 0.0)?;
    let mass = lumped_mass_by_cell(&space, |_, cell| 1.0 + (cell % 5) as f64)?;
    let stiffness = element_stiffness_by_cell(&space, |_, cell| rock(cell))?;
    let stiffness = stiffness.with_local_steps(&space, &mass, base.vertices(), setting.levels)?;
    let lowest = stiffness.lowest_levels();
    assert!(lowest.contains(&0) && lowest.contains(&1), "{lowest:?}");
    let end = space.trace(|x| x[0] == 2.0)?;
    assert!(end.vertices().iter().any(|&vertex| lowest[vertex] > 0));
    Ok(())
}
