//! Cells that relax far faster than the rest of a fault: without strength, or nearly.

use nalgebra::{SMatrix, SVector};
use stickslip_solvers::{Matrix, Potentials};

use super::RungeKutta;
use super::contacts::numbered;
use super::tableau::NODES;
use crate::StepError;
use crate::contact::ContactSet;
use crate::numerics::NUMERICS;
use crate::step::Anderson;
use crate::sums::largest;

/// The cells of a step whose relaxation an explicit method cannot follow, and what they are found by.
///
/// By itself a cell relaxes at the rate `A_ii/(eta + dtau/dV)`. A cell whose friction reads the slip rate is soft if its
/// normal stress lies below that of the fault: of the cells that are joined to the median one by ratios of at most
/// [`growth`](crate::numerics::Numerics::growth), since what a step may grow by is worth another method. Where a soft cell
/// relaxes within the step, its displacement is implicit: at a stage the mean slip rate since the beginning of the step,
/// over `c dt`, balances
/// ```text
/// (eta + c dt A_ii) V + friction(V) = l - (A u)_i + A_ii (u_i - u_i0)
/// ```
/// which is backward Euler's method, for all of these cells together. In the limit of fast cells it is the quasi-steady
/// balance, at each stage, of a differential-algebraic equation of index 1: the other cells see the explicit method with
/// its order. The slip rates of these cells are mean ones of the step.
pub(super) struct SoftCells<const C: usize> {
    /// `A` of each frictional vertex with itself; empty where no cell is treated so.
    own: Vec<SMatrix<f64, C, C>>,
    /// The rates of relaxation at the start of the step [1/s].
    rates: Vec<f64>,
    /// The normal stresses there, and the least one of a cell that is not soft \[Pa\].
    normal_stress: Vec<f64>,
    least: f64,
    ordered: Vec<f64>,
    /// The numbers of those of the present step among the frictional vertices.
    cells: Vec<usize>,
    /// The mean rates of a stage that the elastic forces see, those in balance with them, and 1 for each of the cells;
    /// empty before the first step with such cells.
    seen: Vec<f64>,
    balanced: Vec<f64>,
    weights: Vec<f64>,
    anderson: Anderson,
}

impl<const C: usize> SoftCells<C> {
    /// The soft cells of frictional vertices without prescribed components, each of one contact; none on a single one.
    pub(super) fn new(stiffness: &dyn Matrix<C>, contacts: &ContactSet<C>, is_free: bool) -> Self {
        let vertices = &contacts.vertices[..];
        let cells = contacts.contacts.iter();
        let cells: usize = cells.map(|contact| contact.part.vertices.len()).sum();
        let alone = cells == vertices.len() && cells == stiffness.vertex_count();
        let several = is_free && alone && cells > 1;
        let own = |&vertex: &usize| stiffness.diagonal_block(vertex);
        let own: Vec<_> = (vertices.iter().filter(|_| several)).map(own).collect();
        Self {
            rates: vec![0.0; own.len()],
            normal_stress: vec![0.0; own.len()],
            least: 0.0,
            ordered: Vec::with_capacity(own.len()),
            cells: Vec::with_capacity(own.len()),
            own,
            seen: Vec::new(),
            balanced: Vec::new(),
            weights: Vec::new(),
            anderson: Anderson::default(),
        }
    }

    pub(super) fn are_any(&self) -> bool {
        !self.cells.is_empty()
    }

    /// Whether a vertex is one of them. All vertices are frictional then.
    pub(super) fn has(&self, vertex: usize) -> bool {
        self.cells.binary_search(&vertex).is_ok()
    }

    /// Their vertices, of all frictional ones.
    pub(super) fn vertices(&self, all: &[usize]) -> impl Iterator<Item = usize> {
        self.cells.iter().map(|&k| all[k])
    }

