//! Files for ParaView, read back.

use std::fs;

use stickslip::fem::{P1, stress};
use stickslip::record::{FileError, VtkSeries};
use stickslip::{MeshMismatch, SceneError, Steps};
use vtkio::model::{Attribute, DataSet, Piece, UnstructuredGridPiece, VertexNumbers};
use vtkio::{IOBuffer, Vtk};

use crate::Outcome;
use crate::common::{STEP, Solver, body, paper_slider};
use stickslip::problems::Slider;

/// The only piece of a file.
fn grid(path: impl AsRef<std::path::Path>) -> Outcome<UnstructuredGridPiece> {
    match Vtk::import(path)?.data {
        DataSet::UnstructuredGrid { mut pieces, .. } => match pieces.pop() {
            Some(Piece::Inline(piece)) => Ok(*piece),
            _ => Err("no inline piece".into()),
        },
        _ => Err("no unstructured grid".into()),
    }
}

fn numbers(buffer: &IOBuffer) -> Outcome<Vec<f64>> {
    let numbers = buffer.clone().into_vec::<f64>();
    Ok(numbers.ok_or("no numbers of 64 bits")?)
}

/// The values of an array.
fn field(attributes: &[Attribute], name: &str) -> Outcome<Vec<f64>> {
    let found = attributes.iter().find_map(|attribute| match attribute {
        Attribute::DataArray(array) if array.name == name => Some(array),
        _ => None,
    });
    numbers(&found.ok_or_else(|| format!("no {name}"))?.data)
}

/// Meshes, fields and times come back bit for bit.
#[test]
fn files_read_back() -> Outcome {
    let body = body(1);
    let space = body.space()?;
    let bottom = Slider::bottom(&space)?;
    let mut slider = paper_slider(&body, &space, Solver::Condensed, 1e-10)?;
    let folder = std::env::temp_dir().join(format!("stickslip-vtk-{}", std::process::id()));
    fs::create_dir_all(&folder)?;
    let elastic = body.elastic;
    let mut series = VtkSeries::new(&slider.snapshot(), &space, folder.join("a & b"))?
        .with_stress(move |_, _| elastic)
        .with_contact(&slider.snapshot(), 0, &bottom)?
        .every(10)?;
    let mut times = Vec::new();
    slider.run(&Steps::constant(STEP).count(30), |at| {
        if at.step % 10 == 0 {
            times.push(at.time);
        }
        series.record(&at)
    })?;
    series.finish()?;

    let at = slider.snapshot();
    let body = grid(folder.join("a & b_0002.vtu"))?;
    let points = space.mesh().vertices().iter();
    let points: Vec<f64> = points.flat_map(|x| [x[0], x[1], 0.0]).collect();
    assert_eq!(numbers(&body.points)?, points);
    let VertexNumbers::XML { connectivity, .. } = body.cells.cell_verts else {
        return Err("no cells".into());
    };
    let cells = space.mesh().cells().flatten().map(|&p| u64::from(p));
    assert_eq!(connectivity, cells.collect::<Vec<_>>());
    for (name, expected) in [("displacement", at.displacement), ("velocity", at.velocity)] {
        let expected: Vec<f64> = expected.iter().flat_map(|u| [u[0], u[1], 0.0]).collect();
        assert_eq!(field(&body.data.point, name)?, expected);
    }
    let tensors: Vec<f64> = stress(&space, &elastic, at.displacement)?
        .iter()
        .flat_map(|s| {
            [
                s[(0, 0)],
                s[(0, 1)],
                0.0,
                s[(1, 0)],
                s[(1, 1)],
                0.0,
                0.0,
                0.0,
                0.0,
            ]
        })
        .collect();
    assert_eq!(field(&body.data.cell, "stress")?, tensors);

    let (surface, contact) = (
        grid(folder.join("a & b_contact_0_0002.vtu"))?,
        at.contact(0),
    );
    let of = |value: &dyn Fn(usize) -> f64| (0..contact.len()).map(value).collect::<Vec<f64>>();
    let data = &surface.data.point;
    assert_eq!(field(data, "slip")?, of(&|k| contact.slip(k)));
    assert_eq!(field(data, "slip_rate")?, of(&|k| contact.slip_rate(k)));
    assert_eq!(field(data, "state")?, of(&|k| contact.state(k)));
    let tractions = field(data, "traction")?;
    assert_eq!(
        tractions.iter().step_by(3).copied().collect::<Vec<_>>(),
        of(&|k| contact.traction(k)[0])
    );
    assert_eq!(surface.cells.types.len(), bottom.faces().len());

    let list = fs::read_to_string(folder.join("a & b.pvd"))?;
    let listed = list
        .split("timestep=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next());
    let listed: Vec<f64> = listed.map(str::parse).collect::<Result<_, _>>()?;
    assert_eq!(
        listed,
        times.iter().flat_map(|&t| [t, t]).collect::<Vec<_>>()
    );
    assert_eq!(list.matches("file=\"a &amp; b_").count(), 6);
    fs::remove_dir_all(&folder)?;
    Ok(())
}

/// A folder that is none ends the run; another mesh and another part are refused.
#[test]
fn what_does_not_fit_is_refused() -> Outcome {
    let body = body(0);
    let space = body.space()?;
    let mut slider = paper_slider(&body, &space, Solver::Condensed, 1e-10)?;
    let mut series = VtkSeries::new(&slider.snapshot(), &space, "no/such/folder/name")?;
    let report = slider.run(&Steps::constant(STEP).count(30), |at| series.record(&at))?;
    assert_eq!(report.accepted, 1);
    let refused = series.finish().err();
    assert!(
        matches!(refused, Some(FileError::Write { path: Some(_), .. })),
        "{refused:?}"
    );

    let at = slider.snapshot();
    let other = space.clone().refined(1)?;
    let refused = VtkSeries::new(&at, &other, "name").err();
    assert!(
        matches!(refused, Some(SceneError::Length { what: "space", .. })),
        "{refused:?}"
    );
    // As many vertices, and as many on the bottom.
    let longer = P1::grid([6.0, 1.0], [5, 1])?;
    let (expected, found) = (space.mesh().fingerprint(), longer.mesh().fingerprint());
    let of_other = |error: Option<SceneError>, what: &str| {
        let other = MeshMismatch::new(what, expected, found);
        assert_eq!(error, Some(other.into()));
    };
    of_other(VtkSeries::new(&at, &longer, "name").err(), "space");
    let refused = VtkSeries::new(&at, &space, "name")?;
    let trace = Slider::bottom(&longer)?;
    of_other(refused.with_contact(&at, 0, &trace).err(), "trace");
    let top = Slider::top(&space)?;
    let refused = VtkSeries::new(&at, &space, "name")?
        .with_contact(&at, 0, &top)
        .err();
    assert!(
        matches!(refused, Some(SceneError::OtherVertices { contact: 0, .. })),
        "{refused:?}"
    );
    Ok(())
}
