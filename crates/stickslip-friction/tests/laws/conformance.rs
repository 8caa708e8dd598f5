//! The checks accept every law and potential that keeps the contract.

use crate::common::Generic;
use nalgebra::{SMatrix, SVector};
use stickslip_friction::{
    ConvexPotential, DieterichRuina, FrictionLaw, Interval, LinearWeakening, LocalModel, Radial,
    RegularizedDieterichRuina, StateDependentTresca, Tresca, check_convex_potential,
    check_friction_law,
};
use stickslip_state::{LogTheta, Weakening};

const STATES: [f64; 8] = [-800.0, -100.0, -10.0, 0.0, 2.0, 10.0, 100.0, 800.0];

fn cut_off(a: f64, b: f64, slip_distance: f64) -> DieterichRuina {
    DieterichRuina {
        a,
        b,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance,
    }
}

fn regularized(a: f64, b: f64, slip_distance: f64) -> RegularizedDieterichRuina {
    RegularizedDieterichRuina {
        a,
        b,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance,
    }
}

#[test]
fn our_laws_conform() {
    let states = STATES.map(LogTheta);
    for coefficient in [0.0, 1e-6, 0.6, 1e3] {
        check_friction_law(&Tresca { coefficient }, &[()]).expect("Tresca");
    }
    let weakened = [-1e9, -1.0, 0.0, 1e-12, 0.3, 0.999, 1.0, 1e9].map(Weakening);
    for [static_friction, dynamic_friction] in [[0.677, 0.525], [0.6, 0.0], [0.4, 0.4], [1e4, 0.1]]
    {
        let law = LinearWeakening {
            static_friction,
            dynamic_friction,
        };
        check_friction_law(&law, &weakened).unwrap_or_else(|e| panic!("{law:?}: {e}"));
        check_friction_law(&Generic(law), &weakened).unwrap_or_else(|e| panic!("{law:?}: {e}"));
    }
    for a in [1e-6, 1e-3, 0.01, 1.0] {
        for ratio in [0.0, 0.5, 1.5, 2.0, 5.0, 150.0] {
            for slip_distance in [1e-12, 1e-5, 1.0] {
                let b = ratio * a;
                let tresca = StateDependentTresca {
                    reference_friction: 0.6,
                    b,
                    reference_velocity: 1e-6,
                    slip_distance,
                };
                check_friction_law(&tresca, &states).expect("state-dependent Tresca");
                let law = cut_off(a, b, slip_distance);
                check_friction_law(&law, &states).unwrap_or_else(|e| panic!("{law:?}: {e}"));
                let law = regularized(a, b, slip_distance);
                check_friction_law(&law, &states).unwrap_or_else(|e| panic!("{law:?}: {e}"));
            }
        }
    }
}

#[test]
fn defaults_conform() {
    let states = [-100.0, -10.0, 0.0, 10.0, 100.0].map(LogTheta);
    check_friction_law(&Generic(Tresca { coefficient: 0.6 }), &[()]).expect("Tresca");
    check_friction_law(&Generic(cut_off(0.01, 0.015, 1e-5)), &states).expect("cut-off");
    check_friction_law(&Generic(regularized(0.01, 0.015, 1e-5)), &states).expect("regularised");
    let boxed: Box<dyn FrictionLaw<State = LogTheta>> = Box::new(cut_off(0.01, 0.015, 1e-5));
    check_friction_law(&boxed, &states).expect("cut-off");
    check_friction_law(&*boxed, &states).expect("cut-off");
}

#[test]
fn radial_potentials_conform() {
    fn check<L: FrictionLaw + Copy + std::fmt::Debug>(law: L, state: L::State) {
        for force in [0.0, 1.0, 1e12] {
            let potential = Radial { law, force, state };
            let size = if force > 0.0 { 0.6 * force } else { 1.0 };
            for speed in [1e-12, 1e-6, 1.0] {
                let name = format!("{potential:?}, {speed:e}");
                check_convex_potential::<_, 1>(&potential, speed, size)
                    .unwrap_or_else(|e| panic!("{name}: {e}"));
                check_convex_potential::<_, 2>(&potential, speed, size)
                    .unwrap_or_else(|e| panic!("{name}: {e}"));
                check_convex_potential::<_, 3>(&potential, speed, size)
                    .unwrap_or_else(|e| panic!("{name}: {e}"));
            }
        }
    }
    check(Tresca { coefficient: 0.6 }, ());
    let weakening = LinearWeakening {
        static_friction: 0.677,
        dynamic_friction: 0.525,
    };
    check(weakening, Weakening(0.4));
    for alpha in [-30.0, -10.0, 2.0, 20.0] {
        check(cut_off(0.01, 0.015, 1e-5), LogTheta(alpha));
        check(regularized(0.01, 0.015, 1e-5), LogTheta(alpha));
    }
}

#[test]
fn a_user_potential_conforms() {
    check_convex_potential(&Separable, 1e-3, 1.0).expect("separable");
}

/// `abs(v1) + 2 abs(v2)`: a kink in each component by itself.
struct Separable;

impl ConvexPotential<2> for Separable {
    fn value(&self, v: &SVector<f64, 2>) -> f64 {
        v[0].abs() + 2.0 * v[1].abs()
    }

    fn slope_along(&self, v: &SVector<f64, 2>, d: &SVector<f64, 2>) -> Interval {
        let (mut lower, mut upper) = (0.0, 0.0);
        for (i, weight) in [(0, 1.0), (1, 2.0)] {
            let slope = weight * d[i];
            if v[i] == 0.0 {
                lower -= slope.abs();
                upper += slope.abs();
            } else {
                lower += slope * v[i].signum();
                upper += slope * v[i].signum();
            }
        }
        Interval { lower, upper }
    }

    fn local_model(&self, v: &SVector<f64, 2>) -> LocalModel<2> {
        LocalModel {
            gradient: SVector::from([v[0].signum(), 2.0 * v[1].signum()]),
            hessian: SMatrix::zeros(),
            smooth: [v[0] != 0.0, v[1] != 0.0],
        }
    }

    /// By cases: which components rest.
    fn minimize(&self, s: &SMatrix<f64, 2, 2>, g: &SVector<f64, 2>) -> SVector<f64, 2> {
        let energy = |v: &SVector<f64, 2>| 0.5 * v.dot(&(s * v)) - g.dot(v) + self.value(v);
        let mut best = SVector::zeros();
        for x in [-1.0, 0.0, 1.0] {
            for y in [-1.0, 0.0, 1.0] {
                let force = g - SVector::from([x, 2.0 * y]);
                let v = match (x == 0.0, y == 0.0) {
                    (true, true) => continue,
                    (false, true) => SVector::from([force[0] / s[(0, 0)], 0.0]),
                    (true, false) => SVector::from([0.0, force[1] / s[(1, 1)]]),
                    _ => {
                        let det = s[(0, 0)] * s[(1, 1)] - s[(0, 1)] * s[(1, 0)];
                        SVector::from([
                            s[(1, 1)] * force[0] - s[(0, 1)] * force[1],
                            s[(0, 0)] * force[1] - s[(1, 0)] * force[0],
                        ]) / det
                    }
                };
                let consistent = v[0] * x >= 0.0 && v[1] * y >= 0.0;
                if consistent && energy(&v) < energy(&best) {
                    best = v;
                }
            }
        }
        best
    }
}
