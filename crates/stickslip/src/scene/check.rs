//! Checks of operators and fields before the first step.

use nalgebra::SVector;
use stickslip_core::compiled;
use stickslip_solvers::{Matrix, MeshId, MeshMismatch, Operator, SolveError};

use super::prescribed::conditions_of;
use super::{Conditions, Load, MASS, STIFFNESS, VISCOSITY};
use crate::checks::{finite, require};
use crate::{BoundaryCondition, Scene, SceneError};

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// Refuses a quantity that does not add, if it was given before.
    pub(super) fn repeat(&mut self, what: &'static str, given: bool) {
        if given {
            self.conditions
                .wrong
                .get_or_insert(SceneError::Repeated { what });
        }
    }

    /// Checks matrices and fields; contacts and boundary data are checked when they are placed.
    #[cfg(feature = "condensed")]
    pub(crate) fn check(&self) -> Result<(), SceneError> {
        if let Some(wrong) = &self.conditions.wrong {
            return Err(wrong.clone());
        }
        let mass = self.mass.as_ref().map(|mass| mass as &dyn Matrix<C>);
        let viscosities = self.viscosity.iter().map(|own| own as &dyn Matrix<C>);
        let size = check_matrices(&self.stiffness, mass, viscosities)?;
        check_conditions(&self.conditions, (size, mass.is_some()))
    }
}

/// Checks size, finiteness and the sign of the diagonal of matrices; returns the number of vertices.
pub(crate) fn check_matrices<'a, const C: usize>(
    stiffness: &dyn Matrix<C>,
    mass: Option<&dyn Matrix<C>>,
    viscosities: impl Iterator<Item = &'a dyn Matrix<C>>,
) -> Result<usize, SceneError> {
    let size = stiffness.vertex_count();
    check_operator(STIFFNESS, stiffness, size)?;
    if let Some(mass) = mass {
        check_operator(MASS, mass, size)?;
        check_diagonal(MASS, mass)?;
    }
    for viscosity in viscosities {
        check_operator(VISCOSITY, viscosity, size)?;
        check_diagonal(VISCOSITY, viscosity)?;
    }
    Ok(size)
}

/// Refuses a matrix with infinities or NaN, by its product.
fn check_operator<const C: usize>(
    what: &'static str,
    operator: &dyn Matrix<C>,
    size: usize,
) -> Result<(), SceneError> {
    if operator.vertex_count() != size {
        return Err(SceneError::Length {
            what,
            expected: size,
            found: operator.vertex_count(),
        });
    }
    let mut product = vec![SVector::zeros(); size];
    operator.multiply_add(1.0, &vec![SVector::repeat(1.0); size], &mut product);
    check_field(what, &product, size)
}

/// Refuses a matrix that a negative entry on the diagonal shows to be indefinite.
fn check_diagonal<const C: usize>(
    what: &'static str,
    operator: &dyn Matrix<C>,
) -> Result<(), SceneError> {
    for vertex in 0..operator.vertex_count() {
        let block = operator.diagonal_block(vertex);
        for &value in block.diagonal().iter() {
            require(what, "positive semidefinite", vertex, value, value >= 0.0)?;
        }
    }
    Ok(())
}

/// Checks the fields of a scene of `size` vertices; contacts and boundary data are checked when they are placed.
pub(crate) fn check_conditions<const C: usize>(
    conditions: &Conditions<C>,
    (size, inertia): (usize, bool),
) -> Result<(), SceneError> {
    for load in &conditions.loads {
        if let Load::Constant(load) | Load::Scaled(load, _) = load {
            check_field("load", load, size)?;
        }
    }
    let initial = &conditions.initial;
    for (what, field) in [
        ("initial displacement", &initial.displacement),
        ("initial velocity", &initial.velocity),
        ("initial acceleration", &initial.acceleration),
    ] {
        if !field.is_empty() {
            check_field(what, field, size)?;
        }
    }
    if initial.balanced && inertia {
        let balance = "a balance of the initial slip rates";
        return Err(SceneError::unsupported(balance, "a scene without mass"));
    }
    if !initial.acceleration.is_empty() && !inertia {
        let acceleration = "an initial acceleration";
        return Err(SceneError::unsupported(acceleration, "a scene with mass"));
    }
    finite("initial time", 0, initial.time)
}

