//! Stiffnesses by elements whose vertices are spread over processes.

mod algebra;
mod products;

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use crate::DistributedMatrix;
use crate::layout::Layout;
use crate::unknowns::Unknowns;
use nalgebra::{SMatrix, SVector};
use stickslip::fem::ElementStiffness;

/// The format of a scene for explicit steps in several processes: the sum of stiffnesses
/// [by elements](ElementStiffness) and of a matrix, the distributed [`ElementOperator`](stickslip::ElementOperator).
///
/// ```text
/// A = sum of s_k A_k + B
/// ```
///
/// A process has all cells at the vertices that it owns. A product fetches the field at its ghosts, once, and computes the
/// forces of these cells: those at its own vertices are complete, and no sum of forces goes from process to process. Cells
/// between the vertices of two processes are computed by both. Made by [`DistributedSpace::elements`]; masses and dashpots
/// are a [`DistributedMatrix`]. The solver is [`DistributedDiagonal`](crate::DistributedDiagonal). Products and sums are
/// those of the whole body, and all processes ask for them together; [`product_at`](stickslip::Matrix::product_at) is not a number
/// where it needs a vertex of another process.
///
/// [`DistributedSpace::elements`]: crate::DistributedSpace::elements
#[doc(alias = "matrix-free")]
pub struct DistributedElements<const C: usize> {
    layout: Arc<Layout>,
    numbering: Arc<Numbering>,
    /// The stiffnesses of the cells of this process with their factors.
    elements: Vec<(f64, ElementStiffness<C>)>,
    /// Their change to other unknowns; none for those of the mesh.
    unknowns: Option<Arc<Unknowns<C>>>,
    /// `B`; none for zero.
    matrix: Option<DistributedMatrix<C>>,
    room: Mutex<Room<C>>,
}

/// The vertices of the cells of a process.
#[derive(Debug, Default)]
pub(crate) struct Numbering {
    /// Those that it owns, increasing.
    pub(crate) owned: Vec<u32>,
    /// The number of each among owned ones and ghosts.
    pub(crate) numbers: Vec<u32>,
}

/// Fields of a product, empty before the first one.
#[derive(Debug)]
struct Room<const C: usize> {
    /// At owned vertices and ghosts.
    field: Vec<SVector<f64, C>>,
    /// At the vertices of the cells, and the forces there.
    local: [Vec<SVector<f64, C>>; 2],
    /// The forces at owned vertices.
    forces: Vec<SVector<f64, C>>,
}

impl<const C: usize> Default for Room<C> {
    fn default() -> Self {
        Self {
            field: Vec::new(),
            local: [Vec::new(), Vec::new()],
            forces: Vec::new(),
        }
    }
}

impl<const C: usize> fmt::Debug for DistributedElements<C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("DistributedElements")
            .field("owned", &self.layout.owned)
            .field("terms", &self.elements.len())
            .finish_non_exhaustive()
    }
}

impl<const C: usize> From<DistributedMatrix<C>> for DistributedElements<C> {
    fn from(matrix: DistributedMatrix<C>) -> Self {
        let layout = Arc::clone(&matrix.layout);
        Self::of(layout, Arc::default(), Vec::new(), Some(matrix))
    }
}

impl<const C: usize> DistributedElements<C> {
    pub(crate) fn new(
        layout: Arc<Layout>,
        numbering: Numbering,
        stiffness: ElementStiffness<C>,
    ) -> Self {
        Self::of(layout, Arc::new(numbering), vec![(1.0, stiffness)], None)
    }

    fn of(
        layout: Arc<Layout>,
        numbering: Arc<Numbering>,
        elements: Vec<(f64, ElementStiffness<C>)>,
        matrix: Option<DistributedMatrix<C>>,
    ) -> Self {
        Self {
            layout,
            numbering,
            elements,
            unknowns: None,
            matrix,
            room: Mutex::default(),
        }
    }

    /// The sum as a matrix, if there is no term by elements.
    pub(crate) fn matrix(&self) -> Option<&DistributedMatrix<C>> {
        self.matrix.as_ref().filter(|_| self.elements.is_empty())
    }

    /// Shows the forces of the cells at the owned vertices due to a field there, and to what `fill` makes of the ghosts.
    fn with_forces<T>(
        &self,
        x: &[SVector<f64, C>],
        fill: impl FnOnce(&mut [SVector<f64, C>]),
        use_them: impl FnOnce(&[SVector<f64, C>]) -> T,
    ) -> T {
        let mut room = self.room.lock().unwrap_or_else(PoisonError::into_inner);
        let Room {
            field,
            local: [moved, pulled],
            forces,
        } = &mut *room;
        let Numbering { owned, numbers } = &*self.numbering;
        field.clear();
        field.extend_from_slice(x);
        if let Some(unknowns) = &self.unknowns {
            unknowns.basis.field_to_coordinates(field);
        }
        field.resize(x.len() + self.layout.ghosts.len(), SVector::zeros());
        fill(field);
        moved.clear();
        moved.extend(numbers.iter().map(|&number| field[number as usize]));
        pulled.clear();
        pulled.resize(numbers.len(), SVector::zeros());
        for (factor, stiffness) in &self.elements {
            stiffness.multiply_add(*factor, moved, pulled);
        }
        forces.clear();
        forces.extend(owned.iter().map(|&vertex| pulled[vertex as usize]));
        if let Some(unknowns) = &self.unknowns {
            unknowns.basis.forces_to_basis(forces);
        }
        use_them(forces)
    }

    /// The block of two owned vertices in the stiffness of the mesh.
    fn block(&self, [row, column]: [usize; 2]) -> SMatrix<f64, C, C> {
        let (row, column) = (self.numbering.owned[row], self.numbering.owned[column]);
        let mut block = SMatrix::<f64, C, C>::zeros();
        for c in 0..C {
            let unit = |p: usize| {
                let own = p == column as usize;
                SVector::from_fn(|r, _| f64::from(u8::from(own && r == c)))
            };
            let terms = self.elements.iter();
            let force: SVector<f64, C> = terms
                .map(|(factor, stiffness)| stiffness.product_with(row as usize, unit) * *factor)
                .sum();
            block.set_column(c, &force);
        }
        block
    }
}
