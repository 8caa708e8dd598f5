//! The solver of planes: conjugate gradients with the exact solver of rows of mean coefficients.

use super::Plane;
use super::conjugate_gradients::ConjugateGradients;
use super::multigrid::Multigrid;
use super::system::Conductances;
use super::transform::Transform;
use crate::FieldError;

/// The contrast of conductances along a row or between rows from which multigrid takes less time, as measured.
const CONTRAST: f64 = 6.0;

/// Solves `A x = (diag(a) + q L) x = b` on a plane by conjugate gradients.
///
/// Where conductances change little along strike, the preconditioner has along each row the mean coefficients of the row:
/// a transform along strike makes it tridiagonal down dip. It is exact where coefficients change down dip alone. For
/// others it is a cycle of multigrid.
#[derive(Debug, Clone)]
pub(super) struct PlaneSolver {
    plane: Plane,
    /// Whether pressure is given at the begin and end along strike.
    given: [bool; 2],
    transform: Transform,
    eigenvalues: Vec<f64>,
    /// The factors of each mode, row by row.
    inverse: Vec<f64>,
    ratio: Vec<f64>,
    /// The elimination of a row in the next one.
    carried: Vec<f64>,
    /// Another preconditioner, and whether it is that of the factors.
    multigrid: Option<Box<Multigrid>>,
    is_varied: bool,
    gradients: ConjugateGradients,
}

impl PlaneSolver {
    pub(super) fn new(plane: &Plane, given: [bool; 2]) -> Self {
        let (count, columns) = (plane.count(), plane.counts()[0]);
        let (transform, vector) = (Transform::new(columns, given), || vec![0.0; count]);
        Self {
            plane: plane.clone(),
            given,
            eigenvalues: transform.eigenvalues(),
            transform,
            inverse: vector(),
            ratio: vector(),
            carried: vec![0.0; columns],
            multigrid: None,
            is_varied: false,
            gradients: ConjugateGradients::new(count),
        }
    }

    /// Computes the preconditioner.
    pub(super) fn factor(&mut self, diagonal: &[f64], conductances: &Conductances, q: f64) {
        let (columns, across_strike) = (self.plane.counts()[0], self.plane.faces()[0]);
        let faces = &conductances.faces;
        self.is_varied = self.is_varied(faces);
        if self.is_varied {
            let new = || Box::new(Multigrid::new(self.plane.counts()));
            self.multigrid
                .get_or_insert_with(new)
                .factor(diagonal, faces, q);
            return;
        }
        let given = self.given.map(|given| f64::from(u8::from(given)));
        self.carried.fill(0.0);
        for row in 0..self.plane.counts()[1] {
            let cells = row * columns..(row + 1) * columns;
            let along = &faces[row * (columns - 1)..(row + 1) * (columns - 1)];
            let below = faces.get(across_strike + cells.start..across_strike + cells.end);
            let below = below.map_or(0.0, |below| below.iter().sum::<f64>() / columns as f64);
            // The exchange with sides along strike is a part of the transform: twice that of a face.
            let sides = self.sides(row, &conductances.mobility, q);
            let count = along.len() as f64 + given[0] + given[1];
            let sum = q * along.iter().sum::<f64>() + 0.5 * (sides[0] + sides[1]);
            let along = if count > 0.0 { sum / count } else { 0.0 };
            let sum = diagonal[cells].iter().sum::<f64>() - sides[0] - sides[1];
            self.factor_row(row, sum.max(0.0) / columns as f64, along, q * below);
        }
    }

    /// Whether conductances change much along a row.
    fn is_varied(&self, faces: &[f64]) -> bool {
        let (columns, (along, down)) = (
            self.plane.counts()[0],
            faces.split_at(self.plane.faces()[0]),
        );
        let rows = along
            .chunks((columns - 1).max(1))
            .chain(down.chunks(columns));
        rows.into_iter().any(|row| {
            let least = row.iter().copied().fold(f64::INFINITY, f64::min);
            let most = row.iter().copied().fold(0.0, f64::max);
            most > CONTRAST * least
        })
    }

    /// `q` times the conductances of a row to given pressures along strike.
    fn sides(&self, row: usize, mobility: &[f64], q: f64) -> [f64; 2] {
        let (columns, [width, height]) = (self.plane.counts()[0], self.plane.lengths());
        let cells = [row * columns, (row + 1) * columns - 1];
        [0, 1].map(|end| {
            let conductance = 2.0 * height / width * mobility[cells[end]];
            if self.given[end] {
                q * conductance
            } else {
                0.0
            }
        })
    }

    /// The factors of a row, for all modes, by the elimination of [`LineSolver`](super::line_solver::LineSolver).
    fn factor_row(&mut self, row: usize, alone: f64, along: f64, below: f64) {
        let columns = self.plane.counts()[0];
        let cells = row * columns..(row + 1) * columns;
        let factors = self.inverse[cells.clone()]
            .iter_mut()
            .zip(&mut self.ratio[cells]);
        let modes = self.eigenvalues.iter().zip(&mut self.carried);
        for ((inverse, ratio), (eigenvalue, carried)) in factors.zip(modes) {
            let own = alone + along * eigenvalue + *carried;
            *inverse = 1.0 / (own + below);
            *ratio = below * *inverse;
            *carried = *ratio * own;
        }
    }

    /// Replaces `b` by the solution, up to a relative residual. Returns the number of iterations.
    pub(super) fn solve(
        &mut self,
        diagonal: &[f64],
        conductances: &Conductances,
        q: f64,
        b: &mut [f64],
        tolerance: f64,
    ) -> Result<usize, FieldError> {
        let Self {
            plane,
            transform,
            inverse,
            ratio,
            multigrid,
            is_varied,
            gradients,
            ..
        } = self;
        let columns = plane.counts()[0];
        let apply = |x: &[f64], image: &mut [f64]| {
            for ((image, x), diagonal) in image.iter_mut().zip(x).zip(diagonal) {
                *image = diagonal * x;
            }
            plane.add_flow(&conductances.faces, x, -q, image);
        };
        if let (true, Some(multigrid)) = (*is_varied, multigrid) {
            let precondition =
                |residual: &[f64], into: &mut [f64]| multigrid.precondition(residual, into);
            return gradients.solve(b, tolerance, apply, precondition);
        }
        let normal = 2.0 / columns as f64;
        let precondition = |residual: &[f64], into: &mut [f64]| {
            into.copy_from_slice(residual);
            transform.forward(into);
            solve_down_dip(columns, inverse, ratio, into);
            transform.back(into);
            into.iter_mut().for_each(|into| *into *= normal);
        };
        gradients.solve(b, tolerance, apply, precondition)
    }
}

/// Solves the tridiagonal systems of all modes.
fn solve_down_dip(columns: usize, inverse: &[f64], ratio: &[f64], values: &mut [f64]) {
    let rows = values.len() / columns;
    for row in 1..rows {
        let start = row * columns;
        let (above, below) = values.split_at_mut(start);
        let above = &above[start - columns..];
        let ratios = &ratio[start - columns..start];
        for (below, (above, ratio)) in below.iter_mut().zip(above.iter().zip(ratios)) {
            *below += ratio * above;
        }
    }
    for row in (0..rows).rev() {
        let start = row * columns;
        let (above, below) = values.split_at_mut(start + columns);
        let above = &mut above[start..];
        for (value, inverse) in above.iter_mut().zip(&inverse[start..]) {
            *value *= inverse;
        }
        // None below the last row.
        for (value, (below, ratio)) in above.iter_mut().zip(below.iter().zip(&ratio[start..])) {
            *value += ratio * below;
        }
    }
}
