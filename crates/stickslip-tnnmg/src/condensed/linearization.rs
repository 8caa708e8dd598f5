//! The Newton step of the condensed problem: truncation, direction, projection, what is left.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::ConvexPotential;

use super::boundary::Boundary;
use crate::line_search::NOISE;

/// What the potentials do over a part of the direction.
pub(super) struct Ahead {
    /// By how much their slope at its end, times its length, exceeds that of the second-order model.
    pub(super) bend: f64,
    /// How far rounding may have moved it.
    pub(super) noise: f64,
    /// The kept components have gradients there.
    pub(super) smooth: bool,
}

impl<const C: usize> Boundary<C> {
    /// Chooses the kept unknowns: where the potential is smooth, with a curvature of at most
    /// `ratio` times that of the quadratic part.
    pub(super) fn truncate<P: ConvexPotential<C>>(
        &mut self,
        schur: &[f64],
        potentials: &[P],
        ratio: f64,
    ) {
        let count = self.count();
        self.newton.kept.clear();
        for (k, potential) in potentials.iter().enumerate() {
            let model = potential.local_model(&self.y[k]);
            let scale = (self.free(k)).fold(0.0, |s: f64, (_, i)| s.max(schur[i * count + i]));
            // A diagonal bound suffices: the Hessian is positive semidefinite.
            let bounded = (self.free(k)).all(|(c, _)| model.hessian[(c, c)] <= ratio * scale);
            self.truncated[k] = [true; C];
            for (c, i) in self.free(k).filter(|&(c, _)| bounded && model.smooth[c]) {
                self.truncated[k][c] = false;
                self.newton.kept.push(i as u32);
            }
            let truncated = self.truncated[k];
            let dropped = |c: usize| truncated[c];
            self.gradients[k] =
                SVector::from_fn(|c, _| if dropped(c) { 0.0 } else { model.gradient[c] });
            self.hessians[k] = SMatrix::from_fn(|r, c| {
                if dropped(r) || dropped(c) {
                    0.0
                } else {
                    model.hessian[(r, c)]
                }
            });
        }
    }

    /// Factorises the Newton matrix; the error is the vertex at which it is not positive definite.
    pub(super) fn factorize(&mut self, schur: &[f64]) -> Result<(), usize> {
        self.newton.assemble(schur, self.count());
        let mut begin = 0;
        for (truncated, hessian) in self.truncated.iter().zip(&self.hessians) {
            let kept = || (0..C).filter(|&c| !truncated[c]);
            for (row, r) in kept().enumerate() {
                for (column, c) in kept().enumerate().take(row + 1) {
                    self.newton
                        .add(begin + row, begin + column, hessian[(r, c)]);
                }
            }
            begin += kept().count();
        }
        let failed = self.newton.factorize();
        failed.map_err(|unknown| self.owner(unknown as usize).0)
    }

    /// Takes the gradients of the potentials ahead by `length` times the direction, of the kept
    /// components.
    pub(super) fn differentiate<P: ConvexPotential<C>>(
        &mut self,
        potentials: &[P],
        length: f64,
    ) -> Ahead {
        let (mut bend, mut terms, mut smooth) = (0.0, 0.0, true);
        for (k, potential) in potentials.iter().enumerate() {
            self.gradients_ahead[k] = self.gradients[k];
            let d = self.direction[k] * length;
            if self.truncated[k].iter().all(|&truncated| truncated) {
                continue;
            }
            let model = potential.local_model(&(self.y[k] + d));
            for c in (0..C).filter(|&c| !self.truncated[k][c]) {
                smooth &= model.smooth[c];
                self.gradients_ahead[k][c] = model.gradient[c];
            }
            let linear = self.gradients[k].dot(&d);
            bend += self.gradients_ahead[k].dot(&d) - linear - d.dot(&(self.hessians[k] * d));
            terms += linear.abs();
        }
        Ahead {
            bend,
            noise: NOISE * terms,
            smooth,
        }
    }

