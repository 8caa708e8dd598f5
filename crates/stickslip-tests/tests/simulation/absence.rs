//! Terms absent from a scene are neither stored nor computed: no state, no mass, no friction.

use std::f64::consts::TAU;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use nalgebra::{SMatrix, SVector, Vector1};
use stickslip::fem::{P1, elasticity, lumped_mass, mass};
use stickslip::friction::{Radial, RegularizedDieterichRuina, Tresca};
use stickslip::integrate::{CouplingReport, StepMaps};
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::solvers::{Energy, SolveError, SolveReport, Stopping};
use stickslip::state::{LogTheta, StateLaw};
use stickslip::time::QuasiStatic;
use stickslip::{
    BackwardEuler, BlockMatrix, BoundaryPart, Components, Contact, Coupling, Matrix, Newmark,
    NonsmoothSolver, Operator, Point, Scene, Simulation, StepError, Steps, Tnnmg,
};

use crate::Outcome;
use crate::common::{body, distance};

/// A coupling that must not be asked.
struct Forbidden;

impl Coupling for Forbidden {
    fn couple(&self, _: &mut dyn StepMaps, _: f64) -> Result<CouplingReport, StepError> {
        Err(StepError::StepSize { dt: f64::NAN })
    }
}

#[test]
fn tresca_stores_no_state_and_couples_nothing() -> Outcome {
    assert_eq!(size_of::<<() as StateLaw>::State>(), 0);
    let friction = Tresca { coefficient: 0.01 };
    assert_eq!(
        size_of_val(&Radial::<Tresca> {
            law: friction,
            force: 1.0,
            state: ()
        }),
        2 * size_of::<f64>()
    );
    let body = body(1);
    let space = body.space()?;
    let bottom = PippingSlider::bottom(&space)?;
    let contact = Contact::new(&bottom, friction, NORMAL_STRESS);
    let scene = body.scene(&space)?.with_contact(contact);
    let solver = Tnnmg::new(space.transfers());
    let mut slider = Simulation::new(scene, Newmark::default(), solver)?.with_coupling(Forbidden);
    let mut slipped = false;
    for _ in 0..100 {
        assert_eq!(slider.step(0.02)?.coupling_iterations, 1);
        slipped |= slider.snapshot().max_slip_rate() > 1e-6;
    }
    assert!(slipped);
    assert!(!slider.snapshot().contact(0).has_state());
    let kept = &slider.state().contacts[0];
    assert!(kept.states.is_empty() && kept.earlier.is_empty());
    Ok(())
}

/// The number of uses of an operator.
#[derive(Debug, Default)]
struct Count {
    products: AtomicUsize,
    /// Matrices that entered sums, and sums.
    terms: AtomicUsize,
    sums: AtomicUsize,
}

impl Count {
    fn products(&self) -> usize {
        self.products.load(Relaxed)
    }

    fn sums(&self) -> usize {
        self.sums.load(Relaxed)
    }

    /// The matrices that enter a sum, the same number in all of them.
    fn terms_a_sum(&self) -> usize {
        assert_eq!(self.terms.load(Relaxed) % self.sums(), 0);
        self.terms.load(Relaxed) / self.sums()
    }
}

/// A matrix that counts; the product of a single row counts as one of the whole.
struct Counted(BlockMatrix<2>, Arc<Count>);

impl Counted {
    fn sum(&self, terms: usize) {
        self.1.terms.fetch_add(terms, Relaxed);
        self.1.sums.fetch_add(1, Relaxed);
    }
}

impl Matrix<2> for Counted {
    fn vertex_count(&self) -> usize {
        self.0.vertex_count()
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, 2>]) -> SVector<f64, 2> {
        self.1.products.fetch_add(1, Relaxed);
        self.0.product_at(i, x)
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, 2, 2> {
        self.0.diagonal_block(i)
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, 2>], y: &mut [SVector<f64, 2>]) {
        self.1.products.fetch_add(1, Relaxed);
        self.0.multiply_add(scale, x, y);
    }

    fn quadratic(&self, x: &[SVector<f64, 2>]) -> f64 {
        self.0.quadratic(x)
    }
}

impl Operator<2> for Counted {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, 2, 2>) {
        self.0.add_to_diagonal(i, block);
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        let terms: Vec<_> = terms.iter().copied().chain(mass).collect();
        let inner: Vec<_> = terms
            .iter()
            .map(|(factor, term)| (*factor, &term.0))
            .collect();
        let counter = Arc::clone(&terms[0].1.1);
        let sum = Self(BlockMatrix::combination(&inner), counter);
        sum.sum(inner.len());
        sum
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        let terms = terms.iter().copied().chain(mass);
        let inner: Vec<_> = terms.map(|(factor, term)| (factor, &term.0)).collect();
        self.0.set_combination(&inner);
        self.sum(inner.len());
    }
}

