//! Wrong input is named before the first step; a failed step names itself and leaves no trace.
#![cfg(all(feature = "fem", feature = "tnnmg"))]

mod common;

use nalgebra::{SMatrix, Vector1, Vector2};
use stickslip::fem::{Elastic, FemError, P1, antiplane, mass};
use stickslip::friction::{DieterichRuina, FrictionError, FrictionLaw, Tresca};
use stickslip::problems::{AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, Slider};
use stickslip::state::{Dieterich, LogTheta, StateError, StateLaw};
use stickslip::time::TimeError;
use stickslip::tnnmg::SolveError;
use stickslip::{
    BackwardEuler, BlockGaussSeidel, BlockMatrix, Failure, FixedPoint, Newmark, Patch, Point,
    Scene, SceneError, Simulation, StepError, Stepper, Tnnmg,
};

use common::{Outcome, STEP, Solver, bits, body, paper_slider, slide};

const NAN: f64 = f64::NAN;
const ALPHA: LogTheta = LogTheta(INITIAL_LOG_THETA);

type Spring<L, S> = Scene<SMatrix<f64, 1, 1>, L, S, 1>;
type Body<L, S, const C: usize> = Scene<BlockMatrix<C>, L, S, C>;

fn stiffness() -> SMatrix<f64, 1, 1> {
    SMatrix::from([[1e6]])
}

/// A spring slider that is in order.
fn spring() -> Spring<Tresca, ()> {
    Scene::new(stiffness()).with_friction(Patch::point(1.0), Tresca { coefficient: 0.6 }, 1e5)
}

fn aging_spring() -> Spring<DieterichRuina, Dieterich> {
    Scene::new(stiffness())
        .with_friction(Patch::point(1.0), FRICTION, NORMAL_STRESS)
        .with_state(AGING, ALPHA)
}

/// The error of a scene that must not run; its text is one line.
fn error_of<L, S>(scene: Spring<L, S>) -> Result<SceneError, String>
where
    L: FrictionLaw + Clone,
    S: StateLaw + Clone,
    L::State: From<S::State>,
{
    let made = Simulation::new(scene, Newmark::default(), Point);
    one_line(made.err().ok_or("the scene was accepted")?)
}

fn body_error<L, S, const C: usize>(scene: Body<L, S, C>) -> Result<SceneError, String>
where
    L: FrictionLaw + Clone,
    S: StateLaw + Clone,
    L::State: From<S::State>,
{
    let made = Simulation::new(scene, Newmark::default(), BlockGaussSeidel::new());
    one_line(made.err().ok_or("the scene was accepted")?)
}

fn one_line<E: std::error::Error>(error: E) -> Result<E, String> {
    let text = error.to_string();
    if text.is_empty() || text.contains('\n') {
        return Err(format!("not one line: {text}"));
    }
    Ok(error)
}

/// Where a parameter of the law is.
type Parameter = fn(&mut DieterichRuina) -> &mut f64;

#[test]
fn laws_with_parameters_out_of_range_are_named() -> Outcome {
    let positive: [(&str, Parameter); 3] = [
        ("a", |law| &mut law.a),
        ("reference_velocity", |law| &mut law.reference_velocity),
        ("slip_distance", |law| &mut law.slip_distance),
    ];
    let non_negative: [(&str, Parameter); 2] = [
        ("b", |law| &mut law.b),
        ("reference_friction", |law| &mut law.reference_friction),
    ];
    let scene = |field: Parameter, value| {
        let mut law = FRICTION;
        *field(&mut law) = value;
        aging_spring().with_friction(Patch::point(1.0), law, NORMAL_STRESS)
    };
    for value in [-1e-3, NAN, f64::INFINITY] {
        for (name, field) in positive.into_iter().chain(non_negative) {
            let text = error_of(scene(field, value))?.to_string();
            assert!(
                text.contains("friction law") && text.contains(name),
                "{text}"
            );
            assert!(text.contains(&value.to_string()), "{text}");
        }
        let slip_distance = value;
        let error = error_of(aging_spring().with_state(Dieterich { slip_distance }, ALPHA))?;
        let SceneError::State(StateError::NotPositive { parameter, .. }) = error else {
            return Err(error.into());
        };
        assert_eq!(parameter, "slip_distance");
    }
    for (name, field) in positive {
        let error = error_of(scene(field, 0.0))?;
        let expected = FrictionError::NotPositive {
            parameter: name,
            value: 0.0,
        };
        assert_eq!(error, SceneError::Friction(expected));
    }
    let law = Tresca { coefficient: -0.1 };
    let error = error_of(spring().with_friction(Patch::point(1.0), law, 1e5))?;
    assert!(matches!(
        error,
        SceneError::Friction(FrictionError::Negative { .. })
    ));
    Ok(())
}

