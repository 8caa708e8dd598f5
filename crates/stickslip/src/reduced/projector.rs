//! The map between the fields of a body and the coordinates of its reduction.

use std::sync::{Mutex, PoisonError};

use nalgebra::SVector;
use stickslip_solvers::{BlockMatrix, Matrix, Mode, SolveError, StaticResponses};

/// The condensed interior of a body.
pub(super) struct Interior<const C: usize> {
    /// The vertices outside the interior, increasing.
    pub(super) boundary: Vec<usize>,
    /// The components that are not unknowns of the interior.
    pub(super) eliminated: Vec<[bool; C]>,
    /// The memory limit of its factor \[byte\].
    pub(super) memory_limit: usize,
}

impl<const C: usize> Interior<C> {
    /// The vertex and the component of each unknown of the boundary.
    pub(super) fn owners(&self) -> Vec<(usize, usize)> {
        let all = (self.boundary.iter()).flat_map(|&vertex| (0..C).map(move |c| (vertex, c)));
        all.filter(|&(vertex, c)| !self.eliminated[vertex][c])
            .collect()
    }

    pub(super) fn factorized(
        &self,
        stiffness: &BlockMatrix<C>,
    ) -> Result<StaticResponses<C>, SolveError> {
        StaticResponses::new(
            stiffness,
            &self.boundary,
            &self.eliminated,
            self.memory_limit,
        )
    }
}

/// Fields of vectors at the vertices.
type Fields<const C: usize> = Vec<Vec<SVector<f64, C>>>;

/// The basis of a reduced body: static responses to its boundary and to its driven parts, and modes. All are in the
/// local frames of the vertices.
pub(super) struct Projector<const C: usize> {
    pub(super) interior: Interior<C>,
    /// The static responses; for a body from a file, none until they are needed.
    responses: Mutex<Option<StaticResponses<C>>>,
    /// The vertex and the component of each boundary unknown.
    pub(super) owners: Vec<(usize, usize)>,
    pub(super) stiffness: BlockMatrix<C>,
    /// Unit displacements of driven parts with the static response of the interior, then modes.
    pub(super) shapes: Fields<C>,
    /// The number of shapes of driven parts.
    pub(super) handles: usize,
    /// `omega^2` of the modes.
    pub(super) squares: Vec<f64>,
    /// `phi . M phi` of the modes. Their largest component is 1, so that an amplitude is in metres and comparable with
    /// slip rates in tests for rest.
    pub(super) masses: Vec<f64>,
}

/// `sum of x . y` over the vertices.
pub(super) fn inner<const C: usize>(x: &[SVector<f64, C>], y: &[SVector<f64, C>]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x.dot(y)).sum()
}

impl<const C: usize> Projector<C> {
    pub(super) fn new(
        interior: Interior<C>,
        responses: Option<StaticResponses<C>>,
        stiffness: BlockMatrix<C>,
        handles: Fields<C>,
    ) -> Self {
        Self {
            owners: interior.owners(),
            interior,
            handles: handles.len(),
            responses: Mutex::new(responses),
            stiffness,
            shapes: handles,
            squares: Vec::new(),
            masses: Vec::new(),
        }
    }

    /// Locks the static responses. A panic elsewhere leaves nothing inconsistent: a substitution overwrites its memory.
    fn responses<T>(
        &self,
        substitute: impl FnOnce(&mut StaticResponses<C>) -> Result<T, SolveError>,
    ) -> Result<T, SolveError> {
        let mut responses = self
            .responses
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        let responses = match &mut *responses {
            Some(there) => there,
            absent => absent.insert(self.interior.factorized(&self.stiffness)?),
        };
        substitute(responses)
    }

    /// The number of boundary unknowns.
    pub(super) fn count(&self) -> usize {
        self.owners.len()
    }

    pub(super) fn add_modes(&mut self, modes: Vec<Mode<C>>) {
        for Mode {
            angular_frequency,
            mut shape,
        } in modes
        {
            let largest = shape.iter().map(|x| x.amax()).fold(0.0, f64::max);
            shape.iter_mut().for_each(|x| *x /= largest);
            self.squares.push(angular_frequency.powi(2));
            self.masses.push(largest.powi(-2));
            self.shapes.push(shape);
        }
    }

    pub(super) fn size(&self) -> usize {
        self.count() + self.shapes.len()
    }

