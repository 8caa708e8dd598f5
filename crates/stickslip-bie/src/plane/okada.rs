//! Displacement gradients of a rectangular dislocation in a half space, corner by corner.
//!
//! Source: Y. Okada, "Internal deformation due to shear and tensile faults in a half-space", Bull. Seismol. Soc. Am. 82
//! (1992) 1018-1040, Tables 6 to 9. The gradient is
//!
//! ```text
//! grad u = (D/(2 pi)) grad [ uA(x, y, z) - uA(x, y, -z) + uB(x, y, z) + z uC(x, y, z) ]
//! ```
//!
//! summed over the four corners with the signs of [`WholeSpace`](super::whole_space::WholeSpace). Axes: `x` along
//! strike, `y` horizontal and, on the plane, rising, `z` up; the plane dips to the right of strike. Inside each part the
//! second and third components are along Okada's axes, turned by the dip; here all are turned back.
//!
//! Three of Okada's terms are differences that vanish with `cos(dip)` and are divided by it, once or twice. Here the
//! cosine is divided out by hand ([`half_space`]), so that vertical planes are no case of their own.

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

/// A corner as seen from a point: `xi` along strike, `eta` up dip, `q` along the normal, with the powers of the
/// distance that all parts share. Names are Okada's.
#[derive(Debug, Clone, Copy)]
struct Corner {
    xi: f64,
    eta: f64,
    q: f64,
    r: f64,
    /// `eta cos + q sin`, `eta sin - q cos`.
    y: f64,
    d: f64,
    x11: f64,
    x32: f64,
    x53: f64,
    y11: f64,
    y32: f64,
    y53: f64,
}

/// `r + a` for `r^2 = a^2 + square`, without cancellation.
fn sum_with_distance(r: f64, a: f64, square: f64) -> f64 {
    if a < 0.0 { square / (r - a) } else { r + a }
}

/// `[1/(r (r + a)), (2 r + a)/(r^3 (r + a)^2), (8 r^2 + 9 r a + 3 a^2)/(r^5 (r + a)^3)]`. On the extension of an edge
/// they are infinite at both of its ends, and cancel: 0.
fn inverse_powers(r: f64, a: f64, square: f64) -> [f64; 3] {
    let sum = sum_with_distance(r, a, square);
    if sum == 0.0 {
        return [0.0; 3];
    }
    let first = 1.0 / (r * sum);
    [
        first,
        (2.0 * r + a) * first * first / r,
        (8.0 * r * r + 9.0 * r * a + 3.0 * a * a) * first * first * first / (r * r),
    ]
}

impl Corner {
    fn new(dip: &Dip, xi: f64, eta: f64, q: f64) -> Self {
        let r = (xi * xi + eta * eta + q * q).sqrt();
        let [x11, x32, x53] = inverse_powers(r, xi, eta * eta + q * q);
        let [y11, y32, y53] = inverse_powers(r, eta, xi * xi + q * q);
        Self {
            xi,
            eta,
            q,
            r,
            y: eta * dip.cos + q * dip.sin,
            d: eta * dip.sin - q * dip.cos,
            x11,
            x32,
            x53,
            y11,
            y32,
            y53,
        }
    }
}

/// Derivatives along `x`, `y`, `z` of three components, of slip along strike and up dip.
type Part = [[[f64; 3]; 3]; 2];

/// `uA`, of an unbounded medium.
fn unbounded(dip: &Dip, at: &Corner) -> Part {
    let &Dip { alpha, cos, sin } = dip;
    let &Corner {
        xi,
        eta,
        q,
        r,
        y,
        d,
        x11,
        y11,
        y32,
        ..
    } = at;
    let (a1, a2) = (0.5 * (1.0 - alpha), 0.5 * alpha);
    let r3 = r * r * r;
    let (xy, qy) = (xi * y11, q * y11);
    let [ey, ez, fy, fz, gy, gz] = shared(dip, at);
    [
        [
            [
                -a1 * qy - a2 * xi * xi * q * y32,
                -a2 * xi * q / r3,
                a1 * xy + a2 * xi * q * q * y32,
            ],
            [
                a1 * xy * sin + a2 * xi * fy + 0.5 * d * x11,
                a2 * ey,
                a1 * (cos / r + qy * sin) - a2 * q * fy,
            ],
            [
                a1 * xy * cos + a2 * xi * fz + 0.5 * y * x11,
                a2 * ez,
                -a1 * (sin / r - qy * cos) - a2 * q * fz,
            ],
        ],
        [
            [
                -a2 * xi * q / r3,
                -0.5 * qy - a2 * eta * q / r3,
                a1 / r + a2 * q * q / r3,
            ],
            [
                a2 * ey,
                a1 * d * x11 + 0.5 * xy * sin + a2 * eta * gy,
                a1 * y * x11 - a2 * q * gy,
            ],
            [
                a2 * ez,
                a1 * y * x11 + 0.5 * xy * cos + a2 * eta * gz,
                -a1 * d * x11 - a2 * q * gz,
            ],
        ],
    ]
}

