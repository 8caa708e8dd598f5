//! Derivatives of the two potentials of a straight line from a point along its direction.

use super::two::Two;

/// Second and third derivatives of an axisymmetric potential along `t` (the axis), `w` and `h` (transverse).
pub(super) struct Axial {
    pub(super) tt: Two,
    pub(super) tw: Two,
    pub(super) th: Two,
    pub(super) ww: Two,
    pub(super) wh: Two,
    pub(super) hh: Two,
    pub(super) ttw: Two,
    pub(super) tth: Two,
    pub(super) tww: Two,
    pub(super) twh: Two,
    pub(super) thh: Two,
    pub(super) www: Two,
    pub(super) wwh: Two,
    pub(super) whh: Two,
    pub(super) hhh: Two,
}

/// Where a receiver is: distance `r`, coordinate `t` along the axis, transverse coordinates `w`, `h`; `b = r + t`.
pub(super) struct Place {
    pub(super) r: Two,
    pub(super) t: Two,
    pub(super) w: Two,
    pub(super) h: Two,
    /// `1/r` and `1/b`.
    pub(super) inverse: [Two; 2],
}

impl Axial {
    /// `l = ln(r + t)`, with `dl/dt = 1/r`, and `m = t ln(r + t) - r`, with `dm/dt = l`.
    pub(super) fn pair(place: &Place) -> [Self; 2] {
        let &Place {
            r,
            t,
            w,
            h,
            inverse: [i, ib],
            ..
        } = place;
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
