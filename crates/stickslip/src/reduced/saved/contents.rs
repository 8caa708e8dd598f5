//! The contents of a reduced body's file, and its identification.

use nalgebra::SVector;
use serde::{Deserialize, Serialize};
use stickslip_solvers::{BlockMatrix, MeshId, Symmetric};

use crate::Scene;
use crate::marks::{Fingerprint, Mark};
use crate::reduced::support::Support;

/// The data that are not part of a scene.
#[derive(Serialize, Deserialize)]
pub(super) struct Contents<const C: usize> {
    pub(super) memory_limit: u64,
    pub(super) squares: Vec<f64>,
    pub(super) masses: Vec<f64>,
    pub(super) shapes: Vec<Vec<SVector<f64, C>>>,
    pub(super) next: Option<f64>,
    /// The lower triangles of the operators by rows.
    pub(super) stiffness: Vec<f64>,
    pub(super) mass: Option<Vec<f64>>,
    pub(super) viscosity: Option<Vec<f64>>,
}

/// The lower triangle of a symmetric operator by rows.
pub(super) fn triangle<const C: usize>(operator: &Symmetric<C>) -> Vec<f64> {
    let rows = 0..operator.count();
    rows.flat_map(|row| (0..=row).map(move |column| operator.entry(row, column)))
        .collect()
}

impl<const C: usize> Contents<C> {
    /// Whether the lengths are those of a body with these numbers of vertices, boundary unknowns and driven components.
    pub(super) fn suits(
        &self,
        scene: &Scene<BlockMatrix<C>, C>,
        [size, boundary, handles]: [usize; 3],
    ) -> bool {
        let modes = self.squares.len();
        let Some(rows) = (modes.checked_add(boundary)).and_then(|rows| rows.checked_add(handles))
        else {
            return false;
        };
        let finite = |numbers: &[f64]| numbers.iter().all(|x| x.is_finite());
        let whole = |entries: &Vec<f64>| {
            finite(entries) && Some(entries.len()) == rows.checked_mul(rows + 1).map(|n| n / 2)
        };
        let either = |entries: &Option<Vec<f64>>, present: bool| {
            entries.is_some() == present && entries.iter().all(whole)
        };
        let fits = |shape: &Vec<SVector<f64, C>>| {
            shape.len() == size && shape.iter().all(|x| finite(x.as_slice()))
        };
        let positive = |numbers: &[f64]| numbers.iter().all(|&x| x > 0.0 && x.is_finite());
        positive(&self.squares)
            && positive(&self.masses)
            && self.masses.len() == modes
            && self.shapes.len() == handles + modes
            && self.shapes.iter().all(fits)
            && self.next.is_none_or(|next| next > 0.0)
            && whole(&self.stiffness)
            && either(&self.mass, scene.mass.is_some())
            && either(&self.viscosity, !scene.viscosity.is_empty())
    }
}

/// The marks of a body with `size` vertices: the fingerprints of its mesh and its operators.
pub(super) fn of_body<const C: usize>(
    size: usize,
    mesh: Option<MeshId>,
    operators: u64,
) -> Vec<Mark> {
    let mut fingerprint = Fingerprint::default();
    fingerprint.count("the number of components", C);
    fingerprint.count("the number of vertices", size);
    fingerprint.words("the mesh", mesh.map(|mesh| mesh.fingerprint));
    fingerprint.words("the set of operators", [operators]);
    fingerprint.into_marks()
}

/// The marks of its boundary conditions.
pub(super) fn of_support<const C: usize>(support: &Support<C>) -> Vec<Mark> {
    let mut fingerprint = Fingerprint::default();
    let word = |&flag: &bool| u64::from(flag);
    let numbers = |list: &[usize]| list.iter().map(|&n| n as u64).collect::<Vec<_>>();
    fingerprint.words("the set of kept vertices", numbers(&support.boundary));
    let fixed = support.fixed.iter().flatten().map(word);
    fingerprint.words("the set of prescribed components", fixed);
    let moved = support.moved.iter().zip(&support.reacting);
    let moved = moved.flat_map(|(moved, reacting)| {
        (0..C)
            .map(|c| u64::from(moved[c] || reacting[c]))
            .collect::<Vec<_>>()
    });
    fingerprint.words("the set of moved components", moved);
    fingerprint.count("the number of driven parts", support.parts.len());
    for part in &support.parts {
        let mut words = numbers(&part.part.vertices);
        words.extend(part.components.iter().map(word));
        for position in 0..part.part.vertices.len() {
            for c in 0..C {
                let unit = SVector::from_fn(|row, _| f64::from(u8::from(row == c)));
                let (value, components) = part.at(position, &unit);
                words.extend(value.iter().map(|x| x.to_bits()));
                words.extend(components.iter().map(word));
            }
        }
        fingerprint.words("a driven part", words);
    }
    let frames = support.basis.axes.iter().flat_map(|(vertex, axes)| {
        let axes = axes.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        std::iter::once(vertex as u64).chain(axes)
    });
    fingerprint.words("the set of axes", frames);
    let links = support.basis.links.iter().flat_map(|link| {
        let bases = link.bases.iter().map(|&base| base as u64);
        [
            link.vertex as u64,
            u64::from(link.reversed),
            link.share.to_bits(),
        ]
        .into_iter()
        .chain(bases)
    });
    fingerprint.words("the set of jumps", links);
    fingerprint.into_marks()
}
