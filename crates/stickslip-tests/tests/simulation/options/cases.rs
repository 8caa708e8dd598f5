//! The options, each with the scenes without and with it.

use nalgebra::Vector2;
use stickslip::fem::{GridDiagonal, Mesh, P1, Trace, Viscous, body_force, elasticity, viscosity};
use stickslip::fields::GivenPressure;
use stickslip::friction::{ForcedCap, ForcedRupture, FrictionLaw, LinearWeakening, Tresca};
use stickslip::solvers::Cholesky;
use stickslip::state::{Dieterich, LogTheta, SlipWeakening, Weakening};
use stickslip::{Components, Contact, NormalStress, NormalStressChange, Scene};

use super::Fate::{Refused, Used};
use super::{
    AGING, Body, Case, L, LAW, NORMAL_STRESS, RATE, ROCK, STATE, body, contact, dynamic,
    quasi_static,
};
use crate::Outcome;

const SHEAR: Vector2<f64> = Vector2::new(650.0, 0.0);

/// A pressure that grows with the displacement of its own vertex [Pa/m], of so many vertices.
struct Compressed(usize);

impl NormalStressChange<2> for Compressed {
    fn vertex_count(&self) -> usize {
        self.0
    }

    fn add(&self, scale: f64, displacement: &[Vector2<f64>], normal_stress: &mut [f64]) {
        for (stress, u) in normal_stress.iter_mut().zip(displacement) {
            *stress += scale * 1e6 * u.x;
        }
    }
}

/// Friction that falls with the slip rate at constant state, against the contract of laws.
#[derive(Clone, Copy)]
struct Falling;

impl FrictionLaw for Falling {
    type State = ();

    fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
        0.3 - 0.1 * slip_rate
    }

    fn coefficient_rate_slope(&self, _: f64, (): ()) -> f64 {
        -0.1
    }

    fn potential(&self, slip_rate: f64, (): ()) -> f64 {
        slip_rate * (0.3 - 0.05 * slip_rate)
    }
}

fn right(space: &P1<2>) -> Outcome<Trace<2>> {
    Ok(space.trace(|x| x[0] == 2.0)?)
}

/// The right side without the corner at the top.
fn lower_right(space: &P1<2>) -> Outcome<Trace<2>> {
    Ok(space.trace(|x| x[0] == 2.0 && x[1] < 0.75)?)
}

/// A field that grows with height.
fn shearing(space: &P1<2>) -> Vec<Vector2<f64>> {
    let vertices = space.mesh().vertices().iter();
    vertices.map(|x| Vector2::new(RATE * x.y, 0.0)).collect()
}

fn done<T>(value: T) -> Outcome<T> {
    Ok(value)
}

/// A body whose normal stress comes from the deformation, as it is and with an option.
fn leaning(space: &P1<2>, option: fn(NormalStress) -> NormalStress) -> Outcome<[Body; 2]> {
    let vertices = space.mesh().vertices().iter();
    let lowered: Vec<_> = vertices.map(|x| Vector2::new(0.0, -1e-5 * x.y)).collect();
    let bottom = space.trace(|x| x[1] == 0.0)?;
    // So slippery that the body slides before it tilts.
    let law = Tresca { coefficient: 0.1 };
    let under = |stress| {
        let scene = dynamic(space)?.with_displacement(lowered.clone());
        done(scene.with_contact(Contact::new(&bottom, law, stress)))
    };
    let stress = NormalStress::from_body(2.0 * NORMAL_STRESS);
    Ok([under(stress.clone())?, under(option(stress))?])
}

/// An option that is used and carried.
const fn used(name: &'static str, scenes: fn(&P1<2>) -> Outcome<[Body; 2]>) -> Case {
    Case {
        name,
        scenes,
        whole: Used,
        reduced: Used,
        initial: false,
    }
}

