//! Wrong input is named before the first step; a failed step names itself and leaves no trace.

mod boundaries;
mod contacts;
mod contradictions;
mod input;
mod lengths;
mod matrices;
mod meshes;
mod repeated;
mod restore;
mod sources;
mod steps;
mod values;

use nalgebra::SMatrix;
use stickslip::friction::{DieterichRuina, FrictionLaw, Tresca};
use stickslip::problems::pipping_slider::{AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS};
use stickslip::state::{Dieterich, LogTheta, Reads, StateLaw};
use stickslip::{
    BlockGaussSeidel, BlockMatrix, BoundaryPart, Contact, Newmark, Point, Scene, SceneError,
    Simulation,
};

use crate::Outcome;

const NAN: f64 = f64::NAN;
const ALPHA: LogTheta = LogTheta(INITIAL_LOG_THETA);
const COULOMB: Tresca = Tresca { coefficient: 0.6 };

type Spring = Scene<SMatrix<f64, 1, 1>, 1>;

/// A spring that is in order, without friction.
fn free_spring() -> Spring {
    Scene::new(SMatrix::from([[1e6]]))
}

/// Friction without state on a point, in order.
fn coulomb() -> Contact<Tresca, (), 1> {
    Contact::new(BoundaryPart::point(1.0), COULOMB, 1e5)
}

/// Friction with a state on a point, in order.
fn aging() -> Contact<DieterichRuina, Dieterich, 1> {
    Contact::new(BoundaryPart::point(1.0), FRICTION, NORMAL_STRESS).with_state(AGING, ALPHA)
}

/// A spring slider that is in order.
fn spring() -> Spring {
    free_spring().with_contact(coulomb())
}

/// The error of a scene that must not run; its text is one line.
fn error_of(scene: Spring) -> Outcome<SceneError> {
    let made = Simulation::new(scene, Newmark::default(), Point);
    one_line(made.err().ok_or("the scene was accepted")?)
}

/// The error of a spring slider with a contact that is not in order.
fn contact_error<L, S>(contact: Contact<L, S, 1>) -> Outcome<SceneError>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    error_of(free_spring().with_contact(contact))
}

/// The error of a body that must not run.
fn body_error<const C: usize>(scene: Scene<BlockMatrix<C>, C>) -> Outcome<SceneError> {
    let made = Simulation::new(scene, Newmark::default(), BlockGaussSeidel::new());
    one_line(made.err().ok_or("the scene was accepted")?)
}

fn one_line<E: std::error::Error>(error: E) -> Outcome<E> {
    let text = error.to_string();
    if text.is_empty() || text.contains('\n') {
        return Err(format!("not one line: {text}").into());
    }
    Ok(error)
}
