//! The benchmarks of a rupture in the plane.

use clap::ValueEnum;

use super::{Law, Rock};

/// Benchmarks by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Benchmark {
    /// Slip weakening with two patches of other stress: tpv205 by another name
    Tpv5,
    /// Slip weakening between two materials, normal stress with a delay
    Tpv6,
    /// Rate and state with the aging law
    Tpv101,
    /// Strong rate weakening by flash heating, for cells of 40 m or less
    Tpv103,
    /// The same with thermal pressurization
    Tpv105,
    /// Slip weakening with two patches of other stress, along the depth of the hypocentre
    Tpv205,
}

impl Benchmark {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tpv5 => "TPV5",
            Self::Tpv6 => "TPV6",
            Self::Tpv101 => "TPV101",
            Self::Tpv103 => "TPV103",
            Self::Tpv105 => "TPV105",
            Self::Tpv205 => "TPV205",
        }
    }

    /// Its law of rate and state; none of slip weakening.
    pub fn law(self) -> Option<Law> {
        match self {
            Self::Tpv5 | Self::Tpv6 | Self::Tpv205 => None,
            Self::Tpv101 => Some(Law::Aging),
            Self::Tpv103 => Some(Law::StrongWeakening),
            Self::Tpv105 => Some(Law::Pressurized),
        }
    }

    /// Whether both sides of the fault are bodies; else one body stands for both.
    pub fn has_two_sides(self) -> bool {
        self == Self::Tpv6
    }

    /// The slip across the fault over that of the contact: one body has half of it.
    pub fn bodies(self) -> f64 {
        if self.has_two_sides() { 1.0 } else { 2.0 }
    }

    /// The rocks above the fault, the far side, and below it, the near side.
    pub fn rocks(self) -> [Rock; 2] {
        match self {
            Self::Tpv6 => [Rock::SOFT, Rock::HARD],
            _ => [Rock::HARD; 2],
        }
    }

    /// The stations along the fault \[m\].
    pub fn stations(self) -> Vec<f64> {
        match self {
            Self::Tpv5 | Self::Tpv205 => vec![-12e3, -7.5e3, -4.5e3, 0.0, 4.5e3, 7.5e3, 12e3],
            Self::Tpv6 => vec![-12e3, -9e3, -4.5e3, 0.0, 4.5e3, 9e3, 12e3],
            Self::Tpv101 | Self::Tpv103 | Self::Tpv105 => vec![0.0, 3e3, 6e3, 9e3, 12e3, 15e3],
        }
    }

    /// The initial shear stress of a vertex with a length of the fault \[Pa\].
    pub fn shear(self, x: f64, length: f64) -> f64 {
        match self.law() {
            Some(law) => law.shear(),
            None => super::weakening::prestress(self.patches(), x, length, 1.0),
        }
    }

    /// The patches of other initial shear stress under slip weakening.
    pub fn patches(self) -> &'static [(f64, f64)] {
        match self {
            Self::Tpv6 => &super::weakening::PATCHES[..1],
            _ => &super::weakening::PATCHES,
        }
    }
}