    /// The direction `d = H^-1 descent`; returns `d . H d`.
    pub(super) fn aim(&mut self) -> f64 {
        let size = self.newton.kept.len();
        for (place, &i) in self.newton.kept.iter().enumerate() {
            let (k, c) = self.owner(i as usize);
            self.descent[place] = self.residual[i as usize] - self.gradients[k][c];
        }
        let (descent, correction) = (&self.descent[..size], &mut self.correction[..size]);
        correction.copy_from_slice(descent);
        if size > 0 {
            self.newton.solve(correction);
        }
        let square = descent.iter().zip(&*correction).map(|(r, d)| r * d).sum();
        self.direction.fill(SVector::zeros());
        for (place, &i) in self.newton.kept.iter().enumerate() {
            let (k, c) = self.owner(i as usize);
            self.direction[k][c] = self.correction[place];
        }
        square
    }

    /// Shortens the direction to where the second-order model holds; true if anything changed.
    pub(super) fn project<P: ConvexPotential<C>>(&mut self, potentials: &[P]) -> bool {
        let mut left = false;
        for (k, potential) in potentials.iter().enumerate() {
            if self.truncated[k].iter().all(|&truncated| truncated) {
                continue;
            }
            let mut kept = potential.keep_smooth(&self.y[k], &self.direction[k]);
            for c in (0..C).filter(|&c| self.truncated[k][c]) {
                kept[c] = 0.0;
            }
            left |= kept != self.direction[k];
            self.direction[k] = kept;
        }
        left
    }

    /// `d . (descent)` and `d . (S + D) d` of the direction as it is.
    pub(super) fn slopes(&self, schur: &[f64]) -> (f64, f64) {
        let count = self.count();
        let at = |i: usize| {
            let (k, c) = self.owner(i);
            self.direction[k][c]
        };
        let (mut decrease, mut curvature) = (0.0, 0.0);
        for (place, &j) in self.newton.kept.iter().enumerate() {
            let d = at(j as usize);
            let column = &schur[j as usize * count..][..count];
            let image: f64 = (self.newton.kept.iter())
                .map(|&i| column[i as usize] * at(i as usize))
                .sum();
            decrease += d * self.descent[place];
            curvature += d * image;
        }
        for (d, hessian) in self.direction.iter().zip(&self.hessians) {
            curvature += d.dot(&(hessian * d));
        }
        (decrease, curvature)
    }

    /// Adds to the direction, for vertices with truncated components, what the next sweep would;
    /// returns the squares of these changes in the norm of the diagonal blocks.
    pub(super) fn sweep_ahead<P: ConvexPotential<C>>(
        &mut self,
        schur: &[f64],
        potentials: &[P],
    ) -> f64 {
        let mut sum = 0.0;
        for (k, potential) in potentials.iter().enumerate() {
            if (self.free(k)).all(|(c, _)| !self.truncated[k][c]) {
                continue;
            }
            let change = self.minimizer(schur, potential, k) - self.y[k];
            sum += change.dot(&(self.block(schur, k) * change));
            for c in (0..C).filter(|&c| self.truncated[k][c]) {
                self.direction[k][c] = change[c];
            }
        }
        sum
    }

    /// Takes back what [`sweep_ahead`](Self::sweep_ahead) added to the direction.
    pub(super) fn drop_truncated(&mut self) {
        for (direction, truncated) in self.direction.iter_mut().zip(&self.truncated) {
            for c in (0..C).filter(|&c| truncated[c]) {
                direction[c] = 0.0;
            }
        }
    }

    /// Whether what is left of the descent, and of the local minimisations of truncated components,
    /// is no more than the rounding errors of its terms.
    pub(super) fn is_rounded(&self, schur: &[f64]) -> bool {
        let count = self.count();
        let mut kept = self.descent.iter();
        (0..count).all(|i| {
            let column = &schur[i * count..][..count];
            let (k, c) = self.owner(i);
            let mut terms = self.force[i].abs();
            for (j, entry) in column.iter().enumerate() {
                let (k, c) = self.owner(j);
                terms += (entry * self.y[k][c]).abs();
            }
            let left = if self.truncated[k][c] {
                column[i] * self.direction[k][c].abs()
            } else {
                terms += self.gradients[k][c].abs();
                kept.next().map_or(0.0, |descent| descent.abs())
            };
            left <= 16.0 * f64::EPSILON * terms
        })
    }
}
