//! Checkpoints of a body: pieces are the whole run, and another body is refused.

use std::fs;
use std::path::PathBuf;

use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::record::{EnergyLedger, EventCatalogue, FileError};
use stickslip::state::LogTheta;
use stickslip::{
    Checkpoint, Contact, GeneralizedAlpha, Newmark, RateScheme, Sdirk2, Simulation, Steps,
};

use crate::Outcome;
use crate::common::{Sliding, Solver, body};

/// So little that the slider slides after a second \[Pa\].
const LIGHT: f64 = 0.03 * NORMAL_STRESS;

fn slider(body: &PippingSlider, stress: f64, scheme: Box<dyn RateScheme>) -> Outcome<Sliding> {
    let space = body.space()?;
    let contact = Contact::new(&PippingSlider::bottom(&space)?, FRICTION, stress);
    let scene = body
        .scene(&space)?
        .with_contact(contact.with_state(AGING, LogTheta(INITIAL_LOG_THETA)));
    Ok(Simulation::new(
        scene,
        scheme,
        Solver::Condensed.on(&space),
    )?)
}

fn file(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("stickslip-body-{name}-{}", std::process::id()))
}

fn schemes() -> [Box<dyn RateScheme>; 3] {
    let spectral_radius = 0.8;
    [
        Box::new(Newmark::default()),
        Box::new(GeneralizedAlpha { spectral_radius }),
        Box::new(Sdirk2),
    ]
}

#[test]
fn pieces_of_a_body_are_the_whole_run() -> Outcome {
    // Accelerations are found anew in it, at kinks and where vertices come to rest.
    let body = PippingSlider {
        recurrent: false,
        ..body(1)
    };
    let plans = [
        Steps::constant(4e-3).until(2.0).stopping_at([1.333]),
        Steps::adaptive(1e-2).with_first_step(1e-3).until(1.6),
    ];
    let (whole, piece) = (Checkpoint::at(file("whole")), Checkpoint::at(file("piece")));
    for k in 0..schemes().len() {
        for plan in &plans {
            let make = || slider(&body, LIGHT, schemes().into_iter().nth(k).ok_or("none")?);
            let mut through = make()?;
            let at = through.snapshot();
            let mut ledger = EnergyLedger::new(&at);
            let mut events = EventCatalogue::new(&at, 0, [1e-6, 1e-7], 1e7, 0)?;
            piece.save(&at, &(&ledger, &events))?;
            let all = through.run(plan, |at| {
                ledger.record(&at);
                events.record(&at);
            })?;
            assert!(!events.events().is_empty() || events.is_under_way());
            whole.save(&through.snapshot(), &(ledger, events))?;
            let (every, mut taken) = (all.accepted / 4, 0);
            while taken < all.accepted {
                let mut next = make()?;
                let (mut ledger, mut events): (EnergyLedger<2>, EventCatalogue<2>) =
                    piece.restore(&mut next)?;
                let report = next.run(&plan.clone().count(every), |at| {
                    ledger.record(&at);
                    events.record(&at);
                })?;
                taken += report.accepted;
                piece.save(&next.snapshot(), &(ledger, events))?;
            }
            assert!(
                fs::read(whole.path())? == fs::read(piece.path())?,
                "{k}: other bits"
            );
        }
    }
    fs::remove_file(whole.path())?;
    fs::remove_file(piece.path())?;
    Ok(())
}

#[test]
fn another_body_is_refused() -> Outcome {
    let newmark = || Box::new(Newmark::default());
    let kept = Checkpoint::at(file("other"));
    kept.save(&slider(&body(1), LIGHT, newmark())?.snapshot(), &())?;
    let density = 1.1 * body(1).density;
    let others = [
        ("the number of vertices", body(2), LIGHT),
        (
            "the mesh",
            PippingSlider {
                mirrored: true,
                ..body(1)
            },
            LIGHT,
        ),
        (
            "the mass matrix",
            PippingSlider {
                density,
                gravity: 0.0,
                ..body(1)
            },
            LIGHT,
        ),
        (
            "the load",
            PippingSlider {
                gravity: 0.0,
                ..body(1)
            },
            LIGHT,
        ),
        ("the normal stress of contact 0", body(1), 1.1 * LIGHT),
    ];
    for (what, body, stress) in others {
        let refused = kept.restore::<(), 2>(&mut slider(&body, stress, newmark())?);
        let Err(FileError::Mismatch {
            kind: "checkpoint",
            what: found,
            ..
        }) = refused
        else {
            return Err(format!("{what}: {refused:?}").into());
        };
        assert_eq!(found, what);
    }
    fs::remove_file(kept.path())?;
    Ok(())
}
