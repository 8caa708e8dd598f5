//! What the modes that are left out do when the boundary moves slowly.

use nalgebra::SVector;
use stickslip_tnnmg::{BlockMatrix, Mode, Operator, vibrations};

use super::projector::{Projector, add, inner};
use crate::SceneError;

/// The share that must be left of a field beside those before it to be one of its own.
const OWN: f64 = 1e-6;

/// Adds fields for slow motions of the boundary: the static response to the inertia of `E y`, without what modes make of
/// it, which is what all modes that are left out do together to the second order in the frequency.
///
/// The motions `y` are the vibrations of the body with its interior in equilibrium, up to the angular frequency of the
/// modes. Returns the first one beyond.
pub(super) fn followed<const C: usize>(
    projector: &mut Projector<C>,
    mass: &BlockMatrix<C>,
    (stiffness, inertia): (&[f64], &[f64]),
    up_to: f64,
) -> Result<Option<Vec<f64>>, SceneError> {
    let (frequencies, motions) = vibrations(stiffness, inertia)?;
    let count = frequencies.partition_point(|&frequency| frequency <= up_to);
    let size = mass.rows();
    let mut fields: Vec<Vec<SVector<f64, C>>> = Vec::with_capacity(count);
    let mut forces = vec![SVector::zeros(); size];
    for motion in &motions[..count] {
        let mut coordinates = motion.clone();
        coordinates.resize(projector.size(), 0.0);
        let moved = projector.combine(&coordinates)?;
        forces.fill(SVector::zeros());
        mass.multiply_add(1.0, &moved, &mut forces);
        let mut field = projector.offset(&forces)?;
        let whole = mass.norm(&field);
        // Twice, against rounding.
        for _ in 0..2 {
            for other in &fields {
                forces.fill(SVector::zeros());
                mass.multiply_add(1.0, other, &mut forces);
                let along = inner(&forces, &field);
                add(&mut field, -along, other);
            }
        }
        let own = mass.norm(&field);
        if own > OWN * whole && own > 0.0 {
            field.iter_mut().for_each(|x| *x /= own);
            fields.push(field);
        }
    }
    let columns = |operator: &BlockMatrix<C>| {
        let mut entries = Vec::with_capacity(fields.len() * fields.len());
        let mut image = vec![SVector::zeros(); size];
        for field in &fields {
            image.fill(SVector::zeros());
            operator.multiply_add(1.0, field, &mut image);
            entries.extend(fields.iter().map(|other| inner(other, &image)));
        }
        entries
    };
    let (frequencies, weights) = vibrations(&columns(&projector.stiffness), &columns(mass))?;
    let modes = frequencies
        .iter()
        .zip(&weights)
        .map(|(frequency, weights)| {
            let mut shape = vec![SVector::zeros(); size];
            for (weight, field) in weights.iter().zip(&fields) {
                add(&mut shape, *weight, field);
            }
            Mode {
                angular_frequency: *frequency,
                shape,
            }
        });
    let modes: Vec<_> = modes.collect();
    projector.add_modes(modes);
    Ok(motions.into_iter().nth(count))
}
