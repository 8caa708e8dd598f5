//! The time step as a function of its initial state.

mod anderson;
mod couple;
mod finite;
mod free;
mod free_pass;
mod free_step;
mod highest_frequency;
mod impact;
mod initial_acceleration;
mod lagged;
mod local_steps;
mod method;
mod normal_stress;
mod operators;
mod predict;
mod prediction;
mod reactions;
mod resolved;
mod skew;
mod span;
mod uniqueness;
mod workspace;

pub(crate) use anderson::Anderson;
pub use couple::{Coupling, CouplingReport, FixedPoint, Monolithic, Staggered, StepMaps};
pub(crate) use finite::check_finite;
pub(crate) use free_step::FreeStep;
pub(crate) use highest_frequency::highest_eigenvalue;
pub(crate) use initial_acceleration::InitialAcceleration;
pub(crate) use local_steps::weights_after;
pub(crate) use method::{Method, Tolerance, Traits};
pub(crate) use operators::Operators;
pub(crate) use reactions::Reactions;
pub(crate) use span::Span;
pub use uniqueness::Convexity;
pub(crate) use uniqueness::{Certificate, convexity};
pub(crate) use workspace::{Problem, Workspace};

use stickslip_time::RateScheme;

use crate::sums::agreed;
use crate::{StepError, StepReport, StepState};

/// Takes a step of `dt` \[s\] from `from`; its end is `w.end`.
///
/// Neither `from` nor the problem changes: the caller can discard the result.
///
/// A step that fails for a value that is not finite is repeated with its laws under observation, to name the law.
///
/// # Errors
/// The cause of the failure; `w.end` is then invalid.
pub(crate) fn step<const C: usize>(
    p: &Problem<C>,
    w: &mut Workspace<C>,
    from: &StepState<C>,
    dt: f64,
) -> Result<StepReport, StepError> {
    let taken = attempt(p, w, from, dt);
    match taken {
        Err(cause) if cause.may_be_of_a_law() && !p.ranks.are_several() => {
            let watch = w.contacts.watch();
            let _ = attempt(p, w, from, dt);
            Err(w.contacts.end_watch(watch).unwrap_or(cause))
        }
        taken => taken,
    }
}

fn attempt<const C: usize>(
    p: &Problem<C>,
    w: &mut Workspace<C>,
    from: &StepState<C>,
    dt: f64,
) -> Result<StepReport, StepError> {
    let span = Span::new(&from.clock, dt, &p.stops)?;
    local_steps::check_cycle(p.matrices.stiffness(), from, dt)?;
    let mut start = w.start.take();
    let scheme = &*p.method.scheme;
    let taken = match take(p, w, from, &mut start, &span, scheme, None) {
        // Without inertia, where rates are not resolved: the scheme that never slips too far. With inertia, where contact
        // changes: the scheme that never gains energy.
        Ok(None) => {
            let so_far = Some(w.end.report);
            let fallback: &dyn RateScheme = if has_inertia(scheme) {
                &impact::Impact
            } else {
                &resolved::Halves
            };
            take(p, w, from, &mut start, &span, fallback, so_far)
        }
        taken => taken,
    };
    let balanced = match taken {
        Ok(_) if w.impact => w.rebalance(p, &mut start, (span.next.time(), dt)),
        _ => Ok(()),
    };
    w.start = start;
    let report = taken?.unwrap_or_default();
    balanced?;
    w.balanced = Some(span.next);
    Ok(report)
}

/// Whether a scheme has inertia, which it can leave out of a scene with mass.
pub(crate) fn has_inertia(scheme: &dyn RateScheme) -> bool {
    scheme.update_formula(1.0).acceleration.new_velocity > 0.0
}

/// Takes the stages of a scheme; none if the rates of one of them are not resolved, unless the scheme is the fallback
/// for that.
fn take<const C: usize>(
    p: &Problem<C>,
    w: &mut Workspace<C>,
    from: &StepState<C>,
    start: &mut Option<Box<StepState<C>>>,
    span: &Span,
    scheme: &dyn RateScheme,
    instead_of: Option<StepReport>,
) -> Result<Option<StepReport>, StepError> {
    let (stages, damped) = (scheme.properties().stages, instead_of.is_some());
    let keeps_contact = !damped && w.keeps_contact(p, scheme);
    w.begin(p, from, start, span, instead_of)?;
    for (k, stage) in stages.iter().enumerate() {
        if k > 0 {
            w.lead(from, start, stage.lead)?;
        }
        let start = start
            .as_deref()
            .filter(|_| k > 0 || span.from_right.is_some());
        let (start, dt) = (start.unwrap_or(from), stage.share * span.dt);
        if keeps_contact && k == 0 && !w.is_settled(p, start) {
            return Ok(None);
        }
        let update = p.method.update_of(scheme);
        let formula = w.assemble(p, scheme, dt)?; //        B = c_a M + C + c_u A
        let (time, single) = (span.at(stage.end), stages.len() == 1);
        w.contacts.begin_fields(from, stage.end * span.dt)?;
        w.predict(p, start, &formula, (dt, update), time)?; // u^, a^, r, sigma_n, alpha_o
        if keeps_contact && !w.persists(p, from, &formula) {
            return Ok(None);
        }
        let step = (dt, update, time);
        w.couple_with_reactions(p, start, &formula, step, single)?; // v = argmin J, alpha = S(V)
        if !damped && p.method.switches && !resolved::are_resolved(p, w, start) {
            return Ok(None);
        }
        if keeps_contact && !w.persists(p, from, &formula) {
            return Ok(None);
        }
        let c_u = formula.displacement.new_velocity;
        agreed(&p.ranks, w.contacts.check_openings(&w.end, c_u, dt))?;
        uniqueness::certify(p, w, start, dt)?; //        or NotUnique
        w.correct(start, &formula, dt); //                  u, a, slip, states of the new time
    }
    w.finish(from, span, stages.len() > 1);
    Ok(Some(w.end.report))
}
