//! Faults that meet: one that passes through keeps its jump, and one that ends there does not slip at its end.

use nalgebra::{Matrix2, SVector};
use stickslip::NormalStress;
use stickslip::fem::{Mesh, P1};

use crate::{Outcome, square, stressed};

/// The integral of slip over all faults after 1 s.
fn potency(mesh: Mesh<2>, faults: &[&str], refinements: usize, multigrid: bool) -> Outcome<f64> {
    let space = P1::new(mesh.split_all(faults)?).refined(refinements)?;
    let stress = Matrix2::new(-0.5, 1.0, 1.0, -0.5);
    let from_body = NormalStress::from_body(0.0);
    let mut body = stressed(&space, stress, (faults, 0.1), &from_body, multigrid)?;
    body.step(1.0)?;
    let at = body.snapshot();
    let of_each = at.contacts().map(|fault| {
        let places = 0..fault.len();
        places.map(|k| fault.weight(k) * fault.slip(k)).sum::<f64>()
    });
    Ok(of_each.sum())
}

/// Makes a mesh.
type Make<'a> = &'a dyn Fn() -> Outcome<Mesh<2>>;

fn level(x: &SVector<f64, 2>) -> bool {
    x[1] == 0.0 && x[0].abs() <= 1.0
}

/// Potencies at four sizes of cells: with the share of the last difference that a fault alone has, or less, the error
/// of a fault that meets another one falls as that of a fault alone. Tied junctions spoil the whole fault, with an
/// error that falls as 1/log(1/h): their share is above .7.
#[test]
fn the_error_at_a_junction_falls_as_that_of_tips() -> Outcome {
    let alone = || -> Outcome<Mesh<2>> { Ok(square(8)?.with_surface_where("level", level)?) };
    let crossed = || -> Outcome<Mesh<2>> {
        let on = |x: &SVector<f64, 2>| x[0] == x[1] && x[0].abs() <= 1.0;
        Ok(alone()?.with_surface_where("oblique", on)?)
    };
    let branched = || -> Outcome<Mesh<2>> {
        let on = |x: &SVector<f64, 2>| x[0] == x[1] && (0.0..=1.0).contains(&x[0]);
        Ok(alone()?.with_surface_where("oblique", on)?)
    };
    let share = |mesh: Make, faults: &[&str]| -> Outcome<[f64; 2]> {
        let mut all = Vec::new();
        for refinements in 1..5 {
            all.push(potency(mesh()?, faults, refinements, false)?);
        }
        let share = (all[3] - all[2]) / (all[2] - all[1]);
        // What is left, as a geometric series.
        Ok([share, all[3] + (all[3] - all[2]) * share / (1.0 - share)])
    };
    let [share_alone, single] = share(&alone, &["level"])?;
    let cases: [(Make, [&str; 2]); 3] = [
        (&crossed, ["level", "oblique"]),
        (&branched, ["level", "oblique"]),
        // In the other order, too.
        (&crossed, ["oblique", "level"]),
    ];
    for (mesh, faults) in cases {
        let [share, limit] = share(mesh, &faults)?;
        assert!(share < 1.02 * share_alone, "{share} {share_alone}");
        // Another fault makes the body softer.
        assert!(limit > 1.001 * single, "{limit} {single}");
    }
    Ok(())
}

#[test]
fn multigrid_agrees_where_faults_cross() -> Outcome {
    let mesh = || -> Outcome<Mesh<2>> {
        let oblique = |x: &SVector<f64, 2>| x[0] == x[1] && x[0].abs() <= 1.0;
        let mesh = square(8)?.with_surface_where("level", level)?;
        Ok(mesh.with_surface_where("oblique", oblique)?)
    };
    let faults = ["level", "oblique"];
    let one = potency(mesh()?, &faults, 2, false)?;
    let other = potency(mesh()?, &faults, 2, true)?;
    assert!((one / other - 1.0).abs() < 1e-8);
    Ok(())
}