#[test]
fn schemes_out_of_range_are_named() -> Outcome {
    for scheme in [(0.0, 0.5), (0.25, 0.0), (NAN, 0.5), (0.25, 1.1)] {
        let (beta, gamma) = scheme;
        let made = Simulation::new(spring(), Newmark { beta, gamma }, Point);
        let error = one_line(made.err().ok_or("accepted")?)?;
        assert!(matches!(
            error,
            SceneError::Time(TimeError::InvalidParameter {
                scheme: "Newmark",
                ..
            })
        ));
    }
    Ok(())
}

#[test]
fn material_data_out_of_range_are_named() -> Outcome {
    let paper = body(0);
    let space = paper.space()?;
    let error = |slider: Slider| slider.scene(&space).err().ok_or("accepted");
    for value in [0.0, -1.0, NAN, f64::INFINITY] {
        let slider = Slider {
            density: value,
            ..paper
        };
        let SceneError::Fem(FemError::Density { value: found }) = one_line(error(slider)?)? else {
            return Err("not the density".into());
        };
        assert_eq!(found.to_bits(), value.to_bits());
        let elastic = Elastic {
            young_modulus: value,
            ..paper.elastic
        };
        let error = one_line(error(Slider { elastic, ..paper })?)?;
        assert!(matches!(
            error,
            SceneError::Fem(FemError::YoungModulus { .. })
        ));
        assert!(antiplane(&space, value).is_err());
    }
    for poisson_ratio in [0.5, -1.0, 0.7, NAN] {
        let elastic = Elastic {
            poisson_ratio,
            ..paper.elastic
        };
        let error = one_line(error(Slider { elastic, ..paper })?)?;
        assert!(matches!(
            error,
            SceneError::Fem(FemError::PoissonRatio { .. })
        ));
    }
    for gravity in [NAN, f64::INFINITY] {
        let scene = Slider { gravity, ..paper }.scene(&space)?;
        let error = body_error(scene)?;
        assert!(matches!(error, SceneError::Value { what: "load", .. }));
    }
    let error = body(40).space().err().ok_or("refined 40 times")?;
    assert!(matches!(
        one_line(error)?,
        SceneError::Fem(FemError::TooManyVertices { .. })
    ));
    // A body whose sides are elsewhere has no bottom.
    let elsewhere = P1::new(stickslip::fem::Mesh::new(
        vec![
            Vector2::new(1.0, 1.0),
            Vector2::new(2.0, 1.0),
            Vector2::new(1.0, 2.0),
        ],
        vec![0, 1, 2],
    )?);
    let error = Slider::bottom(&elsewhere).err().ok_or("a bottom")?;
    assert_eq!(one_line(error)?, SceneError::Fem(FemError::EmptyTrace));
    Ok(())
}

/// The first word of the part that has the wrong length, and the two lengths.
fn wrong_length(error: SceneError) -> Result<(&'static str, usize, usize), SceneError> {
    match error {
        SceneError::Length {
            what,
            expected,
            found,
        } => Ok((what, expected, found)),
        other => Err(other),
    }
}

#[test]
fn lengths_that_do_not_fit_are_named() -> Outcome {
    let two = || vec![Vector1::new(0.0); 2];
    let cases = [
        (error_of(spring().with_load(two()))?, "load"),
        (
            error_of(spring().with_displacement(two()))?,
            "initial displacement",
        ),
        (error_of(spring().with_velocity(two()))?, "initial velocity"),
        (
            error_of(spring().with_acceleration(two()))?,
            "initial acceleration",
        ),
        (
            error_of(spring().with_friction::<Tresca>(
                Patch::point(1.0),
                vec![Tresca { coefficient: 0.6 }; 2],
                1e5,
            ))?,
            "friction law",
        ),
        (
            error_of(spring().with_friction(
                Patch::point(1.0),
                Tresca { coefficient: 0.6 },
                vec![1e5; 2],
            ))?,
            "normal stress",
        ),
        (
            error_of(aging_spring().with_state::<Dieterich>(vec![AGING; 2], ALPHA))?,
            "state law",
        ),
        (
            error_of(aging_spring().with_state(AGING, vec![ALPHA; 2]))?,
            "initial state",
        ),
    ];
    for (error, part) in cases {
        assert_eq!(wrong_length(error)?, (part, 1, 2));
    }
    let weights = Patch {
        vertices: vec![0],
        weights: vec![1.0; 2],
    };
    let error = error_of(spring().with_friction(weights, Tresca { coefficient: 0.6 }, 1e5))?;
    assert_eq!(wrong_length(error)?, ("frictional boundary", 1, 2));

    let (coarse, fine) = (body(0).space()?, body(1).space()?);
    let scene = body(1).scene(&fine)?.with_mass(mass(&coarse, 5e3)?);
    assert_eq!(wrong_length(body_error(scene)?)?, ("mass matrix", 33, 12));
    let solver = Tnnmg::new(body(2).space()?.hierarchy().prolongations());
    let made = Simulation::new(body(1).scene(&fine)?, BackwardEuler, solver);
    let error = one_line(made.err().ok_or("a hierarchy of another mesh")?)?;
    assert!(matches!(
        error,
        SceneError::Solver(SolveError::SizeMismatch { .. })
    ));
    Ok(())
}

