//! The uniqueness certificate of every step.

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_solvers::SolveError;

use super::definite::Definite;
use crate::body::{Body, Matrices};
use crate::contact::ContactSet;
use crate::step::{Problem, Workspace};
use crate::{StepError, StepState};

/// Workspace for the certificate of a step.
#[derive(Clone)]
pub(crate) struct Certificate<const C: usize> {
    /// The least slope of friction at each frictional vertex, 0 where it weakens nowhere [N s/m].
    pub(super) slopes: Vec<f64>,
    /// Slopes for which the operator of these factors is certified as positive definite.
    certified: Vec<f64>,
    factors: Option<(f64, f64)>,
    /// Memory for conjugate gradients; none before a solver leaves the test to them.
    pub(super) definite: Option<Definite<C>>,
}

impl<const C: usize> Certificate<C> {
    /// A workspace for a body; none for contacts that weaken nowhere.
    pub(crate) fn new(
        matrices: &dyn Matrices<C>,
        contacts: &ContactSet<C>,
        body: &mut dyn Body<C>,
    ) -> Option<Box<Self>> {
        let told = body.condenses() || body.free_vertices().is_some();
        let weakens = matrices.stiffness().ranks().any(contacts.may_weaken());
        let sites = contacts.vertices.len();
        weakens.then(|| {
            Box::new(Self {
                slopes: vec![0.0; sites],
                certified: vec![0.0; sites],
                factors: None,
                definite: (!told).then(|| Definite::new(matrices.stiffness())),
            })
        })
    }
}

/// Certifies that the solution of a stage of `dt` \[s\] is unique between its old and its new slip rates.
///
/// The solution is unique if friction, with states condensed, weakens at no vertex between these rates, or if the
/// operator with the least slopes there,
///
/// ```text
/// B + diag(m_k),   B = c_a M + C + c_u A,   m_k = min(0, min of w_k abs(sigma_n) dmu(V, S(V))/dV)
/// ```
///
/// is positive definite: the problem is then strictly convex in that box. A vertex that sticks under a force `F = r - B v`
/// differs from all of its other slip rates by forces along chords, of the slope `(friction(V) - F)/V`, not by the slope
/// of friction: `m_k` is then the least of these. With inertia or damping, a sufficiently short step has this certificate.
/// A coupling with lagged states solves only convex problems.
pub(in crate::step) fn certify<const C: usize>(
    p: &Problem<C>,
    w: &mut Workspace<C>,
    start: &StepState<C>,
    dt: f64,
) -> Result<(), StepError> {
    let simultaneous = !w.contacts.have_state() || p.method.coupling.is_simultaneous();
    let Some(mut certificate) = w.certificate.take_if(|_| simultaneous) else {
        return Ok(());
    };
    let Certificate { slopes, .. } = &mut *certificate;
    let (before, now) = (&start.velocity, &w.end.velocity);
    let weakening = w.contacts.least_slopes(before, now, slopes);
    w.end.report.weakening_nodes =
        (w.end.report.weakening_nodes).max(p.ranks.sum(weakening as f64) as usize);
    take_chords_of_sticking(p, w, start, slopes);
    let rising = slopes.iter().all(|&slope| slope == 0.0);
    let certified = p.ranks.all(rising) || certificate.holds(p, w);
    let refused = (!certified).then(|| not_unique(p, w, start, certificate.weakest(w), dt));
    w.certificate = Some(certificate);
    refused.map_or(Ok(()), Err)
}

/// Raises the slopes of vertices that stick to the least chord of friction from the force on them.
fn take_chords_of_sticking<const C: usize>(
    p: &Problem<C>,
    w: &mut Workspace<C>,
    start: &StepState<C>,
    slopes: &mut [f64],
) {
    // Of a vertex in several processes none has the whole force.
    if p.ranks.are_several() {
        return;
    }
    for (k, slope) in slopes.iter_mut().enumerate() {
        let (vertex, contacts) = (w.contacts.vertices[k], &w.contacts);
        let along = |vector: SVector<f64, C>| modulus(&contacts.slip_velocity(k, &vector));
        if *slope == 0.0 || along(w.end.velocity[vertex]) > 0.0 {
            continue;
        }
        let product = w.operators.step().product_at(vertex, &w.end.velocity);
        let force = along(w.load[vertex] - product);
        let before = along(start.velocity[vertex]);
        *slope = slope.max(w.contacts.least_chord(k, force, before));
    }
}

impl<const C: usize> Certificate<C> {
    /// Whether the operator of the step is positive definite with the slopes: certified by an earlier step, or tested.
    fn holds(&mut self, p: &Problem<C>, w: &mut Workspace<C>) -> bool {
        let factors = w.operators.prepared;
        let known = self.factors == factors
            && (self.slopes.iter().zip(&self.certified)).all(|(slope, known)| slope >= known);
        if p.ranks.all(known) {
            return true;
        }
        self.certified.copy_from_slice(&self.slopes);
        let definite = is_definite(&mut self.definite, p, w, &self.slopes);
        self.factors = if definite { factors } else { None };
        definite
    }

    /// The number of the frictional vertex with the largest ratio of weakening to the body's resistance.
    fn weakest(&self, w: &Workspace<C>) -> Option<usize> {
        let share = |k: usize| {
            let block = w.operators.step().diagonal_block(w.contacts.vertices[k]);
            self.slopes[k] / block.diagonal().max()
        };
        (0..self.slopes.len()).min_by(|&a, &b| share(a).total_cmp(&share(b)))
    }
}

/// Whether the operator of the step is positive definite with slopes of friction: by the solver if it can tell, of blocks or of
/// the operator condensed to the contact, else by conjugate gradients.
pub(super) fn is_definite<const C: usize>(
    definite: &mut Option<Definite<C>>,
    p: &Problem<C>,
    w: &mut Workspace<C>,
    slopes: &[f64],
) -> bool {
    if let Some(is_definite) = w.operators.body.is_definite_with(slopes) {
        return p.ranks.all(is_definite);
    }
    let slopes = (w.contacts.vertices.as_slice(), slopes);
    let definite = definite.get_or_insert_with(|| Definite::new(w.operators.step()));
    (w.operators).is_definite_with(definite, slopes, &p.constraints.fixed)
}

/// The error of a step without a certificate of uniqueness, at a frictional vertex.
fn not_unique<const C: usize>(
    p: &Problem<C>,
    w: &Workspace<C>,
    start: &StepState<C>,
    k: Option<usize>,
    dt: f64,
) -> StepError {
    let Some(k) = k else {
        return StepError::Elsewhere;
    };
    let vertex = w.contacts.vertices[k];
    StepError::NotUnique {
        vertex,
        slip_rate: modulus(&w.contacts.slip_velocity(k, &start.velocity[vertex])),
        dt,
        // With a direct effect friction is velocity strengthening for `V << L/dt`.
        shorter: p.matrices.is_resisted() || w.contacts.reads_rate(k),
    }
}

/// Converts the error of a solver for a problem that is not convex to that of a missing certificate.
pub(in crate::step) fn refusal<const C: usize>(
    p: &Problem<C>,
    w: &Workspace<C>,
    start: &StepState<C>,
    dt: f64,
    cause: StepError,
) -> StepError {
    match cause {
        StepError::Solver(SolveError::NotConvex { vertex, .. }) => {
            match w.contacts.vertices.binary_search(&vertex) {
                Ok(k) => not_unique(p, w, start, Some(k), dt),
                Err(_) => cause,
            }
        }
        cause => cause,
    }
}
