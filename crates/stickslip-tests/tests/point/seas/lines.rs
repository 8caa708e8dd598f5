//! Faults along lines: stations, global files, slip.

use std::ops::ControlFlow;

use stickslip::bie::{Cells, DippingFault, Medium, Sense};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::nalgebra::Vector1;
use stickslip::problems::bp1;
use stickslip::record::{SeasGlobal, SeasPoint, SeasProfile, SeasStation};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{Contact, RungeKutta, Scene, Snapshot, Steps};

use super::{YEAR, agree, bp1_cycle, header, parse};
use crate::Outcome;

/// At a depth between cells 7 and 8 of 1 km: time, slip, log10 V, stress in MPa, log10 theta.
fn expected(at: &Snapshot<'_, 1>, share: f64) -> [f64; 5] {
    let contact = at.contact(0);
    let between = |value: &dyn Fn(usize) -> f64| (1.0 - share) * value(7) + share * value(8);
    [
        at.time,
        between(&|k| contact.slip(k)),
        between(&|k| contact.slip_rate(k)).log10(),
        between(&|k| contact.traction(k)[0]) / 1e6,
        between(&|k| contact.state(k).exp().log10()),
    ]
}

#[test]
fn a_station_is_between_cells() -> Outcome {
    let mut cycle = bp1_cycle(1e3)?;
    let at = cycle.snapshot();
    let mut station =
        SeasStation::new(&at, 0, SeasPoint::Line(7.8e3), &header(), Vec::new())?.with_start(&at);
    let mut rows = vec![expected(&at, 0.3)];
    cycle.run(&Steps::adaptive(1e-4).until(30.0 * YEAR), |at| {
        rows.push(expected(&at, 0.3));
        station.record(&at)
    })?;
    let read = parse(&station.finish()?)?;
    let names = ["t", "slip", "slip_rate", "shear_stress", "state"];
    assert_eq!(read.names(), names);
    assert_eq!(read.metadata("problem"), Some("SEAS Benchmark BP1-QD"));
    assert_eq!(read.metadata("modeler"), Some("J. Rice"));
    assert_eq!(read.metadata("location"), Some("on fault, 7.8 km down dip"));
    assert!(rows.len() > 50 && read.len() == rows.len());
    for (n, name) in names.into_iter().enumerate() {
        let expected: Vec<f64> = rows.iter().map(|row| row[n]).collect();
        let found = read.column(name).ok_or(name)?;
        assert!(agree(found, &expected), "{name}");
    }
    Ok(())
}

/// At both ends the values of the last cell, at the centre of a cell its own.
#[test]
fn stations_reach_to_the_ends() -> Outcome {
    let mut cycle = bp1_cycle(1e3)?;
    cycle.run(&Steps::adaptive(1e-4).until(5.0 * YEAR), |_| ())?;
    let at = cycle.snapshot();
    for (depth, cell) in [(0.0, 0), (200.0, 0), (16.5e3, 16), (39.9e3, 39), (40e3, 39)] {
        let point = SeasPoint::Line(depth);
        let station = SeasStation::new(&at, 0, point, &header(), Vec::new())?.with_start(&at);
        let read = parse(&station.finish()?)?;
        let slip = read.column("slip").ok_or("no slip")?;
        assert_eq!(slip, [at.contact(0).slip(cell)], "{depth}");
    }
    Ok(())
}

#[test]
fn the_moment_rate_is_that_of_all_cells() -> Outcome {
    let mut cycle = bp1_cycle(1e3)?;
    let (at, modulus) = (cycle.snapshot(), bp1::MEDIUM.shear_modulus);
    let mut global = SeasGlobal::new(&at, 0, modulus, &header(), Vec::new())?;
    let mut shallow = SeasGlobal::new(&at, 0, modulus, &header(), Vec::new())?
        .moment_within(&at, |[depth, ..]| depth < 18e3);
    let mut rows: [Vec<f64>; 3] = Default::default();
    let mut above = Vec::new();
    cycle.run(&Steps::adaptive(1e-4).until(30.0 * YEAR), |at| {
        let contact = at.contact(0);
        let sum = |count: usize| (0..count).map(|k| contact.slip_rate(k)).sum::<f64>();
        rows[0].push(at.time);
        rows[1].push(contact.max_slip_rate().log10());
        rows[2].push(modulus * 1e3 * sum(40));
        above.push(modulus * 1e3 * sum(18));
        global.record(&at)?;
        shallow.record(&at)
    })?;
    let (read, shallow) = (parse(&global.finish()?)?, parse(&shallow.finish()?)?);
    assert_eq!(read.names(), ["t", "max_slip_rate", "moment_rate"]);
    for (found, expected) in read.columns().iter().zip(&rows) {
        assert!(agree(found, expected));
    }
    assert!(agree(&shallow.columns()[2], &above));
    Ok(())
}

