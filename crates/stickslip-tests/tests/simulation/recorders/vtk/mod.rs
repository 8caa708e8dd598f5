//! Files for ParaView, read back.

mod fault;
mod kinds;
mod reader;

use std::fs;

use stickslip::fem::{P1, stress};
use stickslip::record::{FileError, VtkSeries};
use stickslip::{MeshMismatch, SceneError, Steps};

use crate::Outcome;
use crate::common::{STEP, Solver, body, paper_slider};
use stickslip::problems::pipping_slider::PippingSlider;

use reader::{File, unescaped};

/// Meshes, fields and times come back bit for bit.
#[test]
fn files_read_back() -> Outcome {
    let body = body(1);
    let space = body.space()?;
    let bottom = PippingSlider::bottom(&space)?;
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
    let body = File::read(folder.join("a & b_0002.vtu"))?;
    for (name, expected) in [("displacement", at.displacement), ("velocity", at.velocity)] {
        let expected: Vec<f64> = expected.iter().flat_map(|u| [u[0], u[1], 0.0]).collect();
        assert_eq!(body.numbers("PointData", name, 3)?, expected);
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
    assert_eq!(body.numbers("CellData", "stress", 9)?, tensors);

    let surface = File::read(folder.join("a & b_contact_0_0002.vtu"))?;
    let contact = at.contact(0);
    let states: Vec<f64> = (0..contact.len()).map(|k| contact.state(k)).collect();
    assert_eq!(surface.numbers("PointData", "state", 1)?, states);

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
    let files = list.split("file=\"").skip(1);
    let files: Vec<_> = files.filter_map(|rest| rest.split('"').next()).collect();
    assert_eq!(files.len(), 6);
    assert!(files.iter().all(|name| name.starts_with("a &amp; b_")));
    // The files of the list, the list, and nothing half written.
    assert!(
        files
            .iter()
            .all(|name| folder.join(unescaped(name)).is_file())
    );
    assert_eq!(fs::read_dir(&folder)?.count(), files.len() + 1);
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
    let (expected, found) = (space.mesh().identity(), longer.mesh().identity());
    let of_other = |error: Option<SceneError>, what: &str| {
        let other = MeshMismatch::new(what, expected, found);
        assert_eq!(error, Some(other.into()));
    };
    of_other(VtkSeries::new(&at, &longer, "name").err(), "space");
    let refused = VtkSeries::new(&at, &space, "name")?;
    let trace = PippingSlider::bottom(&longer)?;
    of_other(refused.with_contact(&at, 0, &trace).err(), "trace");
    let top = PippingSlider::top(&space)?;
    let refused = VtkSeries::new(&at, &space, "name")?
        .with_contact(&at, 0, &top)
        .err();
    assert!(
        matches!(refused, Some(SceneError::OtherVertices { contact: 0, .. })),
        "{refused:?}"
    );
    Ok(())
}
