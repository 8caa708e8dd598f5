//! The potentials of the problems in the check of a solver.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::{ConvexPotential, DieterichRuina, Interval, LocalModel, Radial, Tresca};

/// A potential of one of three kinds, each difficult for another reason.
#[derive(Debug, Clone, Copy)]
pub(super) enum SamplePotential {
    /// A kink at rest, and no curvature along the motion elsewhere.
    Tresca(Radial<Tresca>),
    /// Smooth, with curvatures of all sizes.
    DieterichRuina(Radial<DieterichRuina>),
    /// `force sum_c abs(v_c - place)`: each component has a kink of its own, away from rest.
    Kinked {
        /// Half of the jump of the slope \[N\].
        force: f64,
        /// The position of the kinks [m/s].
        place: f64,
    },
}

impl SamplePotential {
    /// A subgradient at `v`: the gradient if it exists; at a kink `inside`, of norm below one, in units of the largest
    /// possible.
    pub(super) fn subgradient<const C: usize>(
        &self,
        v: &SVector<f64, C>,
        inside: &SVector<f64, C>,
    ) -> SVector<f64, C> {
        match *self {
            Self::Tresca(radial) if v.iter().all(|&v| v == 0.0) => {
                inside * (radial.force * radial.law.coefficient)
            }
            Self::Kinked { force, place } => SVector::from_fn(|c, _| {
                if v[c] == place {
                    force * inside[c]
                } else {
                    force * (v[c] - place).signum()
                }
            }),
            _ => self.local_model(v).gradient,
        }
    }
}

impl<const C: usize> ConvexPotential<C> for SamplePotential {
    fn value(&self, v: &SVector<f64, C>) -> f64 {
        match self {
            Self::Tresca(radial) => radial.value(v),
            Self::DieterichRuina(radial) => radial.value(v),
            Self::Kinked { force, place } => {
                force * v.iter().map(|v| (v - place).abs()).sum::<f64>()
            }
        }
    }

    fn slope_along(&self, v: &SVector<f64, C>, d: &SVector<f64, C>) -> Interval {
        match *self {
            Self::Tresca(radial) => radial.slope_along(v, d),
            Self::DieterichRuina(radial) => radial.slope_along(v, d),
            Self::Kinked { force, place } => {
                let (mut lower, mut upper) = (0.0, 0.0);
                for (&v, &d) in v.iter().zip(d) {
                    if v == place {
                        lower -= force * d.abs();
                        upper += force * d.abs();
                    } else {
                        let slope = force * d * (v - place).signum();
                        lower += slope;
                        upper += slope;
                    }
                }
                Interval { lower, upper }
            }
        }
    }

    fn local_model(&self, v: &SVector<f64, C>) -> LocalModel<C> {
        match *self {
            Self::Tresca(radial) => radial.local_model(v),
            Self::DieterichRuina(radial) => radial.local_model(v),
            Self::Kinked { force, place } => LocalModel {
                gradient: v.map(|v| force * (v - place).signum()),
                hessian: SMatrix::zeros(),
                smooth: std::array::from_fn(|c| v[c] != place),
            },
        }
    }

    fn minimize(&self, block: &SMatrix<f64, C, C>, force: &SVector<f64, C>) -> SVector<f64, C> {
        match *self {
            Self::Tresca(radial) => radial.minimize(block, force),
            Self::DieterichRuina(radial) => radial.minimize(block, force),
            Self::Kinked { force: kink, place } => minimize_kinked(block, force, kink, place),
        }
    }

    fn keep_smooth(&self, v: &SVector<f64, C>, d: &SVector<f64, C>) -> SVector<f64, C> {
        match self {
            Self::Tresca(radial) => radial.keep_smooth(v, d),
            Self::DieterichRuina(radial) => radial.keep_smooth(v, d),
            Self::Kinked { .. } => *d,
        }
    }
}

/// Coordinate descent, each coordinate in closed form.
fn minimize_kinked<const C: usize>(
    block: &SMatrix<f64, C, C>,
    force: &SVector<f64, C>,
    kink: f64,
    place: f64,
) -> SVector<f64, C> {
    const SWEEPS: usize = 1000;
    let mut v = SVector::from_element(place);
    for _ in 0..SWEEPS {
        let before = v;
        for c in 0..C {
            let stiffness = block[(c, c)];
            let others = (block.row(c) * v)[0] - stiffness * v[c];
            // In terms of v_c - place: shrink towards zero by the kink.
            let pull = force[c] - others - stiffness * place;
            v[c] = place + (pull.abs() - kink).max(0.0).copysign(pull) / stiffness;
        }
        if v == before {
            break;
        }
    }
    v
}