    /// Finds the least normal stress of a cell that is not soft; 0 if none is.
    fn find_least(&mut self, contacts: &ContactSet<C>) {
        let mut range = [f64::INFINITY, 0.0_f64];
        for contact in &contacts.contacts {
            for (&vertex, &stress) in contact.part.vertices.iter().zip(&contact.normal_stress) {
                self.normal_stress[vertex] = stress;
                range = [range[0].min(stress), range[1].max(stress)];
            }
        }
        self.least = 0.0;
        if range[0] * NUMERICS.growth >= range[1] {
            return;
        }
        self.ordered.clear();
        self.ordered.extend_from_slice(&self.normal_stress);
        self.ordered.sort_unstable_by(f64::total_cmp);
        let below = &self.ordered[..=self.ordered.len() / 2];
        let mut falling = below.iter().rev();
        self.least = falling.next().copied().unwrap_or_default();
        for &own in falling {
            if own * NUMERICS.growth < self.least {
                break;
            }
            self.least = own;
        }
    }

    /// Finds the soft cells that relax within a step.
    fn find(&mut self, dt: f64) {
        self.cells.clear();
        if self.least == 0.0 {
            return;
        }
        let all = self.normal_stress.iter().zip(&self.rates).enumerate();
        let soft = all.filter(|(_, (stress, rate))| **stress < self.least && **rate * dt > 1.0);
        self.cells.extend(soft.map(|(k, _)| k));
        if self.are_any() {
            let size = self.own.len() * C;
            if self.seen.is_empty() {
                self.anderson = Anderson::new(size);
                for field in [&mut self.seen, &mut self.balanced, &mut self.weights] {
                    field.resize(size, 0.0);
                }
            }
            for field in [&mut self.seen, &mut self.balanced, &mut self.weights] {
                field.fill(0.0);
            }
            for &k in &self.cells {
                self.weights[k * C..][..C].fill(1.0);
            }
        }
    }
}

impl<const C: usize> RungeKutta<C> {
    /// Stores the rates of relaxation at the start of a step, by the contacts in force.
    pub(super) fn find_rates(&mut self) {
        let soft = &mut self.soft;
        if soft.own.is_empty() {
            return;
        }
        soft.find_least(&self.scene.contacts);
        if soft.least == 0.0 {
            return;
        }
        for (k, rate) in soft.rates.iter_mut().enumerate() {
            let (v, own) = (&self.stages.slopes[0].displacement[k], &soft.own[k]);
            *rate = 0.0;
            let is_soft = soft.normal_stress[k] < soft.least && self.scene.contacts.reads_rate(k);
            if is_soft && v.amax() > 0.0 {
                let resistance =
                    self.local.damping[k] + self.scene.contacts.local_model(k, v).hessian;
                *rate = v.dot(&(own * v)) / v.dot(&(resistance * v));
            }
        }
    }

    /// Finds the soft cells of a step. Their first slope is the slip rate of the last step.
    pub(super) fn find_soft_cells(&mut self, dt: f64) {
        self.soft.find(dt);
    }

    /// Takes slip rates of soft cells from the state: in a state at the end of a step they are mean rates.
    pub(super) fn remember_soft_cells(&mut self) {
        if self.now.last_step > 0.0 {
            self.soft.find(self.now.last_step);
            for &k in &self.soft.cells {
                let vertex = self.scene.contacts.vertices[k];
                self.stages.slopes[0].displacement[vertex] = self.now.velocity[vertex];
            }
        }
    }

    /// Displaces the soft cells of a stage, as a first guess by the mean rates of the previous one.
    pub(super) fn displace_soft_cells(&mut self, stage: usize, dt: f64) {
        for &k in &self.soft.cells {
            let rate = &self.stages.slopes[stage - 1].displacement[self.scene.contacts.vertices[k]];
            self.soft.seen[k * C..][..C].copy_from_slice(rate.as_slice());
        }
        self.displace_as_seen(stage, dt);
    }