#[test]
fn values_that_are_none_are_named() -> Outcome {
    let one = |value| vec![Vector1::new(value)];
    for value in [NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let cases = [
            (error_of(spring().with_load(one(value)))?, "load"),
            (
                error_of(spring().with_displacement(one(value)))?,
                "initial displacement",
            ),
            (
                error_of(spring().with_velocity(one(value)))?,
                "initial velocity",
            ),
            (
                error_of(spring().with_acceleration(one(value)))?,
                "initial acceleration",
            ),
            (
                error_of(spring().with_mass(SMatrix::from([[value]])))?,
                "mass matrix",
            ),
            (
                error_of(Scene::new(SMatrix::from([[value]])))?,
                "stiffness matrix",
            ),
            (
                error_of(aging_spring().with_state(AGING, LogTheta(value)))?,
                "initial state",
            ),
            (
                error_of(spring().with_friction(
                    Patch::point(1.0),
                    Tresca { coefficient: 0.6 },
                    value,
                ))?,
                "normal stress",
            ),
            (
                error_of(spring().with_friction(
                    Patch::point(value),
                    Tresca { coefficient: 0.6 },
                    1e5,
                ))?,
                "frictional boundary",
            ),
        ];
        for (error, part) in cases {
            let SceneError::Value { what, position, .. } = error else {
                return Err(error.into());
            };
            assert_eq!((what, position), (part, 0));
        }
    }
    let error =
        error_of(spring().with_friction(Patch::point(-1.0), Tresca { coefficient: 0.6 }, 1e5))?;
    assert!(matches!(error, SceneError::Value { value: -1.0, .. }));
    Ok(())
}

#[test]
fn boundary_parts_must_be_sets_of_vertices() -> Outcome {
    let paper = body(1);
    let space = paper.space()?;
    let patch = |vertices: Vec<usize>| Patch {
        weights: vec![1.0; vertices.len()],
        vertices,
    };
    let law = Tresca { coefficient: 0.6 };
    let scene = || paper.scene(&space);
    let parts = |patch: Patch| -> Result<_, Box<dyn std::error::Error>> {
        Ok([
            body_error(scene()?.with_friction(patch.clone(), law, 1e5))?,
            body_error(scene()?.hold(patch.clone(), [true, false]))?,
            body_error(scene()?.move_at(patch, [true, false], |_| [0.0; 2]))?,
        ])
    };
    let roles = ["frictional boundary", "held boundary", "moved boundary"];
    for (error, role) in parts(patch(vec![]))?.into_iter().zip(roles) {
        assert_eq!(error, SceneError::EmptyBoundary { what: role });
    }
    for (vertices, position) in [
        (vec![3, 2], 1),
        (vec![2, 2], 1),
        (vec![0, 33], 1),
        (vec![99], 0),
    ] {
        for (error, role) in parts(patch(vertices.clone()))?.into_iter().zip(roles) {
            let SceneError::Value {
                what,
                position: found,
                value,
                ..
            } = error
            else {
                return Err(error.into());
            };
            assert_eq!((what, found), (role, position));
            assert_eq!(value, vertices[position] as f64);
        }
    }
    Ok(())
}

