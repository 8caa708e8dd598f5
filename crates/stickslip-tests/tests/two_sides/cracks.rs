//! A crack under compression, and a fault that does not slip.

use nalgebra::Vector2;
use stickslip::NormalStress;
use stickslip::fem::{FemError, P1};

use crate::{Outcome, largest, square, stressed};

const HALF_LENGTH: f64 = 0.25;

/// The square with a crack in the middle, of cells of a size that grows with the distance from it.
fn cracked(size: f64) -> Outcome<P1<2>> {
    let mesh = square(16)?
        .with_surface_where("crack", |x| x[1] == 0.0 && x[0].abs() <= HALF_LENGTH)?
        .split("crack")?;
    let away = |x: &Vector2<f64>| Vector2::new((x[0].abs() - HALF_LENGTH).max(0.0), x[1]).norm();
    // The longest edges are diagonals.
    Ok(P1::new(mesh).graded(|x| 2_f64.sqrt() * (size + 0.12 * away(x)))?)
}

/// Slip of a crack of half length b in a plane under a uniaxial compression S at the angle psi to the crack, with the
/// coefficient mu: `4 (1 - nu^2)/E S sin psi (cos psi - mu sin psi) sqrt(b^2 - x^2)`; more by .94 (2b/W)^2 of it in a
/// square of the side W. The normal stress is `S sin^2 psi`, since slip on a plane leaves that on the plane.
#[test]
fn a_crack_slips_as_in_the_plane() -> Outcome {
    let coefficient = 0.2;
    for (psi, size, multigrid, tolerance) in [
        (20_f64, 0.008, false, 0.025),
        (30.0, 0.008, true, 0.025),
        (40.0, 0.008, false, 0.025),
        (30.0, 0.004, false, 0.015),
    ] {
        let psi = psi.to_radians();
        let along = Vector2::new(psi.cos(), psi.sin());
        let space = cracked(size)?;
        let stress = -along * along.transpose();
        let from_body = NormalStress::from_body(0.0);
        let mut body = stressed(
            &space,
            stress,
            (&["crack"], coefficient),
            &from_body,
            multigrid,
        )?;
        let report = body.step(1.0)?;
        assert!(report.reaction_iterations <= 4 && report.contraction < 1e-3);
        let at = body.snapshot();
        let crack = at.contact(0);
        let factor = 1.0 + 0.94 * (2.0 * HALF_LENGTH / 4.0_f64).powi(2);
        let slip = factor * 4.0 * (1.0 - 0.25_f64.powi(2));
        let slip = slip * psi.sin() * (psi.cos() - coefficient * psi.sin());
        for k in 0..crack.len() {
            let x = crack.point(k)[0];
            let exact = slip * (HALF_LENGTH * HALF_LENGTH - x * x).sqrt();
            if x == 0.0 {
                let error = (crack.slip(k) / exact - 1.0).abs();
                assert!(error < tolerance, "{} degrees: {error}", psi.to_degrees());
            }
            let pressure = crack.normal_stress(k) / psi.sin().powi(2);
            assert!((pressure - 1.0).abs() < 1e-3, "{pressure} at {x}");
            // The plus side moves to -x, against the compression from there.
            assert!(crack.slip_vector(k)[0] < 0.0 && crack.slip_vector(k)[1] == 0.0);
        }
    }
    Ok(())
}

/// With slip forbidden the body is the one without the cut.
#[test]
fn a_locked_fault_is_not_there() -> Outcome {
    let stress = nalgebra::Matrix2::new(-0.5, 1.0, 1.0, -0.7);
    let cut = square(8)?
        .with_surface_where("fault", |x| x[1] == x[0] && x[0].abs() <= 1.0)?
        .split("fault")?;
    let [cut, whole] = [P1::new(cut), P1::new(square(8)?)].map(|space| space.refined(1));
    let (cut, whole): (P1<2>, P1<2>) = (cut?, whole?);
    for multigrid in [false, true] {
        let mut locked = stressed(&cut, stress, (&["fault"], 1e6), &1.0.into(), multigrid)?;
        let mut uncut = stressed(&whole, stress, (&[], 0.0), &1.0.into(), multigrid)?;
        locked.step(1.0)?;
        uncut.step(1.0)?;
        let (locked, uncut) = (locked.snapshot(), uncut.snapshot());
        let scale = largest(uncut.displacement.iter().copied());
        for (x, u) in cut.mesh().vertices().iter().zip(locked.displacement) {
            let vertex = whole.vertex_at([x[0], x[1]]).ok_or("no vertex")?;
            assert!((u - uncut.displacement[vertex]).amax() < 1e-12 * scale);
        }
    }
    Ok(())
}

/// Normal and shear stress of a locked fault are those of the body, at every vertex.
#[test]
fn a_locked_fault_bears_the_uniform_stress() -> Outcome {
    let stress = nalgebra::Matrix2::new(-0.5, 0.1, 0.1, -0.7);
    let mesh = square(8)?
        .with_surface_where("fault", |x| x[1] == x[0] && x[0].abs() <= 1.0)?
        .split("fault")?;
    let space = P1::new(mesh).refined(1)?;
    let mut body = stressed(
        &space,
        stress,
        (&["fault"], 10.0),
        &NormalStress::from_body(0.0),
        false,
    )?;
    body.step(1.0)?;
    let at = body.snapshot();
    let fault = at.contact(0);
    let normal = Vector2::new(-1.0, 1.0) / 2_f64.sqrt();
    let traction = stress * normal;
    let shear = traction - normal * normal.dot(&traction);
    for k in 0..fault.len() {
        assert!((fault.normal_stress(k) + normal.dot(&traction)).abs() < 1e-10);
        // On the minus side.
        assert!(
            (fault.traction(k) - shear).amax() < 1e-10,
            "{}",
            fault.traction(k)
        );
    }
    Ok(())
}

#[test]
fn sides_that_are_no_pair_are_refused() -> Outcome {
    let mesh = square(8)?
        .with_surface_where("fault", |x| x[1] == 0.0 && x[0].abs() <= 1.0)?
        .split("fault")?;
    let space: Result<P1<2>, FemError> = P1::new(mesh).refined(1);
    let space = space?;
    let plus = space.part("fault+")?;
    let edge = space.trace(|x| x[1] == 2.0)?;
    for (plus, minus) in [(&plus, &edge), (&edge, &plus)] {
        let contact = stickslip::Contact::between(
            plus,
            minus,
            stickslip::friction::Tresca { coefficient: 0.6 },
            1.0,
        );
        let scene = stickslip::Scene::new(stickslip::fem::elasticity(&space, &crate::ELASTIC)?)
            .with_contact(contact);
        let refused = stickslip::Simulation::new(
            scene,
            stickslip::GeneralizedAlpha::default(),
            stickslip::Condensed::new(),
        );
        assert!(matches!(
            refused,
            Err(stickslip::SceneError::NotPaired { .. })
        ));
    }
    Ok(())
}
