//! Bodies of finite elements: the paper's slider by its methods, through its first event, and bodies of other kinds.

use nalgebra::{Vector2, Vector3};
use stickslip::fem::{Elastic, P1, body_force, elasticity, mass};
use stickslip::friction::{RegularizedDieterichRuina, Tresca};
use stickslip::problems::antiplane_layer::{self, AntiplaneLayer};
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::problems::two_layers::TwoLayers;
use stickslip::reduced::Reduced;
use stickslip::state::LogTheta;
use stickslip::{
    BackwardEuler, BlockMatrix, CentralDifferences, Components, Condensed, Contact, DenseNewton,
    Diagonal, GeneralizedAlpha, Monolithic, Newmark, NormalStress, Scene, Sdirk2, Simulation,
    Staggered, StateUpdate, Steps, Tnnmg,
};

use super::{Cost, simulated};
use crate::Outcome;
use crate::common::{Solver, body, paper_slider};

/// Through the first event.
const UNTIL: f64 = 11.0;

/// The paper's slider with a regularised law.
fn slider(lumped: bool) -> Outcome<(P1<2>, Scene<BlockMatrix<2>, 2>)> {
    let body = PippingSlider { lumped, ..body(1) };
    let space = body.space()?;
    let law = RegularizedDieterichRuina::from(FRICTION);
    let contact = Contact::new(&PippingSlider::bottom(&space)?, law, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = body.scene(&space)?.with_contact(contact);
    Ok((space, scene))
}

fn sliders() -> Outcome<Vec<Cost>> {
    let constant = Steps::constant(1.5e-2).until(UNTIL);
    let mut costs = Vec::new();
    for (name, solver) in [
        ("slider fixed point multigrid", Solver::Tnnmg),
        ("slider fixed point Gauss-Seidel", Solver::GaussSeidel),
        ("slider fixed point condensed", Solver::Condensed),
    ] {
        let body = body(1);
        let space = body.space()?;
        costs.push(simulated(
            name,
            paper_slider(&body, &space, solver, 1e-10)?,
            &constant,
        )?);
    }
    let (space, scene) = slider(false)?;
    let solver = Tnnmg::new(space.transfers());
    let monolithic = Simulation::new(scene, GeneralizedAlpha::default(), solver)?
        .with_coupling(Monolithic::default());
    costs.push(simulated(
        "slider monolithic multigrid",
        monolithic,
        &constant,
    )?);
    let (_, scene) = slider(false)?;
    let staged =
        Simulation::new(scene, Sdirk2, Condensed::new())?.with_coupling(Monolithic::default());
    costs.push(simulated("slider Sdirk2 condensed", staged, &constant)?);
    let (_, scene) = slider(false)?;
    let adaptive = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?
        .with_coupling(Monolithic::default());
    let steps = Steps::adaptive(1e-3).in_powers_of_two().until(UNTIL);
    costs.push(simulated("slider adaptive condensed", adaptive, &steps)?);
    let (_, scene) = slider(false)?;
    let reduced = Reduced::new(&scene).up_to_frequency(100.0)?.reduce(scene)?;
    let reduced = Simulation::new(reduced, Newmark::default(), DenseNewton::new())?;
    costs.push(simulated("slider reduced", reduced, &constant)?);
    let (_, scene) = slider(true)?;
    let explicit = Simulation::new(scene, CentralDifferences, Diagonal::new())?
        .with_coupling(Staggered::default())
        .with_state_update(StateUpdate::Midpoint);
    costs.push(simulated(
        "slider central differences",
        explicit,
        &Steps::constant(5e-4).count(2000),
    )?);
    Ok(costs)
}

const ROCK: Elastic = Elastic {
    young_modulus: 5e7,
    poisson_ratio: 0.3,
};

/// A block whose weight bears it on a slope of 35 degrees, where it can open.
fn on_a_slope() -> Outcome<Cost> {
    let space = P1::grid([1.0, 0.5], [4, 2])?;
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let law = Tresca { coefficient: 0.6 };
    let contact = Contact::new(&bottom, law, NormalStress::from_body(0.0)).allow_opening();
    let (sin, cos) = 35_f64.to_radians().sin_cos();
    let weight = Vector2::new(sin, -cos) * 9.81 * 5e3;
    let scene = Scene::new(elasticity(&space, &ROCK)?)
        .with_mass(mass(&space, 5e3)?)
        .with_load(body_force(&space, |_| weight))
        .with_contact(contact);
    let block = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    simulated("block on a slope", block, &Steps::constant(1e-2).until(1.0))
}

/// A block without mass in space, pulled obliquely.
fn in_space() -> Outcome<Cost> {
    let space = P1::<3>::grid([2.0, 1.0, 1.0], [2, 1, 1])?.refined(1)?;
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let law = RegularizedDieterichRuina::from(FRICTION);
    let contact = Contact::new(&bottom, law, NORMAL_STRESS).with_state(AGING, LogTheta(-5.0));
    let scene = Scene::new(elasticity(&space, &ROCK)?)
        .with_contact(contact)
        .with_displacement(vec![Vector3::zeros(); space.vertex_count()])
        .prescribe_velocity(&space.trace(|x| x[1] == 1.0)?, Components::ALL, |_| {
            [2e-3, 0.0, 1e-3]
        });
    let solver = Tnnmg::new(space.transfers());
    let block = Simulation::new(scene, BackwardEuler, solver)?.with_coupling(Monolithic::default());
    simulated("block in space", block, &Steps::constant(1e-2).until(1.0))
}

fn layers() -> Outcome<Vec<Cost>> {
    let steps = Steps::constant(antiplane_layer::END / 500.0).count(500);
    let laws = || (RegularizedDieterichRuina::from(FRICTION), LogTheta(-10.0));
    let layer = AntiplaneLayer::default();
    let space = layer.space()?;
    let (law, state) = laws();
    let contact = Contact::new(
        &AntiplaneLayer::base(&space)?,
        law,
        antiplane_layer::NORMAL_STRESS,
    )
    .with_state(AGING, state);
    let scene = layer.scene(&space)?.with_contact(contact);
    let one = Simulation::new(scene, Newmark::default(), Tnnmg::new(space.transfers()))?;
    let layers = TwoLayers::default();
    let space = layers.space()?;
    let [upper, lower] = TwoLayers::sides(&space)?;
    let (law, state) = laws();
    let contact = Contact::between(&upper, &lower, law, antiplane_layer::NORMAL_STRESS)
        .with_state(AGING, state);
    let scene = layers.scene(&space)?.with_contact(contact);
    let two = Simulation::new(scene, Newmark::default(), Condensed::new())?
        .with_coupling(Monolithic::default());
    Ok(vec![
        simulated("antiplane layer", one, &steps)?,
        simulated("two antiplane layers", two, &steps)?,
    ])
}

pub(super) fn all() -> Outcome<Vec<Cost>> {
    let mut costs = sliders()?;
    costs.extend([on_a_slope()?, in_space()?]);
    costs.extend(layers()?);
    Ok(costs)
}
