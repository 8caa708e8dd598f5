//! An inclined crack in a square under uniaxial compression, through a file of Gmsh: slip against its closed form.
//!
//! Far tractions on a crack of half length b close it by the normal stress `sigma sin^2 psi` and shear it by
//! `sigma sin psi cos psi`. Friction takes `tan theta` of the normal stress, so that the slip is
//!
//! ```text
//! 1.0094 (4 (1 - nu^2)/E) sigma sin psi (cos psi - sin psi tan theta) sqrt(b^2 - x^2)
//! ```
//!
//! 1.0094 is the finite size of a square of side 20 b.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::Value;
use stickslip::fem::{GridDiagonal, Mesh, P1};
use stickslip::nalgebra::{Rotation2, Vector2};

use crate::{Outcome, folder, program};

const HALF_LENGTH: f64 = 0.1;
const FINITE_SIZE: f64 = 1.0094;
const POISSON_RATIO: f64 = 0.25;

/// A square of side 2 around a crack along x, of 10 faces, refined towards it to `elements` faces along it; turned by
/// `angle` within the distance of 0.25, less beyond, and not at the boundary.
fn square(angle: f64, elements: usize) -> Outcome<Mesh<2>> {
    let outer = [0.12, 0.15, 0.19, 0.25, 0.33, 0.43, 0.57, 0.75, 1.0];
    let half = (0..=5)
        .map(|k| HALF_LENGTH * f64::from(k) / 5.0)
        .chain(outer);
    let half: Vec<f64> = half.collect();
    let count = half.len() - 1;
    let place = |x: f64| {
        let x = x.round() as usize;
        if x >= count {
            half[x - count]
        } else {
            -half[count - x]
        }
    };
    let size = 2 * count;
    let grid = Mesh::<2>::grid([size as f64; 2], [size; 2], GridDiagonal::Rising)?;
    let vertices = grid.vertices().iter().map(|x| x.map(place)).collect();
    let mesh = Mesh::new(vertices, grid.cells().flatten().copied().collect())?;
    let crack = |x: &Vector2<f64>| x[1] == 0.0 && x[0].abs() <= HALF_LENGTH;
    let cell = 2.0 * HALF_LENGTH / elements as f64;
    let space = P1::new(mesh.with_surface_where("crack", crack)?).graded(|x| {
        let beyond = Vector2::new((x[0].abs() - HALF_LENGTH).max(0.0), x[1]);
        2f64.sqrt() * (cell + 0.12 * beyond.norm())
    })?;
    let mesh = space.mesh();
    let turned = |x: &Vector2<f64>| {
        let far = ((x.norm() - 0.25) / 0.7).clamp(0.0, 1.0);
        Rotation2::new(angle * (1.0 - far * far * (3.0 - 2.0 * far))) * x
    };
    let (_, faces) = mesh.surfaces().next().ok_or("no crack")?;
    let vertices = mesh.vertices().iter().map(turned).collect();
    Ok(
        Mesh::new(vertices, mesh.cells().flatten().copied().collect())?
            .with_surface("crack", faces)?,
    )
}

/// A mesh as a file of Gmsh of version 2.2 with its surface as group 103, and its name if it is to have one.
fn write(mesh: &Mesh<2>, named: bool, path: &Path) -> Outcome {
    let mut text = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    if named {
        text += "$PhysicalNames\n1\n1 103 \"crack\"\n$EndPhysicalNames\n";
    }
    writeln!(text, "$Nodes\n{}", mesh.vertex_count())?;
    for (k, x) in mesh.vertices().iter().enumerate() {
        writeln!(text, "{} {} {} 0", k + 1, x[0], x[1])?;
    }
    let (_, faces) = mesh.surfaces().next().ok_or("no crack")?;
    writeln!(
        text,
        "$EndNodes\n$Elements\n{}",
        faces.len() + mesh.cell_count()
    )?;
    for (k, [a, b]) in faces.iter().enumerate() {
        writeln!(text, "{} 1 2 103 1 {} {}", k + 1, a + 1, b + 1)?;
    }
    for (k, cell) in mesh.cells().enumerate() {
        let [a, b, c] = [cell[0] + 1, cell[1] + 1, cell[2] + 1];
        writeln!(text, "{} 2 2 1 1 {a} {b} {c}", faces.len() + k + 1)?;
    }
    text += "$EndElements\n";
    Ok(fs::write(path, text)?)
}

/// Runs the crack at an inclination in degrees, and compares slip, its order and the normal stress.
fn compare(
    degrees: f64,
    coefficient: f64,
    elements: usize,
    named: bool,
    tolerance: f64,
) -> Outcome {
    let angle = degrees.to_radians();
    let folder = folder(&format!("crack-{degrees}-{elements}"))?;
    let file = folder.join("crack.msh");
    write(&square(angle, elements)?, named, &file)?;
    let contact = if named { "crack" } else { "103" };
    let output = program("gmsh")
        .arg(&file)
        .args([
            "--contact",
            contact,
            "--normal-stress",
            "body",
            "--compression",
            "1",
        ])
        .args([
            "--direction",
            "1,0",
            "--young-modulus",
            "1",
            "--friction",
            "coulomb",
        ])
        .args(["--poisson-ratio", &POISSON_RATIO.to_string()])
        .args(["--coefficient", &coefficient.to_string(), "--out"])
        .arg(&folder)
        .output()?;
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let summary: Value = serde_json::from_slice(&fs::read(folder.join("summary.json"))?)?;
    let rows = |name: &str| serde_json::from_value::<Vec<[f64; 3]>>(summary[name].clone());

    let (sin, cos) = angle.sin_cos();
    let factor =
        FINITE_SIZE * 4.0 * (1.0 - POISSON_RATIO.powi(2)) * sin * (cos - sin * coefficient);
    let slip = rows("slip")?;
    assert_eq!(slip.len(), elements - 1, "vertices without the tips");
    for (k, [x, y, slip]) in slip.iter().enumerate() {
        // In order along the crack.
        let along = HALF_LENGTH * (2.0 * (k + 1) as f64 / elements as f64 - 1.0);
        assert!(
            (x - along * cos).hypot(y - along * sin) < 1e-9,
            "{k}: {x}, {y}"
        );
        let exact = factor * (HALF_LENGTH.powi(2) - along.powi(2)).sqrt();
        if along.abs() < 0.5 * HALF_LENGTH {
            let error = slip / exact - 1.0;
            assert!(
                error.abs() < tolerance,
                "{degrees} degrees, {along} m: {error}"
            );
        }
    }
    for [x, y, stress] in rows("normal_stress")? {
        if x.hypot(y) < 0.5 * HALF_LENGTH {
            // The shear crack leaves the normal stress on its plane as it is.
            assert!(
                (stress / sin.powi(2) - 1.0).abs() < 0.1,
                "{x}, {y}: {stress}"
            );
        }
    }
    let contraction = summary["contraction"].as_f64().ok_or("no contraction")?;
    assert!(contraction < coefficient, "{contraction}");
    Ok(())
}

#[test]
fn an_inclined_crack_of_40_elements_slips_as_its_closed_form() -> Outcome {
    compare(20.0, 0.2, 40, true, 0.04)?;
    compare(30.0, 0.2, 40, true, 0.04)?;
    compare(40.0, 0.2, 40, true, 0.04)?;
    compare(25.0, 0.6, 40, true, 0.04)
}

#[test]
fn an_inclined_crack_of_160_elements_and_a_number_slips_as_its_closed_form() -> Outcome {
    compare(35.0, 0.2, 160, false, 0.015)
}
