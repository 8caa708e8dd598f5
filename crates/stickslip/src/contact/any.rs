//! Contacts with type-erased laws.

use std::sync::Arc;

use stickslip_friction::FrictionLaw;
use stickslip_state::{Reads, StateLaw};

use super::laws::{ContactLaws, RateAndState};
use super::{Contact, Strength};
use crate::{BoundaryPart, SceneError};

/// A contact with type-erased laws and its initial states, or its error.
#[derive(Clone)]
pub(crate) struct AnyContact<const C: usize> {
    pub(crate) part: BoundaryPart,
    pub(crate) laws: Result<(Arc<dyn ContactLaws>, Vec<f64>), SceneError>,
    pub(crate) strength: Strength<C>,
    pub(crate) bilateral: bool,
}

impl<L, S, const C: usize> From<Contact<L, S, C>> for AnyContact<C>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    fn from(contact: Contact<L, S, C>) -> Self {
        let Contact {
            part,
            friction,
            evolution,
            initial,
            effect,
            strength,
            bilateral,
            sampled,
        } = contact;
        let count = part.vertices.len();
        let laws = RateAndState::new((friction, evolution), &initial, effect, sampled, count);
        Self {
            part,
            laws: laws.map(|(laws, initial)| (Arc::new(laws) as Arc<dyn ContactLaws>, initial)),
            strength,
            bilateral,
        }
    }
}
