//! Rate and state in one minimisation: the state eliminated at every vertex.

use crate::{Coupling, CouplingReport, FixedPoint, StepError, StepMaps};

/// The default: solves for rate and state at once. The state of each node is a function of its slip rate, which leaves
/// one velocity problem per step. It starts from an extrapolation of the rates of the last two steps.
///
/// Where friction, its state following, weakens with the slip rate faster than the body stiffens, that problem is not
/// convex and may have several solutions. A solver that detects this fails. The step is then taken by
/// [`FixedPoint::accelerated`], in up to 1000 iterations ([`CouplingReport::fell_back`]), or the error is returned
/// ([`without_fallback`](Self::without_fallback)). Behind every coupling the solution has to be certified as the only
/// one between the old and the new slip rates, or the step is refused: [`StepError::NotUnique`].
///
/// ```
/// # use nalgebra::SMatrix;
/// # use stickslip::friction::DieterichRuina;
/// # use stickslip::state::{Dieterich, LogTheta};
/// # use stickslip::{Contact, GeneralizedAlpha, Monolithic, BoundaryPart, Point, Scene, Simulation};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let friction = DieterichRuina {
/// #     a: 0.010, b: 0.015, reference_friction: 0.6, reference_velocity: 1e-6, slip_distance: 1e-5,
/// # };
/// # let scene = Scene::new(SMatrix::<f64, 1, 1>::new(5e7))
/// #     .with_contact(Contact::new(BoundaryPart::point(1.0), friction, 49_050.0)
/// #         .with_state(Dieterich { slip_distance: 1e-5 }, LogTheta(-10.0)))
/// #     .with_load_history(|time, load| load[0][0] = 5e7 * 1e-6 * time);
/// let mut simulation = Simulation::new(scene, GeneralizedAlpha::default(), Point)?
///     .with_coupling(Monolithic::without_fallback());
/// let report = simulation.step(1e-3)?;
/// assert_eq!(report.coupling_iterations, 1);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Monolithic {
    fallback: Option<FixedPoint>,
}

impl Monolithic {
    /// Falls back on `fixed_point` if the eliminated problem is not solved.
    pub fn with_fallback(fixed_point: FixedPoint) -> Self {
        Self {
            fallback: Some(fixed_point),
        }
    }

    /// Returns the error of a step whose eliminated problem is not solved.
    pub fn without_fallback() -> Self {
        Self { fallback: None }
    }
}

impl Default for Monolithic {
    fn default() -> Self {
        Self::with_fallback(FixedPoint::accelerated().with_max_iterations(1000))
    }
}

impl Coupling for Monolithic {
    fn couple(&self, maps: &mut dyn StepMaps, tolerance: f64) -> Result<CouplingReport, StepError> {
        maps.extrapolate_rates();
        match (maps.solve_coupled(tolerance), &self.fallback) {
            (Ok(()), _) => {
                maps.propose_states()?;
                maps.relax_states(1.0);
                Ok(CouplingReport {
                    iterations: 1,
                    fell_back: false,
                })
            }
            (Err(StepError::Solver(_)), Some(fixed_point)) => {
                let report = fixed_point.couple(maps, tolerance)?;
                Ok(CouplingReport {
                    iterations: report.iterations + 1,
                    fell_back: true,
                })
            }
            (Err(error), _) => Err(error),
        }
    }
}
