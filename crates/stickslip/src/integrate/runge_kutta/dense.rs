//! The motion inside of a step: the continuous extension of the method.

use stickslip_friction::modulus;

use super::RungeKutta;
use super::motion::Dense;
use super::tableau::{DENSE, STAGES};
use crate::step::Span;
use crate::{Snapshot, StepFailure, StepState};

/// The weights of `y_1 - y_0`, `dt k_1`, `dt k_7` and the sum of [`DENSE`] at a share `s` of the step: Hermite's cubic, and
/// a quartic that vanishes with its slope at both ends,
/// ```text
/// y(s) = y_0 + s (y_1 - y_0) + s (1 - s) (dt k_1 - (y_1 - y_0) + s (2 (y_1 - y_0) - dt k_1 - dt k_7
///      + (1 - s) dt sum_i d_i k_i))
/// ```
/// of order 4 throughout the step (E. Hairer, S. Norsett, G. Wanner, Solving Ordinary Differential Equations I, II.6).
pub(super) fn weights(share: f64) -> [f64; 4] {
    let bend = share * (1.0 - share);
    [
        share - bend + 2.0 * bend * share,
        bend * (1.0 - share),
        -bend * share,
        bend * bend,
    ]
}

impl<const C: usize> RungeKutta<C> {
    /// Whether times inside of a step can be shown: not where the state follows the normal stress or fields have a
    /// memory, which stages change in place.
    pub(super) fn is_dense(&self) -> bool {
        let contacts = &self.scene.contacts;
        let follow = (contacts.contacts.iter()).any(|own| own.trial.follows_normal_stress());
        !follow && !contacts.have_fields()
    }

    /// Shows the motion at times inside of the last accepted step, then restores its end.
    pub(super) fn show_inside(
        &mut self,
        times: &[f64],
        show: &mut dyn FnMut(Snapshot<'_, C>),
    ) -> Result<(), StepFailure> {
        let mut dense = self.stages.dense.take().unwrap_or_else(|| {
            Box::new(Dense {
                first: self.stages.slopes[0].clone(),
                from: self.last.clone(),
                to: self.now.clone(),
            })
        });
        std::mem::swap(&mut dense.first, &mut self.stages.slopes[0]);
        dense.from.copy_from(&self.last);
        dense.to.copy_from(&self.now);
        let shown = times.iter().try_for_each(|&time| {
            self.move_inside(&dense, time)?;
            show(self.snapshot());
            Ok(())
        });
        let back = self.move_back(&dense.to);
        std::mem::swap(&mut dense.first, &mut self.stages.slopes[0]);
        self.stages.dense = Some(dense);
        shown.and(back)
    }

    /// The motion at a time \[s\] inside of a step, its slip rates in balance.
    fn move_inside(&mut self, dense: &Dense<C>, time: f64) -> Result<(), StepFailure> {
        let (from, to) = (&dense.from, &dense.to);
        let (dt, since) = (to.last_step, from.clock.left(time));
        let share = since / dt;
        let [ends, first, last, inside] = weights(share);
        let mut shares = DENSE.map(|weight| weight * inside * dt);
        shares[0] += first * dt;
        shares[STAGES - 1] += last * dt;
        let slopes = &self.stages.slopes;
        // The slope of a stage; the second has no weight.
        let of = |stage: usize| {
            if stage == 0 {
                &dense.first
            } else {
                &slopes[stage]
            }
        };
        let stages = || (0..STAGES).filter(|&stage| stage != 1);
        self.now.copy_from(to);
        self.now.clock = from.clock.after(since);
        for (vertex, now) in self.now.displacement.iter_mut().enumerate() {
            let (begin, end) = (from.displacement[vertex], to.displacement[vertex]);
            *now = begin;
            if self.soft.has(vertex) {
                // Its slip rate is the mean one of the step.
                *now += (end - begin) * share;
                continue;
            }
            *now += (end - begin) * ends;
            for stage in stages() {
                *now += of(stage).displacement[vertex] * shares[stage];
            }
        }
        let mut row = 0;
        for ((at, contact), (from, to)) in (self.now.contacts.iter_mut())
            .zip(&self.scene.contacts.contacts)
            .zip(from.contacts.iter().zip(&to.contacts))
        {
            for (k, state) in at.states.iter_mut().enumerate() {
                let rates = stages().map(|stage| of(stage).states[row + k] * shares[stage]);
                *state =
                    from.states[k] + (to.states[k] - from.states[k]) * ends + rates.sum::<f64>();
            }
            row += at.states.len();
            for (k, slip) in at.slip.iter_mut().enumerate() {
                let vertex = contact.part.vertices[k];
                let moved = self.now.displacement[vertex] - dense.from.displacement[vertex];
                *slip = from.slip[k] + modulus(&contact.tangential(k, &moved));
            }
        }
        self.stages.motion.copy_from(&self.now);
        let stiffness = self.matrices.stiffness();
        (self.elastic).at(0, stiffness, &self.stages.motion.displacement);
        let balanced = self.evaluate(0, self.now.clock.time());
        balanced.map_err(|cause| StepFailure::of(&self.now.clock, cause))?;
        for (vertex, rate) in self.now.velocity.iter_mut().enumerate() {
            if !self.soft.has(vertex) {
                *rate = self.stages.slopes[0].displacement[vertex];
            }
        }
        self.show_balanced();
        Ok(())
    }

    /// The end of the step, with its loads, normal stresses and elastic forces: those of the last stage, bit for bit.
    fn move_back(&mut self, to: &StepState<C>) -> Result<(), StepFailure> {
        self.now.copy_from(to);
        self.stages.motion.copy_from(&self.now);
        self.elastic.repeat_last();
        let time = Span::seen(&self.now.clock, &self.scene.stops);
        let balanced = self.evaluate(0, time);
        balanced.map_err(|cause| StepFailure::of(&self.now.clock, cause))?;
        self.show_balanced();
        Ok(())
    }

    fn show_balanced(&mut self) {
        for (at, contact) in self
            .now
            .contacts
            .iter_mut()
            .zip(&self.scene.contacts.contacts)
        {
            at.normal_stress.copy_from_slice(&contact.normal_stress);
        }
        self.drive.balanced = Some(self.now.clock);
        self.scene.seen.show(&self.now);
    }
}

#[cfg(test)]
mod tests {
    use super::super::tableau::{NODES, WEIGHTS};
    use super::*;