/// Okada's `E`, `F`, `G` and their primes.
fn shared(dip: &Dip, at: &Corner) -> [f64; 6] {
    let &Dip { cos, sin, .. } = dip;
    let &Corner {
        xi,
        q,
        r,
        y,
        d,
        x11,
        x32,
        y32,
        ..
    } = at;
    let r3 = r * r * r;
    [
        sin / r - y * q / r3,
        cos / r + d * q / r3,
        d / r3 + xi * xi * y32 * sin,
        y / r3 + xi * xi * y32 * cos,
        2.0 * x11 * sin - y * q * x32,
        2.0 * x11 * cos + d * q * x32,
    ]
}

/// `uB`, of the free surface.
///
/// With `c = cos(dip)`, `s = sin(dip)`, `R' = R + d`, `R'' = R + eta` and the identities `1 - s = c^2/(1 + s)`,
/// `eta = y c + d s`, `q = y s - d c`, the quotients of Table 8 are
///
/// ```text
/// K1 = xi (R c/(1+s) + y)/(R R' R''),    K3 = (R (q c/(1+s) - eta) - q^2 - eta^2)/(R R' R'')
/// J3 = (K1 - s J2)/c = xi [R R'/(1+s) + y (R c/(1+s) - q)]/(R R'^2 R'')
/// J6 = (K3 - s J5)/c = [R' (R q/(1+s) - R y + s d y - c d^2) - y^2 (R c/(1+s) + d c - s y)]/(R R'^2 R'')
/// ```
fn half_space(dip: &Dip, at: &Corner) -> Part {
    let &Dip { alpha, cos, sin } = dip;
    let &Corner {
        xi,
        eta,
        q,
        r,
        y,
        d,
        x11,
        y11,
        y32,
        ..
    } = at;
    let a3 = (1.0 - alpha) / alpha;
    let r3 = r * r * r;
    let (rd, re) = (r + d, sum_with_distance(r, eta, xi * xi + q * q));
    let d11 = 1.0 / (r * rd);
    let tilt = cos / (1.0 + sin);
    let j2 = xi * y / rd * d11;
    let j5 = -(d + y * y / rd) * d11;
    let k1 = xi * (r * tilt + y) * d11 / re;
    let k3 = (r * (q * tilt - eta) - q * q - eta * eta) * d11 / re;
    let share = d11 / (rd * re);
    let j3 = xi * (r * rd / (1.0 + sin) + y * (r * tilt - q)) * share;
    let j6 = (rd * (r * q / (1.0 + sin) - r * y + sin * d * y - cos * d * d)
        - y * y * (r * tilt + d * cos - sin * y))
        * share;
    let (xy, qy) = (xi * y11, q * y11);
    let k2 = 1.0 / r + k3 * sin;
    let k4 = xy * cos - k1 * sin;
    let j1 = j5 * cos - j6 * sin;
    let j4 = -xy - j2 * cos + j3 * sin;
    let [ey, ez, fy, fz, gy, gz] = shared(dip, at);
    let (b, c) = (a3 * sin, a3 * sin * cos);
    [
        [
            [
                xi * xi * q * y32 - b * j1,
                xi * q / r3 - b * j2,
                -xi * q * q * y32 - b * j3,
            ],
            [
                -xi * fy - d * x11 + b * (xy + j4),
                -ey + b * (1.0 / r + j5),
                q * fy - b * (qy - j6),
            ],
            [
                -xi * fz - y * x11 + b * k1,
                -ez + b * y * d11,
                q * fz + b * k2,
            ],
        ],
        [
            [
                xi * q / r3 + c * j4,
                eta * q / r3 + qy + c * j5,
                -q * q / r3 + c * j6,
            ],
            [-ey + c * j1, -eta * gy - xy * sin + c * j2, q * gy + c * j3],
            [
                -ez - c * k3,
                -eta * gz - xy * cos - c * xi * d11,
                q * gz - c * k4,
            ],
        ],
    ]
}

