//! The velocity problem of one step of the slider.

use nalgebra::SVector;
use stickslip::fem::{Constraints, P1, elasticity, mass};
use stickslip::friction::{DieterichRuina, Radial};
use stickslip::problems::pipping_slider::{FRICTION, NORMAL_STRESS, PippingSlider};
use stickslip::solvers::{Energy, Stopping};
use stickslip::state::LogTheta;
use stickslip::{BlockMatrix, Matrix, Operator, SceneError};

use super::TIME_STEP;

/// The regime of the frictional boundary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Regime {
    /// Old contacts hold.
    Stick,
    /// Young contacts slide at about 1e-3 m/s.
    Slip,
}

pub(crate) const REGIMES: [(&str, Regime); 2] = [("stick", Regime::Stick), ("slip", Regime::Slip)];

/// `J` of one step of Newmark's scheme, and a field to start from.
pub(crate) struct Problem {
    pub(crate) space: P1<2>,
    stiffness: BlockMatrix<2>,
    mass: BlockMatrix<2>,
    pub(crate) operator: BlockMatrix<2>,
    norm: BlockMatrix<2>,
    load: Vec<SVector<f64, 2>>,
    potentials: Vec<Radial<DieterichRuina>>,
    vertices: Vec<usize>,
    pub(crate) fixed: Vec<[bool; 2]>,
    /// Off the solution by up to 5e-5 m/s a component, so that friction is linearised anew.
    pub(crate) start: Vec<SVector<f64, 2>>,
}

impl Problem {
    pub(crate) fn new(refinements: usize, regime: Regime) -> Result<Self, SceneError> {
        let slider = PippingSlider {
            refinements,
            ..PippingSlider::default()
        };
        let space = slider.space()?;
        let (bottom, top) = (
            PippingSlider::bottom(&space)?,
            space.trace(|x| x[1] == 1.0)?,
        );
        let stiffness = elasticity(&space, &slider.elastic)?.into_matrix();
        let mass = mass(&space, slider.density)?.into_matrix();
        let mut held = Constraints::none(&space);
        held.fix(&top, [true, true])?;
        held.fix(&bottom, [false, true])?;
        let fixed = held.as_slice().to_vec();

        // Friction 0.2 holds an old contact, 0.6 is that of steady sliding.
        let (rate, alpha, coefficient) = match regime {
            Regime::Stick => (0.0, 2.0, 0.2),
            Regime::Slip => (1e-3, (FRICTION.slip_distance / 1e-3).ln(), 0.6),
        };
        let mut start =
            space.interpolate(|x| SVector::from([rate * (1.0 - x[1]) + 2e-4 * x[1], 0.0]));
        let operator = newmark(TIME_STEP, &stiffness, &mass);
        let mut load = vec![SVector::zeros(); start.len()];
        operator.multiply_add(1.0, &start, &mut load);
        let mut potentials = Vec::new();
        for (&p, weight) in bottom.vertices().iter().zip(bottom.weights()) {
            let force = weight * NORMAL_STRESS;
            load[p][0] += coefficient * force;
            potentials.push(Radial {
                law: FRICTION,
                force,
                state: LogTheta(alpha),
            });
        }
        for (i, v) in start.iter_mut().enumerate() {
            for c in (0..2).filter(|&c| !fixed[i][c]) {
                v[c] += 1e-4 * ((i % 17) as f64 / 17.0 - 0.5);
            }
        }
        Ok(Self {
            norm: BlockMatrix::combination(&[(1.0, &stiffness), (1.0, &mass)]),
            operator,
            stiffness,
            mass,
            load,
            potentials,
            vertices: bottom.vertices().to_vec(),
            fixed,
            start,
            space,
        })
    }

    /// The operator for another time step \[s\].
    pub(crate) fn operator_of(&self, dt: f64) -> BlockMatrix<2> {
        newmark(dt, &self.stiffness, &self.mass)
    }

    pub(crate) fn energy(&self) -> Energy<'_, BlockMatrix<2>, 2> {
        Energy {
            operator: &self.operator,
            load: &self.load,
            potentials: &self.potentials,
            vertices: &self.vertices,
            fixed: &self.fixed,
        }
    }

    /// As in a step: to 1e-10 m/s.
    pub(crate) fn to_tolerance(&self) -> Stopping<'_, BlockMatrix<2>> {
        Stopping {
            norm: &self.norm,
            tolerance: 1e-10,
            relative: 1e-14,
            equivalence: 2.0 / TIME_STEP,
            max_iterations: 10_000,
        }
    }

    /// One iteration, which no tolerance ends.
    pub(crate) fn one_iteration(&self) -> Stopping<'_, BlockMatrix<2>> {
        Stopping {
            norm: &self.norm,
            tolerance: f64::MIN_POSITIVE,
            relative: 0.0,
            equivalence: f64::INFINITY,
            max_iterations: 1,
        }
    }
}

/// `c_a M + c_u A`.
fn newmark(dt: f64, stiffness: &BlockMatrix<2>, mass: &BlockMatrix<2>) -> BlockMatrix<2> {
    BlockMatrix::combination(&[(0.5 * dt, stiffness), (2.0 / dt, mass)])
}
