//! Displacement gradients of a rectangular dislocation in a half space, corner by corner.
//!
//! Source: Y. Okada, "Internal deformation due to shear and tensile faults in a half-space", Bull. Seismol. Soc. Am. 82
//! (1992) 1018-1040, Tables 6 to 9. The gradient is
//!
//! ```text
//! grad u = (D/(2 pi)) grad [ uA(x, y, z) - uA(x, y, -z) + uB(x, y, z) + z uC(x, y, z) ]
//! ```
//!
//! summed over the four corners, with the sign + for the deeper one where strike begins and the shallower one where it
//! ends. Axes: `x` along strike, `y` horizontal, `z` up; the plane rises with `y`. Okada's parts have their second and
//! third components turned by the dip; [`source`] and [`image`] turn them back.
//!
//! Three of Okada's terms are differences that vanish with `cos(dip)` and are divided by it, once or twice. Here the
//! cosine is divided out by hand ([`surface`]), so that vertical planes are no case of their own.

mod corner;
mod depth;
mod surface;
mod unbounded;

use corner::Corner;

/// `gradient[i][j]`: the derivative of the displacement's component `j` along axis `i`.
pub(crate) type Gradient = [[f64; 3]; 3];

/// Rock and dip.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Dip {
    /// `(lambda + mu)/(lambda + 2 mu) = 1/(2 (1 - nu))`.
    pub(crate) alpha: f64,
    pub(crate) cos: f64,
    pub(crate) sin: f64,
}

/// Derivatives along `x`, `y`, `z` of three components, of slip along strike and up dip.
type Part = [[[f64; 3]; 3]; 2];

/// Components along Okada's axes of a part, as components along `x`, `y`, `z`.
fn turned_back(dip: &Dip, [u1, u2, u3]: [f64; 3]) -> [f64; 3] {
    [u1, u2 * dip.cos - u3 * dip.sin, u2 * dip.sin + u3 * dip.cos]
}

/// The share of a corner `[xi, eta, q]` in the gradient of the source itself, of slip along strike and up dip. `eta`
/// and `q` are those of the point itself. Both ends along strike, or both ends down dip, may be behind it.
pub(crate) fn source(dip: &Dip, at: [f64; 3], behind: [bool; 2]) -> [Gradient; 2] {
    // Okada's reflected point is the point here: its derivative along z has the other sign.
    let mut gradients = unbounded::gradients(dip, &Corner::new(dip, at, behind));
    for gradient in &mut gradients {
        for (axis, derivative) in gradient.iter_mut().enumerate() {
            let [u1, u2, u3] = *derivative;
            let sign = if axis == 2 { 1.0 } else { -1.0 };
            let [x, y, z] = turned_back(dip, [u1, u2, u3]);
            *derivative = [sign * x, sign * y, sign * z];
        }
    }
    gradients
}

/// The share of a corner `[xi, eta, q]` in the gradient that the free surface adds at the height `z <= 0`. `eta` and `q`
/// are those of the point's image at `-z`. Both ends along strike may be behind it.
pub(crate) fn image(dip: &Dip, at: [f64; 3], behind: bool, z: f64) -> [Gradient; 2] {
    let at = Corner::new(dip, at, [behind, false]);
    let (first, second) = (unbounded::gradients(dip, &at), surface::gradients(dip, &at));
    let (displacement, third) = depth::gradients(dip, &at, z);
    let mut gradients = [[[0.0; 3]; 3]; 2];
    for slip in 0..2 {
        for axis in 0..3 {
            let (mut even, mut odd) = ([0.0; 3], [0.0; 3]);
            for i in 0..3 {
                even[i] = first[slip][axis][i] + second[slip][axis][i];
                odd[i] = z * third[slip][axis][i];
                if axis == 2 {
                    odd[i] += displacement[slip][i];
                }
            }
            // Okada's third part has its vertical component downwards.
            let (even, odd) = (turned_back(dip, even), turned_back(dip, odd));
            gradients[slip][axis] = [even[0] + odd[0], even[1] + odd[1], even[2] - odd[2]];
        }
    }
    gradients
}
