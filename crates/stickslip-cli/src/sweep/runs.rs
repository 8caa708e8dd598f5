//! A body that is reduced once, and a run on it for each law.

use super::{Arguments, Seen};
use crate::cli::Problem;
use crate::onsets::Onsets;
use stickslip::fem::P1;
use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::{
    END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::reduced::{Reduced, ReducedBody};
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, Contact, DenseNewton, Newmark, Scene, SceneError, Simulation, Steps, Symmetric,
};

/// The slip rates [m/s] for the start and the end of an event.
const EVENT: (f64, f64) = (1e-3, 2e-4);

/// Data shared by all runs.
pub struct Runs {
    slider: PippingSlider,
    space: P1<2>,
    body: ReducedBody<2>,
    middle: usize,
    plan: Steps,
}

fn scene(
    slider: &PippingSlider,
    space: &P1<2>,
    law: DieterichRuina,
) -> Result<Scene<BlockMatrix<2>, 2>, SceneError> {
    let contact = Contact::new(&PippingSlider::bottom(space)?, law, NORMAL_STRESS);
    let contact = contact.with_state(law.aging(), LogTheta(INITIAL_LOG_THETA));
    Ok(slider.scene(space)?.with_contact(contact))
}

impl Runs {
    /// Reduces the body.
    pub fn new(arguments: &Arguments) -> Result<Self, Problem> {
        let slider = PippingSlider {
            refinements: arguments.refinements.into(),
            ..PippingSlider::default()
        };
        let space = slider.space()?;
        let whole = scene(&slider, &space, FRICTION)?;
        let body: ReducedBody<2> = Reduced::new(&whole).up_to_frequency(arguments.frequency)?;
        let middle = PippingSlider::centre(&space).and_then(|vertex| body.vertex(vertex));
        let middle = middle.ok_or("the mesh has no vertex at the middle of the bottom")?;
        let steps = arguments.steps.get();
        let plan = Steps::constant(END / steps as f64).count(steps);
        Ok(Self {
            slider,
            space,
            body,
            middle,
            plan: if arguments.no_bridging {
                plan.without_substeps()
            } else {
                plan
            },
        })
    }

    /// Takes the run of a law as far as it goes.
    pub fn take(&self, law: DieterichRuina) -> Seen {
        let scene = scene(&self.slider, &self.space, law);
        self.follow(scene.and_then(|scene| self.body.reduce(scene)))
    }

    fn follow(&self, scene: Result<Scene<Symmetric<2>, 2>, SceneError>) -> Seen {
        let (mut events, mut peak_slip_rate) = (Onsets::new(EVENT.0, EVENT.1), 0.0_f64);
        let run =
            scene.and_then(|scene| Simulation::new(scene, Newmark::default(), DenseNewton::new()));
        let ended = match run {
            Err(error) => Err(error.to_string()),
            Ok(mut run) => {
                let ended = run.run(&self.plan, |at| {
                    events.record(at.time, at.velocity[self.middle].norm());
                    peak_slip_rate = peak_slip_rate.max(at.max_slip_rate());
                });
                ended.map_err(|failure| failure.to_string())
            }
        };
        Seen {
            events: events.times().to_vec(),
            peak_slip_rate,
            lost: ended.err(),
        }
    }
}
