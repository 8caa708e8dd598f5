//! Data that depend on the fixed components and the frictional vertices of a dense operator: numbering, memory.

use nalgebra::SVector;

use super::elimination::{Elimination, split};
use super::kernels::quadratic;
use super::matrix::DenseMatrix;
use super::{DenseOperator, Unknowns, Workspace};
use crate::{Matrix, SolveError};

/// The problem on the unknowns of Newton's method, and the transfers between them and the body.
#[derive(Debug)]
pub(super) struct Problem<const C: usize> {
    /// The fixed components of the body it is made for.
    pub(super) body_fixed: Vec<[bool; C]>,
    pub(super) body_vertices: Vec<usize>,
    eliminating: bool,
    /// The vertices of the body with unknowns of Newton's method.
    pub(super) moves: Vec<usize>,
    /// The positions of the frictional vertices among these.
    pub(super) places: Vec<usize>,
    pub(super) fixed: Vec<[bool; C]>,
    /// The vertex and the component of each unknown in the body.
    owners: Vec<(usize, usize)>,
    /// The fixed components of the body.
    prescribed: Vec<(usize, usize)>,
    /// The elimination of all other unknowns; `None` if the operator is not definite on them, and all stay unknowns.
    pub(super) elimination: Option<Elimination<C>>,
    /// `S` on the unknowns.
    pub(super) matrix: DenseMatrix,
    pub(super) work: Workspace<C>,
    pub(super) y: Vec<SVector<f64, C>>,
    /// The load minus the forces of prescribed components.
    left: Vec<SVector<f64, C>>,
    /// `E^T N E` by columns, if changes are measured with it.
    gram: Vec<f64>,
    pub(super) measured: bool,
    /// A change of the body.
    pub(super) field: Vec<SVector<f64, C>>,
    /// A change of the unknowns.
    values: Vec<f64>,
    /// The forces of the condensed load on the unknowns.
    condensed: Vec<f64>,
}

impl<const C: usize> Problem<C> {
    /// The problem with all but the frictional vertices eliminated, or none.
    pub(super) fn new(
        fixed: &[[bool; C]],
        vertices: &[usize],
        eliminating: bool,
    ) -> Result<Self, SolveError> {
        let (unknowns, eliminated) = split(fixed, vertices);
        let (moves, places, unknowns, eliminated) = if eliminating {
            let places = (0..vertices.len()).collect();
            (vertices.to_vec(), places, unknowns, eliminated)
        } else {
            let all = (0..fixed.len()).collect();
            (all, vertices.to_vec(), Unknowns::of_free(fixed), Vec::new())
        };
        let (count, size) = (unknowns.count(), fixed.len());
        let failure = || SolveError::Analysis {
            what: "operator",
            unknowns: count,
            entries: count * count,
        };
        let owner = |i: usize| {
            let (p, c) = unknowns.owner(i);
            (moves[p], c)
        };
        let components = (0..size).flat_map(|p| (0..C).map(move |c| (p, c)));
        let elimination = match eliminated.len() {
            0 => None,
            _ => Some(Elimination::new(eliminated, count).ok_or_else(failure)?),
        };
        Ok(Self {
            body_fixed: fixed.to_vec(),
            body_vertices: vertices.to_vec(),
            eliminating,
            owners: (0..count).map(owner).collect(),
            prescribed: components.filter(|&(p, c)| fixed[p][c]).collect(),
            fixed: moves.iter().map(|&p| fixed[p]).collect(),
            elimination,
            matrix: DenseMatrix::new(count),
            y: vec![SVector::zeros(); moves.len()],
            left: vec![SVector::zeros(); size],
            gram: Vec::new(),
            measured: false,
            field: vec![SVector::zeros(); size],
            values: vec![0.0; count],
            condensed: vec![0.0; count],
            work: Workspace::new(unknowns, vertices.len()).ok_or_else(failure)?,
            moves,
            places,
        })
    }

    /// Whether the frictional vertices alone are unknowns.
    pub(super) fn is_eliminating(&self) -> bool {
        self.eliminating
    }

    /// Takes the entries of an operator; false if it is not definite on the eliminated unknowns.
    pub(super) fn take<Op: DenseOperator<C>>(&mut self, operator: &Op) -> bool {
        self.measured = false;
        let count = self.owners.len();
        let (owners, elimination) = (&self.owners, &mut self.elimination);
        self.matrix.write(|columns| {
            for (j, &column) in owners.iter().enumerate() {
                for (i, &row) in owners.iter().enumerate() {
                    columns[j * count + i] = operator.at(row, column);
                }
            }
            match elimination {
                None => true,
                Some(elimination) => elimination.eliminate(operator, owners, columns),
            }
        })
    }

