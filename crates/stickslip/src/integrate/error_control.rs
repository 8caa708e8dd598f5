//! How the error of a step is measured.

/// How the error of an adaptive step is measured, and whether results are extrapolated.
///
/// A step is taken at once, in two halves, in three thirds and so on, up to `levels`. The error of
/// a symmetric scheme of second order (Newmark with average acceleration and the midpoint state,
/// where everything is smooth) has even powers of the step only, so that each level may gain two
/// orders. A scheme of first order gains one a level; others use two levels and gain one order (W.
/// Gragg 1965; E. Hairer, S. Norsett, G. Wanner, "Solving Ordinary Differential Equations I", Sec.
/// II.9).
///
/// | `levels` | `extrapolate` | result | order | solves per step |
/// | --- | --- | --- | --- | --- |
/// | 2 | no | the two halves | 2 | 3 |
/// | 2 | yes | extrapolated | 4 | 3 |
/// | 3 | yes | extrapolated | 6 | 6 |
/// | 4 | yes | extrapolated | 8 | 10 |
///
/// Extrapolation is for points: what Newmark's scheme leaves of waves that a step does not resolve would grow by
/// 5/3 per step. A run of a body with inertia refuses
/// schemes of second order; [`BackwardEuler`](crate::BackwardEuler) may be extrapolated. Three levels and more that do not
/// approach one another go on from the smallest steps, as they are.
///
/// A step is accepted if the difference `d` of the last two results keeps to `abs(d) <= atol + rtol abs(x)` for each
/// quantity of the scene, with the relative tolerance of [`Steps::adaptive`](crate::Steps::adaptive) and
/// `atol = rtol floor`:
///
/// | quantity | `d` | `x` | floor |
/// | --- | --- | --- | --- |
/// | slip rate of a contact whose friction depends on it and on a state | `dV`, near enough `d ln V` | `V` | [creep](Self::slip_rate_floor), or [`rest`](Self::rest) times the fastest velocity |
/// | state | the change of `ln theta` | | 1 |
/// | slip of other contacts | `du` | slip | [`slip_floor`](Self::slip_floor) |
/// | displacement of an unconstrained body | `du` | `u - u_0` | [`slip_floor`](Self::slip_floor) |
/// | motion, times its weight | `sqrt(du . A du + dv . M dv)` | the same of `u - u_0` and `v` | [`rest`](Self::rest) times that of the strength of friction, of the equilibrium and of `slip_floor` |
///
/// Displacements are measured from the [equilibrium](crate::Scene::in_equilibrium) that the scene starts from, or from
/// zero. The motion of the strength of friction is the deformation by the forces `w abs(sigma_n) + w c`, node by node; that of
/// `slip_floor` is the sum over nodes of their own.
///
/// With inertia the differences of slip and displacement count in the middle of the step, too, where the longer of two
/// steps is interpolated by Hermite's cubic: where a scheme arrests a node at once, both results end at the same place.
///
/// Two results differ also by the tolerance of the solver: an [absolute
/// tolerance](crate::Simulation::with_absolute_tolerance) of the coupling has to lie well below the error that is asked
/// for.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias = "step-size control")]
pub struct ErrorControl {
    /// The creep floor: slip rates well below count as rest [m/s].
    pub slip_rate_floor: f64,
    /// Slip rates well below this share of the fastest velocity of the body count as rest, too, and so does motion well
    /// below this share of what the strength of friction deforms.
    pub rest: f64,
    /// Slip and displacement well below this are not resolved \[m\].
    pub slip_floor: f64,
    /// The weight of the error of the motion, from 0 to 1. Below 1 the waves of a body need not be followed as
    /// closely as slip: those that hold less than the tolerance over the weight are left to a scheme that damps
    /// unresolved waves, [`Sdirk2`](crate::Sdirk2) or
    /// [`GeneralizedAlpha`](crate::GeneralizedAlpha).
    pub motion: f64,
    /// The number of ways to take the step, from 2 to 8; 2 without extrapolation.
    pub levels: usize,
    /// Go on from the extrapolated result; else from that of the smallest steps.
    pub extrapolate: bool,
}

impl Default for ErrorControl {
    /// Creep below 1e-12 m/s, rest below 1e-4 of the fastest motion and of the strength of friction, slip from 1e-6 m on,
    /// motion of weight 1, two levels, no extrapolation.
    fn default() -> Self {
        Self {
            slip_rate_floor: 1e-12,
            rest: 1e-4,
            slip_floor: 1e-6,
            motion: 1.0,
            levels: 2,
            extrapolate: false,
        }
    }
}

impl ErrorControl {
    /// Extrapolation over `levels` levels.
    pub fn extrapolated(levels: usize) -> Self {
        Self {
            levels,
            extrapolate: true,
            ..Self::default()
        }
    }

    /// The power of the step with which the estimated error falls, for a method of order `order`.
    pub(crate) fn error_order(&self, order: usize, symmetric: bool) -> usize {
        let gain = if symmetric { 2 } else { 1 };
        let levels = self.levels_for(order, symmetric);
        order + gain * (levels - 2) + 1
    }

    /// The levels that make sense: with odd powers of the step beside a missing first one, a third
    /// level does not fit the scheme of elimination, and without extrapolation none does.
    pub(crate) fn levels_for(&self, order: usize, symmetric: bool) -> usize {
        if !self.extrapolate || order > 1 && !symmetric {
            2
        } else {
            self.levels.clamp(2, 8)
        }
    }
}