#[test]
fn touching_boundaries_are_named() -> Outcome {
    let paper = body(1);
    let space = paper.space()?;
    let bottom = Slider::bottom(&space)?;
    let law = Tresca { coefficient: 0.6 };
    let scene =
        || -> Result<_, SceneError> { Ok(paper.scene(&space)?.with_friction(&bottom, law, 1e5)) };
    let corner = space.vertex_at([0.0, 0.0]).ok_or("no corner")?;
    let side = space.trace(|x| x[0] == 0.0)?;
    let touching = |other| SceneError::TouchingBoundaries {
        other,
        vertex: corner,
    };
    assert_eq!(
        body_error(scene()?.hold(&side, [true, true]))?,
        touching("held")
    );
    // Each of two parts holds one component.
    assert_eq!(
        body_error(scene()?.hold(&side, [true, false]))?,
        touching("held")
    );
    let moved = scene()?.move_at(&side, [true, true], |_| [0.0; 2]);
    assert_eq!(body_error(moved)?, touching("moved"));
    // With the normal component alone the bottom can still slide.
    assert!(body_error(scene()?.hold(&side, [false, true])).is_err());
    Ok(())
}

/// Without any support there is no equilibrium under a push.
#[test]
fn a_floating_body_has_no_equilibrium() -> Outcome {
    let space = P1::grid([2.0, 1.0], [2, 1])?.refined(1)?;
    let scene = || -> Result<_, SceneError> {
        let push = vec![Vector1::new(1.0); space.vertex_count()];
        let scene = Scene::new(antiplane(&space, 1e7)?).with_mass(mass(&space, 5e3)?);
        Ok(scene.with_load(push).in_equilibrium())
    };
    let solver = Tnnmg::new(space.hierarchy().prolongations());
    let made = Simulation::new(scene()?, Newmark::default(), solver);
    let error = one_line(made.err().ok_or("multigrid found one")?)?;
    assert!(matches!(error, SceneError::Solver(_)), "{error:?}");
    let error = body_error(scene()?)?;
    assert!(matches!(error, SceneError::Solver(_)), "{error:?}");
    Ok(())
}

/// What failed, where and when; in one line that says so.
fn failure_of<const C: usize>(stepper: &mut dyn Stepper<C>, dt: f64) -> Result<Failure, String> {
    let before = bits(&stepper.snapshot());
    let (step, time) = (stepper.snapshot().step, stepper.snapshot().time);
    let failure = stepper.step(dt).err().ok_or("the step was accepted")?;
    let failure = one_line(failure)?;
    if failure.step != step + 1 || (failure.time - (time + dt)).abs() > 1e-14 * time {
        return Err(format!("another step: {failure}"));
    }
    if !failure.to_string().contains(&format!("step {}", step + 1)) {
        return Err(format!("which step? {failure}"));
    }
    let after = stepper.snapshot();
    if bits(&after) != before || (after.step, after.time) != (step, time) {
        return Err("the last accepted step has changed".into());
    }
    Ok(failure)
}

#[test]
fn step_sizes_out_of_range_leave_no_trace() -> Outcome {
    let body = body(1);
    let space = body.space()?;
    let mut failing = paper_slider(&body, &space, Solver::Tnnmg, 1e-10)?;
    let mut steady = paper_slider(&body, &space, Solver::Tnnmg, 1e-10)?;
    for n in 0..60 {
        for dt in [0.0, -STEP, NAN, f64::INFINITY] {
            let StepError::StepSize { dt: found } = failure_of(&mut *failing, dt)?.cause else {
                return Err("another failure".into());
            };
            assert_eq!(found.to_bits(), dt.to_bits());
        }
        let dt = if n < 40 { STEP } else { 3.0 * STEP };
        assert_eq!(failing.step(dt)?, steady.step(dt)?);
        assert_eq!(bits(&failing.snapshot()), bits(&steady.snapshot()));
        assert_eq!(failing.snapshot().time, steady.snapshot().time);
    }
    Ok(())
}

/// A load and a pull that are no numbers around 0.35 s: the steps into the gap fail, a longer one
/// over it goes on as if nothing had been tried.
#[test]
fn data_that_turn_nan_are_named_and_can_be_stepped_over() -> Outcome {
    let gap = |time: f64| {
        if (0.325..0.375).contains(&time) {
            NAN
        } else {
            0.0
        }
    };
    let body = body(1);
    let space = body.space()?;
    let side = space.trace(|x| x[0] == 5.0)?;
    let corner = side.vertices()[0];
    let first = space.trace(|x| x[1] == 1.0)?.vertices()[0];
    for load in [true, false] {
        let make = || -> Result<_, Box<dyn std::error::Error>> {
            let scene = body
                .scene(&space)?
                .with_friction(&Slider::bottom(&space)?, FRICTION, NORMAL_STRESS)
                .with_state(AGING, ALPHA);
            let scene = if load {
                scene.with_load_history(move |time, load| load[corner][0] = 1e3 * time + gap(time))
            } else {
                let top = space.trace(|x| x[1] == 1.0)?;
                scene.move_at(&top, [true, true], move |time| [1e-3 * time, gap(time)])
            };
            let solver = Tnnmg::new(space.hierarchy().prolongations());
            Ok(Simulation::new(scene, Newmark::default(), solver)?)
        };
        let (mut failing, mut steady) = (make()?, make()?);
        failing.run(3, 0.1, &mut |_| ())?;
        steady.run(3, 0.1, &mut |_| ())?;
        for dt in [0.05, 0.03] {
            let failure = failure_of(&mut failing, dt)?;
            let StepError::Data {
                what,
                vertex,
                value,
            } = failure.cause
            else {
                return Err(failure.into());
            };
            let expected = if load {
                ("load", corner)
            } else {
                ("prescribed velocity", first)
            };
            assert_eq!(
                (what, vertex, value.is_nan()),
                (expected.0, expected.1, true)
            );
            assert!((failure.time - (0.3 + dt)).abs() < 1e-15);
        }
        for _ in 0..5 {
            assert_eq!(failing.step(0.1)?, steady.step(0.1)?);
            assert_eq!(bits(&failing.snapshot()), bits(&steady.snapshot()));
        }
        assert!(failing.snapshot().max_slip_rate() > 0.0);
    }
    Ok(())
}

