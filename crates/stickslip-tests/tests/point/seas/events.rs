//! An event of BP1: catalogue, rupture front and files agree.

use std::ops::ControlFlow;

use stickslip::Steps;
use stickslip::problems::bp1;
use stickslip::record::{
    Event, EventCatalogue, RuptureTimes, SeasGlobal, SeasPoint, SeasProfile, Table,
};

use super::{YEAR, agree, bp1_cycle, header, parse};
use crate::Outcome;

const RATES: [f64; 2] = [1e-2, 1e-3];

#[test]
fn an_event_has_a_moment_a_hypocentre_and_a_front() -> Outcome {
    let mut cycle = bp1_cycle(200.0)?;
    let (at, modulus) = (cycle.snapshot(), bp1::MEDIUM.shear_modulus);
    let mut catalogue = EventCatalogue::new(&at, 0, RATES, modulus, 4)?;
    let mut front = RuptureTimes::new(&at, 0, RATES)?;
    let mut global = SeasGlobal::new(&at, 0, modulus, &header(), Vec::new())?;
    let points = [5e3, 12.5e3].map(SeasPoint::Line);
    let mut slip = SeasProfile::new(&at, 0, &points, &header(), Vec::new())?
        .at_intervals(1e-2, [5.0 * YEAR, 1.0])?;
    cycle.run(&Steps::adaptive(1e-4).until(230.0 * YEAR), |at| {
        catalogue.record(&at);
        front.record(&at);
        slip.record(&at)?;
        global.record(&at)?;
        if catalogue.events().is_empty() {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    })?;
    let event = catalogue.events().first().ok_or("no event")?;
    let rupture = front.events().first().ok_or("no rupture")?;
    // The first vertex to pass the threshold.
    assert_eq!(event.onset, rupture.onset);
    assert_eq!(rupture.times[event.origin], 0.0);
    assert_eq!(
        event.hypocentre,
        [200.0 * (event.origin as f64 + 0.5), 0.0, 0.0]
    );
    let reached = rupture.times.iter().filter(|time| **time < 1e9);
    assert_eq!(reached.clone().count(), event.vertices);
    assert!(
        reached
            .clone()
            .all(|time| (0.0..event.arrest - event.onset).contains(time))
    );
    // The front runs from the hypocentre to the surface.
    let shallow = &rupture.times[..event.origin];
    assert!(shallow[0] > 1.0 && shallow.windows(2).all(|pair| pair[0] > pair[1] - 0.5));

    let file = front.write(rupture, &header(), Vec::new())?;
    let read = parse(&file)?;
    assert_eq!(read.names(), ["z", "t"]);
    assert!(agree(&read.columns()[1], &rupture.times));
    assert_eq!(read.columns()[0][3], 700.0);

    // The moment is the integral of the moment rate, up to creep outside of the rupture and the trapezoidal rule.
    let read = parse(&global.finish()?)?;
    let (times, rates) = (&read.columns()[0], &read.columns()[2]);
    let steps = times.windows(2).zip(rates.windows(2));
    let moment: f64 = steps
        .filter(|(times, _)| times[0] >= event.onset)
        .map(|(times, rates)| 0.5 * (times[1] - times[0]) * (rates[0] + rates[1]))
        .sum();
    assert!(
        (moment / event.moment - 1.0).abs() < 0.02,
        "{moment:e} {:e}",
        event.moment
    );
    let sum = event.mean_slip * event.area * modulus;
    assert!((event.moment / sum - 1.0).abs() < 1e-12);

    // Rows of slip are a second apart in the event, and 5 years between events.
    let read = parse(&slip.finish()?)?;
    let times = &read.columns()[0];
    let within = times.iter().filter(|time| **time > event.onset).count();
    assert!(
        within > 10 && times.len() - within < 60,
        "{within} of {}",
        times.len()
    );

    let mut table = Table::new(Vec::new(), &Event::COLUMNS)?;
    table.row(event.entries())?;
    let read = parse(&table.finish()?)?;
    let found = read
        .columns()
        .iter()
        .map(|column| column[0])
        .collect::<Vec<_>>();
    let names = Event::COLUMNS;
    let at = |name: &str| {
        names
            .iter()
            .position(|found| *found == name)
            .map(|n| found[n])
    };
    assert_eq!(at("moment"), Some(event.moment));
    assert_eq!(at("hypocentre_x"), Some(event.hypocentre[0]));
    assert_eq!(at("arrest"), Some(event.arrest));
    Ok(())
}

/// An event in progress at the start begins there, and a finished one can be handed over.
#[test]
fn an_event_can_be_in_progress_at_the_start() -> Outcome {
    let mut cycle = bp1_cycle(1e3)?;
    // All cells slip at 1e-9 m/s at first, and the deep ones go on.
    let mut front = RuptureTimes::new(&cycle.snapshot(), 0, [0.9e-9, 0.8e-9])?;
    let first = front.under_way().ok_or("no event")?;
    assert!(first.onset == 0.0 && first.times.iter().all(|time| *time == 0.0));
    cycle.run(&Steps::adaptive(1e-4).until(YEAR), |at| front.record(&at))?;
    assert!(front.events().is_empty() && front.take().is_empty());
    let rupture = front.under_way().ok_or("no event")?;
    let read = parse(&front.write(rupture, &header(), Vec::new())?)?;
    assert!(read.columns()[1].iter().all(|time| *time == 0.0));
    Ok(())
}
