//! Whether a step of a body has a single solution, against eigenvalues.

use nalgebra::DMatrix;
use stickslip::fem::{Assembled, P1, antiplane, mass};
use stickslip::problems::pipping_slider::FRICTION;
use stickslip::state::{LogTheta, Ruina};
use stickslip::{Components, Condensed, Contact, Newmark, Scene, Simulation};

use crate::Outcome;

/// The layer as a matrix on its free vertices.
fn dense(terms: &[(f64, &Assembled<1>)], added: &[(usize, f64)], held: &[usize]) -> DMatrix<f64> {
    let size = terms[0].1.rows();
    let mut sum = DMatrix::zeros(size, size);
    for (factor, term) in terms {
        for (p, row) in term.outer_iterator().enumerate() {
            for (q, block) in row.iter() {
                sum[(p, q)] += factor * block[0];
            }
        }
    }
    for &(vertex, slope) in added {
        sum[(vertex, vertex)] += slope;
    }
    sum.remove_rows_at(held).remove_columns_at(held)
}

/// With one law and one state the weakening of a vertex is proportional to its weight.
#[test]
fn a_body_is_convex_where_the_least_eigenvalue_says_so() -> Outcome {
    let space = P1::grid([1.0, 1.0], [6, 3])?;
    let (bottom, top) = (space.trace(|x| x[1] == 0.0)?, space.trace(|x| x[1] == 1.0)?);
    let (stiffness, inertia) = (antiplane(&space, 2e7)?, mass(&space, 5e3)?);
    let scene = Scene::new(stiffness.clone())
        .with_mass(inertia.clone())
        .fix(&top, Components::ALL)
        .with_contact(Contact::new(&bottom, FRICTION, 5e4).with_state(
            Ruina {
                slip_distance: 1e-5,
            },
            LogTheta(5.0),
        ));
    let mut layer = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let (mut convex, mut not) = (0, 0);
    for n in 0..25 {
        let dt = 1e-5 * 1.5_f64.powi(n);
        let found = layer.convexity(dt, 10.0)?;
        let place = bottom.vertices().iter().position(|&p| p == found.vertex);
        let weight = bottom.weights()[place.ok_or("not on the bottom")?];
        let added: Vec<_> = (bottom.vertices().iter().zip(bottom.weights()))
            .map(|(&p, w)| (p, -found.weakening * w / weight))
            .collect();
        let terms = [(2.0 / dt, &inertia), (0.5 * dt, &stiffness)];
        let matrix = dense(&terms, &added, top.vertices());
        let (least, largest) = (matrix.symmetric_eigenvalues().min(), matrix.amax());
        // Within rounding either will do.
        if least.abs() > 1e-9 * largest {
            assert_eq!(found.convex, least > 0.0, "{dt:e}: {least:e}");
        }
        if found.convex {
            convex += 1
        } else {
            not += 1
        }
        assert!(found.weakening <= found.diagonal_stiffness || !found.convex);
    }
    assert!(convex > 3 && not > 3, "{convex}, {not}");
    Ok(())
}
