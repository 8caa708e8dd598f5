//! Balance of the initial slip rates with stresses and states.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::modulus;
use stickslip_solvers::Potentials;

use super::constraints::Constraints;
use crate::body::Matrices;
use crate::contact::ContactSet;
use crate::numerics::NUMERICS;
use crate::scene::{Initial, Loads};
use crate::{SceneError, StepState};

/// Compares the given slip rates of a scene without inertia with those at which friction and viscosity balance load and
/// stiffness, vertex by vertex. It refuses differing rates, or replaces them if requested. Rest is compatible with any
/// stress. Where neither friction nor viscosity depends on the rate, any rate is.
pub(crate) fn balance_rates<const C: usize>(
    (matrices, initial): (&dyn Matrices<C>, &Initial<C>),
    constraints: &Constraints<C>,
    loads: &Loads<C>,
    contacts: &mut ContactSet<C>,
    state: &mut StepState<C>,
) -> Result<(), SceneError> {
    let balances = initial.balanced;
    let moves = !initial.velocity.is_empty();
    if matrices.has_mass() || !(moves || balances) {
        return Ok(());
    }
    let (time, size) = (state.clock.time(), state.velocity.len());
    contacts.use_states(time, state)?;
    contacts.prescribe(&constraints.fixed, &state.velocity);
    let mut drive = vec![SVector::zeros(); size];
    loads.fill(time, &mut drive, &mut loads.scratch(size));
    contacts.add_tractions(&mut drive);
    (matrices.stiffness()).multiply_add(-1.0, &state.displacement, &mut drive);
    let viscosity = matrices.viscosity();
    for (k, &vertex) in contacts.vertices.iter().enumerate() {
        let fixed = &constraints.fixed[vertex];
        if viscosity.is_none() && !contacts.reads_rate(k) || fixed.contains(&true) && C == 1 {
            continue;
        }
        let block = viscosity.map_or(SMatrix::zeros(), |own| own.diagonal_block(vertex));
        let free = |field: &SVector<f64, C>| {
            let slip = contacts.slip_velocity(k, field);
            SVector::<f64, C>::from_fn(|c, _| if fixed[c] { 0.0 } else { slip[c] })
        };
        let (pull, given) = (free(&drive[vertex]), free(&state.velocity[vertex]));
        let implied = contacts.minimize(k, &decoupled(&block, fixed), &pull);
        let rates = [modulus(&given), modulus(&free(&implied))];
        if balances {
            for c in (0..C).filter(|&c| !fixed[c]) {
                state.velocity[vertex][c] = implied[c];
            }
        } else if rates[0] > 0.0
            && !(rates[1] * NUMERICS.resolved_ratio >= rates[0]
                && rates[1] <= NUMERICS.resolved_ratio * rates[0])
        {
            let force = contacts.friction(k, rates[0]) + modulus(&(block * given));
            let area: f64 = contacts
                .shares_of(k)
                .map(|(contact, k)| contact.part.weights[k])
                .sum();
            return Err(SceneError::Unbalanced {
                vertex,
                slip_rate: rates[0],
                missing: (force - modulus(&pull)) / area,
            });
        }
    }
    Ok(())
}

/// A block with identity rows and columns at Dirichlet components.
fn decoupled<const C: usize>(block: &SMatrix<f64, C, C>, fixed: &[bool; C]) -> SMatrix<f64, C, C> {
    SMatrix::from_fn(|r, c| match (fixed[r] || fixed[c], r == c) {
        (false, _) => block[(r, c)],
        (true, diagonal) => f64::from(u8::from(diagonal)),
    })
}
