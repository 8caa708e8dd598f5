//! The second-order models of the potentials: truncation, projection, and their remainder ahead.

use std::ops::Range;

use nalgebra::{SMatrix, SVector};
use stickslip_friction::LocalModel;

use super::line_search::NOISE;
use crate::Potentials;
use crate::parts::gather_contact;

/// The frictional part of an energy.
#[derive(Clone, Copy)]
pub(crate) struct Friction<'a, const C: usize> {
    pub(crate) potentials: &'a dyn Potentials<C>,
    pub(crate) vertices: &'a [usize],
    pub(crate) fixed: &'a [[bool; C]],
}

/// Gradient and Hessian of every potential on the kept components.
#[derive(Debug, Default)]
pub(crate) struct Models<const C: usize> {
    /// Zero on dropped components.
    pub(crate) gradients: Vec<SVector<f64, C>>,
    /// The gradients at the end of the direction.
    pub(crate) ahead: Vec<SVector<f64, C>>,
    /// The Hessians at the end of the direction.
    hessians_ahead: Vec<SMatrix<f64, C, C>>,
    /// Zero on dropped rows and columns.
    pub(crate) hessians: Vec<SMatrix<f64, C, C>>,
    /// The components that are fixed or truncated.
    pub(crate) dropped: Vec<[bool; C]>,
    /// Whether a component of the vertex is truncated.
    pub(crate) truncated: Vec<bool>,
    /// Whether Hessians or dropped components differ from those of the linear solver.
    pub(crate) stale: bool,
    /// The vertex at which the Newton matrix had no positive pivot until the Hessians were stiffened.
    pub(crate) loose: Option<usize>,
}

/// The range in which a second-order model is useful.
#[derive(Clone, Copy)]
pub(crate) struct Trust {
    /// The largest curvature of the potential.
    pub(crate) curvature: f64,
    /// The largest component of the distance over which it must hold.
    pub(crate) distance: f64,
}

/// The potentials over a part of the direction.
#[derive(Clone, Copy)]
pub(crate) struct Ahead {
    /// Excess of their slope at its end, times its length, over that of the second-order model.
    pub(crate) bend: f64,
    /// The bound of its rounding error.
    pub(crate) noise: f64,
    /// Whether the kept components have gradients there.
    pub(crate) smooth: bool,
}

impl Ahead {
    /// Combines two parts of a contact.
    fn and(self, other: Self) -> Self {
        Self {
            bend: self.bend + other.bend,
            noise: self.noise + other.noise,
            smooth: self.smooth && other.smooth,
        }
    }
}

/// Gradients and Hessians of a part of a contact; with them, its dropped components and truncated vertices.
type Derivatives<'a, const C: usize> = (&'a mut [SVector<f64, C>], &'a mut [SMatrix<f64, C, C>]);
type Taken<'a, const C: usize> = (Derivatives<'a, C>, (&'a mut [[bool; C]], &'a mut [bool]));

impl<const C: usize> Models<C> {
    /// Allocates for so many vertices, with no models yet.
    pub(crate) fn resize(&mut self, count: usize) {
        self.gradients.resize(count, SVector::zeros());
        self.ahead.resize(count, SVector::zeros());
        self.hessians.resize(count, SMatrix::zeros());
        self.hessians_ahead.resize(count, SMatrix::zeros());
        self.dropped.resize(count, [true; C]);
        self.truncated.resize(count, true);
        self.stale = true;
        self.loose = None;
    }

