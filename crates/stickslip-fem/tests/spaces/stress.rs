//! Stress by cell against the energy of the stiffness, and what is refused.

use nalgebra::SVector;
use stickslip_fem::{Elastic, FemError, P1, elasticity_by_cell, stress, stress_by_cell};

const ELASTIC: Elastic = Elastic {
    young_modulus: 5e7,
    poisson_ratio: 0.3,
};
use crate::illegal;

/// `sum over the cells of volume sigma : eps = u . A u`, with a material that changes from cell to cell and a
/// displacement that is nothing special; sigma : eps = (sigma : sigma - nu_D (tr sigma)^2) / (2 mu), where
/// `nu_D = lambda / (D lambda + 2 mu)`.
fn stores_the_energy_of_the_stiffness<const D: usize>(space: &P1<D>) {
    let material = |x: &SVector<f64, D>, cell: usize| Elastic {
        young_modulus: 1e7 * (1.0 + x[0]) * (1.0 + (cell % 3) as f64),
        poisson_ratio: 0.1 + 0.3 * x[1],
    };
    let displacement = space.interpolate(|x| {
        SVector::<f64, D>::from_fn(|c, _| (3.0 * x[c] + x[(c + 1) % D]).sin() + x[0] * x[D - 1])
    });
    let stiffness = elasticity_by_cell(space, material).unwrap();
    let mut energy = 0.0;
    for (p, row) in stiffness.outer_iterator().enumerate() {
        let force = row.iter().map(|(q, block)| block * displacement[q]);
        energy += displacement[p].dot(&force.sum::<SVector<f64, D>>());
    }
    let mesh = space.mesh();
    let stored = stress_by_cell(space, material, &displacement)
        .unwrap()
        .iter()
        .enumerate()
        .map(|(index, sigma)| {
            let corners = mesh.cell(index).iter();
            let sum: SVector<f64, D> = corners.map(|&p| mesh.vertices()[p as usize]).sum();
            let (lambda, mu) = material(&(sum / (D + 1) as f64), index).lame().unwrap();
            let share = lambda / (D as f64 * lambda + 2.0 * mu);
            mesh.volume(index) * (sigma.norm_squared() - share * sigma.trace().powi(2)) / (2.0 * mu)
        })
        .sum::<f64>();
    assert!(
        (stored / energy - 1.0).abs() < 1e-12,
        "{stored:e}, {energy:e}"
    );
}

#[test]
fn in_the_plane() {
    stores_the_energy_of_the_stiffness(&P1::grid([1.0, 1.0], [3, 4]).unwrap());
}

#[test]
fn in_space() {
    stores_the_energy_of_the_stiffness(&P1::grid([1.0, 1.0, 1.0], [2, 3, 2]).unwrap());
}

#[test]
fn what_does_not_fit_is_refused() {
    let space = P1::grid([1.0, 1.0], [1, 1]).unwrap();
    let zeros = vec![SVector::<f64, 2>::zeros(); 4];
    let refused = stress(&space, &ELASTIC, &zeros[1..]).err();
    let (expected, found) = (4, 3);
    assert_eq!(
        refused,
        Some(FemError::Length {
            what: "vectors of a field on the mesh",
            expected,
            found
        })
    );
    let bad = Elastic {
        poisson_ratio: 0.5,
        ..ELASTIC
    };
    let refused = stress(&space, &bad, &zeros).err();
    assert_eq!(
        refused,
        Some(illegal("Poisson\'s ratio", "above -1 and below 1/2", 0.5))
    );
    let refused = stress_by_cell(&space, |_, _| bad, &zeros).err();
    assert!(
        matches!(
            refused,
            Some(FemError::Value {
                what: "Poisson's ratio",
                value: 0.5,
                cell: Some(0),
                ..
            })
        ),
        "{refused:?}"
    );
}
