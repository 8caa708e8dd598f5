//! State laws by name.

use std::fmt;
use std::str::FromStr;

use stickslip_friction::DieterichRuina;
use stickslip_state::{LogTheta, StateLaw};

use crate::error::LabError;
use crate::parameter::Parameter;

/// A boxed state law.
pub type BoxedLaw = Box<dyn StateLaw<State = LogTheta>>;

/// The state law of one state variable. It reads from its name, such as `kato-tullis`.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub enum Evolution<'a> {
    /// Dieterich's law, `theta' = 1 - V theta/L`.
    #[doc(alias("Dieterich", "slowness law"))]
    Aging,
    /// Ruina's law, `theta' = -(V theta/L) ln(V theta/L)`.
    #[doc(alias = "Ruina")]
    Slip,
    /// The law of Perrin, Rice and Zheng, `theta' = 1 - (V theta/2L)^2`, with `2L` in the place of `L` in friction.
    PerrinRiceZheng,
    /// The composite law of Kato and Tullis, `theta' = exp(-V/Vc) - (V theta/L) ln(V theta/L)`, with
    /// [`aging_velocity`](crate::StateParameters::aging_velocity) for `Vc`.
    #[doc(alias = "composite law")]
    KatoTullis,
    /// Nagata's law, `theta' = 1 - V theta/L - (c/b) theta mu'` with the rate of friction without the trend, and
    /// [`stress_weight`](crate::StateParameters::stress_weight) for `c`. Of several states each has its own `b`.
    Nagata,
    /// A state law as a function of `a`, `b`, `L` and `V0`. Its fit takes derivatives by differences.
    Custom(&'a (dyn Fn(&DieterichRuina) -> BoxedLaw + Sync)),
}

impl fmt::Debug for Evolution<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Evolution<'_> {
    /// Its name: `aging`, `slip`, `perrin-rice-zheng`, `kato-tullis`, `nagata` or `custom`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Aging => "aging",
            Self::Slip => "slip",
            Self::PerrinRiceZheng => "perrin-rice-zheng",
            Self::KatoTullis => "kato-tullis",
            Self::Nagata => "nagata",
            Self::Custom(_) => "custom",
        }
    }

    /// The parameter that the law has beside `L`, as that of state `i` from 0 on: `Vc` of Kato and Tullis, `c` of Nagata.
    pub fn parameter(&self, i: usize) -> Option<Parameter> {
        match self {
            Self::KatoTullis => Some(Parameter::AgingVelocity(i)),
            Self::Nagata => Some(Parameter::StressWeight(i)),
            _ => None,
        }
    }
}

impl FromStr for Evolution<'static> {
    type Err = LabError;

    fn from_str(name: &str) -> Result<Self, LabError> {
        let laws = [
            Self::Aging,
            Self::Slip,
            Self::PerrinRiceZheng,
            Self::KatoTullis,
            Self::Nagata,
        ];
        let found = laws.into_iter().find(|law| law.name() == name);
        found.ok_or_else(|| LabError::LawName { name: name.into() })
    }
}
