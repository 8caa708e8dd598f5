//! The linear system of both stages.

use super::Cells;
use super::line_solver::LineSolver;
use super::network_solver::NetworkSolver;
use super::plane_solver::PlaneSolver;
use super::{Boundary, Side};
use crate::FieldError;

/// The volume rates per pressure between cells at a moment.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Conductances {
    /// The mobility `k w_h/eta_f` of each cell.
    pub mobility: Vec<f64>,
    /// Those of inner faces.
    pub faces: Vec<f64>,
    /// Whether fluid can flow from each cell to each other one.
    pub connected: bool,
}

impl Conductances {
    /// Computes the faces from the mobilities.
    pub(super) fn update(&mut self, cells: &Cells) {
        cells.conductances(&self.mobility, &mut self.faces);
        self.connected = cells.is_connected(&self.faces);
    }
}

/// `(diag(a) + q L) x = b`, with `L` the Laplacian of the inner faces.
#[derive(Debug, Clone)]
pub(super) struct System {
    /// The `q` of the factors, none before the first.
    pub q: f64,
    /// `a`.
    pub diagonal: Vec<f64>,
    sum: f64,
    solver: Solver,
}

#[derive(Debug, Clone)]
enum Solver {
    Line(LineSolver),
    Plane(Box<PlaneSolver>),
    Network(NetworkSolver),
}

impl System {
    pub(super) fn new(cells: &Cells, sides: &[Boundary; 4]) -> Self {
        let count = cells.count();
        let given = [Side::Begin, Side::End]
            .map(|side| matches!(sides[side as usize], Boundary::Pressure(_)));
        let solver = match cells {
            Cells::Line(_) => Solver::Line(LineSolver::new(count)),
            Cells::Plane(plane) => Solver::Plane(Box::new(PlaneSolver::new(plane, given))),
            Cells::Network(network) => Solver::Network(NetworkSolver::new(network)),
        };
        Self {
            q: f64::NAN,
            diagonal: vec![0.0; count],
            sum: 0.0,
            solver,
        }
    }

    /// Prepares solutions with the diagonal as it stands.
    pub(super) fn factor(&mut self, conductances: &Conductances, q: f64) {
        self.q = q;
        self.sum = self.diagonal.iter().sum();
        match &mut self.solver {
            Solver::Line(solver) => solver.factor(&self.diagonal, &conductances.faces, q),
            Solver::Plane(solver) => solver.factor(&self.diagonal, conductances, q),
            Solver::Network(solver) => solver.factor(&self.diagonal, conductances, q),
        }
    }

    /// Replaces `b` by the solution. `total` is the sum of `b` without what cells exchange with one another: the solution
    /// keeps it, `sum a x = total`, however large `q L` is. Iterations end at a relative residual.
    pub(super) fn solve(
        &mut self,
        conductances: &Conductances,
        b: &mut [f64],
        total: f64,
        tolerance: f64,
    ) -> Result<(), FieldError> {
        match &mut self.solver {
            Solver::Line(solver) => solver.solve(b),
            Solver::Plane(solver) => {
                solver.solve(&self.diagonal, conductances, self.q, b, tolerance)?;
            }
            Solver::Network(solver) => {
                solver.solve(&self.diagonal, conductances, self.q, b, tolerance)?;
            }
        }
        let found: f64 = self.diagonal.iter().zip(&*b).map(|(a, x)| a * x).sum();
        let shift = (total - found) / self.sum;
        if !shift.is_finite() {
            return Err(not_finite(b));
        }
        if conductances.connected && shift != 0.0 {
            for x in b {
                *x += shift;
            }
        }
        Ok(())
    }
}

/// The error of a change of pressure that is not finite.
fn not_finite(change: &[f64]) -> FieldError {
    let place = change.iter().position(|x| !x.is_finite()).unwrap_or(0);
    FieldError {
        what: "change of pore pressure [Pa]",
        place,
        value: change[place],
    }
}
