//! Parameters of laws, schemes and materials.

use nalgebra::Vector2;
use stickslip::fem::{Elastic, FemError, P1, antiplane};
use stickslip::friction::{DieterichRuina, FrictionError, Tresca};
use stickslip::problems::{FRICTION, NORMAL_STRESS, Slider};
use stickslip::state::{Dieterich, StateError};
use stickslip::time::TimeError;
use stickslip::{Newmark, Patch, Point, SceneError, Simulation};

use crate::common::{Outcome, body};
use crate::{ALPHA, NAN, aging_spring, body_error, error_of, one_line, spring};

/// Where a parameter of the law is.
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
    let scene = |field: Parameter, value| {
        let mut law = FRICTION;
        *field(&mut law) = value;
        aging_spring().with_friction(Patch::point(1.0), law, NORMAL_STRESS)
    };
    for value in [-1e-3, NAN, f64::INFINITY] {
        for (name, field) in positive.into_iter().chain(non_negative) {
            let text = error_of(scene(field, value))?.to_string();
            assert!(
                text.contains("friction law") && text.contains(name),
                "{text}"
            );
            assert!(text.contains(&value.to_string()), "{text}");
        }
        let slip_distance = value;
        let error = error_of(aging_spring().with_state(Dieterich { slip_distance }, ALPHA))?;
        let SceneError::State(StateError::NotPositive { parameter, .. }) = error else {
            return Err(error.into());
        };
        assert_eq!(parameter, "slip_distance");
    }
    for (name, field) in positive {
        let error = error_of(scene(field, 0.0))?;
        let expected = FrictionError::NotPositive {
            parameter: name,
            value: 0.0,
        };
        assert_eq!(error, SceneError::Friction(expected));
    }
    let law = Tresca { coefficient: -0.1 };
    let error = error_of(spring().with_friction(Patch::point(1.0), law, 1e5))?;
    assert!(matches!(
        error,
        SceneError::Friction(FrictionError::Negative { .. })
    ));
    Ok(())
}

#[test]
fn schemes_out_of_range_are_named() -> Outcome {
    for scheme in [(0.0, 0.5), (0.25, 0.0), (NAN, 0.5), (0.25, 1.1)] {
        let (beta, gamma) = scheme;
        let made = Simulation::new(spring(), Newmark { beta, gamma }, Point);
        let error = one_line(made.err().ok_or("accepted")?)?;
        assert!(matches!(
            error,
            SceneError::Time(TimeError::InvalidParameter {
                scheme: "Newmark",
                ..
            })
        ));
    }
    Ok(())
}

#[test]
fn material_data_out_of_range_are_named() -> Outcome {
    let paper = body(0);
    let space = paper.space()?;
    let error = |slider: Slider| slider.scene(&space).err().ok_or("accepted");
    for value in [0.0, -1.0, NAN, f64::INFINITY] {
        let slider = Slider {
            density: value,
            ..paper
        };
        let SceneError::Fem(FemError::Density { value: found }) = one_line(error(slider)?)? else {
            return Err("not the density".into());
        };
        assert_eq!(found.to_bits(), value.to_bits());
        let elastic = Elastic {
            young_modulus: value,
            ..paper.elastic
        };
        let error = one_line(error(Slider { elastic, ..paper })?)?;
        assert!(matches!(
            error,
            SceneError::Fem(FemError::YoungModulus { .. })
        ));
        assert!(antiplane(&space, value).is_err());
    }
    for poisson_ratio in [0.5, -1.0, 0.7, NAN] {
        let elastic = Elastic {
            poisson_ratio,
            ..paper.elastic
        };
        let error = one_line(error(Slider { elastic, ..paper })?)?;
        assert!(matches!(
            error,
            SceneError::Fem(FemError::PoissonRatio { .. })
        ));
    }
    for gravity in [NAN, f64::INFINITY] {
        let scene = Slider { gravity, ..paper }.scene(&space)?;
        let error = body_error(scene)?;
        assert!(matches!(error, SceneError::Value { what: "load", .. }));
    }
    let error = body(40).space().err().ok_or("refined 40 times")?;
    assert!(matches!(
        one_line(error)?,
        SceneError::Fem(FemError::TooManyVertices { .. })
    ));
    // A body whose sides are elsewhere has no bottom.
    let elsewhere = P1::new(stickslip::fem::Mesh::new(
        vec![
            Vector2::new(1.0, 1.0),
            Vector2::new(2.0, 1.0),
            Vector2::new(1.0, 2.0),
        ],
        vec![0, 1, 2],
    )?);
    let error = Slider::bottom(&elsewhere).err().ok_or("a bottom")?;
    assert_eq!(one_line(error)?, SceneError::Fem(FemError::EmptyTrace));
    Ok(())
}
