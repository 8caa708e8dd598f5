//! Laws of one's own, those of the examples: their contracts, and what is known of them in a spring
//! slider and in the 2D slider.

mod contracts;
#[path = "../../own_laws/perrin_rice_zheng.rs"]
mod perrin_rice_zheng;
mod slider;
#[path = "../../own_laws/soft_cutoff.rs"]
mod soft_cutoff;
mod spring;

use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::{AGING, FRICTION, INITIAL_LOG_THETA};
use stickslip::state::{LogTheta, Theta};

use perrin_rice_zheng::PerrinRiceZheng;
use soft_cutoff::SoftCutoff;

const OWN_STATE: PerrinRiceZheng = PerrinRiceZheng {
    slip_distance: AGING.slip_distance,
};
/// Friction that compares contacts with `2L/V0`, the age of steady ones by the law above.
const OF_OWN_STATE: DieterichRuina = DieterichRuina {
    slip_distance: 2.0 * AGING.slip_distance,
    ..FRICTION
};
const OWN_FRICTION: SoftCutoff = SoftCutoff(FRICTION);
const ALPHA: LogTheta = LogTheta(INITIAL_LOG_THETA);
/// `2 exp(ALPHA)`: the same initial friction.
const THETA: Theta = Theta(2.0 * 4.539_992_976_248_485e-5);