/// `uC` at the height `z`, first itself, then its derivatives.
fn depth_part(dip: &Dip, at: &Corner, z: f64) -> ([[f64; 3]; 2], Part) {
    let &Dip { alpha, cos, sin } = dip;
    let &Corner {
        xi,
        eta,
        q,
        r,
        y,
        d,
        x11,
        x32,
        x53,
        y11,
        y32,
        y53,
    } = at;
    let (a4, a5) = (1.0 - alpha, alpha);
    let (r2, r3) = (r * r, r * r * r);
    let r5 = r2 * r3;
    let c = d + z;
    let h = q * cos - z;
    let z32 = sin / r3 - h * y32;
    let z53 = 3.0 * sin / r5 - h * y53;
    let y0 = y11 - xi * xi * y32;
    let z0 = z32 - xi * xi * z53;
    let ppy = cos / r3 + q * y32 * sin;
    let ppz = sin / r3 - q * y32 * cos;
    let qq = z * y32 + z32 + z0;
    let qqy = 3.0 * c * d / r5 - qq * sin;
    let qqz = 3.0 * c * y / r5 - qq * cos + q * y32;
    let (xy, qy) = (xi * y11, q * y11);
    let qr = 3.0 * q / r5;
    let cdr = (c + d) / r3;
    let yy0 = y / r3 - y0 * cos;
    let displacement = [
        [
            a4 * xy * cos - a5 * xi * q * z32,
            a4 * (cos / r + 2.0 * qy * sin) - a5 * c * q / r3,
            a4 * qy * cos - a5 * (c * eta / r3 - z * y11 + xi * xi * z32),
        ],
        [
            a4 * cos / r - qy * sin - a5 * c * q / r3,
            a4 * y * x11 - a5 * c * eta * q * x32,
            -d * x11 - xy * sin - a5 * c * (x11 - q * q * x32),
        ],
    ];
    let strike = [
        [
            a4 * y0 * cos - a5 * q * z0,
            -a4 * xi * (cos / r3 + 2.0 * q * y32 * sin) + a5 * c * xi * qr,
            -a4 * xi * q * y32 * cos + a5 * xi * (3.0 * c * eta / r5 - qq),
        ],
        [
            -a4 * xi * ppy * cos - a5 * xi * qqy,
            a4 * 2.0 * (d / r3 - y0 * sin) * sin
                - y / r3 * cos
                - a5 * (cdr * sin - eta / r3 - c * y * qr),
            -a4 * q / r3 + yy0 * sin + a5 * (cdr * cos + c * d * qr - (y0 * cos + q * z0) * sin),
        ],
        [
            a4 * xi * ppz * cos - a5 * xi * qqz,
            a4 * 2.0 * (y / r3 - y0 * cos) * sin + d / r3 * cos - a5 * (cdr * cos + c * d * qr),
            yy0 * cos - a5 * (cdr * sin - c * y * qr - y0 * sin * sin + q * z0 * cos),
        ],
    ];
    let up_dip = [
        [
            -a4 * xi / r3 * cos + a5 * c * xi * qr + xi * q * y32 * sin,
            -a4 * y / r3 + a5 * c * eta * qr,
            d / r3 - y0 * sin + a5 * c / r3 * (1.0 - 3.0 * q * q / r2),
        ],
        [
            -a4 * eta / r3 + y0 * sin * sin - a5 * (cdr * sin - c * y * qr),
            a4 * (x11 - y * y * x32) - a5 * c * ((d + 2.0 * q * cos) * x32 - y * eta * q * x53),
            xi * ppy * sin + y * d * x32 + a5 * c * ((y + 2.0 * q * sin) * x32 - y * q * q * x53),
        ],
        [
            -q / r3 + y0 * sin * cos - a5 * (cdr * cos + c * d * qr),
            a4 * y * d * x32 - a5 * c * ((y - 2.0 * q * sin) * x32 + d * eta * q * x53),
            -xi * ppz * sin + x11
                - d * d * x32
                - a5 * c * ((d - 2.0 * q * cos) * x32 - d * q * q * x53),
        ],
    ];
    (displacement, [strike, up_dip])
}

/// Components along Okada's axes of a part, as components along `x`, `y`, `z`.
fn turned_back(dip: &Dip, [u1, u2, u3]: [f64; 3]) -> [f64; 3] {
    [u1, u2 * dip.cos - u3 * dip.sin, u2 * dip.sin + u3 * dip.cos]
}

/// The share of a corner in the gradient of the source itself, of slip along strike and up dip. `eta` and `q` are those
/// of the point itself.
pub(crate) fn source(dip: &Dip, xi: f64, eta: f64, q: f64) -> [Gradient; 2] {
    // Okada's reflected point is the point here: its derivative along z has the other sign.
    let mut gradients = unbounded(dip, &Corner::new(dip, xi, eta, q));
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

/// The share of a corner in the gradient that the free surface adds at the height `z <= 0`. `eta` and `q` are those of
/// the point's image at `-z`.
pub(crate) fn image(dip: &Dip, xi: f64, eta: f64, q: f64, z: f64) -> [Gradient; 2] {
    let at = Corner::new(dip, xi, eta, q);
    let (first, second) = (unbounded(dip, &at), half_space(dip, &at));
    let (displacement, third) = depth_part(dip, &at, z);
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