    /// Keeps the components in which a potential is smooth with a curvature of at most `trust(k)`, and computes
    /// gradient and Hessian there.
    ///
    /// A small curvature over an insignificant distance alone, as below the slip rate at which friction sets in, would
    /// make a linear step leave that distance at once. Such components are left to the sweep.
    pub(crate) fn truncate(
        &mut self,
        friction: &Friction<'_, C>,
        v: &[SVector<f64, C>],
        trust: impl Fn(usize) -> Trust + Sync,
    ) {
        self.loose = None;
        let fields = (
            (&mut self.gradients[..], &mut self.hessians[..]),
            (&mut self.dropped[..], &mut self.truncated[..]),
        );
        let truncate = |places: Range<usize>, fields: Taken<'_, C>| {
            let ((gradients, hessians), (dropped, truncated)) = fields;
            let mut stale = false;
            for (i, k) in places.enumerate() {
                let vertex = friction.vertices[k];
                let model = friction.potentials.local_model(k, &v[vertex]);
                let (fixed, trust) = (&friction.fixed[vertex], trust(k));
                // A diagonal bound suffices: the Hessian is positive semidefinite.
                let is_bounded = |model: &LocalModel<C>| {
                    (0..C).all(|c| fixed[c] || model.hessian[(c, c)] <= trust.curvature)
                };
                let mut bounded = is_bounded(&model);
                if bounded && v[vertex].amax() < trust.distance {
                    let beyond = SVector::from_fn(|c, _| {
                        let v = v[vertex][c];
                        if fixed[c] {
                            v
                        } else {
                            v + trust.distance.copysign(v)
                        }
                    });
                    bounded = is_bounded(&friction.potentials.local_model(k, &beyond));
                }
                let out = std::array::from_fn(|c| fixed[c] || !(bounded && model.smooth[c]));
                let hessian = kept_part(&model.hessian, &out);
                stale |= out != dropped[i] || hessian != hessians[i];
                truncated[i] = (0..C).any(|c| out[c] && !fixed[c]);
                gradients[i] =
                    SVector::from_fn(|c, _| if out[c] { 0.0 } else { model.gradient[c] });
                dropped[i] = out;
                hessians[i] = hessian;
            }
            stale
        };
        self.stale |= gather_contact(friction.vertices.len(), fields, &truncate, &|a, b| a || b);
    }

    /// Keeps all free components, whatever their curvature, and computes gradient and Hessian there. False, with the
    /// models half computed, if a potential is not smooth in one of them.
    pub(crate) fn keep_all(&mut self, friction: &Friction<'_, C>, v: &[SVector<f64, C>]) -> bool {
        self.loose = None;
        self.stale = true;
        let fields = (
            (&mut self.gradients[..], &mut self.hessians[..]),
            (&mut self.dropped[..], &mut self.truncated[..]),
        );
        let keep = |places: Range<usize>, fields: Taken<'_, C>| {
            let ((gradients, hessians), (dropped, truncated)) = fields;
            for (i, k) in places.enumerate() {
                let vertex = friction.vertices[k];
                let model = friction.potentials.local_model(k, &v[vertex]);
                let fixed = friction.fixed[vertex];
                if (0..C).any(|c| !(fixed[c] || model.smooth[c])) {
                    return false;
                }
                gradients[i] =
                    SVector::from_fn(|c, _| if fixed[c] { 0.0 } else { model.gradient[c] });
                hessians[i] = kept_part(&model.hessian, &fixed);
                (dropped[i], truncated[i]) = (fixed, false);
            }
            true
        };
        gather_contact(friction.vertices.len(), fields, &keep, &|a, b| a && b)
    }

    /// Uses the Hessians at the end of the last step, if all free components were kept in it; the gradients there are
    /// known.
    pub(crate) fn move_on(&mut self) -> bool {
        let all = self.truncated.iter().all(|&truncated| !truncated) && self.loose.is_none();
        if all {
            std::mem::swap(&mut self.hessians, &mut self.hessians_ahead);
            self.stale = true;
        }
        all
    }

    /// Adds a share of `scale(k)` to the Hessians on the kept components. A rigid-body motion that friction alone
    /// resists, without growth, then has a finite length. `loose` is the vertex at which elimination had no positive
    /// pivot.
    ///
    /// The direction still descends, and the line search treats the added share as part of the model's error.
    pub(crate) fn stiffen(&mut self, loose: usize, scale: impl Fn(usize) -> f64) {
        const SHARE: f64 = 1e-8;
        self.loose = Some(loose);
        for (k, (hessian, dropped)) in self.hessians.iter_mut().zip(&self.dropped).enumerate() {
            for c in (0..C).filter(|&c| !dropped[c]) {
                hessian[(c, c)] += SHARE * scale(k);
            }
        }
        self.stale = true;
    }

    /// The first vertex, by its number among the frictional ones, whose Hessian has a negative curvature.
    #[cfg(feature = "multigrid")]
    pub(crate) fn weakening(&self) -> Option<usize> {
        let falls = |hessian: &SMatrix<f64, C, C>| {
            let size = hessian.amax();
            let raised = hessian + SMatrix::identity() * (NOISE * size);
            size > 0.0 && raised.cholesky().is_none()
        };
        self.hessians.iter().position(falls)
    }

    /// Whether no component of a vertex is kept.
    pub(crate) fn is_out(&self, k: usize) -> bool {
        self.dropped[k].iter().all(|&dropped| dropped)
    }

    /// Projects the direction to the range of the second-order models; true if it had left.
    pub(crate) fn project(
        &self,
        friction: &Friction<'_, C>,
        v: &[SVector<f64, C>],
        direction: &mut [SVector<f64, C>],
    ) -> bool {
        let mut left = false;
        for (k, &vertex) in friction.vertices.iter().enumerate() {
            if self.is_out(k) {
                continue;
            }
            let d = &mut direction[vertex];
            let mut kept = friction.potentials.keep_smooth(k, &v[vertex], d);
            for c in (0..C).filter(|&c| self.dropped[k][c]) {
                kept[c] = 0.0;
            }
            left |= kept != *d;
            *d = kept;
        }
        left
    }

    /// Computes the gradients of the potentials ahead by `length` times the direction, of the kept components.
    pub(crate) fn differentiate(
        &mut self,
        friction: &Friction<'_, C>,
        v: &[SVector<f64, C>],
        direction: &[SVector<f64, C>],
        length: f64,
    ) -> Ahead {
        let Self {
            gradients,
            ahead,
            hessians_ahead,
            hessians,
            dropped,
            ..
        } = self;
        let (gradients, hessians, dropped) = (&gradients[..], &hessians[..], &dropped[..]);
        let fields = (&mut ahead[..], &mut hessians_ahead[..]);
        let differentiate = |places: Range<usize>, fields: Derivatives<'_, C>| {
            let (ahead, hessians_ahead) = fields;
            let (mut bend, mut terms, mut smooth) = (0.0, 0.0, true);
            for (i, k) in places.enumerate() {
                let vertex = friction.vertices[k];
                ahead[i] = gradients[k];
                hessians_ahead[i] = hessians[k];
                if dropped[k].iter().all(|&dropped| dropped) {
                    continue;
                }
                let d = direction[vertex] * length;
                let model = friction.potentials.local_model(k, &(v[vertex] + d));
                for c in (0..C).filter(|&c| !dropped[k][c]) {
                    smooth &= model.smooth[c];
                    ahead[i][c] = model.gradient[c];
                }
                hessians_ahead[i] = kept_part(&model.hessian, &dropped[k]);
                let linear = gradients[k].dot(&d);
                bend += ahead[i].dot(&d) - linear - d.dot(&(hessians[k] * d));
                terms += linear.abs();
            }
            Ahead {
                bend,
                noise: NOISE * terms,
                smooth,
            }
        };
        gather_contact(friction.vertices.len(), fields, &differentiate, &Ahead::and)
    }
}

/// A Hessian without the rows and columns of dropped components.
fn kept_part<const C: usize>(
    hessian: &SMatrix<f64, C, C>,
    dropped: &[bool; C],
) -> SMatrix<f64, C, C> {
    SMatrix::from_fn(|r, c| {
        if dropped[r] || dropped[c] {
            0.0
        } else {
            hessian[(r, c)]
        }
    })
}
