//! Files of faults that are not planes.

use std::fs;

use stickslip::bie::{
    FaultGeometry, Medium, Mode, SegmentFault, Segments, SurfaceFault, Triangles,
};
use stickslip::friction::{FrictionLaw, RegularizedDieterichRuina};
use stickslip::nalgebra::{SVector, Vector3};
use stickslip::record::VtkFaultSeries;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{BoundaryPart, Contact, RungeKutta, Scene, SceneError, Steps};

use super::reader::File;
use crate::Outcome;

const ROCK: Medium = Medium {
    shear_modulus: 32.04e9,
    shear_wave_speed: 3464.0,
};
const FRICTION: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.01,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 0.01,
};

fn scene<const C: usize, G: FaultGeometry<C>>(
    fault: &G,
    rate: SVector<f64, C>,
) -> Outcome<Scene<G::Kernel, C>> {
    let part = BoundaryPart::from(FaultGeometry::cells(fault));
    let count = part.points.len();
    // Steady at the rate.
    let state = LogTheta((0.01 / rate.norm()).ln());
    let damping = 0.5 * ROCK.shear_modulus / ROCK.shear_wave_speed;
    let stress = 50e6 * FRICTION.coefficient(rate.norm(), state) + damping * rate.norm();
    let contact = Contact::new(part, FRICTION, 50e6)
        .with_state(
            Dieterich {
                slip_distance: 0.01,
            },
            state,
        )
        .with_shear_stress(vec![rate.normalize() * stress; count]);
    Ok(Scene::of_fault(fault, rate)?
        .with_contact(contact)
        .with_velocity(vec![rate; count]))
}

/// Two squares of 1 km, the lower one less steep.
fn surface() -> Outcome<SurfaceFault> {
    let points: Vec<_> = [[0.0, 1e3], [600.0, 1.8e3], [1.4e3, 2.4e3]]
        .into_iter()
        .flat_map(|[south, depth]| [0.0, 1e3].map(|x| [x, -south, -depth]))
        .collect();
    let triangles = [[0, 1, 3], [0, 3, 2], [2, 3, 5], [2, 5, 4]];
    Ok(SurfaceFault::half_space(
        Triangles::new(&points, &triangles)?,
        ROCK,
        0.25,
    )?)
}

#[test]
fn files_of_triangles_read_back() -> Outcome {
    let fault = surface()?;
    let mut run = RungeKutta::new(scene(&fault, SVector::from([0.6e-9, 0.8e-9]))?)?;
    let folder = std::env::temp_dir().join(format!("stickslip-vtk-fault-{}", std::process::id()));
    fs::create_dir_all(&folder)?;
    let base = folder.join("fault");
    let mut series = VtkFaultSeries::of_surface(&run.snapshot(), 0, &fault, base)?.every(2)?;
    run.run(&Steps::adaptive(1e-4).count(4), |at| series.record(&at))?;
    series.finish()?;

    let cells = fault.cells();
    let (at, file) = (run.snapshot(), File::read(folder.join("fault_0001.vtu"))?);
    let contact = at.contact(0);
    let expected: Vec<_> = (0..4).map(|k| contact.slip_rate(k)).collect();
    assert_eq!(file.numbers("CellData", "slip_rate", 1)?, expected);
    let expected: Vec<_> = (0..4).map(|k| contact.normal_stress(k)).collect();
    assert_eq!(file.numbers("CellData", "normal_stress", 1)?, expected);
    // The vector of slip is in the cell, and as long as slip.
    let slip = file.numbers("CellData", "slip", 1)?;
    let vectors = file.numbers("CellData", "slip_vector", 3)?;
    for (cell, vector) in vectors.chunks(3).enumerate() {
        let vector = Vector3::from_column_slice(vector);
        let normal = Vector3::from(cells.axes(cell).normal);
        assert!(slip[cell] > 0.0 && (vector.norm() / slip[cell] - 1.0).abs() < 1e-12);
        assert!(vector.dot(&normal).abs() < 1e-12 * slip[cell]);
        assert!(vector.z > 0.0);
    }
    let names = fs::read_dir(&folder)?.count();
    assert_eq!(names, 3);
    fs::remove_dir_all(&folder)?;
    Ok(())
}

#[test]
fn other_faults_are_refused() -> Outcome {
    let fault = surface()?;
    let run = RungeKutta::new(scene(&fault, SVector::from([0.0, 1e-9]))?)?;
    let (at, name) = (run.snapshot(), "name");
    let refused = VtkFaultSeries::of_surface(&at, 1, &fault, name).err();
    assert!(
        matches!(refused, Some(SceneError::Index { .. })),
        "{refused:?}"
    );
    let points = [[0.0, 0.0, -1e3], [1e3, 0.0, -1e3], [1e3, 0.0, -2e3]];
    let other = SurfaceFault::half_space(Triangles::new(&points, &[[0, 1, 2]])?, ROCK, 0.25)?;
    let refused = VtkFaultSeries::of_surface(&at, 0, &other, name).err();
    assert!(matches!(refused, Some(SceneError::Mesh(_))), "{refused:?}");
    Ok(())
}

#[test]
fn files_of_segments_read_back() -> Outcome {
    let line = Segments::polyline(&[[0.0, -1e3], [500.0, -1.8e3], [1.4e3, -2.4e3]])?;
    let fault = SegmentFault::half_space(line, ROCK, Mode::Antiplane)?;
    let mut run = RungeKutta::new(scene(&fault, SVector::from([1e-9]))?)?;
    let name = format!("stickslip-vtk-line-{}", std::process::id());
    let folder = std::env::temp_dir().join(name);
    fs::create_dir_all(&folder)?;
    let base = folder.join("line");
    let mut series = VtkFaultSeries::of_segments(&run.snapshot(), 0, &fault, base)?;
    run.run(&Steps::adaptive(1e-4).count(1), |at| series.record(&at))?;
    series.finish()?;
    let (at, file) = (run.snapshot(), File::read(folder.join("line_0000.vtu"))?);
    let contact = at.contact(0);
    let expected: Vec<_> = (0..contact.len()).map(|k| contact.state(k)).collect();
    assert_eq!(file.numbers("CellData", "state", 1)?, expected);
    fs::remove_dir_all(&folder)?;
    Ok(())
}
