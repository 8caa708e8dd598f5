//! The scheme of a step with inertia in which a contact opens or closes.

use stickslip_time::{BackwardEuler, RateScheme, SchemeProperties, UpdateFormula};

use super::{Problem, Workspace, has_inertia};
use crate::StepState;

/// Backward Euler, with prescribed parts at their mean velocity. Contact and friction act by their impulses, and energy
/// falls at any step:
///
/// ```text
/// M (v - v_o) = dt (l - A u - lambda n - friction),    u = u_o + dt v
/// 0 <= lambda  perpendicular to  gap(u) >= 0     =>    lambda v_n = lambda gap(u_o)/dt >= 0
/// ```
pub(super) struct Impact;

impl RateScheme for Impact {
    fn update_formula(&self, dt: f64) -> UpdateFormula {
        UpdateFormula {
            prescribed: UpdateFormula::mean_velocity(dt),
            ..BackwardEuler.update_formula(dt)
        }
    }

    fn properties(&self) -> SchemeProperties {
        BackwardEuler.properties()
    }
}

impl<const C: usize> Workspace<C> {
    /// Whether a scheme may change contact only by [`Impact`]: with inertia, unless it is explicit or backward Euler.
    pub(super) fn keeps_contact(&self, p: &Problem<C>, scheme: &dyn RateScheme) -> bool {
        let properties = scheme.properties();
        let euler = || {
            let single = properties.stages.len() == 1;
            single && scheme.update_formula(1.0).is_implicit_euler()
        };
        p.ranks.any(self.contacts.can_open())
            && has_inertia(scheme)
            && properties.implicit
            && !euler()
    }

    /// Whether accelerations of a state are free of impulses.
    pub(super) fn is_settled(&self, p: &Problem<C>, start: &StepState<C>) -> bool {
        p.ranks.all(self.contacts.is_settled(start))
    }

    /// Whether each vertex that can open stays open or closed from the start of the step to the end of a stage.
    pub(super) fn persists(
        &self,
        p: &Problem<C>,
        from: &StepState<C>,
        formula: &UpdateFormula,
    ) -> bool {
        let c_u = formula.displacement.new_velocity;
        p.ranks.all(self.contacts.persists(from, &self.end, c_u))
    }
}
