//! The laws on a command line.

use clap::ValueEnum;
use serde::Serialize;
use stickslip::friction::{
    DieterichRuina, FrictionLaw, RegularizedDieterichRuina, StateDependentTresca, Tresca,
};
use stickslip::problems::spring_slider::{SpringScene, SpringSlider, steady_state};
use stickslip::state::{
    Discontinuous, KatoTullis, LogTheta, PerrinRiceZheng, Sato, StateLaw, Theta,
};
use stickslip::{BoundaryPart, Contact, NormalStress, Operator, Scene};

use crate::cli::Problem;

/// The state law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Law {
    /// The aging law: contacts age at rest
    Dieterich,
    /// The slip law: contacts change only by slip
    Ruina,
    /// Perrin, Rice and Zheng: aging with a square, steady state 2L/V; friction uses 2L as slip distance
    PerrinRiceZheng,
    /// Kato and Tullis: aging below 1e-8 m/s, slip above
    KatoTullis,
    /// Sato, Nakatani and Ando: aging below a hundredth of the steady state, slip above
    Sato,
    /// A discontinuous law
    Discontinuous,
    /// No state
    None,
}

/// The coefficient of friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Friction {
    /// Rate and state, cut off at zero
    DieterichRuina,
    /// Rate and state, regularised by asinh
    Regularized,
    /// State alone; constant without one
    #[value(alias = "coulomb")]
    Tresca,
}

impl Law {
    /// The map from the state variable of the law to `ln(theta / 1 s)`; NaN without a state.
    pub fn log_theta(self) -> fn(f64) -> f64 {
        match self {
            Law::Dieterich | Law::Ruina | Law::PerrinRiceZheng | Law::KatoTullis | Law::Sato => {
                |alpha| alpha
            }
            Law::Discontinuous => f64::ln,
            Law::None => |_| f64::NAN,
        }
    }
}

/// The surface of a contact.
pub enum Surface {
    /// A part of the boundary, on a rigid surface.
    Rigid(BoundaryPart),
    /// The plus and the minus side of a fault inside the body.
    Sides(Box<[BoundaryPart; 2]>),
}

impl Surface {
    fn contact<L: FrictionLaw, const C: usize>(
        self,
        law: L,
        (stress, opens): (NormalStress, bool),
    ) -> Contact<L, (), C> {
        let contact = match self {
            Self::Rigid(part) => Contact::new(part, law, stress),
            Self::Sides(sides) => {
                let [plus, minus] = *sides;
                Contact::between(plus, minus, law, stress)
            }
        };
        if opens {
            contact.allow_opening()
        } else {
            contact
        }
    }
}

/// Laws of a contact, chosen at run time.
pub struct Laws {
    /// The state law.
    pub law: Law,
    /// The friction law.
    pub friction: Friction,
    /// The parameters, of which each law takes its own.
    pub parameters: DieterichRuina,
}

impl Laws {
    /// Derives a missing law from the other one; refuses friction without the state it needs.
    pub fn new(
        law: Option<Law>,
        friction: Option<Friction>,
        parameters: DieterichRuina,
    ) -> Result<Self, Problem> {
        let friction = friction.unwrap_or(match law {
            Some(Law::None) => Friction::Tresca,
            _ => Friction::DieterichRuina,
        });
        let law = law.unwrap_or(match friction {
            Friction::Tresca => Law::None,
            _ => Law::Dieterich,
        });
        if law == Law::None && friction != Friction::Tresca {
            return Err("--friction by rate and state needs a state, --law none has none".into());
        }
        Ok(Self {
            law,
            friction,
            parameters,
        })
    }

    /// The friction law that reads a state.
    pub fn friction(&self) -> Box<dyn FrictionLaw<State = LogTheta>> {
        let mut parameters = self.parameters;
        if self.law == Law::PerrinRiceZheng {
            parameters.slip_distance *= 2.0;
        }
        match self.friction {
            Friction::DieterichRuina => Box::new(parameters),
            Friction::Regularized => Box::new(RegularizedDieterichRuina::from(parameters)),
            Friction::Tresca => Box::new(StateDependentTresca::from(parameters)),
        }
    }

    /// The friction law without a state.
    fn tresca(&self) -> Tresca {
        let coefficient = self.parameters.reference_friction;
        Tresca { coefficient }
    }

    /// The law of `ln theta`; the aging law if the law integrates another variable.
    pub fn evolution(&self) -> Box<dyn StateLaw<State = LogTheta>> {
        let slip_distance = self.parameters.slip_distance;
        match self.law {
            Law::Ruina => Box::new(self.parameters.slip()),
            Law::PerrinRiceZheng => Box::new(PerrinRiceZheng { slip_distance }),
            Law::KatoTullis => Box::new(KatoTullis {
                slip_distance,
                aging_velocity: 1e-8,
            }),
            Law::Sato => Box::new(Sato::new(slip_distance)),
            _ => Box::new(self.parameters.aging()),
        }
    }

    /// Adds a contact with a rigid surface by these laws, from the state `ln(theta / 1 s)`.
    pub fn on<Op: Operator<C>, const C: usize>(
        &self,
        scene: Scene<Op, C>,
        part: impl Into<BoundaryPart>,
        stress: f64,
        alpha: LogTheta,
    ) -> Scene<Op, C> {
        self.on_surface(
            scene,
            Surface::Rigid(part.into()),
            (stress.into(), false),
            alpha,
        )
    }

    /// Adds a contact on a surface by these laws, from the state `ln(theta / 1 s)`; with its normal stress, and whether
    /// tension opens it.
    pub fn on_surface<Op: Operator<C>, const C: usize>(
        &self,
        scene: Scene<Op, C>,
        surface: Surface,
        stress: (NormalStress, bool),
        alpha: LogTheta,
    ) -> Scene<Op, C> {
        if self.law == Law::None {
            return scene.with_contact(surface.contact(self.tresca(), stress));
        }
        let contact = surface.contact(self.friction(), stress);
        match self.law {
            Law::Discontinuous => {
                scene.with_contact(contact.with_state(Discontinuous, Theta::from(alpha)))
            }
            _ => scene.with_contact(contact.with_state(self.evolution(), alpha)),
        }
    }

    /// A block on a spring by these laws, with an initial slip rate and state, or the state of steady sliding at the
    /// velocity of the load.
    pub fn spring(
        &self,
        slider: &SpringSlider,
        slip_rate: f64,
        theta: Option<Theta>,
    ) -> Result<SpringScene, Problem> {
        let load_velocity = slider.load.velocity(0.0);
        Ok(match self.law {
            Law::None => slider.scene(self.tresca(), (), slip_rate, ())?,
            Law::Discontinuous => {
                let steady = || steady_state(&Discontinuous, load_velocity);
                let state = theta.map_or_else(steady, Ok)?;
                slider.scene(self.friction(), Discontinuous, slip_rate, state)?
            }
            _ => {
                let law = self.evolution();
                let state = match theta {
                    Some(theta) => theta.into(),
                    None => steady_state(&law, load_velocity)?,
                };
                slider.scene(self.friction(), law, slip_rate, state)?
            }
        })
    }
}
