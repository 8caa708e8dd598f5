//! Transforms that diagonalize the second difference along strike.

use std::f64::consts::PI;
use std::fmt;
use std::sync::Arc;

use rustdct::{DctPlanner, TransformType2And3, TransformType4};

/// A cosine or sine transform, by the conditions at both ends: where pressure is given at the edge of the last cell,
/// functions are odd there, else even.
#[derive(Clone)]
pub(super) struct Transform {
    count: usize,
    kind: Kind,
    scratch: Vec<f64>,
}

#[derive(Clone)]
enum Kind {
    Cosines(Arc<dyn TransformType2And3<f64>>),
    Sines(Arc<dyn TransformType2And3<f64>>),
    CosinesToZero(Arc<dyn TransformType4<f64>>),
    SinesFromZero(Arc<dyn TransformType4<f64>>),
}

impl fmt::Debug for Transform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Transform")
            .field("count", &self.count)
            .finish_non_exhaustive()
    }
}

impl Transform {
    /// The transform of rows of so many cells; `given` says at which ends the pressure is given.
    pub(super) fn new(count: usize, given: [bool; 2]) -> Self {
        let mut planner = DctPlanner::new();
        let kind = match given {
            [false, false] => Kind::Cosines(planner.plan_dct2(count)),
            [true, true] => Kind::Sines(planner.plan_dst2(count)),
            [false, true] => Kind::CosinesToZero(planner.plan_dct4(count)),
            [true, false] => Kind::SinesFromZero(planner.plan_dst4(count)),
        };
        let scratch = match &kind {
            Kind::Cosines(plan) | Kind::Sines(plan) => plan.get_scratch_len(),
            Kind::CosinesToZero(plan) | Kind::SinesFromZero(plan) => plan.get_scratch_len(),
        };
        Self {
            count,
            kind,
            scratch: vec![0.0; scratch],
        }
    }

    /// The eigenvalues of the second difference, `2 - 2 cos(w)`.
    pub(super) fn eigenvalues(&self) -> Vec<f64> {
        let shift = match self.kind {
            Kind::Cosines(_) => 0.0,
            Kind::Sines(_) => 1.0,
            Kind::CosinesToZero(_) | Kind::SinesFromZero(_) => 0.5,
        };
        let value = |mode: usize| {
            let half = 0.5 * PI * (mode as f64 + shift) / self.count as f64;
            4.0 * half.sin().powi(2)
        };
        (0..self.count).map(value).collect()
    }

    /// Transforms each row.
    pub(super) fn forward(&mut self, rows: &mut [f64]) {
        let scratch = &mut self.scratch;
        for row in rows.chunks_mut(self.count) {
            match &self.kind {
                Kind::Cosines(plan) => plan.process_dct2_with_scratch(row, scratch),
                Kind::Sines(plan) => plan.process_dst2_with_scratch(row, scratch),
                Kind::CosinesToZero(plan) => plan.process_dct4_with_scratch(row, scratch),
                Kind::SinesFromZero(plan) => plan.process_dst4_with_scratch(row, scratch),
            }
        }
    }

    /// Transforms each row back, times half their length.
    pub(super) fn back(&mut self, rows: &mut [f64]) {
        let scratch = &mut self.scratch;
        for row in rows.chunks_mut(self.count) {
            match &self.kind {
                Kind::Cosines(plan) => plan.process_dct3_with_scratch(row, scratch),
                Kind::Sines(plan) => plan.process_dst3_with_scratch(row, scratch),
                Kind::CosinesToZero(plan) => plan.process_dct4_with_scratch(row, scratch),
                Kind::SinesFromZero(plan) => plan.process_dst4_with_scratch(row, scratch),
            }
        }
    }
}