#[test]
fn slip_on_a_line_has_its_positions() -> Outcome {
    let mut cycle = bp1_cycle(1e3)?;
    let depths = [0.0, 3e3, 7.25e3, 16.5e3];
    let at = cycle.snapshot();
    let points = depths.map(SeasPoint::Line);
    let mut slip = SeasProfile::new(&at, 0, &points, &header(), Vec::new())?
        .at_intervals(1e-2, [2.0 * YEAR, 1.0])?;
    let mut rows = Vec::new();
    cycle.run(&Steps::adaptive(1e-4).until(30.0 * YEAR), |at| {
        let contact = at.contact(0);
        let last = rows
            .last()
            .map_or(f64::NEG_INFINITY, |row: &[f64; 6]| row[0]);
        if at.time - last >= 2.0 * YEAR {
            let s = |k| contact.slip(k);
            let rate = contact.max_slip_rate().log10();
            let [a, b] = [0.5 * (s(2) + s(3)), 0.25 * s(6) + 0.75 * s(7)];
            rows.push([at.time, rate, s(0), a, b, s(16)]);
        }
        slip.record(&at)
    })?;
    let read = parse(&slip.finish()?)?;
    assert_eq!(read.positions(), Some(&depths[..]));
    assert_eq!(read.names(), ["t", "max_slip_rate", "slip"]);
    assert!(read.len() > 5 && read.columns().len() == 6);
    for (n, found) in read.columns().iter().enumerate() {
        let expected: Vec<f64> = rows.iter().map(|row| row[n]).collect();
        assert!(agree(found, &expected), "{n}");
    }
    Ok(())
}

/// Shear stress at the rows of slip, in MPa, between the centres of cells.
#[test]
fn shear_stress_on_a_line_is_read_back() -> Outcome {
    let mut cycle = bp1_cycle(1e3)?;
    let depths = [0.0, 3e3, 7.25e3];
    let at = cycle.snapshot();
    let points = depths.map(SeasPoint::Line);
    let profile = || -> Outcome<_> {
        let profile = SeasProfile::new(&at, 0, &points, &header(), Vec::new())?;
        Ok(profile.at_intervals(1e-2, [YEAR, 1.0])?)
    };
    let (mut slip, mut stress) = (profile()?, profile()?.shear_stress());
    let normal = profile()?.normal_stress().with_start(&at);
    let mut rows = Vec::new();
    cycle.run(&Steps::adaptive(1e-4).until(20.0 * YEAR), |at| {
        let contact = at.contact(0);
        let s = |k: usize| contact.traction(k)[0] / 1e6;
        let stresses = [s(0), 0.5 * (s(2) + s(3)), 0.25 * s(6) + 0.75 * s(7)];
        rows.push((at.time, stresses));
        slip.record(&at)?;
        stress.record(&at)
    })?;
    let (slip, read) = (parse(&slip.finish()?)?, parse(&stress.finish()?)?);
    assert_eq!(read.positions(), Some(&depths[..]));
    assert_eq!(read.names(), ["t", "max_slip_rate", "shear_stress"]);
    assert_eq!(read.columns()[..2], slip.columns()[..2]);
    assert!(read.len() > 10);
    for (n, time) in read.columns()[0].iter().enumerate() {
        let row = rows.iter().find(|row| row.0 == *time).ok_or("no step")?;
        let found: Vec<f64> = (2..5).map(|c| read.columns()[c][n]).collect();
        assert!(agree(&found, &row.1), "{found:?}");
    }
    let normal = parse(&normal.finish()?)?;
    assert_eq!(normal.names()[2], "normal_stress");
    assert!(agree(&normal.columns()[4], &[50.0]));
    Ok(())
}

/// A thrust fault: the normal stress between the cells follows slip, as in BP3.
#[test]
fn a_dipping_fault_has_a_normal_stress() -> Outcome {
    let cells = Cells::new([0.0, 10e3], 10)?;
    let rock = Medium {
        shear_modulus: 32e9,
        shear_wave_speed: 3464.0,
    };
    let fault = DippingFault::new(cells, rock, 0.25, 60.0, Sense::Thrust)?;
    let law = RegularizedDieterichRuina {
        a: 0.025,
        ..bp1::friction(0.0)
    };
    let contact = Contact::new(&fault, law, 50e6)
        .with_state(
            Dieterich {
                slip_distance: 8e-3,
            },
            LogTheta(15.9),
        )
        .with_shear_stress(Vector1::new(30e6));
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_normal_stress_change(fault.normal_stiffness(), Vector1::new(1e-9))
        .with_contact(contact);
    let mut motion = RungeKutta::new(scene)?;
    let at = motion.snapshot();
    let mut station = SeasStation::new(&at, 0, SeasPoint::Line(2e3), &header(), Vec::new())?
        .with_normal_stress()
        .with_log10_state(|alpha| 2.0 * alpha);
    let mut rows: [Vec<f64>; 2] = Default::default();
    motion.run(&Steps::adaptive(1e-6).count(40), |at| {
        let contact = at.contact(0);
        let mean = |value: &dyn Fn(usize) -> f64| 0.5 * (value(1) + value(2));
        rows[0].push(mean(&|k| contact.normal_stress(k)) / 1e6);
        rows[1].push(mean(&|k| 2.0 * contact.state(k)));
        station.record(&at)?;
        ControlFlow::Continue(())
    })?;
    let read = parse(&station.finish()?)?;
    assert_eq!(
        read.names()[3..],
        ["shear_stress", "normal_stress", "state"]
    );
    assert!(agree(&read.columns()[4], &rows[0]) && agree(&read.columns()[5], &rows[1]));
    assert!(rows[0].iter().any(|stress| (stress - 50.0).abs() > 1e-9));
    Ok(())
}
