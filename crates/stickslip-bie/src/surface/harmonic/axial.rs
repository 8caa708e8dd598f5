//! Derivatives of the two potentials of a straight line from a point along its direction.

/// Second and third derivatives of an axisymmetric potential along `t` (the axis), `w` and `h` (transverse).
pub(super) struct Axial {
    pub(super) tt: f64,
    pub(super) tw: f64,
    pub(super) th: f64,
    pub(super) ww: f64,
    pub(super) wh: f64,
    pub(super) hh: f64,
    pub(super) ttw: f64,
    pub(super) tth: f64,
    pub(super) tww: f64,
    pub(super) twh: f64,
    pub(super) thh: f64,
    pub(super) www: f64,
    pub(super) wwh: f64,
    pub(super) whh: f64,
    pub(super) hhh: f64,
}

/// Where a receiver is: distance `r`, coordinate `t` along the axis, transverse coordinates `w`, `h`, and `b = r + t`.
pub(super) struct Place {
    pub(super) r: f64,
    pub(super) t: f64,
    pub(super) w: f64,
    pub(super) h: f64,
    pub(super) b: f64,
}

impl Axial {
    /// `l = ln(r + t)`, with `dl/dt = 1/r`, and `m = t ln(r + t) - r`, with `dm/dt = l`.
    pub(super) fn pair(place: &Place) -> [Self; 2] {
        let &Place { r, t, w, h, b } = place;
        let (i, ib) = (r.recip(), b.recip());
        let i3 = i * i * i;
        let i5 = 3.0 * i3 * i * i;
        let first = i * ib;
        let second = (2.0 * r + t) * i3 * ib * ib;
        let third = (8.0 * r * r + 9.0 * r * t + 3.0 * t * t) * i3 * i * i * ib * ib * ib;
        let l = Self {
            tt: -t * i3,
            tw: -w * i3,
            th: -h * i3,
            ww: first - w * w * second,
            wh: -w * h * second,
            hh: first - h * h * second,
            ttw: t * w * i5,
            tth: t * h * i5,
            tww: w * w * i5 - i3,
            twh: w * h * i5,
            thh: h * h * i5 - i3,
            www: w * (w * w * third - 3.0 * second),
            wwh: h * (w * w * third - second),
            whh: w * (h * h * third - second),
            hhh: h * (h * h * third - 3.0 * second),
        };
        let second = first * ib;
        let third = (3.0 * r + t) * i3 * ib * ib * ib;
        let m = Self {
            tt: i,
            tw: w * first,
            th: h * first,
            ww: w * w * second - ib,
            wh: w * h * second,
            hh: h * h * second - ib,
            ttw: l.tw,
            tth: l.th,
            tww: l.ww,
            twh: l.wh,
            thh: l.hh,
            www: w * (3.0 * second - w * w * third),
            wwh: h * (second - w * w * third),
            whh: w * (second - h * h * third),
            hhh: h * (3.0 * second - h * h * third),
        };
        [l, m]
    }
}
