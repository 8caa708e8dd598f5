//! The fill of the factor for an order, counted without factorising.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::cholesky::simplicial::{
    prefactorize_symbolic_cholesky, prefactorize_symbolic_cholesky_scratch,
};

use crate::SolveError;
use crate::block_matrix::Graph;

/// The number of blocks in each column of a factor, with the diagonal.
pub(super) struct Fill {
    columns: Vec<usize>,
}

impl Fill {
    /// Counts the factor of a matrix whose vertices are eliminated in an order.
    pub(super) fn of(graph: &Graph<'_>, order: &[u32]) -> Result<Self, SolveError> {
        let size = order.len();
        let mut places = vec![0_usize; size];
        for (place, &vertex) in order.iter().enumerate() {
            places[vertex as usize] = place;
        }
        let (mut starts, mut upper) = (vec![0], Vec::new());
        for (place, &vertex) in order.iter().enumerate() {
            let columns = graph.columns[graph.range(vertex as usize)].iter();
            let above = columns.map(|&other| places[other as usize]);
            upper.extend(above.filter(|&other| other <= place));
            let begin = starts[place];
            upper[begin..].sort_unstable();
            starts.push(upper.len());
        }
        let scratch = prefactorize_symbolic_cholesky_scratch::<usize>(size, upper.len());
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| SolveError::Analysis {
            what: "operator",
            unknowns: size,
            entries: upper.len(),
        })?;
        let (mut tree, mut columns) = (vec![0_isize; size], vec![0; size]);
        prefactorize_symbolic_cholesky(
            &mut tree,
            &mut columns,
            SymbolicSparseColMatRef::new_checked(size, size, &starts, None, &upper),
            MemStack::new(&mut memory),
        );
        Ok(Self { columns })
    }

    /// The blocks that the factor stores.
    pub(super) fn entries(&self) -> usize {
        self.columns.iter().sum()
    }

    /// The number of multiplications of the factorisation, for blocks of `components` rows.
    pub(super) fn multiplications(&self, components: usize) -> f64 {
        let squares = self.columns.iter().map(|&n| (n as f64).powi(2));
        (components as f64).powi(3) * squares.sum::<f64>()
    }
}