    fn displace_as_seen(&mut self, stage: usize, dt: f64) {
        let since = NODES[stage] * dt;
        for &k in &self.soft.cells {
            let vertex = self.scene.contacts.vertices[k];
            let rate = SVector::from_column_slice(&self.soft.seen[k * C..][..C]);
            self.stages.motion.displacement[vertex] = self.now.displacement[vertex] + rate * since;
        }
    }

    /// Balances the soft cells of a stage at a time with one another, and then all others: by Anderson's acceleration of
    /// Jacobi's method.
    pub(super) fn couple_soft_cells(
        &mut self,
        stage: usize,
        time: f64,
        dt: f64,
    ) -> Result<(), StepError> {
        if !self.soft.are_any() {
            return Ok(());
        }
        self.soft.anderson.begin();
        for iterations in 1.. {
            let [missing, scale] = self.balance_soft_cells(stage, dt);
            let tolerance = NUMERICS.rounding * scale;
            if missing <= tolerance {
                break;
            }
            if iterations == NUMERICS.evaluations || !missing.is_finite() {
                return Err(StepError::NotCoupled {
                    iterations,
                    change: missing,
                    tolerance,
                });
            }
            let ranks = self.matrices.stiffness().ranks();
            let SoftCells {
                anderson,
                weights,
                seen,
                balanced,
                ..
            } = &mut self.soft;
            anderson.advance(&ranks, weights, seen, balanced);
            self.displace_as_seen(stage, dt);
            (self.elastic).at(
                stage,
                self.matrices.stiffness(),
                &self.stages.motion.displacement,
            );
            self.evaluate(stage, time)?;
        }
        Ok(())
    }

    /// Balances the soft cells of a stage by their mean rates since the beginning of the step. Returns the largest elastic
    /// force that they do not see, and the scale of forces \[N\].
    fn balance_soft_cells(&mut self, stage: usize, dt: f64) -> [f64; 2] {
        let [mut missing, mut scale] = [0.0_f64; 2];
        let since = NODES[stage] * dt;
        for &k in &self.soft.cells {
            let (vertex, own) = (self.scene.contacts.vertices[k], &self.soft.own[k]);
            let moved = self.stages.motion.displacement[vertex] - self.now.displacement[vertex];
            let force = self.drive.forces[vertex] + own * moved;
            let resistance = self.local.damping[k] + own * since;
            let velocity = self.scene.contacts.minimize(k, &resistance, &force);
            self.soft.balanced[k * C..][..C].copy_from_slice(velocity.as_slice());
            let unseen = own * (velocity * since - moved);
            missing = largest([missing, unseen.amax()].into_iter());
            let elastic = &self.elastic.at_stages[stage][vertex];
            scale = scale.max(elastic.amax() + force.amax());
            let slope = &mut self.stages.slopes[stage];
            slope.displacement[vertex] = velocity;
            for (contact, at, first) in numbered(&self.scene.contacts, &self.now) {
                let place = contact.position_of(vertex);
                if let Some(place) = place.filter(|_| !at.states.is_empty()) {
                    let rate = contact.slip_rate(place, &slope.displacement);
                    let state = self.stages.motion.states[first + place];
                    slope.states[first + place] =
                        contact.trial.laws().evolution(place, rate, state);
                }
            }
        }
        [missing, scale]
    }

    /// Sets the errors of the displacements of soft cells: that of backward Euler's method, damped by the relaxation.
    pub(super) fn differ_soft_cells(&mut self, dt: f64) {
        for &k in &self.soft.cells {
            let vertex = self.scene.contacts.vertices[k];
            let [first, .., last] = self
                .stages
                .slopes
                .each_ref()
                .map(|at| at.displacement[vertex]);
            let share = 0.5 * dt / (1.0 + dt * self.soft.rates[k]);
            self.stages.error.displacement[vertex] = (last - first) * share;
        }
    }
}