/// In the middle of an event a long step needs more than 20 velocity problems; the short ones after
/// it go on as if it had never been tried.
#[test]
fn steps_that_do_not_couple_can_be_taken_shorter() -> Outcome {
    let body = body(1);
    let space = body.space()?;
    let make = || -> Result<_, Box<dyn std::error::Error>> {
        let laws = (FRICTION, AGING, ALPHA);
        let scheme = Newmark::default();
        let slider = slide(&body, &space, laws, scheme, Solver::Tnnmg, 1e-10)?;
        Ok(slider.with_coupling(FixedPoint::paper().with_max_iterations(20)))
    };
    let (mut failing, mut steady) = (make()?, make()?);
    failing.run(6700, STEP, &mut |_| ())?;
    steady.run(6700, STEP, &mut |_| ())?;
    let (mut failures, mut most, mut peak) = (0, 0, 0_f64);
    for _ in 0..50 {
        let before = failing.snapshot().step;
        match failing.step(10.0 * STEP) {
            Ok(_) => {
                steady.step(10.0 * STEP)?;
            }
            Err(failure) => {
                let StepError::NotCoupled {
                    iterations: 20,
                    change,
                    tolerance: 1e-10,
                } = failure.cause
                else {
                    return Err(failure.into());
                };
                assert!(change > 1e-10 && change.is_finite());
                assert_eq!(
                    (failure.step, failing.snapshot().step),
                    (before + 1, before)
                );
                one_line(failure)?;
                failures += 1;
            }
        }
        assert_eq!(bits(&failing.snapshot()), bits(&steady.snapshot()));
        let report = failing.step(STEP)?;
        assert_eq!(report, steady.step(STEP)?);
        assert_eq!(bits(&failing.snapshot()), bits(&steady.snapshot()));
        assert_eq!(failing.snapshot().time, steady.snapshot().time);
        most = report.coupling_iterations.max(most);
        peak = failing.snapshot().max_slip_rate().max(peak);
    }
    assert!(
        failures > 0 && most > 5 && peak > 1e-3,
        "{failures}, {most}, {peak:e}"
    );
    Ok(())
}

/// A law that has no answer is named with vertex and rate.
#[derive(Debug, Clone, Copy)]
struct Broken;

impl StateLaw for Broken {
    type State = LogTheta;

    fn evolution(&self, _state: LogTheta, slip_rate: f64) -> f64 {
        if slip_rate > 1e-3 { NAN } else { 0.0 }
    }

    fn evolution_slope(&self, _state: LogTheta, _slip_rate: f64) -> f64 {
        0.0
    }
}

#[test]
fn a_state_law_without_an_answer_is_named() -> Outcome {
    let scene = aging_spring()
        .with_state(Broken, ALPHA)
        .with_load_history(|time, load| load[0][0] = 1e6 * time);
    let mut slider = Simulation::new(scene, BackwardEuler, Point)?;
    slider.run(5, 1e-3, &mut |_| ())?;
    let failure = failure_of(&mut slider, 1.0)?;
    let StepError::State {
        vertex,
        slip_rate,
        source,
    } = failure.cause
    else {
        return Err(failure.into());
    };
    assert!(vertex == 0 && slip_rate > 1e-3);
    assert!(matches!(source, StateError::Advance { dt: 1.0, .. }));
    slider.run(5, 1e-3, &mut |_| ())?;
    assert_eq!(slider.snapshot().step, 10);
    Ok(())
}