    /// The forces on the coordinates that do the work of given forces on the body.
    pub(super) fn project(
        &self,
        forces: &[SVector<f64, C>],
        onto: &mut [f64],
    ) -> Result<(), SolveError> {
        let (boundary, others) = onto.split_at_mut(self.count());
        self.responses(|responses| responses.project(&self.stiffness, forces, boundary))?;
        for (other, shape) in others.iter_mut().zip(&self.shapes) {
            *other = inner(shape, forces);
        }
        Ok(())
    }

    /// The columns of an operator between the coordinates; those of shapes contain the rows up to their own. `boundary`
    /// are its entries between those of the boundary.
    pub(super) fn reduce(
        &self,
        operator: &BlockMatrix<C>,
        boundary: &[f64],
    ) -> Result<Vec<Vec<f64>>, SolveError> {
        let (mut columns, forces) = self.of_handles(operator, boundary)?;
        let modes = &self.shapes[self.handles..];
        if modes.is_empty() {
            return Ok(columns);
        }
        let between = self.responses(|responses| responses.between(operator, modes))?;
        for (k, shape) in modes.iter().enumerate() {
            let mut column = Vec::with_capacity(self.size());
            column.extend_from_slice(&between.boundary[k * self.count()..][..self.count()]);
            column.extend(forces.iter().map(|forces| inner(shape, forces)));
            column.extend(between.fields.column(k).iter());
            columns.push(column);
        }
        Ok(columns)
    }

    /// The columns of the stiffness, for which modes are orthogonal to one another and to all fields in equilibrium.
    pub(super) fn reduce_stiffness(&self, boundary: &[f64]) -> Result<Vec<Vec<f64>>, SolveError> {
        let (mut columns, _) = self.of_handles(&self.stiffness, boundary)?;
        let first = columns.len();
        for (k, (square, mass)) in self.squares.iter().zip(&self.masses).enumerate() {
            let mut column = vec![0.0; self.size()];
            column[first + k] = square * mass;
            columns.push(column);
        }
        Ok(columns)
    }

    /// The columns of the boundary and of driven parts, and the operator's forces for the latter.
    fn of_handles(
        &self,
        operator: &BlockMatrix<C>,
        boundary: &[f64],
    ) -> Result<(Vec<Vec<f64>>, Fields<C>), SolveError> {
        let mut columns: Vec<Vec<f64>> = (boundary.chunks_exact(self.count().max(1)))
            .map(|column| column.to_vec())
            .collect();
        let mut moved = Vec::with_capacity(self.handles);
        for shape in &self.shapes[..self.handles] {
            let mut forces = vec![SVector::zeros(); self.stiffness.rows()];
            operator.multiply_add(1.0, shape, &mut forces);
            let mut column = vec![0.0; self.size()];
            let (boundary, others) = column.split_at_mut(self.count());
            self.responses(|responses| responses.project(&self.stiffness, &forces, boundary))?;
            for (other, shape) in others.iter_mut().zip(&self.shapes[..self.handles]) {
                *other = inner(shape, &forces);
            }
            columns.push(column);
            moved.push(forces);
        }
        Ok((columns, moved))
    }

    /// The static response of the interior to `forces` beyond the coordinates, with these at rest.
    pub(super) fn offset(
        &self,
        forces: &[SVector<f64, C>],
    ) -> Result<Vec<SVector<f64, C>>, SolveError> {
        let mut field = vec![SVector::zeros(); forces.len()];
        let at_rest = vec![0.0; self.count()];
        self.responses(|responses| {
            responses.extend(&self.stiffness, Some(forces), &at_rest, &mut field)
        })?;
        let modes = &self.shapes[self.handles..];
        for ((shape, square), mass) in modes.iter().zip(&self.squares).zip(&self.masses) {
            let weight = inner(shape, forces) / (square * mass);
            add(&mut field, -weight, shape);
        }
        Ok(field)
    }

    /// The field of the body with these coordinates.
    pub(super) fn combine(&self, coordinates: &[f64]) -> Result<Vec<SVector<f64, C>>, SolveError> {
        let mut field = vec![SVector::zeros(); self.stiffness.rows()];
        let (boundary, others) = coordinates.split_at(self.count());
        self.responses(|responses| responses.extend(&self.stiffness, None, boundary, &mut field))?;
        for (weight, shape) in others.iter().zip(&self.shapes) {
            add(&mut field, *weight, shape);
        }
        Ok(field)
    }
}

/// `field += weight * shape`.
pub(super) fn add<const C: usize>(
    field: &mut [SVector<f64, C>],
    weight: f64,
    shape: &[SVector<f64, C>],
) {
    for (field, shape) in field.iter_mut().zip(shape) {
        *field += shape * weight;
    }
}
