//! The rocks of the benchmarks.

use stickslip::fem::{Elastic, FemError, Impedance};

/// An elastic rock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rock {
    /// Density [kg/m^3].
    pub density: f64,
    /// The speed of P waves [m/s].
    pub c_p: f64,
    /// The speed of S waves [m/s].
    pub c_s: f64,
}

impl Rock {
    /// That of all benchmarks here, in TPV6 of the near side.
    pub const HARD: Self = Self {
        density: 2670.0,
        c_p: 6000.0,
        c_s: 3464.0,
    };
    /// That of the far side of TPV6.
    pub const SOFT: Self = Self {
        density: 2225.0,
        c_p: 3750.0,
        c_s: 2165.0,
    };

    /// Its elasticity.
    ///
    /// # Errors
    /// Wave speeds that no material has: none of these.
    pub fn elastic(&self) -> Result<Elastic, FemError> {
        Elastic::of_waves(self.density, self.c_p, self.c_s)
    }

    /// Its impedance.
    ///
    /// # Errors
    /// As [`elastic`](Self::elastic).
    pub fn impedance(&self) -> Result<Impedance, FemError> {
        Impedance::of(&self.elastic()?, self.density)
    }

    /// The shear modulus over `1 - nu` \[Pa\], which resists slip in plane strain.
    pub fn stiffness(&self) -> f64 {
        let square = (self.c_s / self.c_p).powi(2);
        let poisson_ratio = (1.0 - 2.0 * square) / (2.0 - 2.0 * square);
        self.density * self.c_s * self.c_s / (1.0 - poisson_ratio)
    }
}
