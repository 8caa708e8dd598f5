//! Craig-Bampton reduction: static responses to the boundary, and the modes with the boundary fixed.

mod between;
mod lanczos;
mod loss;
mod modes;
mod ordered;
mod orthogonal;

pub use between::Between;
pub use modes::{Mode, Modes};

use nalgebra::SVector;

use crate::block::FIXED;
use crate::cholesky::{Analysis, Interior, Layout, Memory, tallest};
use crate::{BlockMatrix, SolveError};

/// Static responses of a body to its boundary: the factor of a stiffness with the boundary vertices last.
///
/// With the free components split into the interior `I` and the boundary `F`, the interior follows the boundary
/// statically by the extension
///
/// ```text
/// E y = (-A_II^-1 A_IF y, y),   E^T A E = A_FF - A_FI A_II^-1 A_IF
/// ```
///
/// It is orthogonal in `A` to all fields that vanish on the boundary. No extension is stored: products with `E` and
/// `E^T` are substitutions, and `E^T N E` is formed by eliminating the interior.
///
/// Boundary unknowns are counted along the boundary vertices, component by component
/// ([`owners`](StaticResponses::owners)). Fields have one vector per vertex, and zero on fixed components.
///
/// ```
/// use nalgebra::{DMatrix, SVector};
/// use stickslip_fem::{P1, antiplane};
/// use stickslip_solvers::StaticResponses;
///
/// // A layer of 1 m, held at its top: each vertex of its base feels mu w / 1 m if all of them move.
/// let space = P1::grid([2.0, 1.0], [8, 4])?;
/// let (base, top) = (space.trace(|x| x[1] == 0.0)?, space.trace(|x| x[1] == 1.0)?);
/// let stiffness = antiplane(&space, 3e9)?;
/// let fixed: Vec<_> = (0..space.vertex_count()).map(|p| [top.vertices().contains(&p)]).collect();
/// let mut responses = StaticResponses::new(&stiffness, base.vertices(), &fixed, 1 << 30)?;
/// let count = responses.owners().len();
/// let stiffness = DMatrix::from_vec(count, count, responses.stiffness());
/// for (force, weight) in stiffness.column_sum().iter().zip(base.weights()) {
///     assert!((force - 3e9 * weight).abs() < 1.0);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct StaticResponses<const C: usize> {
    layout: Layout<C>,
    analysis: Analysis,
    factor: Vec<f64>,
    /// Whether `S` as factorised contains the addition to its diagonal.
    stiffened: bool,
    owners: Vec<(usize, usize)>,
    /// The position of each boundary unknown after the interior.
    places: Vec<usize>,
    /// The field in the order of elimination.
    x: Vec<f64>,
    work: Vec<f64>,
    zeros: Vec<SVector<f64, C>>,
}

impl<const C: usize> StaticResponses<C> {
    /// Factorises a stiffness that is definite on the interior. `boundary` increases, and `fixed` components are no
    /// unknowns. The memory limit of the factor is `allowed` bytes.
    ///
    /// # Errors
    /// [`SolveError`]: memory, a boundary out of order, an unconstrained interior.
    pub fn new(
        stiffness: &BlockMatrix<C>,
        boundary: &[usize],
        fixed: &[[bool; C]],
        allowed: usize,
    ) -> Result<Self, SolveError> {
        crate::block::check_blocks(stiffness, fixed)?;
        for (position, &vertex) in boundary.iter().enumerate() {
            let sorted = position == 0 || boundary[position - 1] < vertex;
            if !sorted || vertex >= fixed.len() {
                return Err(SolveError::UnsortedVertices { vertex, position });
            }
        }
        let (layout, upper) = Layout::new(stiffness, boundary, fixed)?;
        let memory = Memory { allowed, beside: 0 };
        let mut analysis = Analysis::new(&layout, &upper, &memory)?;
        let mut factor = vec![0.0; analysis.symbolic.len_val()];
        let stiffened = analysis.factorize_interior(&layout, stiffness, &mut factor)?;
        if let Some(vertex) = analysis.rounded_pivot(&layout, &factor, layout.interior) {
            return Err(SolveError::RigidBodyMode { vertex });
        }
        let owners: Vec<_> = (boundary.iter())
            .flat_map(|&vertex| (0..C).map(move |c| (vertex, c)))
            .filter(|&(vertex, c)| layout.positions[vertex][c] != FIXED)
            .collect();
        let place = |&(vertex, c): &(usize, usize)| layout.positions[vertex][c] as usize;
        Ok(Self {
            stiffened,
            places: owners.iter().map(place).collect(),
            owners,
            x: vec![0.0; layout.unknowns()],
            work: vec![0.0; tallest(&analysis.symbolic)],
            zeros: vec![SVector::zeros(); layout.size()],
            layout,
            analysis,
            factor,
        })
    }

