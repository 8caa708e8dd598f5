//! Parameters of laws, schemes and materials.

use nalgebra::Vector2;
use stickslip::fem::{Elastic, FemError, Mesh, P1, antiplane};
use stickslip::friction::{DieterichRuina, FrictionError, FrictionViolation, Tresca};
use stickslip::problems::pipping_slider::{AGING, FRICTION, NORMAL_STRESS, PippingSlider};
use stickslip::state::{Dieterich, Number, StateError, StateLawViolation};
use stickslip::time::TimeError;
use stickslip::{
    BoundaryPart, CentralDifferences, Contact, GeneralizedAlpha, Newmark, Point, RateScheme,
    SceneError, Simulation,
};

use super::{ALPHA, NAN, body_error, contact_error, one_line, spring};
use crate::Outcome;
use crate::common::body;

/// The places of a parameter of the law.
type Parameter = fn(&mut DieterichRuina) -> &mut f64;

#[test]
fn laws_with_parameters_out_of_range_are_named() -> Outcome {
    let positive: [(&str, Parameter); 3] = [
        ("a", |law| &mut law.a),
        ("reference_velocity", |law| &mut law.reference_velocity),
        ("slip_distance", |law| &mut law.slip_distance),
    ];
    let non_negative: [(&str, Parameter); 2] = [
        ("b", |law| &mut law.b),
        ("reference_friction", |law| &mut law.reference_friction),
    ];
    let refused = |field: Parameter, value| {
        let mut law = FRICTION;
        *field(&mut law) = value;
        let contact = Contact::new(BoundaryPart::point(1.0), law, NORMAL_STRESS);
        contact_error(contact.with_state(AGING, ALPHA))
    };
    for value in [-1e-3, NAN, f64::INFINITY] {
        for (name, field) in positive.into_iter().chain(non_negative) {
            let text = refused(field, value)?.to_string();
            assert!(
                text.contains("friction law") && text.contains(name),
                "{text}"
            );
            assert!(text.contains(&Number(value).to_string()), "{text}");
        }
        let slip_distance = value;
        let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, NORMAL_STRESS);
        let error = contact_error(contact.with_state(Dieterich { slip_distance }, ALPHA))?;
        let SceneError::State(StateLawViolation::Refused(StateError::Value {
            what: parameter,
            requirement: "finite and positive",
            ..
        })) = error
        else {
            return Err(error.into());
        };
        assert_eq!(parameter, "slip_distance");
    }
    for (name, field) in positive {
        let error = refused(field, 0.0)?;
        let SceneError::Friction(FrictionViolation::Refused(FrictionError {
            what,
            requirement: "finite and positive",
            value: 0.0,
            ..
        })) = error
        else {
            return Err(error.into());
        };
        assert_eq!(what, name);
    }
    let law = Tresca { coefficient: -0.1 };
    let error = contact_error(Contact::new(BoundaryPart::point(1.0), law, 1e5))?;
    assert!(matches!(
        error,
        SceneError::Friction(FrictionViolation::Refused(FrictionError {
            what: "coefficient",
            requirement: "finite and non-negative",
            value: -0.1,
            ..
        }))
    ));
    Ok(())
}

/// The schemes that no parameters make sense of, by name.
fn senseless_schemes() -> Vec<(&'static str, Box<dyn RateScheme>)> {
    let mut schemes: Vec<(_, Box<dyn RateScheme>)> = Vec::new();
    for (beta, gamma) in [(0.0, 0.5), (0.25, 0.0), (NAN, 0.5), (0.25, 1.1)] {
        schemes.push(("Newmark", Box::new(Newmark { beta, gamma })));
    }
    for spectral_radius in [-0.1, 1.1, NAN] {
        let scheme = GeneralizedAlpha { spectral_radius };
        schemes.push(("generalised-alpha", Box::new(scheme)));
    }
    schemes
}