/// One that is part of the first state.
const fn first(name: &'static str, scenes: fn(&P1<2>) -> Outcome<[Body; 2]>) -> Case {
    Case {
        initial: true,
        ..used(name, scenes)
    }
}

/// One that only some methods take.
const fn refused(
    name: &'static str,
    whole: Option<&'static str>,
    reduced: &'static str,
    scenes: fn(&P1<2>) -> Outcome<[Body; 2]>,
) -> Case {
    Case {
        whole: match whole {
            Some(word) => Refused(word),
            None => Used,
        },
        reduced: Refused(reduced),
        ..used(name, scenes)
    }
}

pub(super) const CASES: [Case; 39] = [
    used("with_contact", |s| {
        let wall = Contact::new(&right(s)?, Tresca { coefficient: 0.3 }, 1e2);
        Ok([body(s)?, body(s)?.with_contact(wall)])
    }),
    used("with_mass", |s| {
        let light = quasi_static(s)?.with_contact(contact(s)?);
        Ok([light, body(s)?])
    }),
    used("with_viscosity", |s| {
        let viscous = Viscous {
            shear_viscosity: 2e4,
            bulk_viscosity: 2e4,
        };
        Ok([body(s)?, body(s)?.with_viscosity(viscosity(s, &viscous)?)])
    }),
    used("with_load", |s| {
        let weight = body_force(s, |_| Vector2::new(300.0, 0.0));
        Ok([body(s)?, body(s)?.with_load(weight)])
    }),
    used("with_scaled_load", |s| {
        let pull = vec![Vector2::new(300.0, 0.0); s.vertex_count()];
        Ok([body(s)?, body(s)?.with_scaled_load(pull, |time| time)])
    }),
    used("with_load_history", |s| {
        let history = |time: f64, load: &mut [Vector2<f64>]| {
            load.iter_mut().for_each(|f| f.x += 300.0 * time)
        };
        Ok([body(s)?, body(s)?.with_load_history(history)])
    }),
    used("fix", |s| {
        Ok([body(s)?, body(s)?.fix(&lower_right(s)?, Components::X)])
    }),
    used("prescribe_velocity", |s| {
        let fast = |_| [2.0 * RATE, 0.0];
        Ok([
            body(s)?,
            body(s)?.prescribe_velocity(&lower_right(s)?, Components::X, fast),
        ])
    }),
    used("with_periodic", |s| {
        let left = s.trace(|x| x[0] == 0.0)?;
        Ok([body(s)?, body(s)?.with_periodic(&left, &right(s)?)])
    }),
    used("with_open_walls", |_| {
        let mesh = Mesh::<2>::grid([2.0, 1.0], [4, 2], GridDiagonal::Rising)?;
        let mesh = mesh.with_surface_where("crack", |x| x[1] == 0.5 && x[0] <= 1.0)?;
        let split = P1::new(mesh.split("crack")?);
        Ok([body(&split)?, body(&split)?.with_open_walls()])
    }),
    refused("on", Some("another mesh"), "another mesh", |s| {
        let other = P1::grid([3.0, 1.0], [4, 2])?;
        let matrix = || elasticity(s, &ROCK).map(|matrix| matrix.into_matrix());
        let (unknown, of_other) = (Scene::new(matrix()?), Scene::new(matrix()?).on(&other));
        Ok([
            unknown.with_contact(contact(s)?),
            of_other.with_contact(contact(s)?),
        ])
    }),
    refused(
        "with_normal_stress_change",
        None,
        "do not follow the displacement",
        |s| {
            let change = Compressed(s.vertex_count());
            Ok([
                body(s)?,
                body(s)?.with_normal_stress_change(change, Vector2::zeros()),
            ])
        },
    ),
    first("in_equilibrium", |s| {
        let loaded = || done(body(s)?.with_load(body_force(s, |_| Vector2::new(0.0, -9e3))));
        Ok([loaded()?, loaded()?.in_equilibrium(Cholesky::new())])
    }),
    first("with_displacement", |s| {
        let bent = s
            .mesh()
            .vertices()
            .iter()
            .map(|x| Vector2::new(1e-5 * (1.0 - x.y) * (2.0 * x.x).sin(), 0.0));
        Ok([body(s)?, body(s)?.with_displacement(bent.collect())])
    }),
    first("with_velocity", |s| {
        Ok([body(s)?, body(s)?.with_velocity(shearing(s))])
    }),
    first("with_acceleration", |s| {
        // None of the driven side, whose acceleration follows its velocity.
        let vertices = s.mesh().vertices().iter();
        let inside = vertices.map(|x| Vector2::new(x.y * (1.0 - x.y), 0.0));
        Ok([body(s)?, body(s)?.with_acceleration(inside.collect())])
    }),
    first("with_zero_acceleration", |s| {
        let pushed = || done(body(s)?.with_load(body_force(s, |_| Vector2::new(300.0, 0.0))));
        Ok([pushed()?, pushed()?.with_zero_acceleration()])
    }),
    first("with_balanced_rates", |s| {
        let sheared =
            || done(quasi_static(s)?.with_contact(contact(s)?.with_shear_stress(2.0 * SHEAR)));
        Ok([sheared()?, sheared()?.with_balanced_rates()])
    }),
    first("from_time", |s| {
        let pushed = || done(body(s)?.with_load_history(|time, load| load[7].x = 100.0 * time));
        Ok([pushed()?, pushed()?.from_time(1.0)])
    }),
    used("with_state", |s| {
        let older = Contact::new(&s.trace(|x| x[1] == 0.0)?, LAW, NORMAL_STRESS)
            .with_state(AGING, LogTheta(6.0));
        Ok([body(s)?, dynamic(s)?.with_contact(older)])
    }),
    used("with_state_per_vertex", |s| {
        let bottom = s.trace(|x| x[1] == 0.0)?;
        let laws = bottom.map(|x| Dieterich {
            slip_distance: L * (1.0 + x.x),
        });
        let varied = Contact::new(&bottom, LAW, NORMAL_STRESS).with_state_per_vertex(laws, STATE);
        Ok([body(s)?, dynamic(s)?.with_contact(varied)])
    }),
    used("with_free_normal", |s| {
        Ok([
            body(s)?,
            dynamic(s)?.with_contact(contact(s)?.with_free_normal()),
        ])
    }),
    used("unchecked", |s| {
        // Strength that falls with the slip rate at constant state.
        let law = Falling;
        let bottom = s.trace(|x| x[1] == 0.0)?;
        let contact = || Contact::new(&bottom, law, NORMAL_STRESS);
        Ok([
            dynamic(s)?.with_contact(contact()),
            dynamic(s)?.with_contact(contact().unchecked()),
        ])
    }),
    used("with_cohesion", |s| {
        Ok([
            body(s)?,
            dynamic(s)?.with_contact(contact(s)?.with_cohesion(500.0)),
        ])
    }),
    used("with_forced_rupture", |s| {
        let weakens = || {
            let law = LinearWeakening {
                static_friction: 0.6,
                dynamic_friction: 0.1,
            };
            let slip = SlipWeakening { slip_distance: 1.0 };
            let bottom = s.trace(|x| x[1] == 0.0)?;
            done(Contact::new(&bottom, law, NORMAL_STRESS).with_state(slip, Weakening(0.0)))
        };
        let forced = ForcedRupture {
            rupture_time: 0.0,
            duration: 0.2,
        };
        Ok([
            dynamic(s)?.with_contact(weakens()?),
            dynamic(s)?.with_contact(weakens()?.with_forced_rupture(forced)),
        ])
    }),
    used("with_friction_cap", |s| {
        let cap = ForcedCap {
            rupture_time: 0.0,
            duration: 0.2,
            static_friction: 0.5,
            dynamic_friction: 0.01,
        };
        Ok([
            dynamic(s)?.with_contact(contact(s)?),
            dynamic(s)?.with_contact(contact(s)?.with_friction_cap(cap)),
        ])
    }),
    used("with_normal_stress_history", |s| {
        let pressed = contact(s)?.with_normal_stress_history(|time, stress| {
            stress.iter_mut().for_each(|sigma| *sigma *= 1.0 + time)
        });
        Ok([body(s)?, dynamic(s)?.with_contact(pressed)])
    }),
    used("with_field", |s| {
        let count = s.trace(|x| x[1] == 0.0)?.vertices().len();
        let field = GivenPressure::new(count, 0.0, |time, pressure: &mut [f64]| {
            pressure
                .iter_mut()
                .for_each(|own| *own -= NORMAL_STRESS * time)
        });
        Ok([
            body(s)?,
            dynamic(s)?.with_contact(contact(s)?.with_field(field)),
        ])
    }),
    used("with_least_normal_stress", |s| {
        let released = || {
            done(contact(s)?.with_normal_stress_history(|time, stress| {
                stress.fill(NORMAL_STRESS * (1.0 - 10.0 * time))
            }))
        };
        Ok([
            dynamic(s)?.with_contact(released()?),
            dynamic(s)?.with_contact(released()?.with_least_normal_stress(0.5 * NORMAL_STRESS)),
        ])
    }),
    used("with_largest_normal_stress", |s| {
        let pressed = || {
            done(contact(s)?.with_normal_stress_history(|time, stress| {
                stress.fill(NORMAL_STRESS * (1.0 + 10.0 * time))
            }))
        };
        Ok([
            dynamic(s)?.with_contact(pressed()?),
            dynamic(s)?.with_contact(pressed()?.with_largest_normal_stress(1.5 * NORMAL_STRESS)),
        ])
    }),
    used("with_normal_stress_effect", |s| {
        let pressed = || {
            done(contact(s)?.with_normal_stress_history(|time, stress| {
                stress.fill(NORMAL_STRESS * (1.0 + time))
            }))
        };
        Ok([
            dynamic(s)?.with_contact(pressed()?),
            dynamic(s)?.with_contact(pressed()?.with_normal_stress_effect(0.3)),
        ])
    }),
    used("allow_opening", |s| {
        let lifted = || {
            done(contact(s)?.with_normal_stress_history(|time, stress| {
                stress.fill(NORMAL_STRESS * (1.0 - 10.0 * time))
            }))
        };
        Ok([
            dynamic(s)?.with_contact(lifted()?),
            dynamic(s)?.with_contact(lifted()?.allow_opening()),
        ])
    }),
    used("with_shear_stress", |s| {
        Ok([
            body(s)?,
            dynamic(s)?.with_contact(contact(s)?.with_shear_stress(SHEAR)),
        ])
    }),
    used("with_prestress", |s| {
        let stress = |x: &[f64; 3]| [[0.0, 500.0, 0.0], [500.0, -1e3 * x[0], 0.0], [0.0; 3]];
        Ok([
            body(s)?,
            dynamic(s)?.with_contact(contact(s)?.with_prestress(stress)),
        ])
    }),
    refused("at_start", None, "equilibrium", |s| {
        leaning(s, NormalStress::at_start)
    }),
    refused("with_relaxation_time", None, "equilibrium", |s| {
        leaning(s, |stress| stress.with_relaxation_time(0.1))
    }),
    refused("with_relaxation_distance", None, "equilibrium", |s| {
        leaning(s, |stress| stress.with_relaxation_distance(1e-4))
    }),
    // Refused by name where there is nothing that it could act on.
    refused("with_acceleration", Some("mass"), "mass", |s| {
        let light = || done(quasi_static(s)?.with_contact(contact(s)?));
        Ok([light()?, light()?.with_zero_acceleration()])
    }),
    refused(
        "with_balanced_rates",
        Some("without mass"),
        "without mass",
        |s| Ok([body(s)?, body(s)?.with_balanced_rates()]),
    ),
];
