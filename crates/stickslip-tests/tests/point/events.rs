//! Events over runs, at the first sample and at the end of a run; slip and its path.

use stickslip::friction::Tresca;
use stickslip::nalgebra::{SMatrix, Vector1};
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
use stickslip::record::{Event, EventCatalogue};
use stickslip::{
    BoundaryPart, Contact, Newmark, Point, RungeKutta, Scene, Simulation, Snapshot, Steps,
};

use crate::Outcome;

const RATES: [f64; 2] = [1e-4, 1e-5];

/// A block of 1 m^2 on a spring that slips in events.
fn block() -> Outcome<RungeKutta<1>> {
    let slider = SpringSlider {
        stiffness: 2.5e8,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 5e6,
        load: LoadPath::steady(1e-6),
    };
    Ok(RungeKutta::new(slider.steady(FRICTION, AGING, 1.01e-6)?)?)
}

fn catalogue(at: &Snapshot<'_, 1>) -> Outcome<EventCatalogue<1>> {
    Ok(EventCatalogue::new(at, 0, RATES, 3e10, 4)?)
}

/// The plan in pieces of so many steps, each with a catalogue of its own: all their events, those under way included.
fn in_pieces(steps: &Steps, pieces: &[usize]) -> Outcome<Vec<Vec<Event>>> {
    let mut block = block()?;
    let mut found = Vec::new();
    for &count in pieces {
        let mut own = catalogue(&block.snapshot())?;
        block.run(&steps.clone().count(count), |at| own.record(&at))?;
        let under_way = own.under_way(&block.snapshot());
        assert_eq!(under_way.is_some(), own.is_under_way());
        found.push(own.events().iter().copied().chain(under_way).collect());
    }
    Ok(found)
}

/// A run that is cut anywhere, also within events: one catalogue over all pieces finds the events of the whole run, bit
/// for bit, and slip and work of the parts of an event in catalogues of their own are those of the whole one.
#[test]
fn no_event_is_lost_between_runs() -> Outcome {
    let steps = Steps::adaptive(1e-6).until(3000.0);
    let mut whole = block()?;
    let mut all = catalogue(&whole.snapshot())?;
    let (mut count, mut within) = (0, Vec::new());
    whole.run(&steps, |at| {
        all.record(&at);
        count += 1;
        if all.is_under_way() {
            within.push((count, all.events().len()));
        }
    })?;
    let [.., last] = all.events() else {
        return Err("no event".into());
    };
    // Within the last event, by a generator of Knuth's.
    let of_last = within
        .iter()
        .filter(|(_, event)| event + 1 == all.events().len());
    let last_steps: Vec<usize> = of_last.map(|&(step, _)| step).collect();
    let mut seed = 7_u64;
    for _ in 0..6 {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let cut = last_steps[(seed >> 33) as usize % last_steps.len()];
        let mut parted = block()?;
        let mut over_both = catalogue(&parted.snapshot())?;
        for part in [cut, count - cut] {
            let plan = steps.clone().count(part);
            parted.run(&plan, |at| over_both.record(&at))?;
            over_both = over_both.clone();
        }
        assert_eq!(over_both.events(), all.events());

        let pieces = in_pieces(&steps, &[cut, count - cut])?;
        let (Some(first), Some(second)) = (pieces[0].last(), pieces[1].first()) else {
            return Err("a part of the event is lost".into());
        };
        assert!(first.arrest.is_nan() && first.onset == last.onset);
        assert!(second.onset > first.onset && second.arrest == last.arrest);
        let close = |parts: f64, whole: f64| assert!((parts / whole - 1.0).abs() < 1e-9);
        close(first.mean_slip + second.mean_slip, last.mean_slip);
        close(first.moment + second.moment, last.moment);
        close(
            first.friction_work + second.friction_work,
            last.friction_work,
        );
        close(first.stress_drop + second.stress_drop, last.stress_drop);
    }
    Ok(())
}

/// A block that slides when the record begins: the event begins with it, with the slip from there on.
#[test]
fn an_event_at_the_first_sample_begins_there() -> Outcome {
    let mut block = block()?;
    let rate = block.snapshot().max_slip_rate();
    let rates = [0.5 * rate, 0.1 * rate];
    let mut own = EventCatalogue::new(&block.snapshot(), 0, rates, 3e10, 4)?;
    let start = own.under_way(&block.snapshot()).ok_or("no event")?;
    assert_eq!((start.onset, start.peak_slip_rate), (0.0, rate));
    assert_eq!((start.mean_slip, start.vertices), (0.0, 1));
    block.run(&Steps::adaptive(1e-6).until(3000.0), |at| own.record(&at))?;
    let first = own.events().first().ok_or("no event")?;
    assert_eq!(first.onset, 0.0);
    assert!(first.arrest > 0.0 && first.mean_slip > 0.0);
    // The next one begins after it.
    let later = own.events().get(1).map(|event| event.onset);
    assert!(later.is_none_or(|onset| onset > first.arrest));
    Ok(())
}

/// A block that rings: Coulomb friction `F` takes `2 F/k` from the amplitude in each half period, until the spring cannot
/// overcome it. Slip is the distance from the start, the path what the block has gone, and friction works along the path.
#[test]
fn slip_is_the_distance_and_its_path_is_longer() -> Outcome {
    let (stiffness, mass, amplitude) = (1e6, 1e3, 1e-2);
    let friction = 0.1 * 7e3;
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_mass(SMatrix::<f64, 1, 1>::new(mass))
        .with_displacement(vec![Vector1::new(amplitude)])
        .with_contact(Contact::new(
            BoundaryPart::point(1.0),
            Tresca { coefficient: 0.1 },
            7e3,
        ));
    let mut block = Simulation::new(scene, Newmark::default(), Point)?;
    let mut events = EventCatalogue::new(&block.snapshot(), 0, [1e-6, 1e-9], 1.0, 4)?;
    let half = std::f64::consts::PI * f64::sqrt(mass / stiffness);
    block.run(&Steps::constant(half / 2000.0).count(20_000), |at| {
        events.record(&at)
    })?;
    let (mut place, mut path) = (amplitude, 0.0);
    while stiffness * f64::abs(place) > friction {
        let next = -place.signum() * (f64::abs(place) - 2.0 * friction / stiffness);
        path += f64::abs(next - place);
        place = next;
    }
    let at = block.snapshot();
    let contact = at.contact(0);
    assert_eq!(at.velocity[0][0], 0.0);
    assert_eq!(contact.slip(0), (at.displacement[0][0] - amplitude).abs());
    assert!((contact.slip(0) - (place - amplitude).abs()).abs() < 1e-4 * amplitude);
    assert!((contact.slip_path(0) / path - 1.0).abs() < 1e-3);
    assert!(path > 5.0 * (place - amplitude).abs());
    // One event or one for each half period, whose slips are distances and whose work is along the path.
    let work: f64 = events
        .events()
        .iter()
        .map(|event| event.friction_work)
        .sum();
    assert!((work / (friction * path) - 1.0).abs() < 1e-3, "{work:e}");
    Ok(())
}
