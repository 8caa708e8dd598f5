//! Derivatives of axisymmetric potentials along the axes of an edge and the vertical.

use super::axial::Axial;
use super::two::Two;

/// The direction of an edge: shares along `e` and `z`, and `1/(1 + c)`.
#[derive(Clone, Copy)]
pub(super) struct Direction {
    pub(super) s: f64,
    pub(super) c: f64,
    pub(super) f: f64,
}

/// Derivatives of a potential: `hh he hhz hez zz zze zzh zzz`.
pub(super) type Jet = [Two; 8];

/// Derivatives of an axisymmetric potential along `e`, `h`, `z` and `w`.
pub(super) struct InSpace {
    pub(super) hh: Two,
    pub(super) he: Two,
    pub(super) hz: Two,
    pub(super) ee: Two,
    pub(super) ez: Two,
    pub(super) hw: Two,
    pub(super) ew: Two,
    pub(super) wz: Two,
    hhh: Two,
    hhe: Two,
    hhw: Two,
    hew: Two,
    hhz: Two,
    hze: Two,
    hzz: Two,
    whz: Two,
    wze: Two,
    wzz: Two,
}

impl InSpace {
    /// With `e = s t - c w` and `z = c t + s w`.
    pub(super) fn of(direction: Direction, f: &Axial) -> Self {
        let Direction { s, c, .. } = direction;
        let (ss, sc, cc) = (s * s, s * c, c * c);
        let along = |t: Two, w: Two| s * t - c * w;
        let up = |t: Two, w: Two| c * t + s * w;
        let along_up = |tt: Two, tw: Two, ww: Two| sc * (tt - ww) + (ss - cc) * tw;
        let up_up = |tt: Two, tw: Two, ww: Two| cc * tt + (2.0 * sc) * tw + ss * ww;
        Self {
            hh: f.hh,
            he: along(f.th, f.wh),
            hz: up(f.th, f.wh),
            ee: ss * f.tt - (2.0 * sc) * f.tw + cc * f.ww,
            ez: along_up(f.tt, f.tw, f.ww),
            hw: f.wh,
            ew: along(f.tw, f.ww),
            wz: up(f.tw, f.ww),
            hhh: f.hhh,
            hhe: along(f.thh, f.whh),
            hhw: f.whh,
            hew: along(f.twh, f.wwh),
            hhz: up(f.thh, f.whh),
            hze: along_up(f.tth, f.twh, f.wwh),
            hzz: up_up(f.tth, f.twh, f.wwh),
            whz: up(f.twh, f.wwh),
            wze: along_up(f.ttw, f.tww, f.www),
            wzz: up_up(f.ttw, f.tww, f.www),
        }
    }

    /// The jet of `F,h`, where `F,z` is this potential.
    pub(super) fn jet_of_h(&self, hhh: Two, hhe: Two) -> Jet {
        [
            hhh, hhe, self.hhh, self.hhe, self.hz, self.hze, self.hhz, self.hzz,
        ]
    }

    /// The jet of `F,w`, where `F,z` is this potential.
    pub(super) fn jet_of_w(&self, hhw: Two, hew: Two) -> Jet {
        [
            hhw, hew, self.hhw, self.hew, self.wz, self.wze, self.whz, self.wzz,
        ]
    }
}
