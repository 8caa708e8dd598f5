//! Both globs in one program: no name means two things.

use stickslip::fem::*;
use stickslip::*;

use crate::Outcome;

/// A strip by an explicit scheme: the names that both crates have.
#[test]
fn names_are_unambiguous_under_both_globs() -> Outcome {
    let space = P1::new(Mesh::<2>::grid([4.0, 1.0], [4, 1], GridDiagonal::Rising)?);
    let base = space.trace(|x| x[1] == 0.0)?;
    let stiffness: BlockMatrix<1> = antiplane(&space, 4.0)?.into_matrix();
    let scene = Scene::new(stiffness)
        .on(&space)
        .with_mass(lumped_mass(&space, 1.0)?)
        .fix(&base, Components::ALL);
    let mut strip = Simulation::new(scene, CentralDifferences, Diagonal::new())?;
    strip.step(1e-3)?;
    assert_eq!(strip.snapshot().max_slip_rate(), 0.0);
    Ok(())
}
