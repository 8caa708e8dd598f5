//! Monolithic coupling: one minimisation for the rate, with the state condensed statically at every vertex.

use crate::{Coupling, CouplingReport, FixedPoint, StepError, StepMaps};

/// The default: solves for rate and state at once. Static condensation of the state makes it a function of the slip
/// rate at each node, and leaves one velocity problem per step. The initial guess extrapolates the rates of the last
/// two steps.
///
/// Where friction, with its state condensed, weakens with the slip rate faster than the body stiffens, that problem is
/// not convex and can have several solutions. A solver that detects this fails. The fallback
/// [`FixedPoint::accelerated`] then takes the step, in up to 1000 iterations ([`CouplingReport::fell_back`]), or the
/// error is returned ([`without_fallback`](Self::without_fallback)). After every coupling the solution must be
/// certified as unique between the old and the new slip rates; otherwise the step is refused: [`StepError::NotUnique`].
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
    /// Sets `fixed_point` as the fallback for a condensed problem without convergence.
    pub fn with_fallback(fixed_point: FixedPoint) -> Self {
        Self {
            fallback: Some(fixed_point),
        }
    }

    /// Returns the error of a condensed problem without convergence.
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