/// Refuses what a reduced body does not have: the whole displacement, and forces without an energy.
#[cfg(feature = "condensed")]
pub(crate) fn check_reducible<const C: usize>(scene: &Conditions<C>) -> Result<(), SceneError> {
    if let Some(asymmetric) = &scene.asymmetric {
        return Err(asymmetric.clone());
    }
    if scene.clamping.is_some() {
        return Err(SceneError::unsupported(
            SceneError::REDUCTION,
            "normal stresses that do not follow the displacement of the body",
        ));
    }
    Ok(())
}

/// The share of the trace by which two products of a symmetric matrix can differ; rounding is far below it.
const ASYMMETRY: f64 = 1e-8;

/// Checks that a matrix is an operator; [`check_operator`] checks its values for infinities and NaN.
pub(super) fn check_format<const C: usize>(
    what: &'static str,
    matrix: &dyn Matrix<C>,
) -> Result<(), SceneError> {
    let defect = matrix.defect();
    defect.map_or(Ok(()), |defect| Err(SceneError::Matrix { what, defect }))
}

compiled! {
    /// Checks that an operator is symmetric. A matrix that is no operator is not checked.
    pub(super) fn check_symmetry<C>(
        what: &'static str,
        matrix: &dyn Matrix<C>,
    ) -> Result<(), SceneError> {
        if matrix.defect().is_some() {
            return Ok(());
        }
        let size = matrix.vertex_count();
        // Multiples of irrational numbers, without their integers: no pattern that a matrix has.
        let field = |irrational: f64| -> Vec<SVector<f64, C>> {
            let value = |k: usize| ((k + 1) as f64 * irrational).fract() - 0.5;
            let vertices = (0..size).map(|i| SVector::from_fn(|c, _| value(i * C + c)));
            vertices.collect()
        };
        let fields = [0.5_f64.sqrt(), 0.6_f64.sqrt()].map(field);
        let product = |k: usize| {
            let mut image = vec![SVector::zeros(); size];
            matrix.multiply_add(1.0, &fields[k], &mut image);
            let pairs = image.iter().zip(&fields[1 - k]);
            matrix
                .ranks()
                .sum(pairs.map(|(image, field)| image.dot(field)).sum())
        };
        let products = [product(0), product(1)];
        let traces = (0..size).map(|i| matrix.diagonal_block(i).diagonal().abs().sum());
        let trace = matrix.ranks().sum(traces.sum());
        if (products[0] - products[1]).abs() > ASYMMETRY * trace {
            return Err(SceneError::NotSymmetric { what, products });
        }
        Ok(())
    }
}

/// The mesh of all matrices and parts, if one of them or the scene identifies it. For a body without a known mesh, the
/// stiffness matrix identifies it.
pub(crate) fn common_mesh<const C: usize>(
    scene: &Conditions<C>,
) -> Result<Option<MeshId>, SceneError> {
    let prescribed = scene.prescribed.iter().map(|given| &given.part);
    let contacts = scene.contacts.iter().map(|contact| &contact.part);
    let periodic = (1..).map(BoundaryCondition::Periodic).zip(&scene.periodic);
    let periodic = periodic.flat_map(|(role, sides)| sides.each_ref().map(|side| (role, side)));
    let parts = conditions_of(&scene.prescribed)
        .zip(prescribed)
        .chain((1..).map(BoundaryCondition::Contact).zip(contacts))
        .chain(periodic);
    let mut body = scene.mesh;
    for &(what, found) in &scene.assembled {
        MeshMismatch::check(what, body, Some(found))?;
        body = Some(found);
    }
    for (role, part) in parts {
        MeshMismatch::check(role, body, part.mesh)?;
        body = body.or(part.mesh);
    }
    Ok(body)
}

/// Refuses a solver for another mesh, if both meshes are known.
pub(crate) fn same_mesh(expected: Option<MeshId>, found: Option<MeshId>) -> Result<(), SolveError> {
    Ok(MeshMismatch::check("solver", expected, found)?)
}

/// Refuses a field unless it has one finite vector per vertex.
pub(crate) fn check_field<const C: usize>(
    what: &'static str,
    field: &[SVector<f64, C>],
    size: usize,
) -> Result<(), SceneError> {
    if field.len() != size {
        return Err(SceneError::Length {
            what,
            expected: size,
            found: field.len(),
        });
    }
    field
        .iter()
        .enumerate()
        .try_for_each(|(i, value)| value.iter().try_for_each(|&value| finite(what, i, value)))
}

impl SceneError {
    /// The index of a vertex or contact, if it is in range.
    pub(crate) fn check_index(
        what: &'static str,
        index: usize,
        count: usize,
    ) -> Result<usize, Self> {
        if index < count {
            return Ok(index);
        }
        Err(Self::Index { what, index, count })
    }
}