    /// The vertex and the component of each boundary unknown.
    pub fn owners(&self) -> &[(usize, usize)] {
        &self.owners
    }

    /// The number of interior unknowns.
    pub fn interior(&self) -> usize {
        self.layout.interior
    }

    /// `E^T A E` by columns [N/m].
    pub fn stiffness(&mut self) -> Vec<f64> {
        let count = self.owners.len();
        let (mut schur, mut work) = (vec![0.0; count * count], vec![0.0; count * count]);
        let interior = self.layout.interior;
        (self.analysis).schur(&self.factor, interior, &mut work, &mut schur);
        if self.stiffened {
            self.analysis.relax_schur(&self.layout, &mut schur);
        }
        self.ordered(&schur, work)
    }

    /// `E^T N E` by columns, of an operator with the pattern of the stiffness, such as the mass.
    ///
    /// # Errors
    /// [`SolveError::SizeMismatch`] for another pattern.
    pub fn condensed(&mut self, operator: &BlockMatrix<C>) -> Result<Vec<f64>, SolveError> {
        self.check_pattern(operator)?;
        let (layout, count) = (&self.layout, self.owners.len());
        let mut condensed = vec![0.0; count * count];
        (self.analysis).congruence(layout, operator, &self.factor, &mut condensed);
        let into = vec![0.0; count * count];
        Ok(self.ordered(&condensed, into))
    }

    fn check_pattern(&self, operator: &BlockMatrix<C>) -> Result<(), SolveError> {
        let layout = &self.layout;
        if layout.fits(operator, layout.vertices(), layout.fixed()) {
            return Ok(());
        }
        Err(SolveError::SizeMismatch {
            expected: layout.blocks(),
            found: operator.nnz(),
        })
    }

    /// A matrix in the order of the boundary unknowns.
    fn ordered(&self, matrix: &[f64], mut into: Vec<f64>) -> Vec<f64> {
        let (count, interior) = (self.owners.len(), self.layout.interior);
        for (column, &q) in self.places.iter().enumerate() {
            for (row, &p) in self.places.iter().enumerate() {
                into[column * count + row] = matrix[(q - interior) * count + p - interior];
            }
        }
        into
    }

    /// `E^T f`: the forces on the boundary that do the work of `f` \[N\].
    ///
    /// # Errors
    /// [`SolveError::NotFinite`].
    pub fn project(
        &mut self,
        operator: &BlockMatrix<C>,
        forces: &[SVector<f64, C>],
        onto: &mut [f64],
    ) -> Result<(), SolveError> {
        self.gather(operator, forces)?;
        self.interior_factor(|factor, x, work| factor.forward(x, work));
        for (onto, &place) in onto.iter_mut().zip(&self.places) {
            *onto = self.x[place];
        }
        Ok(())
    }

    /// `E y` plus the static response of the interior to `forces` with the boundary fixed, into the free components of
    /// `field`.
    ///
    /// # Errors
    /// [`SolveError::NotFinite`].
    pub fn extend(
        &mut self,
        operator: &BlockMatrix<C>,
        forces: Option<&[SVector<f64, C>]>,
        y: &[f64],
        field: &mut [SVector<f64, C>],
    ) -> Result<(), SolveError> {
        match forces {
            None => self.x.fill(0.0),
            Some(forces) => {
                self.gather(operator, forces)?;
                self.interior_factor(|factor, x, work| factor.forward(x, work));
            }
        }
        for (y, &place) in y.iter().zip(&self.places) {
            self.x[place] = *y;
        }
        self.interior_factor(|factor, x, work| factor.backward(x, work));
        self.layout.scatter(&self.x, field);
        Ok(())
    }

    fn gather(
        &mut self,
        operator: &BlockMatrix<C>,
        forces: &[SVector<f64, C>],
    ) -> Result<(), SolveError> {
        crate::energy::expect([(self.layout.size(), forces.len())])?;
        let gathered = (self.layout).gather(operator, forces, &self.zeros, &mut self.x);
        gathered.ok_or(SolveError::NotFinite {
            iteration: 1,
            change: f64::NAN,
        })
    }

    fn interior_factor(&mut self, substitute: impl FnOnce(&Interior<'_>, &mut [f64], &mut [f64])) {
        let factor = substitution(&self.analysis, &self.factor, &self.layout);
        substitute(&factor, &mut self.x, &mut self.work);
    }
}

/// The columns of a factor that belong to the interior.
fn substitution<'a, const C: usize>(
    analysis: &'a Analysis,
    factor: &'a [f64],
    layout: &Layout<C>,
) -> Interior<'a> {
    Interior {
        symbolic: &analysis.symbolic,
        factor,
        columns: layout.interior,
    }
}
