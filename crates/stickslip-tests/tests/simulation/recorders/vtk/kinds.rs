//! Bodies in the plane, in space and in antiplane shear: points, cells and fields come back bit for bit.

use std::fs;
use std::path::PathBuf;

use nalgebra::SVector;
use stickslip::fem::{Elastic, P1, Trace, antiplane, elasticity, stress};
use stickslip::friction::Tresca;
use stickslip::record::VtkSeries;
use stickslip::{
    BlockMatrix, Components, Condensed, Contact, ContactView, GeneralizedAlpha, Scene, Simulation,
    Steps,
};

use super::reader::File;
use crate::Outcome;

/// VTK's numbers of cells by their number of corners: line, triangle, tetrahedron.
const SHAPES: [u8; 5] = [0, 0, 3, 5, 10];

const ELASTIC: Elastic = Elastic {
    young_modulus: 5e7,
    poisson_ratio: 0.3,
};

/// A body without inertia that is pulled at its top over its bottom until it slides.
fn pulled<const C: usize, const D: usize>(
    space: &P1<D>,
    bottom: &Trace<D>,
    stiffness: impl stickslip::solvers::IntoOperator<C, Operator = BlockMatrix<C>>,
) -> Outcome<Simulation<C>> {
    let top = space.trace(|x| x[D - 1] == 1.0)?;
    let scene = Scene::new(stiffness)
        .with_contact(Contact::new(bottom, Tresca { coefficient: 0.6 }, 1e3))
        .prescribe_velocity(&top, Components::ALL, |_| [1e-3; C]);
    let mut body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    body.run(&Steps::constant(0.1).count(3), |_| ())?;
    Ok(body)
}

/// A vector of the body in three dimensions.
fn spatial<const C: usize, const D: usize>(vector: &SVector<f64, C>) -> [f64; 3] {
    match *vector.as_slice() {
        [z] if D == 2 => [0.0, 0.0, z],
        [x, y] => [x, y, 0.0],
        [x, y, z] => [x, y, z],
        _ => unreachable!("no body has {C} components"),
    }
}

/// Cells of the file are these, by their vertices, and of the shape with so many corners.
fn same_cells(file: &File, expected: &[Vec<i64>]) -> Outcome {
    let (found, shapes) = file.topology()?;
    assert!(!expected.is_empty() && found == expected);
    assert!((expected.iter().zip(&shapes)).all(|(corners, &shape)| shape == SHAPES[corners.len()]));
    Ok(())
}

fn places<const D: usize>(points: &[SVector<f64, D>]) -> Vec<f64> {
    let extended = |x: &SVector<f64, D>| [x[0], x[1], if D == 3 { x[2] } else { 0.0 }];
    points.iter().flat_map(extended).collect()
}

/// Writes a step of the body and compares both of its files with it; gives that of the body back.
fn compare<const C: usize, const D: usize>(
    name: &str,
    space: &P1<D>,
    bottom: &Trace<D>,
    body: &Simulation<C>,
) -> Outcome<File> {
    let folder = folder(name);
    fs::create_dir_all(&folder)?;
    let at = body.snapshot();
    let mut series = VtkSeries::new(&at, space, folder.join(name))?
        .with_stress(|_, _| ELASTIC)
        .with_contact(&at, 0, bottom)?;
    assert!(series.record(&at).is_continue());
    series.finish()?;

    let whole = File::read(folder.join(format!("{name}_0000.vtu")))?;
    assert_eq!(
        whole.numbers("Points", "Points", 3)?,
        places(space.mesh().vertices())
    );
    let cells = space.mesh().cells();
    let cells = cells.map(|cell| cell.iter().map(|&p| i64::from(p)).collect());
    same_cells(&whole, &cells.collect::<Vec<_>>())?;
    for (name, field) in [("displacement", at.displacement), ("velocity", at.velocity)] {
        let expected: Vec<f64> = field.iter().flat_map(spatial::<C, D>).collect();
        assert!(expected.iter().any(|&x| x != 0.0));
        assert_eq!(whole.numbers("PointData", name, 3)?, expected, "{name}");
    }

    let surface = File::read(folder.join(format!("{name}_contact_0_0000.vtu")))?;
    let contact = at.contact(0);
    assert_eq!(
        surface.numbers("Points", "Points", 3)?,
        places(bottom.points())
    );
    let faces = bottom.faces().iter();
    let faces = faces.map(|face| face.iter().map(|&k| k as i64).collect());
    same_cells(&surface, &faces.collect::<Vec<_>>())?;
    let scalar = |of: &dyn Fn(&ContactView<'_, C>, usize) -> f64| {
        (0..contact.len())
            .map(|k| of(&contact, k))
            .collect::<Vec<_>>()
    };
    assert_eq!(
        surface.numbers("PointData", "slip", 1)?,
        scalar(&|at, k| at.slip(k))
    );
    assert_eq!(
        surface.numbers("PointData", "slip_rate", 1)?,
        scalar(&|at, k| at.slip_rate(k))
    );
    assert!(
        scalar(&|at, k| at.slip_rate(k))
            .iter()
            .all(|&rate| rate > 0.0),
        "it slides"
    );
    let tractions: Vec<f64> = (0..contact.len())
        .flat_map(|k| spatial::<C, D>(&contact.traction(k)))
        .collect();
    assert_eq!(surface.numbers("PointData", "traction", 3)?, tractions);
    fs::remove_dir_all(&folder)?;
    Ok(whole)
}

fn folder(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("stickslip-vtk-{name}-{}", std::process::id()))
}

#[test]
fn plane_strain_reads_back() -> Outcome {
    let space = P1::grid([2.0, 1.0], [4, 2])?;
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let body = pulled(&space, &bottom, elasticity(&space, &ELASTIC)?)?;
    let file = compare("plane", &space, &bottom, &body)?;
    let active = |place: &str, kind: &str, name: &str| {
        (place.to_string(), kind.to_string(), name.to_string())
    };
    assert_eq!(
        file.active,
        [
            active("PointData", "Vectors", "displacement"),
            active("CellData", "Tensors", "stress")
        ]
    );
    Ok(())
}

#[test]
fn a_block_in_space_reads_back() -> Outcome {
    let space = P1::grid([2.0, 1.0, 1.0], [2, 1, 1])?.refined(1)?;
    let bottom = space.trace(|x| x[2] == 0.0)?;
    let body = pulled(&space, &bottom, elasticity(&space, &ELASTIC)?)?;
    let file = compare("block", &space, &bottom, &body)?;
    let tensors: Vec<f64> = stress(&space, &ELASTIC, body.snapshot().displacement)?
        .iter()
        .flat_map(|sigma| (0..9).map(|n| sigma[(n / 3, n % 3)]))
        .collect();
    assert_eq!(file.numbers("CellData", "stress", 9)?, tensors);
    Ok(())
}

/// Motion out of the plane is along z; its body has no stress by cell.
#[test]
fn antiplane_shear_reads_back() -> Outcome {
    let space = P1::grid([2.0, 1.0], [4, 2])?;
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let body = pulled(&space, &bottom, antiplane(&space, 1e7)?)?;
    let file = compare("antiplane", &space, &bottom, &body)?;
    assert!(!file.arrays.keys().any(|(place, _)| place == "CellData"));
    Ok(())
}
