//! Pore pressure and Darcy velocity in the files of the benchmarks with fluid injection.

use stickslip::bie::{Cells, Fault, Medium, Mode, PlaneFault, Rectangles};
use stickslip::fields::{Diffusion, GivenPressure, Hydraulics, Line, Plane, RateHistory, Well};
use stickslip::nalgebra::{Vector1, Vector2};
use stickslip::problems::bp1;
use stickslip::record::{SeasFolder, SeasPoint, SeasStation, SeasTable};
use stickslip::state::LogTheta;
use stickslip::{Contact, RungeKutta, Scene, Steps};

use super::{Folder, agree, header, parse};
use crate::Outcome;

const ROCK: Medium = Medium {
    shear_modulus: 32e9,
    shear_wave_speed: 3464.0,
};
/// Over the viscosity: 1e-10 m^2/(Pa s).
const PERMEABILITY: f64 = 1e-13;
const VISCOSITY: f64 = 1e-3;

fn zone() -> Hydraulics {
    Hydraulics {
        permeability: PERMEABILITY.into(),
        viscosity: VISCOSITY.into(),
        storage: 1e-9.into(),
        thickness: 2.0.into(),
    }
}

/// Cells of 10 m on a line of 400 m, injection at -45 m.
fn line(
    contact: impl Fn(Contact<Law, Aging, 1>) -> Contact<Law, Aging, 1>,
) -> Outcome<RungeKutta<1>> {
    let fault = Fault::whole_space(Cells::new([-200.0, 200.0], 40)?, ROCK, Mode::Antiplane)?;
    let own = Contact::new(&fault, bp1::friction(30e3), 50e6)
        .with_state(bp1::AGING, LogTheta(20.0))
        .with_shear_stress(Vector1::new(29e6));
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(contact(own));
    Ok(RungeKutta::new(scene)?)
}

type Law = stickslip::friction::RegularizedDieterichRuina;
type Aging = stickslip::state::Dieterich;

/// Between two centres the mean of both. The Darcy velocity follows Darcy's law: at a centre the central difference.
#[test]
fn a_station_on_a_line_shows_its_fluid() -> Outcome {
    let well = Well::new(-45.0, RateHistory::constant(2e-6)?);
    let diffusion =
        Diffusion::new(Line::uniform([-200.0, 200.0], 40)?, &zone())?.with_well(well)?;
    let mut motion = line(|contact| contact.with_field(diffusion.clone()))?;
    let at = motion.snapshot();
    let station = |x| SeasStation::new(&at, 0, SeasPoint::Line(x), &header(), Vec::new());
    // At the centre of cell 22, and between it and the next one.
    let mut stations = [station(25.0)?, station(30.0)?].map(SeasStation::with_pore_fluid);
    let mut expected: [Vec<f64>; 3] = Default::default();
    motion.run(&Steps::adaptive(1e-5).until(864e2), |at| {
        let contact = at.contact(0);
        let p = |k| contact.pore_pressure(k);
        let velocity = -PERMEABILITY / VISCOSITY * (p(23) - p(21)) / 20.0;
        let row = [1e-6 * p(22), velocity, 0.5e-6 * (p(22) + p(23))];
        expected
            .iter_mut()
            .zip(row)
            .for_each(|(all, x)| all.push(x));
        stations
            .iter_mut()
            .try_for_each(|station| station.record(&at))
    })?;
    let [centre, between] = stations.map(SeasStation::finish);
    let (centre, between) = (parse(&centre?)?, parse(&between?)?);
    let names = "t slip slip_rate shear_stress pore_pressure darcy_vel state";
    assert_eq!(centre.names().join(" "), names);
    assert!(expected[0].len() > 10);
    // Away from the well.
    assert!(expected[1].iter().all(|&velocity| velocity > 0.0));
    let close = |found: &[f64], expected: &[f64]| {
        let largest = expected.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        let mut pairs = found.iter().zip(expected);
        found.len() == expected.len() && pairs.all(|(a, b)| (a - b).abs() < 1e-9 * largest)
    };
    assert!(agree(&centre.columns()[4], &expected[0]));
    assert!(close(&centre.columns()[5], &expected[1]));
    assert!(agree(&between.columns()[4], &expected[2]));
    Ok(())
}

/// A pressure in closed form has no velocity.
#[test]
fn a_velocity_that_no_field_shows_is_no_number() -> Outcome {
    let given = |_: f64, p: &mut [f64]| p.fill(2e6);
    let motion = line(|contact| contact.with_field(GivenPressure::new(40, 0.0, given)))?;
    let at = motion.snapshot();
    let station = SeasStation::new(&at, 0, SeasPoint::Line(0.0), &header(), Vec::new())?;
    let read = parse(&station.with_pore_fluid().with_start(&at).finish()?)?;
    assert!(agree(&read.columns()[4], &[2.0]));
    assert!(read.columns()[5][0].is_nan());
    Ok(())
}