#[test]
fn schemes_out_of_range_are_named() -> Outcome {
    for (name, scheme) in senseless_schemes() {
        let made = Simulation::new(spring(), scheme, Point);
        let error = one_line(made.err().ok_or("accepted")?)?;
        let SceneError::Time(TimeError { scheme, .. }) = error else {
            return Err(error.into());
        };
        assert_eq!(scheme, name);
    }
    // Without mass an explicit scheme has nothing to solve for.
    let made = Simulation::new(spring(), CentralDifferences, Point);
    let error = one_line(made.err().ok_or("accepted")?)?;
    assert!(
        matches!(
            error,
            SceneError::Unsupported {
                by: SceneError::EXPLICIT,
                ..
            }
        ),
        "{error}"
    );
    Ok(())
}

/// On the way too; the scheme that is at work stays.
#[test]
fn schemes_out_of_range_do_not_take_over() -> Outcome {
    let mut slider = Simulation::new(spring(), Newmark::default(), Point)?;
    let mut steady = Simulation::new(spring(), Newmark::default(), Point)?;
    let explicit: Box<dyn RateScheme> = Box::new(CentralDifferences);
    let senseless = senseless_schemes().into_iter().map(|(_, scheme)| scheme);
    for scheme in senseless.chain([explicit]) {
        let error = slider.set_scheme(scheme).err().ok_or("accepted")?;
        one_line(error)?;
        assert_eq!(slider.step(0.1)?, steady.step(0.1)?);
        assert_eq!(slider.state(), steady.state());
        assert_eq!(slider.scheme().properties(), steady.scheme().properties());
    }
    Ok(())
}

#[test]
fn material_data_out_of_range_are_named() -> Outcome {
    let paper = body(0);
    let space = paper.space()?;
    let error = |slider: PippingSlider| slider.scene(&space).err().ok_or("accepted");
    for value in [0.0, -1.0, NAN, f64::INFINITY] {
        let slider = PippingSlider {
            density: value,
            ..paper
        };
        let SceneError::Fem(FemError::Value {
            what: "density [kg/m^D]",
            value: found,
            ..
        }) = one_line(error(slider)?)?
        else {
            return Err("not the density".into());
        };
        assert_eq!(found.to_bits(), value.to_bits());
        let elastic = Elastic {
            young_modulus: value,
            ..paper.elastic
        };
        let error = one_line(error(PippingSlider { elastic, ..paper })?)?;
        assert!(matches!(
            error,
            SceneError::Fem(FemError::Value {
                what: "Young's modulus [Pa]",
                ..
            })
        ));
        assert!(antiplane(&space, value).is_err());
    }
    for poisson_ratio in [0.5, -1.0, 0.7, NAN] {
        let elastic = Elastic {
            poisson_ratio,
            ..paper.elastic
        };
        let error = one_line(error(PippingSlider { elastic, ..paper })?)?;
        assert!(matches!(
            error,
            SceneError::Fem(FemError::Value {
                what: "Poisson's ratio",
                ..
            })
        ));
    }
    for gravity in [NAN, f64::INFINITY] {
        let scene = PippingSlider { gravity, ..paper }.scene(&space)?;
        let error = body_error(scene)?;
        assert!(matches!(error, SceneError::Value { what: "load", .. }));
    }
    let error = body(40).space().err().ok_or("refined 40 times")?;
    assert!(matches!(
        one_line(error)?,
        SceneError::Fem(FemError::TooMany {
            what: "vertices",
            ..
        })
    ));
    // A body whose sides are elsewhere has no bottom.
    let elsewhere = P1::new(Mesh::new(
        vec![
            Vector2::new(1.0, 1.0),
            Vector2::new(2.0, 1.0),
            Vector2::new(1.0, 2.0),
        ],
        vec![0, 1, 2],
    )?);
    let error = PippingSlider::bottom(&elsewhere).err().ok_or("a bottom")?;
    assert!(matches!(
        one_line(error)?,
        SceneError::Fem(FemError::Empty {
            what: "faces of the boundary that satisfy the predicate",
            ..
        })
    ));
    Ok(())
}
