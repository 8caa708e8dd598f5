//! A block under Coulomb's friction whose minimiser sticks at every other frictional vertex.

use std::f64::consts::TAU;

use nalgebra::SVector;
use stickslip_fem::FemError;
use stickslip_friction::{Radial, Tresca};
use stickslip_solvers::{BlockMatrix, Energy, Matrix};

use super::{Numbers, Problem, Regime, block};

pub(crate) struct Coulomb {
    /// Its minimiser and load are those of Coulomb's friction, its potentials are not.
    pub(crate) problem: Problem<3>,
    potentials: Vec<Radial<Tresca>>,
}

impl Coulomb {
    /// Friction that balances what slides, and forces inside the cone on what sticks.
    pub(crate) fn block(level: usize, seed: u64) -> Result<Self, FemError> {
        let law = Tresca { coefficient: 0.6 };
        let mut problem = block(level, Regime::Slip, seed)?;
        let mut numbers = Numbers(seed ^ 1);
        for &p in problem.vertices.iter().step_by(2) {
            problem.exact[p].fill(0.0);
        }
        let mut load = vec![SVector::zeros(); problem.exact.len()];
        problem
            .operator
            .multiply_add(1.0, &problem.exact, &mut load);
        let potentials: Vec<_> = (problem.potentials.iter())
            .map(|radial| Radial {
                law,
                force: radial.force,
                state: (),
            })
            .collect();
        for (potential, &p) in potentials.iter().zip(&problem.vertices) {
            let v = problem.exact[p];
            if v.norm() > 0.0 {
                load[p] += v.normalize() * (0.6 * potential.force);
            } else {
                let angle = numbers.between(0.0, TAU);
                let inside = numbers.between(0.0, 0.59) * potential.force;
                load[p] += SVector::from([angle.cos(), angle.sin(), 0.0]) * inside;
            }
        }
        problem.load = load;
        Ok(Self {
            problem,
            potentials,
        })
    }

    pub(crate) fn energy(&self) -> Energy<'_, BlockMatrix<3>, 3> {
        Energy {
            operator: &self.problem.operator,
            load: &self.problem.load,
            potentials: &self.potentials,
            vertices: &self.problem.vertices,
            fixed: &self.problem.fixed,
        }
    }

    /// The vertices that stick.
    pub(crate) fn sticking(&self) -> impl Iterator<Item = usize> {
        self.problem.vertices.iter().copied().step_by(2)
    }
}
