//! The elastic forces of the stages.

use nalgebra::SVector;
use stickslip_solvers::Matrix;

use super::tableau::{ERROR, STAGES, WEIGHTS};
use super::threads::on_shares;

/// The last stage: the end of the step, and the first stage of the next one.
const LAST: usize = STAGES - 1;

/// The elastic forces `A u` of the stages, with six products a step.
///
/// The second stage is `u + dt w v`, with `A v` known from the last stage of the previous step. The error estimate is a
/// sum of the stages' forces, with weights such that the slopes inside add up to its own, and of `A v` of the last stage.
/// A restart repeats the two products of the first stage, with the same bits.
pub(super) struct Elastic<const C: usize> {
    /// `A u_s`.
    pub(super) at_stages: [Vec<SVector<f64, C>>; STAGES],
    /// `A v` at the first and the last stage.
    of_rates: [Vec<SVector<f64, C>>; 2],
}

impl<const C: usize> Elastic<C> {
    pub(super) fn new(size: usize) -> Self {
        let zeros = vec![SVector::zeros(); size];
        Self {
            at_stages: std::array::from_fn(|_| zeros.clone()),
            of_rates: [zeros.clone(), zeros],
        }
    }

    /// Forces at a displacement, by a product.
    pub(super) fn at(
        &mut self,
        stage: usize,
        stiffness: &dyn Matrix<C>,
        displacement: &[SVector<f64, C>],
    ) {
        multiply(stiffness, displacement, &mut self.at_stages[stage]);
    }

    /// Forces of the slip rates at the first stage, by a product.
    pub(super) fn of_first_rates(&mut self, stiffness: &dyn Matrix<C>, rates: &[SVector<f64, C>]) {
        multiply(stiffness, rates, &mut self.of_rates[0]);
    }

    /// Forces of the slip rates at the last stage, by a product.
    pub(super) fn of_last_rates(&mut self, stiffness: &dyn Matrix<C>, rates: &[SVector<f64, C>]) {
        multiply(stiffness, rates, &mut self.of_rates[1]);
    }

    /// Takes the forces of the last stage for those of the first.
    pub(super) fn repeat_last(&mut self) {
        let [first, .., last] = &mut self.at_stages;
        first.copy_from_slice(last);
    }

    /// Forces at the second stage of a step, from those of the first.
    pub(super) fn at_second_stage(&mut self, dt: f64) {
        let [first, second, ..] = &mut self.at_stages;
        let share = WEIGHTS[1][0] * dt;
        for ((second, first), rate) in second.iter_mut().zip(first).zip(&self.of_rates[0]) {
            *second = *first + rate * share;
        }
    }

    /// Makes the last stage of an accepted step the first of the next one.
    pub(super) fn accept(&mut self) {
        self.at_stages.swap(0, LAST);
        self.of_rates.swap(0, 1);
    }

    /// Subtracts the forces of an error of the displacement, by a product.
    pub(super) fn add_error_of(
        &mut self,
        stiffness: &dyn Matrix<C>,
        error: &[SVector<f64, C>],
        forces: &mut [SVector<f64, C>],
    ) {
        // The second stage enters nothing behind its own.
        let [_, product, ..] = &mut self.at_stages;
        multiply(stiffness, error, product);
        for (force, product) in forces.iter_mut().zip(product) {
            *force -= *product;
        }
    }

    /// Adds the forces of the error estimate, times `scale`.
    pub(super) fn add_error(&self, scale: f64, dt: f64, forces: &mut [SVector<f64, C>]) {
        const SHARES: [f64; STAGES] = shares_of_stages();
        let [first_rate, last_rate] = &self.of_rates;
        on_shares(forces, &|first, forces| {
            for (i, force) in (first..).zip(forces) {
                let start = self.at_stages[0][i];
                let rates = first_rate[i] * SHARES[0] + last_rate[i] * ERROR[LAST];
                let mut sum = rates * dt;
                for stage in 2..STAGES {
                    sum += (self.at_stages[stage][i] - start) * SHARES[stage];
                }
                *force += sum * scale;
            }
        });
    }
}

/// The weights of `u_s - u` from the third stage on that, with the first entry times `dt v`, yield all of the error
/// estimate but its last slope; the second is 0.
const fn shares_of_stages() -> [f64; STAGES] {
    let mut left = ERROR;
    let mut shares = [0.0; STAGES];
    let mut stage = LAST;
    while stage >= 2 {
        // The latest slope of a stage is in no earlier one.
        let share = left[stage - 1] / WEIGHTS[stage][stage - 1];
        shares[stage] = share;
        let mut slope = 0;
        while slope < stage {
            left[slope] -= share * WEIGHTS[stage][slope];
            slope += 1;
        }
        stage -= 1;
    }
    shares[0] = left[0];
    shares
}

fn multiply<const C: usize>(
    stiffness: &dyn Matrix<C>,
    field: &[SVector<f64, C>],
    product: &mut [SVector<f64, C>],
) {
    product.fill(SVector::zeros());
    stiffness.multiply_add(1.0, field, product);
}