/// Multigrid on the matrix inside.
struct Inside(Tnnmg<2>);

impl NonsmoothSolver<Counted, 2> for Inside {
    fn prepare(&mut self, energy: &Energy<'_, Counted, 2>) -> Result<(), SolveError> {
        self.0.prepare(&inside(energy))
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, Counted, 2>,
        stopping: &Stopping<'_, Counted>,
        v: &mut [SVector<f64, 2>],
    ) -> Result<SolveReport, SolveError> {
        let stopping = Stopping {
            norm: &stopping.norm.0,
            tolerance: stopping.tolerance,
            relative: stopping.relative,
            equivalence: stopping.equivalence,
            max_iterations: stopping.max_iterations,
        };
        self.0.minimize(&inside(energy), &stopping, v)
    }
}

fn inside<'a>(energy: &Energy<'a, Counted, 2>) -> Energy<'a, BlockMatrix<2>, 2> {
    Energy {
        operator: &energy.operator.0,
        load: energy.load,
        potentials: energy.potentials,
        vertices: energy.vertices,
        fixed: energy.fixed,
    }
}

/// Two squares.
fn strip() -> Outcome<P1<2>> {
    Ok(P1::grid([2.0, 1.0], [2, 1])?.refined(1)?)
}

/// A body of them, its matrices counted.
fn counted(count: &Arc<Count>, space: &P1<2>, inertia: bool) -> Outcome<Scene<Counted, 2>> {
    let stiffness = elasticity(space, &body(1).elastic)?.into_matrix();
    let scene = Scene::new(Counted(stiffness, Arc::clone(count)));
    if !inertia {
        return Ok(scene);
    }
    let mass = mass(space, 5e3)?.into_matrix();
    Ok(scene.with_mass(Counted(mass, Arc::clone(count))))
}

/// The same, pulled at its top on a frictional bottom.
fn pulled(count: &Arc<Count>, inertia: bool) -> Outcome<(Scene<Counted, 2>, Inside)> {
    let space = strip()?;
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let contact = Contact::new(&bottom, Tresca { coefficient: 0.1 }, NORMAL_STRESS);
    let scene = counted(count, &space, inertia)?
        .with_contact(contact)
        .prescribe_velocity(&space.trace(|x| x[1] == 1.0)?, Components::ALL, |_| {
            [0.1, 0.0]
        });
    Ok((scene, Inside(Tnnmg::new(space.transfers()))))
}

#[test]
fn a_quasi_static_scene_has_no_mass_and_no_acceleration() -> Outcome {
    const STEPS: usize = 20;
    for inertia in [true, false] {
        let matrices = 1 + usize::from(inertia);
        let count = Arc::new(Count::default());
        let (scene, solver) = pulled(&count, inertia)?;
        let mut slider = Simulation::new(scene, BackwardEuler, solver)?;
        assert_eq!(count.terms_a_sum(), matrices);
        slider.step(1e-3)?;
        let before = (count.products(), count.sums());
        slider.run(&Steps::constant(1e-3).count(STEPS), |_| ())?;
        // One product a step and matrix; equal steps need no new sum.
        assert_eq!(count.products() - before.0, STEPS * matrices);
        assert_eq!(count.sums(), before.1);
        slider.step(2e-3)?;
        assert_eq!(count.sums(), before.1 + 1);
        assert_eq!(count.terms_a_sum(), matrices);
        let at = slider.snapshot();
        assert_eq!(at.acceleration.is_empty(), !inertia);
        assert!(at.max_slip_rate() > 1e-3);
    }
    Ok(())
}

/// Steps so short that all motion in them is below the tolerance: what the solver leaves open of the rates seems to ring
/// with them, and is not looked into in every step.
#[test]
fn no_accelerations_are_found_for_what_the_solver_leaves_open() -> Outcome {
    const STEPS: usize = 50;
    let count = Arc::new(Count::default());
    let space = body(2).space()?;
    let law = RegularizedDieterichRuina {
        reference_friction: 0.01,
        reference_velocity: 1e-12,
        ..FRICTION.into()
    };
    let bottom = Contact::new(&PippingSlider::bottom(&space)?, law, NORMAL_STRESS);
    let scene = counted(&count, &space, true)?
        .with_contact(bottom.with_state(AGING, LogTheta(-300.0)))
        .prescribe_velocity(&PippingSlider::top(&space)?, Components::ALL, |time| {
            [load_velocity(time), 0.0]
        });
    let solver = Inside(Tnnmg::new(space.transfers()));
    let slider = Simulation::new(scene, Newmark::default(), solver)?;
    let mut slider = slider.with_absolute_tolerance(1e-10)?;
    let steps = Steps::constant(1e-11);
    slider.run(&steps.clone().count(5), |_| ())?;
    let before = count.products();
    let mut swings = 0;
    slider.run(&steps.count(STEPS), |at| {
        let bottom = at.contact(0);
        let mut vertices = (0..bottom.len()).map(|k| (bottom.vertex(k), bottom.slip_rate(k)));
        swings += usize::from(vertices.any(|(p, rate)| 1e-11 * at.acceleration[p].norm() > rate));
    })?;
    // One of each matrix in a step.
    assert_eq!(count.products() - before, 2 * STEPS);
    assert!(swings > 0);
    Ok(())
}

