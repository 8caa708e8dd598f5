//! A checked scene with its contacts and boundary data placed, for any time stepper.

mod axes;
mod change_basis;
mod coincident;
mod connect;
mod connected;
mod constraints;
mod contacts;
mod equilibrium;
mod identify;
mod partners;
mod start;

pub(crate) use connect::Parts;
#[cfg(feature = "condensed")]
pub(crate) use connect::connect;
pub(crate) use connected::Connected;
pub(crate) use constraints::Constraints;
#[cfg(feature = "condensed")]
pub(crate) use contacts::place_normals;

use change_basis::change_basis;
use equilibrium::equilibrium;
use start::balance_rates;

use std::iter::once;

use nalgebra::SVector;
use stickslip_solvers::{Basis, MOST_LEVELS};

use crate::body::Matrices;
use crate::contact::ContactSet;
use crate::numerics::NUMERICS;
use crate::scene::{
    Conditions, Loads, check_conditions, check_matrices, common_mesh, or_zeros, same_mesh,
};
use crate::sums::largest;
use crate::{Clock, ContactState, ControlState, SceneError, StepReport, StepState};

/// The conditions of a checked scene on its vertices, and its initial state.
pub(crate) struct Placement<const C: usize> {
    pub(crate) loads: Loads<C>,
    pub(crate) constraints: Constraints<C>,
    pub(crate) contacts: ContactSet<C>,
    pub(crate) basis: Basis<C>,
    /// The initial state, with the normal stress of its time in force.
    pub(crate) state: StepState<C>,
}

/// Checks operators and fields, finds the mesh that all parts share, and adds the viscosities. Contacts and boundary
/// data are checked when they are placed.
pub(crate) fn check<const C: usize>(
    matrices: &mut dyn Matrices<C>,
    scene: &mut Conditions<C>,
) -> Result<(), SceneError> {
    if let Some(wrong) = &scene.wrong {
        return Err(wrong.clone());
    }
    let viscosities = (0..).map_while(|number| matrices.viscosity_at(number));
    let size = check_matrices(matrices.stiffness(), matrices.mass(), viscosities)?;
    check_conditions(scene, (size, matrices.has_mass()))?;
    scene.mesh = common_mesh(scene)?;
    // Parts of other meshes may lie at one place.
    scene.check_walls()?;
    matrices.sum_viscosities();
    Ok(())
}

impl<const C: usize> Placement<C> {
    /// Places contacts and boundary data of a [checked](check) scene.
    pub(crate) fn new(
        matrices: &mut dyn Matrices<C>,
        mut scene: Conditions<C>,
    ) -> Result<Self, SceneError> {
        let size = matrices.stiffness().vertex_count();
        let ranks = matrices.stiffness().ranks();
        let stiffness = |i| matrices.stiffness().diagonal_block(i).trace();
        let parts = Parts {
            contacts: &mut scene.contacts,
            prescribed: &mut scene.prescribed,
            periodic: &scene.periodic,
        };
        let Connected {
            axes,
            basis,
            mut constraints,
        } = Connected::new(parts, size, ranks.are_several(), stiffness)?;
        change_basis(matrices, &mut scene, &basis)?;
        let given = std::mem::take(&mut scene.contacts);
        let mut contacts = contacts::place(given, &axes, &mut constraints)?;
        constraints.finish();
        check_local_steps(matrices, &contacts, &scene.initial.acceleration)?;
        let loads = Loads::new(std::mem::take(&mut scene.loads), &basis);
        let time = scene.initial.time;
        if scene.clamping.is_some() && ranks.any(!basis.is_empty()) {
            return Err(SceneError::unsupported(
                "Scene::with_normal_stress_change",
                "surfaces along the axes, and no contact between two sides of the body",
            ));
        }
        contacts.clamped_by(scene.clamping.take());
        if ranks.are_several() && contacts.have_fields() {
            return Err(SceneError::unsupported(
                "Contact::with_field",
                "one process",
            ));
        }
        let given = or_zeros(&scene.initial.displacement, size);
        contacts.set_normal_stress(time, &given)?;
        let displacement = if matrices.starts_in_equilibrium() {
            same_mesh(scene.mesh, matrices.mesh_of_equilibrium())?;
            equilibrium(matrices, &constraints.fixed, (&loads, &contacts), time)?
        } else {
            given
        };
        if ranks.any(contacts.follow_body()) {
            let mut forces = vec![SVector::zeros(); size];
            loads.fill(time, &mut forces, &mut loads.scratch(size));
            contacts.add_tractions(&mut forces);
            let stiffness = matrices.stiffness();
            stiffness.multiply_add(-1.0, &displacement, &mut forces);
            let size = |field: &[SVector<f64, C>]| largest(field.iter().map(SVector::amax));
            let moved = size(&displacement);
            contacts.start_from_body(
                |vertex| forces[vertex],
                |vertex| {
                    let block = stiffness.diagonal_block(vertex);
                    NUMERICS.rounding * block.diagonal().max() * moved
                },
            )?;
        }
        contacts.set_normal_stress(time, &displacement)?;
        let mut velocity = or_zeros(&scene.initial.velocity, size);
        constraints.prescribe(time, &mut velocity)?;
        let mut state = StepState {
            clock: Clock::starting_at(time),
            contacts: contacts_at_rest(&contacts, &displacement),
            displacement,
            velocity,
            acceleration: if matrices.has_mass() {
                or_zeros(&scene.initial.acceleration, size)
            } else {
                Vec::new()
            },
            algorithmic: Vec::new(),
            last_step: 0.0,
            coupling: [0.0; 4],
            control: ControlState::default(),
            report: StepReport::default(),
        };
        let given = (&*matrices, &scene.initial);
        balance_rates(given, &constraints, &loads, &mut contacts, &mut state)?;
        Ok(Self {
            loads,
            constraints,
            contacts,
            basis,
            state,
        })
    }
}

