//! Derivatives of axisymmetric potentials along the axes of an edge and the vertical.

use super::axial::Axial;

/// The direction of an edge: shares along `e` and `z`, and `1/(1 + c)`.
#[derive(Clone, Copy)]
pub(super) struct Direction {
    pub(super) s: f64,
    pub(super) c: f64,
    pub(super) f: f64,
}

/// Derivatives of a potential: `hh he hhz hez zz zze zzh zzz`.
pub(super) type Jet = [f64; 8];

/// Derivatives of an axisymmetric potential along `e`, `h`, `z` and `w`.
pub(super) struct InSpace {
    pub(super) hh: f64,
    pub(super) he: f64,
    pub(super) hz: f64,
    pub(super) ee: f64,
    pub(super) ez: f64,
    wz: f64,
    hhh: f64,
    hhe: f64,
    hhw: f64,
    hew: f64,
    hhz: f64,
    hze: f64,
    hzz: f64,
    whz: f64,
    wze: f64,
    wzz: f64,
}

impl InSpace {
    /// With `e = s t - c w` and `z = c t + s w`.
    pub(super) fn of(direction: Direction, f: &Axial) -> Self {
        let Direction { s, c, .. } = direction;
        let (ss, sc, cc) = (s * s, s * c, c * c);
        let along = |t: f64, w: f64| s * t - c * w;
        let up = |t: f64, w: f64| c * t + s * w;
        let along_up = |tt: f64, tw: f64, ww: f64| sc * (tt - ww) + (ss - cc) * tw;
        let up_up = |tt: f64, tw: f64, ww: f64| cc * tt + 2.0 * sc * tw + ss * ww;
        Self {
            hh: f.hh,
            he: along(f.th, f.wh),
            hz: up(f.th, f.wh),
            ee: ss * f.tt - 2.0 * sc * f.tw + cc * f.ww,
            ez: along_up(f.tt, f.tw, f.ww),
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
    pub(super) fn jet_of_h(&self, hhh: f64, hhe: f64) -> Jet {
        [
            hhh, hhe, self.hhh, self.hhe, self.hz, self.hze, self.hhz, self.hzz,
        ]
    }

    /// The jet of `F,w`, where `F,z` is this potential.
    pub(super) fn jet_of_w(&self, hhw: f64, hew: f64) -> Jet {
        [
            hhw, hew, self.hhw, self.hew, self.wz, self.wze, self.whz, self.wzz,
        ]
    }
}
