//! Scenes that are no differential equation vertex by vertex.

use nalgebra::{DMatrix, Vector1};
use stickslip::bie::Cells;
use stickslip::friction::Tresca;
use stickslip::state::LogTheta;
use stickslip::{Components, Contact, MeshMismatch, Scene, SceneError};

use super::{AGING, MEDIUM, fault, law, refused, whole};
use crate::Outcome;

#[test]
fn what_is_no_differential_equation_is_refused() -> Outcome {
    let fault = fault()?;
    let (stiffness, damping) = (|| fault.stiffness(), || fault.radiation_damping());
    let friction = || Contact::new(&fault, Tresca { coefficient: 0.6 }, 1e6);
    let sliding = || {
        Scene::new(stiffness())
            .with_contact(friction())
            .with_viscosity(damping())
    };
    assert_eq!(refused(sliding()), None);
    let error = refused(sliding().with_mass(damping()));
    assert!(
        matches!(
            error,
            Some(SceneError::Unsupported {
                by: SceneError::EXPLICIT,
                ..
            })
        ),
        "{error:?}"
    );
    // A viscosity by which cells feel each other, as an operator and as a matrix.
    let error = refused(sliding().with_viscosity(stiffness()));
    assert_eq!(unfit(error), Some((0, "block diagonal")));
    let mut coupled = DMatrix::from(&damping());
    (coupled[(7, 9)], coupled[(9, 7)]) = (1e3, 1e3);
    let scene = Scene::new(DMatrix::from(&stiffness()))
        .with_contact(friction())
        .with_viscosity(coupled);
    assert_eq!(unfit(refused(scene)), Some((7, "block diagonal")));
    // Cells without friction and damping; held ones need neither.
    let section = fault.section([0.0, 10e3])?;
    let requirement = "positive where friction resists no motion or has no slope in the slip rate";
    let coulomb = Contact::new(&section, Tresca { coefficient: 0.6 }, 1e6);
    let error = refused(Scene::new(stiffness()).with_contact(coulomb));
    assert_eq!(unfit(error), Some((0, requirement)));
    let upper = || Contact::new(&section, law(0.01), 1e6).with_state(AGING, LogTheta(10.0));
    let scene = || Scene::new(stiffness()).with_contact(upper());
    assert_eq!(unfit(refused(scene())), Some((20, requirement)));
    assert_eq!(refused(scene().with_viscosity(damping())), None);
    assert_eq!(
        refused(scene().fix(&fault.section([10e3, 20e3])?, Components::ALL)),
        None
    );
    Ok(())
}

/// Parts of another fault, also of one with as many cells.
#[test]
fn cells_of_another_fault_are_refused() -> Outcome {
    let (one, other) = (
        whole(Cells::new([0.0, 1e3], 10)?)?,
        whole(Cells::new([0.0, 2e3], 10)?)?,
    );
    let law = Tresca { coefficient: 0.6 };
    let scene = Scene::new(one.stiffness())
        .with_viscosity(one.radiation_damping())
        .with_contact(Contact::new(&one.section([0.0, 500.0])?, law, 1e6))
        .with_contact(Contact::new(&other.section([1e3, 2e3])?, law, 1e6));
    let error = refused(scene);
    let [expected, found] = [&one, &other].map(|fault| fault.cells().identity());
    assert_eq!(
        error,
        Some(MeshMismatch::new("contact 2", expected, found).into())
    );
    Ok(())
}

/// Cells below a locked part that are held, and move with the plate when they are moved.
#[test]
fn held_and_moved_cells_do_as_they_are_told() -> Outcome {
    let fault = whole(Cells::new([0.0, 1e3], 10)?)?;
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .fix(&fault.section([0.0, 200.0])?, Components::ALL)
        .prescribe_velocity(&fault.section([800.0, 1e3])?, Components::ALL, |time| {
            [1e-3 * time]
        });
    let mut motion = stickslip::RungeKutta::new(scene)?;
    // Some seconds: a shear wave over the cells, and the fault between is a spring.
    motion.run(&stickslip::Steps::adaptive(1e-8).until(20.0), |_| ())?;
    let at = motion.snapshot();
    assert_eq!(
        (at.displacement[0], at.velocity[9]),
        (Vector1::new(0.0), Vector1::new(0.02))
    );
    assert!((at.displacement[9][0] / 0.2 - 1.0).abs() < 1e-9);
    // In balance: what is left of the force is what damping takes.
    let force = fault.stiffness();
    let damping = MEDIUM.shear_modulus / (2.0 * MEDIUM.shear_wave_speed) * 100.0;
    for i in 2..8 {
        let left = -stickslip::Matrix::product_at(&force, i, at.displacement)[0];
        assert!((left - damping * at.velocity[i][0]).abs() < 1e-9 * MEDIUM.shear_modulus * 0.2);
    }
    let pulled = at.reaction(&fault.section([800.0, 1e3])?)?[0];
    assert!(pulled > 0.0);
    Ok(())
}

/// The vertex whose viscosity does not suit, and the beginning of its condition.
fn unfit(error: Option<SceneError>) -> Option<(usize, &'static str)> {
    match error? {
        SceneError::Vertex {
            what: "viscosity",
            vertex,
            requirement,
        } => Some((vertex, requirement.split(',').next()?)),
        _ => None,
    }
}
