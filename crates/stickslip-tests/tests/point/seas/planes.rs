//! Planes of rectangular cells, with two components of slip or one.

use stickslip::bie::{Cells, Medium, PlaneFault, Rectangles};
use stickslip::nalgebra::{SVector, Vector2};
use stickslip::problems::bp1;
use stickslip::record::{SeasPoint, SeasProfile, SeasStation};
use stickslip::state::LogTheta;
use stickslip::{Contact, RungeKutta, Scene, Steps};

use super::{agree, header, parse};
use crate::Outcome;

fn plane() -> Outcome<PlaneFault> {
    let cells = Rectangles::new(Cells::new([-3e3, 3e3], 6)?, Cells::new([0.0, 4e3], 4)?);
    let rock = Medium {
        shear_modulus: 32e9,
        shear_wave_speed: 3464.0,
    };
    Ok(PlaneFault::half_space(cells, 60.0, rock, 0.25)?)
}

/// States that differ from cell to cell, under an oblique stress.
fn motion<const C: usize>(
    fault: &PlaneFault<C>,
    stress: SVector<f64, C>,
) -> Outcome<RungeKutta<C>> {
    let law = bp1::friction(30e3);
    let states = fault
        .cells()
        .map(|[x, y]| LogTheta(15.0 + 1e-4 * x + 2e-4 * y));
    let contact = Contact::new(fault, law, 50e6)
        .with_state(bp1::AGING, states)
        .with_shear_stress(stress);
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(contact);
    Ok(RungeKutta::new(scene)?)
}

/// The mean of the four cells around [`POINT`]: columns 1 and 2 of rows 1 and 2, 6 cells a row.
fn mean(value: impl Fn(usize) -> f64) -> f64 {
    0.5 * (0.75 * value(7) + 0.25 * value(8)) + 0.5 * (0.75 * value(13) + 0.25 * value(14))
}

/// Between the centres (-1.5, 1.5), (-0.5, 1.5), (-1.5, 2.5), (-0.5, 2.5) km.
const POINT: SeasPoint = SeasPoint::Plane([-1.25e3, 2e3]);

#[test]
fn a_station_is_between_four_cells() -> Outcome {
    let mut motion = motion(&plane()?, Vector2::new(27e6, 9e6))?;
    let at = motion.snapshot();
    let mut station = SeasStation::new(&at, 0, POINT, &header(), Vec::new())?;
    let mut rows: [Vec<f64>; 8] = Default::default();
    motion.run(&Steps::adaptive(1e-5).count(50), |at| {
        let contact = at.contact(0);
        let numbers = [
            at.time,
            mean(|k| contact.slip_vector(k)[0]),
            -mean(|k| contact.slip_vector(k)[1]),
            mean(|k| contact.slip_velocity(k)[0]).abs().log10(),
            mean(|k| contact.slip_velocity(k)[1]).abs().log10(),
            mean(|k| contact.traction(k)[0]) / 1e6,
            -mean(|k| contact.traction(k)[1]) / 1e6,
            mean(|k| contact.state(k)) / std::f64::consts::LN_10,
        ];
        rows.iter_mut()
            .zip(numbers)
            .for_each(|(row, number)| row.push(number));
        station.record(&at)
    })?;
    let read = parse(&station.finish()?)?;
    let names = "t slip_2 slip_3 slip_rate_2 slip_rate_3 shear_stress_2 shear_stress_3 state";
    assert_eq!(read.names().join(" "), names);
    let location = "on fault, -1.25 km along strike, 2 km down dip";
    assert_eq!(read.metadata("location"), Some(location));
    for (n, (found, expected)) in read.columns().iter().zip(&rows).enumerate() {
        assert!(agree(found, expected), "{n}");
    }
    // Driven along strike and up dip.
    let last = |n: usize| rows[n].last().copied().unwrap_or(f64::NAN);
    assert!(last(1) > 0.0 && last(2) < 0.0);
    Ok(())
}

/// One component of slip up dip is component 3, and component 2 is at rest.
#[test]
fn a_fixed_rake_has_components() -> Outcome {
    let fault = plane()?.with_rake(90.0)?;
    let mut motion = motion(&fault, SVector::from([28e6]))?;
    let at = motion.snapshot();
    let station = SeasStation::new(&at, 0, POINT, &header(), Vec::new())?.along(fault.directions());
    motion.run(&Steps::adaptive(1e-5).count(20), |_| ())?;
    let at = motion.snapshot();
    let station = station.with_start(&at);
    let read = parse(&station.finish()?)?;
    let contact = at.contact(0);
    let slip = mean(|k| contact.slip(k));
    assert!(slip > 0.0 && agree(&read.columns()[2], &[-slip]));
    assert!(read.columns()[1][0].abs() < 1e-15 * slip);
    assert_eq!(read.columns()[3], [-20.0]);
    Ok(())
}

#[test]
fn slip_along_strike_and_down_dip() -> Outcome {
    let mut motion = motion(&plane()?, Vector2::new(27e6, 9e6))?;
    motion.run(&Steps::adaptive(1e-5).count(20), |_| ())?;
    let at = motion.snapshot();
    let points = [-2.5e3, 0.5e3].map(|x| SeasPoint::Plane([x, 1.5e3]));
    let strike = SeasProfile::new(&at, 0, &points, &header(), Vec::new())?.with_start(&at);
    let strike = parse(&strike.finish()?)?;
    let points = [0.5e3, 2.5e3].map(|y| SeasPoint::Plane([0.5e3, y]));
    let dip = SeasProfile::new(&at, 0, &points, &header(), Vec::new())?.down_dip();
    let dip = dip.with_start(&at);
    let dip = parse(&dip.finish()?)?;
    assert_eq!(strike.positions(), Some(&[-2.5e3, 0.5e3][..]));
    assert_eq!(strike.names()[2], "slip_2");
    assert_eq!(dip.positions(), Some(&[0.5e3, 2.5e3][..]));
    assert_eq!(dip.names()[2], "slip_3");
    let contact = at.contact(0);
    for (n, cell) in [6, 9].into_iter().enumerate() {
        assert!(agree(
            &strike.columns()[2 + n],
            &[contact.slip_vector(cell)[0]]
        ));
    }
    for (n, cell) in [3, 15].into_iter().enumerate() {
        assert!(agree(
            &dip.columns()[2 + n],
            &[-contact.slip_vector(cell)[1]]
        ));
    }
    Ok(())
}