    /// Condenses a load; `None` where it is not finite.
    pub(super) fn condense<Op: DenseOperator<C>>(
        &mut self,
        operator: &Op,
        load: &[SVector<f64, C>],
        v: &[SVector<f64, C>],
    ) -> Option<()> {
        let left = &mut self.left;
        left.copy_from_slice(load);
        for &(q, d) in &self.prescribed {
            if v[q][d] != 0.0 {
                for (p, left) in left.iter_mut().enumerate() {
                    for c in (0..C).filter(|&c| !self.body_fixed[p][c]) {
                        left[c] -= operator.at((p, c), (q, d)) * v[q][d];
                    }
                }
            }
        }
        let spoiled: f64 = left.iter().flatten().map(|left| 0.0 * left).sum();
        for (force, &(p, c)) in self.condensed.iter_mut().zip(&self.owners) {
            *force = left[p][c];
        }
        if let Some(elimination) = &mut self.elimination {
            elimination.forward(|(p, c)| left[p][c], &mut self.condensed);
        }
        self.work.force.copy_from_slice(&self.condensed);
        (spoiled == 0.0).then_some(())
    }

    /// Prepares to measure changes by the unknowns alone, once per operator.
    pub(super) fn measure<Op: DenseOperator<C>>(&mut self, norm: &Op) {
        if self.measured {
            return;
        }
        self.measured = true;
        let count = self.owners.len();
        self.gram.resize(count * count, 0.0);
        for (j, &column) in self.owners.iter().enumerate() {
            for (i, &row) in self.owners.iter().enumerate() {
                self.gram[j * count + i] = norm.at(row, column);
            }
        }
        if let Some(elimination) = &self.elimination {
            elimination.congruence(norm, &self.owners, &mut self.gram);
        }
    }

    /// The parts of Newton's method: its matrix, the frictional vertices, the start and the norm of a change.
    #[expect(clippy::type_complexity, reason = "parts that are used side by side")]
    pub(super) fn parts<'a, Op: DenseOperator<C>>(
        &'a mut self,
        norm: &'a Op,
        unknowns: &'a Unknowns<C>,
        measured: bool,
    ) -> (
        &'a mut Workspace<C>,
        &'a DenseMatrix,
        (&'a [usize], &'a [[bool; C]]),
        &'a mut [SVector<f64, C>],
        Measure<'a, Op, C>,
    ) {
        let measure = Measure {
            norm,
            gram: measured.then_some(&*self.gram),
            elimination: self.elimination.as_mut(),
            unknowns,
            moves: &self.moves,
            values: &mut self.values,
            field: &mut self.field,
        };
        let friction = (&*self.places, &*self.fixed);
        (&mut self.work, &self.matrix, friction, &mut self.y, measure)
    }

    /// Gathers the unknown velocities from those of the body.
    pub(super) fn gather(&mut self, v: &[SVector<f64, C>]) {
        for (y, &vertex) in self.y.iter_mut().zip(&self.moves) {
            *y = v[vertex];
        }
    }

    /// Scatters the unknown velocities to the body.
    pub(super) fn scatter(&self, v: &mut [SVector<f64, C>]) {
        for (y, &vertex) in self.y.iter().zip(&self.moves) {
            v[vertex] = *y;
        }
    }

    /// Extends the unknowns in `v` to the body; `None` if the result is not finite.
    pub(super) fn extend(&mut self, v: &mut [SVector<f64, C>]) -> Option<()> {
        self.gather(v);
        let Some(elimination) = &mut self.elimination else {
            return Some(());
        };
        let (unknowns, y) = (&self.work.unknowns, &self.y);
        self.field.copy_from_slice(v);
        elimination.backward(true, |j| unknowns.value(y, j), &mut self.field);
        let spoiled: f64 = self.field.iter().flatten().map(|v| 0.0 * v).sum();
        (spoiled == 0.0).then(|| v.copy_from_slice(&self.field))
    }
}

/// The norm of a change of the body that follows a change of the unknowns.
pub(super) struct Measure<'a, Op, const C: usize> {
    pub(super) norm: &'a Op,
    /// `E^T N E`, if it is known.
    pub(super) gram: Option<&'a [f64]>,
    pub(super) elimination: Option<&'a mut Elimination<C>>,
    pub(super) unknowns: &'a Unknowns<C>,
    pub(super) moves: &'a [usize],
    pub(super) values: &'a mut [f64],
    pub(super) field: &'a mut [SVector<f64, C>],
}

impl<Op: DenseOperator<C>, const C: usize> Measure<'_, Op, C> {
    pub(super) fn of(&mut self, change: &[SVector<f64, C>]) -> f64 {
        if let Some(gram) = self.gram {
            for (value, &(p, c)) in self.values.iter_mut().zip(self.unknowns.owners()) {
                *value = change[p as usize][c as usize];
            }
            let square = quadratic(gram, self.values);
            return if square < 0.0 { 0.0 } else { square.sqrt() };
        }
        self.field.fill(SVector::zeros());
        for (change, &vertex) in change.iter().zip(self.moves) {
            self.field[vertex] = *change;
        }
        if let Some(elimination) = &mut self.elimination {
            elimination.backward(false, |j| self.unknowns.value(change, j), self.field);
        }
        Matrix::norm(self.norm, self.field)
    }
}
