//! An a priori condition for the uniqueness of a step.

use nalgebra::SVector;

use super::definite::Definite;
use crate::laws::StateStep;
use crate::step::{Problem, Span, Workspace};
use crate::{StepError, StepState};

/// The resistance of the body to weakening of friction in the next step, see
/// [`Simulation::convexity`](crate::Simulation::convexity).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Convexity {
    /// The velocity problem with the state condensed is convex, so that the step has a unique solution.
    pub convex: bool,
    /// The frictional vertex at which `weakening` is the largest share of `diagonal_stiffness`.
    pub vertex: usize,
    /// Minus the least slope of the frictional force there, with its state condensed, 0 where it does not weaken [N
    /// s/m].
    pub weakening: f64,
    /// The slip rate of the steepest weakening [m/s].
    pub slip_rate: f64,
    /// The least diagonal entry of the operator `B` there [N s/m]: an upper bound of the body's resistance.
    pub diagonal_stiffness: f64,
    /// The largest `b/a` of the contacts, `dmu/dln(theta)` over `dmu/dln(V)`; 0 without a state.
    pub b_over_a: f64,
}

/// See [`Simulation::convexity`](crate::Simulation::convexity).
pub(crate) fn convexity<const C: usize>(
    p: &Problem<C>,
    w: &mut Workspace<C>,
    from: &StepState<C>,
    dt: f64,
    max_slip_rate: f64,
) -> Result<Convexity, StepError> {
    let span = Span::new(&from.clock, dt, &p.stops)?;
    if !(max_slip_rate > 0.0 && max_slip_rate.is_finite()) {
        return Err(StepError::Control {
            what: "largest slip rate",
            requirement: "positive and finite",
            value: max_slip_rate,
        });
    }
    let stage = p.method.scheme.properties().stages[0];
    let size = stage.share * dt;
    let formula = p.method.scheme.update_formula(size);
    let (update, inertia) = (p.method.update_of(&*p.method.scheme), p.matrices.has_mass());
    let step = StateStep::new(size, update, &formula, inertia);
    w.balanced = None;
    w.contacts.begin_fields(from, stage.end * dt)?;
    (w.contacts).begin(step, span.at(stage.end), from, |vertex| {
        SVector::from_fn(|c, _| step.taken_over(&formula, from.motion(vertex, c), inertia))
    })?;
    let mut found = Convexity {
        convex: true,
        vertex: w.contacts.vertices.first().copied().unwrap_or(0),
        weakening: 0.0,
        slip_rate: 0.0,
        diagonal_stiffness: f64::INFINITY,
        b_over_a: w.contacts.b_over_a(max_slip_rate),
    };
    let Some(mut certificate) = w.certificate.take() else {
        return Ok(found);
    };
    let factors = (
        formula.displacement.new_velocity,
        formula.acceleration.new_velocity,
    );
    let fixed = &p.constraints.fixed;
    w.contacts.eliminate(true);
    let mut share = f64::NEG_INFINITY;
    for (k, &vertex) in w.contacts.vertices.iter().enumerate() {
        let (slope, slip_rate) = w.contacts.steepest(k, max_slip_rate);
        certificate.slopes[k] = slope;
        let block = w.operators.block(&*p.matrices, factors, vertex);
        let free = (0..C).filter(|&c| !fixed[vertex][c]);
        let diagonal_stiffness = free.map(|c| block[(c, c)]).fold(f64::INFINITY, f64::min);
        if -slope / diagonal_stiffness > share || slope.is_nan() {
            share = -slope / diagonal_stiffness;
            (found.vertex, found.weakening) = (vertex, 0.0 - slope);
            (found.slip_rate, found.diagonal_stiffness) = (slip_rate, diagonal_stiffness);
        }
    }
    w.contacts.eliminate(false);
    found.convex = certificate.slopes.iter().all(|&slope| slope == 0.0) || {
        w.operators.prepared = None;
        (w.operators).form(p.matrices.has_mass(), factors, &w.contacts.vertices);
        let slopes = (w.contacts.vertices.as_slice(), &*certificate.slopes);
        let definite = &mut certificate.definite;
        let definite = definite.get_or_insert_with(|| Definite::new(w.operators.step()));
        (w.operators).is_definite_with(definite, slopes, fixed)
    };
    w.certificate = Some(certificate);
    Ok(found)
}
