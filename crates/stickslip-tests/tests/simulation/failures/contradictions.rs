//! Parts that say different things of one component are both named; what agrees is no
//! contradiction.

use stickslip::fem::{P1, Trace};
use stickslip::problems::pipping_slider::PippingSlider;
use stickslip::{
    BlockMatrix, BoundaryCondition, Components, Contact, Newmark, Scene, SceneError, Simulation,
    Tnnmg,
};

use super::{COULOMB, body_error};
use crate::Outcome;
use crate::common::body;

type Body = Scene<BlockMatrix<2>, 2>;

/// The paper's body without contact, its left side and the vertex where that meets the moved top.
fn with_side() -> Outcome<(P1<2>, Body, Trace<2>, usize)> {
    let paper = body(1);
    let space = paper.space()?;
    let scene = paper.scene(&space)?;
    let side = space.trace(|x| x[0] == 0.0)?;
    let corner = space.vertex_at([0.0, 1.0]).ok_or("no corner")?;
    Ok((space, scene, side, corner))
}

/// The body's top is moved; a part that meets it there is the second to speak.
#[test]
fn contradicting_prescriptions_are_named_with_both_places() -> Outcome {
    let still = |_: f64| [0.0; 2];
    let expect = |scene: Body, component, second| -> Outcome {
        let vertex = with_side()?.3;
        let error = body_error(scene)?;
        let expected = SceneError::Contradiction {
            vertex,
            component,
            first: BoundaryCondition::Prescribed(1),
            second,
        };
        assert_eq!(error, expected);
        let text = error.to_string();
        assert!(text.contains("driven part 1"), "{text}");
        assert!(text.contains(&second.to_string()), "{text}");
        Ok(())
    };
    let (_, scene, side, _) = with_side()?;
    expect(
        scene.fix(&side, Components::ALL),
        0,
        BoundaryCondition::Fixed(1),
    )?;
    let (_, scene, side, _) = with_side()?;
    expect(
        scene.fix(&side, Components::Y),
        1,
        BoundaryCondition::Fixed(1),
    )?;
    let (_, scene, side, _) = with_side()?;
    expect(
        scene.prescribe_velocity(&side, Components::X, still),
        0,
        BoundaryCondition::Prescribed(2),
    )?;
    // Even where they say the same: velocities in time cannot be compared.
    let (space, scene, ..) = with_side()?;
    let top = PippingSlider::top(&space)?;
    let first = top.vertices()[0];
    let again = scene.prescribe_velocity(&top, Components::Y, still);
    let SceneError::Contradiction { vertex, second, .. } = body_error(again)? else {
        return Err("not a contradiction".into());
    };
    assert_eq!((vertex, second), (first, BoundaryCondition::Prescribed(2)));
    // Parts of one kind are counted in the order in which they were given.
    let (space, scene, side, _) = with_side()?;
    let other = space.trace(|x| x[0] == 5.0 && x[1] < 1.0)?;
    let scene = scene.fix(&other, Components::X).fix(&side, Components::X);
    expect(scene, 0, BoundaryCondition::Fixed(2))
}

/// Held twice is held; and what no two parts say of one component does not contradict.
#[test]
fn prescriptions_that_agree_are_no_contradiction() -> Outcome {
    let (space, scene, side, corner) = with_side()?;
    let lower = space.trace(|x| x[0] == 0.0 && x[1] < 1.0)?;
    let scene = scene
        .fix(&lower, Components::ALL)
        .fix(&lower, Components::X)
        .fix(&side, Components::NONE);
    let solver = Tnnmg::new(space.transfers());
    let mut body = Simulation::new(scene, Newmark::default(), solver)?;
    body.step(1e-3)?;
    let at = body.snapshot();
    assert!(
        lower
            .vertices()
            .iter()
            .all(|&p| at.velocity[p].norm() == 0.0)
    );
    assert!(at.velocity[corner][0] > 0.0);
    Ok(())
}

/// The bottom cannot be free in its normal direction in one contact and closed in another.
#[test]
fn a_normal_that_is_free_and_closed_is_named_with_both_contacts() -> Outcome {
    let (space, scene, ..) = with_side()?;
    let bottom = PippingSlider::bottom(&space)?;
    let contact = || Contact::new(&bottom, COULOMB, 1e5);
    let error = body_error(
        scene
            .with_contact(contact())
            .with_contact(contact().with_free_normal()),
    )?;
    let expected = SceneError::Contradiction {
        vertex: bottom.vertices()[0],
        component: 1,
        first: BoundaryCondition::Contact(1),
        second: BoundaryCondition::Contact(2),
    };
    assert_eq!(error, expected);
    let text = error.to_string();
    assert!(
        text.contains("contact 1") && text.contains("contact 2"),
        "{text}"
    );
    // The other way round the same two disagree.
    let (_, scene, ..) = with_side()?;
    let error = body_error(
        scene
            .with_contact(contact().with_free_normal())
            .with_contact(contact()),
    )?;
    let SceneError::Contradiction { first, second, .. } = error else {
        return Err(error.into());
    };
    let mut roles = [first, second].map(|role| role.to_string());
    roles.sort();
    assert_eq!(roles, ["contact 1", "contact 2"]);
    Ok(())
}
