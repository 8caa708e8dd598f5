//! Wrong input is named before the first step; a failed step names itself and leaves no trace.
#![cfg(all(feature = "fem", feature = "tnnmg"))]

#[path = "../common/mod.rs"]
mod common;

mod boundaries;
mod input;
mod lengths_and_values;
mod steps;

use nalgebra::SMatrix;
use stickslip::friction::{DieterichRuina, FrictionLaw, Tresca};
use stickslip::problems::{AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS};
use stickslip::state::{Dieterich, LogTheta, StateLaw};
use stickslip::{
    BlockGaussSeidel, BlockMatrix, Newmark, Patch, Point, Scene, SceneError, Simulation,
};

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
