//! Stations that are not on their fault, and other wrong settings.

use stickslip::bie::{Cells, Fault, Medium, PlaneFault, Rectangles};
use stickslip::friction::Tresca;
use stickslip::nalgebra::Vector1;
use stickslip::problems::bp1;
use stickslip::record::{
    FileError, RuptureTimes, SeasFolder, SeasGlobal, SeasPoint, SeasProfile, SeasStation,
};
use stickslip::{Contact, RungeKutta, Scene, SceneError, Snapshot};

use super::{bp1_cycle, header};
use crate::Outcome;

fn cause<const C: usize>(
    at: &Snapshot<'_, C>,
    contact: usize,
    point: SeasPoint,
) -> Option<SceneError> {
    match SeasStation::new(at, contact, point, &header(), Vec::new()) {
        Err(FileError::Scene(cause)) => Some(cause),
        _ => None,
    }
}

#[test]
fn stations_off_a_line_are_refused() -> Outcome {
    let cycle = bp1_cycle(1e3)?;
    let at = cycle.snapshot();
    for depth in [-1.0, 40.1e3] {
        let point = SeasPoint::Line(depth);
        let expected = SceneError::OutsideContact {
            point: vec![depth],
            ends: vec![[0.0, 40e3]],
        };
        let found = cause(&at, 0, point).ok_or("accepted")?;
        assert!(found.to_string().contains("[[0.0, 40000.0]] m"), "{found}");
        assert_eq!(found, expected);
        let profile = SeasProfile::new(&at, 0, &[point], &header(), Vec::new());
        assert!(profile.is_err());
    }
    for (contact, point) in [
        (0, SeasPoint::Line(f64::NAN)),
        (0, SeasPoint::Plane([0.0, 0.0])),
        (1, SeasPoint::Line(0.0)),
    ] {
        let found = cause(&at, contact, point);
        let refused = matches!(
            found,
            Some(SceneError::Value { .. } | SceneError::Index { .. })
        );
        assert!(refused, "{found:?}");
    }
    Ok(())
}

/// Stations whose positions round to one name, on a line and on a plane: both are named, and no file is begun.
#[test]
fn two_stations_of_one_name_are_refused() -> Outcome {
    let cycle = bp1_cycle(1e3)?;
    let folder = std::env::temp_dir().join(format!("stickslip-names-{}", std::process::id()));
    let files = |points: [f64; 2], unit| {
        let points = points.map(SeasPoint::Line);
        let files = SeasFolder::new(&folder, header()).with_stations(points);
        files
            .with_names(unit, 3)
            .create(&cycle.snapshot(), 32e9, &[])
    };
    for (points, unit) in [
        ([7.50e3, 7.54e3], 100.0),
        ([7e3, 7e3], 1.0),
        ([1e3, 2e3], 1e5),
    ] {
        let error = files(points, unit).err().ok_or("taken")?;
        let FileError::SameName { path, points: both } = &error else {
            return Err(error.into());
        };
        assert_eq!(path.parent(), Some(&*folder));
        let names = points.map(|x| SeasPoint::Line(x).to_string());
        assert_eq!(both, &names);
        assert!(names.iter().all(|name| error.to_string().contains(name)));
        assert!(!folder.exists());
    }
    files([7.50e3, 7.54e3], 10.0)?.finish()?;
    std::fs::remove_dir_all(&folder)?;
    Ok(())
}

/// Two rows and a hole: a section of a plane without its cell at (500, 500) m.
#[test]
fn stations_off_a_plane_are_refused() -> Outcome {
    let cells = Rectangles::new(Cells::new([-1e3, 2e3], 3)?, Cells::new([0.0, 2e3], 2)?);
    let rock = Medium {
        shear_modulus: 32e9,
        shear_wave_speed: 3464.0,
    };
    let fault = PlaneFault::whole_space(cells, rock, 0.25)?.with_rake(0.0)?;
    let section = fault.section(|[x, y]| x != 500.0 || y != 500.0)?;
    let hole = fault.section(|[x, y]| x == 500.0 && y == 500.0)?;
    let law = Tresca { coefficient: 0.6 };
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(Contact::new(&section, law, 1e6))
        .with_contact(Contact::new(&hole, law, 1e6));
    let motion = RungeKutta::new(scene)?;
    let at = motion.snapshot();
    for point in [
        [500.0, 500.0],
        [900.0, 900.0],
        [-1001.0, 100.0],
        [0.0, 2001.0],
    ] {
        let found = cause(&at, 0, SeasPoint::Plane(point));
        assert!(
            matches!(found, Some(SceneError::OutsideContact { .. })),
            "{found:?}"
        );
    }
    // Beside the hole, in a corner, and in the hole's own contact.
    for (contact, point) in [(0, [1100.0, 500.0]), (0, [-1e3, 2e3]), (1, [500.0, 900.0])] {
        let found = cause(&at, contact, SeasPoint::Plane(point));
        assert_eq!(found, None);
    }
    let found = cause(&at, 0, SeasPoint::Line(0.0));
    assert!(matches!(found, Some(SceneError::Value { .. })), "{found:?}");
    // On no line along strike or down dip.
    let points = [[-500.0, 500.0], [1500.0, 1500.0]].map(SeasPoint::Plane);
    assert!(SeasProfile::new(&at, 0, &points, &header(), Vec::new()).is_err());
    assert!(SeasProfile::new(&at, 0, &[], &header(), Vec::new()).is_err());
    Ok(())
}

#[test]
fn settings_out_of_range_are_refused() -> Outcome {
    let fault = Fault::half_space(Cells::new([0.0, 40e3], 4)?, bp1::MEDIUM)?;
    let motion = RungeKutta::new(
        Scene::new(fault.stiffness())
            .with_viscosity(fault.radiation_damping())
            .with_contact(
                Contact::new(&fault, Tresca { coefficient: 0.6 }, 1e6)
                    .with_shear_stress(Vector1::new(1e6)),
            ),
    )?;
    let at = motion.snapshot();
    for modulus in [0.0, -1.0, f64::NAN] {
        assert!(SeasGlobal::new(&at, 0, modulus, &header(), Vec::new()).is_err());
    }
    for rates in [[1e-3, 1e-2], [0.0, 0.0], [1e-2, f64::NAN]] {
        assert!(RuptureTimes::new(&at, 0, rates).is_err());
    }
    assert!(RuptureTimes::new(&at, 1, [1e-2, 1e-3]).is_err());
    let points = [SeasPoint::Line(5e3)];
    let profile = || SeasProfile::new(&at, 0, &points, &header(), Vec::new());
    assert!(profile()?.at_intervals(0.0, [1.0, 1.0]).is_err());
    assert!(profile()?.at_intervals(1e-2, [1.0, f64::INFINITY]).is_err());
    // Without a state the column is NaN.
    let station = SeasStation::new(&at, 0, points[0], &header(), Vec::new())?.with_start(&at);
    let read = super::parse(&station.finish()?)?;
    assert!(read.column("state").is_some_and(|state| state[0].is_nan()));
    Ok(())
}
