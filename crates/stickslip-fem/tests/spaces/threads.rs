//! The same bits on any number of threads.

use stickslip_fem::{Assembled, Elastic, FemError, P1, elasticity_by_cell, mass};

/// Two operators of a body of some ten thousand vertices, whose stiffness varies.
fn operators<const D: usize>(space: &P1<D>) -> Result<(Assembled<D>, Assembled<1>), FemError> {
    assert!(space.vertex_count() > 15_000);
    let stiffness = elasticity_by_cell(space, |x, cell| Elastic {
        young_modulus: 1e10 * (1.0 + x[0]) + cell as f64,
        poisson_ratio: 0.3,
    })?;
    Ok((stiffness, mass(space, 2.7e3)?))
}

fn are_the_same<const D: usize>(cells: usize, refinements: usize) -> Result<(), FemError> {
    let space = P1::<D>::grid([1.0; D], [cells; D])?.refined(refinements)?;
    let inside = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads");
        pool.install(|| operators(&space))
    };
    let alone = inside(1)?;
    assert!(alone == inside(2)? && alone == inside(3)?);
    // From outside, in the pool that there is for all.
    assert!(alone == operators(&space)?);
    Ok(())
}

#[test]
fn the_bits_of_operators_do_not_depend_on_the_threads() -> Result<(), FemError> {
    are_the_same::<2>(1, 7)?;
    are_the_same::<3>(3, 3)
}
