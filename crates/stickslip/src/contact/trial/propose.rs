//! The states that slip rates leave behind.

use stickslip_solvers::gather_contact;
use stickslip_state::StateError;

use super::Trial;
use crate::laws::Followed;

/// A slip rate without a proposal: the state law has no solution there, or a value is not finite.
pub(crate) enum Refused {
    State(StateError),
    Value(Followed),
}

impl Trial {
    /// Proposes the states of slip rates; writes their distances from those in use to `changes`. An error carries its
    /// place in the contact.
    pub(crate) fn propose(
        &mut self,
        rates: &[f64],
        changes: &mut [f64],
    ) -> Result<(), (usize, Refused)> {
        let mut proposed = std::mem::take(&mut self.proposed);
        let mut slopes = std::mem::take(&mut self.slopes);
        let fields = (changes, &mut proposed[..], &mut slopes[..]);
        let refused = gather_contact(
            rates.len(),
            fields,
            &|places, (changes, proposed, slopes)| {
                let rates = &rates[places.clone()];
                let to = changes.iter_mut().zip(proposed).zip(slopes);
                for ((k, &rate), ((change, proposed), slope)) in places.zip(rates).zip(to) {
                    let followed = match self.followed(k, rate) {
                        Ok(followed) => followed,
                        Err(source) => return Some((k, Refused::State(source))),
                    };
                    if !(followed.state.is_finite() && followed.coefficient.is_finite()) {
                        return Some((k, Refused::Value(followed)));
                    }
                    *change = followed.state - self.states[k];
                    *proposed = followed.state;
                    *slope = (rate, followed.rate_slope);
                }
                None
            },
            &|first: Option<_>, second| first.or(second),
        );
        (self.proposed, self.slopes) = (proposed, slopes);
        refused.map_or(Ok(()), Err)
    }
}