/// Refuses numbers of levels out of their range, contacts at cells that do not act in every step, and accelerations of a
/// start whose forces do not act alike.
fn check_local_steps<const C: usize>(
    matrices: &dyn Matrices<C>,
    contacts: &ContactSet<C>,
    acceleration: &[SVector<f64, C>],
) -> Result<(), SceneError> {
    let stiffness = matrices.stiffness();
    let viscosities = (0..).map_while(|number| matrices.viscosity_at(number));
    let viscosities = viscosities.map(|viscosity| ("viscosity", viscosity));
    for (what, matrix) in once(("stiffness", stiffness)).chain(viscosities) {
        let levels = matrix.levels();
        if !(1..=MOST_LEVELS).contains(&levels) {
            return Err(SceneError::Levels { what, levels });
        }
    }
    if stiffness.levels() == 1 {
        return Ok(());
    }
    if !acceleration.is_empty() {
        let acceleration = "an initial acceleration";
        return Err(SceneError::unsupported(
            acceleration,
            "a body without local steps",
        ));
    }
    for (index, contact) in contacts.contacts.iter().enumerate() {
        for &vertex in &contact.part.vertices {
            let level = stiffness.level_at(vertex);
            if level > 0 {
                return Err(SceneError::LocalSteps {
                    contact: index,
                    vertex,
                    level,
                });
            }
        }
    }
    Ok(())
}

/// The contacts before the first step.
fn contacts_at_rest<const C: usize>(
    contacts: &ContactSet<C>,
    displacement: &[SVector<f64, C>],
) -> Vec<ContactState<C>> {
    let contacts = contacts.contacts.iter();
    contacts
        .map(|contact| {
            let vertices = &contact.part.vertices;
            let count = |needed: bool| if needed { vertices.len() } else { 0 };
            let has_state = contact.trial.has_state();
            let stateful = count(has_state);
            let remembering = count(has_state || contact.reads_rate);
            // A delayed normal stress starts from that of the body.
            let unrelaxed = (contact.body.as_ref())
                .filter(|body| !body.unrelaxed.is_empty())
                .map_or(Vec::new(), |body| body.trial.clone());
            ContactState {
                states: (0..stateful).map(|k| contact.trial.state(k)).collect(),
                normal_stress: contact.normal_stress.clone(),
                slip: vec![0.0; vertices.len()],
                origin: vertices
                    .iter()
                    .map(|&vertex| displacement[vertex])
                    .collect(),
                earlier: vec![SVector::zeros(); remembering],
                earlier_normal_stress: match &contact.body {
                    None => Vec::new(),
                    Some(_) => contact.normal_stress.clone(),
                },
                relaxed_stress: unrelaxed.clone(),
                body_stress: unrelaxed,
                fields: (contact.fields.as_ref()).map_or(Vec::new(), |own| own.memories()),
                pore_pressure: (contact.fields.as_ref())
                    .map_or(Vec::new(), |own| own.pressure.clone()),
                excess_pressure: (contact.fields.as_ref())
                    .map_or(Vec::new(), |own| own.excess.clone()),
            }
        })
        .collect()
}
