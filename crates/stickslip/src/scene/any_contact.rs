//! Contacts with type-erased laws.

use std::sync::Arc;

use stickslip_core::compiled;
use stickslip_friction::{FrictionLaw, Nodal};
use stickslip_state::{Reads, StateLaw, StateVariable};

use super::contact::Contact;
use super::prestress::{StressField, resolve};
use super::sides::{Pairs, Sides};
use super::strength::Strength;
use crate::laws::{ContactLaws, LawProperties, LawsAt, NormalStressEffect, Places, RateAndState};
use crate::{BoundaryPart, SceneError, checks};

/// A contact with type-erased laws and its initial states, or its error.
#[derive(Clone)]
pub(crate) struct AnyContact<const C: usize> {
    pub(crate) part: BoundaryPart,
    pub(crate) laws: Result<ErasedLaws, SceneError>,
    pub(crate) strength: Strength<C>,
    pub(crate) bilateral: bool,
    pub(crate) sides: Sides,
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
            prestress,
            pairs,
            repeated,
        } = contact;
        let count = part.vertices.len();
        let laws = match &pairs {
            None => erase((friction, evolution), &initial, effect, sampled, count),
            Some(Err(error)) => Err(error.clone()),
            Some(Ok(Pairs { places, .. })) => {
                let selected = || {
                    let friction = places.select("friction law", friction)?;
                    let evolution = places.select("state law", evolution)?;
                    let initial = places.select("initial state", initial)?;
                    let effect = effect.map(|effect| effect.at(places)).transpose()?;
                    erase((friction, evolution), &initial, effect, sampled, count)
                };
                selected()
            }
        };
        let given = Given {
            part,
            strength,
            bilateral,
            prestress,
            pairs,
            repeated,
        };
        with_laws(given, laws)
    }
}

/// A contact beside its laws, as it was given.
struct Given<const C: usize> {
    part: BoundaryPart,
    strength: Strength<C>,
    bilateral: bool,
    prestress: Option<StressField>,
    pairs: Option<Result<Pairs, SceneError>>,
    repeated: Option<&'static str>,
}

compiled! {
    fn with_laws<C>(given: Given<C>, laws: Result<ErasedLaws, SceneError>) -> AnyContact<C> {
        let Given {
            part,
            strength: given,
            bilateral,
            prestress,
            pairs,
            repeated,
        } = given;
        let resolved = |mut strength: Strength<C>| {
            let stress = prestress.as_ref();
            stress.map_or(Ok(()), |stress| resolve(stress, &part, &mut strength))?;
            Ok(strength)
        };
        let (strength, sides) = match pairs {
            None => (resolved(given.clone()), Sides::Rigid),
            Some(Err(_)) => (Ok(given.clone()), Sides::Rigid),
            Some(Ok(pairs)) => {
                let strength = given.clone().at(&pairs.places).and_then(resolved);
                (strength, Sides::Two(pairs.minus))
            }
        };
        let (laws, strength) = match strength {
            Ok(strength) => (laws, strength),
            Err(error) => (Err(error), given),
        };
        let laws = match repeated {
            Some(what) => Err(SceneError::Repeated { what }),
            None => laws,
        };
        AnyContact {
            part,
            laws,
            strength,
            bilateral,
            sides,
        }
    }
}

impl<const C: usize> AnyContact<C> {
    /// Keeps some of the vertices.
    pub(crate) fn keep(&mut self, places: Places) -> Result<(), SceneError> {
        let select = |values: &[usize]| places.places.iter().map(|&k| values[k]).collect();
        if let Sides::Two(minus) = &mut self.sides {
            *minus = select(minus);
        }
        self.part = self.part.select(&places.places);
        self.strength = self.strength.clone().at(&places)?;
        self.laws = self.laws.clone().map(|laws| ErasedLaws {
            initial: (places.places.iter()).map(|&k| laws.initial[k]).collect(),
            functions: Arc::new(LawsAt {
                laws: laws.functions,
                places: places.places,
            }),
            ..laws
        });
        Ok(())
    }
}

impl<const C: usize> Strength<C> {
    /// The strength at some of the vertices.
    fn at(self, places: &Places) -> Result<Self, SceneError> {
        let shear = self.shear.map(|shear| places.select("shear stress", shear));
        let forced = (self.forced).map(|forced| places.select("forced rupture", forced));
        let cap = self.cap.map(|cap| places.select("cap of friction", cap));
        Ok(Self {
            normal_stress: places.select("normal stress", self.normal_stress)?,
            source: self.source,
            relaxation: self.relaxation,
            history: self.history.map(|history| history.at(places)),
            opens: self.opens,
            least: self.least,
            largest: self.largest,
            cohesion: places.select("cohesion", self.cohesion)?,
            shear: shear.transpose()?,
            forced: forced.transpose()?,
            cap: cap.transpose()?,
            fields: self.fields,
        })
    }
}

/// The laws of a contact, their properties and their initial states.
#[derive(Clone)]
pub(crate) struct ErasedLaws {
    pub(crate) functions: Arc<dyn ContactLaws>,
    pub(crate) properties: LawProperties,
    pub(crate) initial: Vec<f64>,
}

/// Checks laws and initial states for `count` vertices, with samples if requested, and erases their types.
pub(crate) fn erase<L, S>(
    (friction, evolution): (Nodal<L>, Nodal<S>),
    initial: &Nodal<S::State>,
    effect: Option<NormalStressEffect<S::State>>,
    sampled: bool,
    count: usize,
) -> Result<ErasedLaws, SceneError>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    checks::length("friction law", &friction, count)?;
    checks::length("state law", &evolution, count)?;
    checks::length("initial state", initial, count)?;
    for k in 0..count {
        let state = *initial.at(k);
        friction.at(k).validate()?;
        evolution.at(k).validate()?;
        checks::finite("initial state", k, state.value())?;
        evolution.at(k).validate_state(state)?;
    }
    if let Some(effect) = &effect {
        effect.check(count)?;
    }
    // A contact has no vertex in some processes of several.
    if sampled && count > 0 {
        checks::laws(&friction, &evolution, initial)?;
    }
    let properties = LawProperties {
        has_state: size_of::<S::State>() > 0,
        unchecked: !sampled,
        follows_normal_stress: effect.is_some(),
    };
    let laws = RateAndState::new(friction, evolution, effect);
    Ok(ErasedLaws {
        functions: Arc::new(laws),
        properties,
        initial: (0..count).map(|k| initial.at(k).value()).collect(),
    })
}