    /// The conditions of order 4 of a quadrature at every share of the step, and the ends of the step.
    #[test]
    fn the_extension_has_order_4() {
        for share in [0.0, 0.1, 0.37, 0.5, 0.81, 1.0] {
            let [ends, first, last, inside] = weights(share);
            let mut all = DENSE.map(|weight| weight * inside);
            all[0] += first;
            all[STAGES - 1] += last;
            for (weight, step) in all.iter_mut().zip(WEIGHTS[STAGES - 1]) {
                *weight += ends * step;
            }
            let sum = |of: &dyn Fn(usize) -> f64| (0..STAGES).map(|i| all[i] * of(i)).sum::<f64>();
            let inner = |i: usize, power: i32| {
                (0..i)
                    .map(|j| WEIGHTS[i][j] * NODES[j].powi(power))
                    .sum::<f64>()
            };
            let deep = |i: usize| (0..i).map(|j| WEIGHTS[i][j] * inner(j, 1)).sum::<f64>();
            for (found, exact) in [
                (sum(&|_| 1.0), share),
                (sum(&|i| NODES[i]), share.powi(2) / 2.0),
                (sum(&|i| NODES[i].powi(2)), share.powi(3) / 3.0),
                (sum(&|i| inner(i, 1)), share.powi(3) / 6.0),
                (sum(&|i| NODES[i].powi(3)), share.powi(4) / 4.0),
                (sum(&|i| NODES[i] * inner(i, 1)), share.powi(4) / 8.0),
                (sum(&|i| inner(i, 2)), share.powi(4) / 12.0),
                (sum(&deep), share.powi(4) / 24.0),
            ] {
                assert!((found - exact).abs() < 1e-14, "{share}: {found} {exact}");
            }
        }
    }
}
