//! The measure of a step's error.

/// The error measure of adaptive steps, and the choice of extrapolation.
///
/// A step is taken at once, in two halves, in three thirds and so on, up to `levels`. The error of a symmetric scheme
/// of second order (Newmark with average acceleration and the midpoint state, for smooth solutions) has even powers of
/// the step only, so that each level can gain two orders. A scheme of first order gains one order per level; others use
/// two levels and gain one order (W. Gragg 1965; E. Hairer, S. Norsett, G. Wanner, "Solving Ordinary Differential
/// Equations I", Sec. II.9).
///
/// | `levels` | `extrapolate` | result | order | solves per step |
/// | --- | --- | --- | --- | --- |
/// | 2 | no | the two halves | 2 | 3 |
/// | 2 | yes | extrapolated | 4 | 3 |
/// | 3 | yes | extrapolated | 6 | 6 |
/// | 4 | yes | extrapolated | 8 | 10 |
///
/// Use extrapolation for point models: unresolved waves of Newmark's scheme would grow by 5/3 per step. A run of a body
/// with inertia refuses it for schemes of second order; [`BackwardEuler`](crate::BackwardEuler) can be extrapolated. If
/// three or more levels do not converge, the run continues from the smallest substeps without extrapolation.
///
/// A step is accepted if the difference `d` of the last two results satisfies `abs(d) <= atol + rtol abs(x)` for each
/// quantity of the scene, with the relative tolerance of [`Steps::adaptive`](crate::Steps::adaptive) and `atol = rtol
/// floor`:
///
/// | quantity | `d` | `x` | floor |
/// | --- | --- | --- | --- |
/// | slip rate of a contact whose friction depends on it and on a state | `dV`, near enough `d ln V` | `V` | [creep](Self::slip_rate_floor), or the [relative one](Self::relative_slip_rate_floor) times the fastest velocity |
/// | state | the change of `ln theta` | | 1 |
/// | slip of other contacts | `du` | slip | [`slip_floor`](Self::slip_floor) |
/// | displacement of an unconstrained body | `du` | `u - u_0` | [`slip_floor`](Self::slip_floor) |
/// | motion, times its weight | `sqrt(du . A du + dv . M dv)` | the same of `u - u_0` and `v - v_0` | [`motion_floor`](Self::motion_floor) times that of the strength of friction, of the equilibrium and of `slip_floor` |
///
/// Displacements are measured from the [equilibrium](crate::Scene::in_equilibrium) at the start of the scene, or from
/// zero; velocities of the motion from the initial ones, which makes it the same in all frames that move uniformly. With
/// inertia the scale of the motion is its largest value so far, which [`StepState`](crate::StepState) holds: waves that an
/// arrest leaves in the body are resolved to the tolerance of the motion that it has ended. The motion of the strength of
/// friction is the deformation by the forces `w abs(sigma_n) + w c`, node by node; that of `slip_floor` is the sum over
/// nodes of their own.
///
/// With inertia the differences of slip and displacement also count in the middle of the step, where the longer of two
/// steps is interpolated by Hermite's cubic: if a scheme arrests a node at once, both results agree at the end.
///
/// Where a contact with a normal stress from the body [opens or closes](crate::Contact::allow_opening) in the step, its
/// slip rate jumps, and slip counts in its place. Without inertia a vertex that closes adds the slip until then that two
/// substeps may both miss: the smaller of half the step and the time in which its velocity closes the gap, times the
/// change of its slip rate.
///
/// Two results also differ by the tolerance of the solver: an [absolute
/// tolerance](crate::Simulation::with_absolute_tolerance) of the coupling has to lie well below the requested error.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias = "step-size control")]
pub struct ErrorControl {
    /// The creep floor: slip rates well below it count as rest [m/s].
    pub slip_rate_floor: f64,
    /// The relative floor of the slip rate: rates well below this share of the fastest velocity also count as rest.
    pub relative_slip_rate_floor: f64,
    /// The relative floor of the motion: one well below this share of the elastic deformation by the strength of friction
    /// counts as none.
    pub motion_floor: f64,
    /// Slip and displacement well below this value are not resolved \[m\].
    pub slip_floor: f64,
    /// The weight of the error of the motion, from 0 to 1. Below 1, waves of the body are resolved less accurately than
    /// slip: those of less energy than the tolerance over the weight are left to a scheme that damps unresolved waves,
    /// [`Sdirk2`](crate::Sdirk2) or [`GeneralizedAlpha`](crate::GeneralizedAlpha).
    pub motion: f64,
    /// The number of levels, from 2 to 8; 2 without extrapolation.
    pub levels: usize,
    /// Whether the run continues from the extrapolated result, or from that of the smallest substeps.
    pub extrapolate: bool,
}

impl Default for ErrorControl {
    /// Creep below 1e-12 m/s, rest below 1e-4 of the fastest motion and of the strength of friction, slip from 1e-6 m on,
    /// motion of weight 1, two levels, no extrapolation.
    fn default() -> Self {
        Self {
            slip_rate_floor: 1e-12,
            relative_slip_rate_floor: 1e-4,
            motion_floor: 1e-4,
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

    /// The useful number of levels: with odd powers of the step after a missing first one, a third level does not fit
    /// the elimination of error terms; without extrapolation two suffice.
    pub(crate) fn levels_for(&self, order: usize, symmetric: bool) -> usize {
        if !self.extrapolate || order > 1 && !symmetric {
            2
        } else {
            self.levels.clamp(2, 8)
        }
    }
}