/// A mass that is one number a pair of vertices is held as such, whatever the dimension.
#[test]
fn a_mass_of_finite_elements_has_no_blocks() -> Outcome {
    let plane = P1::grid([2.0, 1.0], [2, 1])?;
    let block = P1::grid([2.0, 1.0, 1.0], [2, 1, 1])?;
    let density = 5e3;
    let plane = Scene::new(elasticity(&plane, &body(1).elastic)?).with_mass(mass(&plane, density)?);
    let block =
        Scene::new(elasticity(&block, &body(1).elastic)?).with_mass(lumped_mass(&block, density)?);
    assert!(plane.mass().is_some_and(|mass| mass.is_scalar()));
    assert!(block.mass().is_some_and(|mass| mass.is_scalar()));
    Ok(())
}

/// [`QuasiStatic`] takes the inertia out of a scene that has it.
#[test]
fn a_scheme_without_inertia_ignores_the_mass() -> Outcome {
    let mut runs = Vec::new();
    for inertia in [true, false] {
        let (scene, solver) = pulled(&Arc::new(Count::default()), inertia)?;
        let scheme = QuasiStatic(Newmark::default());
        let mut slider = Simulation::new(scene, scheme, solver)?.with_absolute_tolerance(1e-13)?;
        slider.run(&Steps::constant(1e-3).count(20), |_| ())?;
        let at = slider.snapshot();
        assert!(at.acceleration.iter().all(|a| a.norm() == 0.0));
        runs.push((at.displacement.to_vec(), at.velocity.to_vec()));
    }
    assert!(distance(&runs[0].0, &runs[1].0) < 1e-13);
    let apart = distance(&runs[0].1, &runs[1].1);
    assert!(apart < 1e-10, "{apart:e}");
    assert!(runs[0].1.iter().any(|v| v.norm() > 1e-2));
    Ok(())
}

/// Newmark's oscillator `u'' = -w^2 u` is `cos(n phi)` with `tan(phi/2) = w dt/2`.
#[test]
fn a_scene_without_friction_swings() -> Outcome {
    let (stiffness, mass, dt) = (3.0_f64, 0.2, 0.1);
    let frequency = (stiffness / mass).sqrt();
    let angle = 2.0 * (0.5 * frequency * dt).atan();
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_mass(SMatrix::<f64, 1, 1>::new(mass))
        .with_displacement(vec![Vector1::new(1.0)])
        .with_acceleration(vec![Vector1::new(-stiffness / mass)]);
    let mut oscillator =
        Simulation::new(scene, Newmark::default(), Point)?.with_coupling(Forbidden);
    let periods = (10.0 * TAU / angle) as usize;
    for n in 1..=periods {
        let report = oscillator.step(dt)?;
        assert_eq!(
            (report.coupling_iterations, report.solver_iterations),
            (1, 1)
        );
        let at = oscillator.snapshot();
        assert!((at.displacement[0][0] - (n as f64 * angle).cos()).abs() < 1e-12);
        assert!(at.contact_count() == 0 && at.max_slip_rate() == 0.0);
        assert!(at.contacts().next().is_none());
    }
    Ok(())
}

/// A contact with friction coefficient zero is as good as none.
#[test]
fn frictionless_contact_equals_no_contact() -> Outcome {
    let scene = || {
        Scene::new(SMatrix::<f64, 1, 1>::new(3.0))
            .with_mass(SMatrix::<f64, 1, 1>::new(0.2))
            .with_velocity(vec![Vector1::new(1.0)])
    };
    let contact = Contact::new(BoundaryPart::point(1.0), Tresca { coefficient: 0.0 }, 1e5);
    let smooth = scene().with_contact(contact);
    let mut with = Simulation::new(smooth, Newmark::default(), Point)?;
    let mut without = Simulation::new(scene(), Newmark::default(), Point)?;
    for _ in 0..100 {
        with.step(0.1)?;
        without.step(0.1)?;
        let (with, without) = (with.snapshot(), without.snapshot());
        assert!(distance(with.velocity, without.velocity) < 1e-13);
        assert_eq!((with.contact(0).len(), without.contact_count()), (1, 0));
    }
    Ok(())
}