/// Eleven columns, and profiles along strike and down dip in a folder. Fluid flows away from the well: along strike and
/// down dip on their positive sides.
#[test]
fn files_of_a_plane_show_its_fluid() -> Outcome {
    let cells = Cells::new([-50.0, 50.0], 5)?;
    let fault = PlaneFault::whole_space(Rectangles::new(cells, cells), ROCK, 0.25)?;
    let well = Well::new([0.0, 0.0], RateHistory::constant(1e-4)?);
    let diffusion =
        Diffusion::new(Plane::new([[-50.0, 50.0]; 2], [5; 2])?, &zone())?.with_well(well)?;
    let contact = Contact::new(&fault, bp1::friction(30e3), 50e6)
        .with_state(bp1::AGING, LogTheta(20.0))
        .with_shear_stress(Vector2::new(29e6, 0.0))
        .with_field(diffusion);
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(contact);
    let mut motion = RungeKutta::new(scene)?;
    let folder = Folder::new("fluid")?;
    let centres = [-40.0, -20.0, 0.0, 20.0, 40.0];
    let mut files = SeasFolder::new(folder.join("files"), header())
        .with_stations([[20.0, 0.0], [0.0, 20.0], [-20.0, -20.0]].map(SeasPoint::Plane))
        .with_line(centres.map(|x| SeasPoint::Plane([x, 0.0])))
        .with_line(centres.map(|y| SeasPoint::Plane([0.0, y])))
        .with_names(1.0, 3)
        .with_pore_fluid()
        .create(&motion.snapshot(), 32e9, fault.directions())?;
    motion.run(&Steps::adaptive(1e-4).until(3600.0), |at| files.record(&at))?;
    files.finish()?;
    let read = |name: &str| SeasTable::read(folder.join("files").join(name));
    let along = read("fltst_strk+020dp+000")?;
    let names = "t slip_2 slip_3 slip_rate_2 slip_rate_3 shear_stress_2 shear_stress_3 pore_pressure \
                 darcy_vel_2 darcy_vel_3 state";
    assert_eq!(along.names().join(" "), names);
    let last = |table: &SeasTable, name: &str| {
        let column = table.column(name).unwrap_or_default();
        column.last().copied().unwrap_or(f64::NAN)
    };
    let (down, beside) = (read("fltst_strk+000dp+020")?, read("fltst_strk-020dp-020")?);
    let fast = last(&along, "darcy_vel_2");
    assert!(fast > 0.0 && last(&along, "darcy_vel_3").abs() < 1e-9 * fast);
    assert!((last(&down, "darcy_vel_3") / fast - 1.0).abs() < 1e-6);
    assert!(last(&beside, "darcy_vel_2") < 0.0 && last(&beside, "darcy_vel_3") < 0.0);
    let contact = motion.snapshot();
    let contact = contact.contact(0);
    for (axis, stride) in [("strike", 1), ("depth", 5)] {
        for quantity in ["slip_2", "slip_3", "shear_stress_2", "shear_stress_3"] {
            assert_eq!(
                read(&format!("{quantity}_{axis}.dat"))?.positions(),
                Some(&centres[..])
            );
        }
        let pressure = read(&format!("pore_pressure_{axis}.dat"))?;
        assert_eq!(pressure.names()[2], "pore_pressure");
        for n in 0..5 {
            let cell = if stride == 1 { 10 + n } else { 5 * n + 2 };
            let end = pressure.columns()[2 + n].last().copied().into_iter();
            assert!(agree(
                &end.collect::<Vec<_>>(),
                &[1e-6 * contact.pore_pressure(cell)]
            ));
        }
    }
    Ok(())
}

/// Two lines along strike would be one file.
#[test]
fn lines_of_one_file_are_refused() -> Outcome {
    let cells = Cells::new([-50.0, 50.0], 5)?;
    let fault = PlaneFault::whole_space(Rectangles::new(cells, cells), ROCK, 0.25)?;
    let contact =
        Contact::new(&fault, bp1::friction(30e3), 50e6).with_state(bp1::AGING, LogTheta(20.0));
    let motion = RungeKutta::new(
        Scene::new(fault.stiffness())
            .with_viscosity(fault.radiation_damping())
            .with_contact(contact),
    )?;
    let folder = Folder::new("lines")?;
    let files = SeasFolder::new(folder.join("files"), header())
        .with_line([-40.0, 0.0].map(|x| SeasPoint::Plane([x, 0.0])))
        .with_line([-40.0, 0.0].map(|x| SeasPoint::Plane([x, 20.0])))
        .create(&motion.snapshot(), 32e9, fault.directions());
    let message = files.err().ok_or("two lines in one file")?.to_string();
    assert!(message.contains("slip_strike.dat"), "{message}");
    assert!(!folder.join("files").exists());
    Ok(())
}
