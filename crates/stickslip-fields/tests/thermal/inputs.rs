//! Wrong parameters, and their messages.

use stickslip_fields::{
    PerVertex, PoreFluid, ShearHeating, ShearZone, ThermalError, ThermalPressurization,
};

use super::zones::{fluid, zone};

fn heating(change: impl FnOnce(&mut ShearZone)) -> String {
    let mut zone = zone(0.01, 1e-6);
    change(&mut zone);
    let refused = ShearHeating::new(3, zone.clone()).expect_err("the zone is refused");
    let with_fluid = ThermalPressurization::new(3, zone, fluid(1e-4));
    assert_eq!(
        with_fluid.err().map(|error| error.to_string()),
        Some(refused.to_string())
    );
    refused.to_string()
}

fn pressurization(change: impl FnOnce(&mut PoreFluid)) -> String {
    let mut fluid = fluid(1e-4);
    change(&mut fluid);
    let refused = ThermalPressurization::new(3, zone(0.01, 1e-6), fluid);
    refused.expect_err("the fluid is refused").to_string()
}

/// One wrong value, of all vertices and of the last alone.
fn each(wrong: f64, right: f64) -> [PerVertex; 2] {
    [wrong.into(), vec![right, right, wrong].into()]
}

#[test]
fn values_out_of_range_are_refused_with_their_vertex() {
    let expect = |found: String, what: &str, value: f64, vertex: usize, advice: &str| {
        let begin = format!("{what} is {value:e} ");
        assert!(found.starts_with(&begin), "{found}");
        assert!(
            found.contains(&format!(" at vertex {vertex}, must be finite and ")),
            "{found}"
        );
        assert!(found.ends_with(advice), "{found}");
    };
    for wrong in [-1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (vertex, k) in [(0, 0), (2, 1)] {
            let value = |right: f64| each(wrong, right)[k].clone();
            let found = heating(|zone| zone.half_width = value(0.01));
            expect(
                found,
                "half width",
                wrong,
                vertex,
                "use a half width of 1e-5 m for a plane",
            );
            let found = heating(|zone| zone.volumetric_heat_capacity = value(2e6));
            expect(
                found,
                "volumetric heat capacity",
                wrong,
                vertex,
                "rock has about 2.7e6 J/(m^3 K)",
            );
            let found = heating(|zone| zone.thermal_diffusivity = value(1e-6));
            expect(
                found,
                "thermal diffusivity",
                wrong,
                vertex,
                "and 0 is adiabatic",
            );
            let found = heating(|zone| zone.initial_temperature = value(300.0));
            expect(
                found,
                "initial temperature",
                wrong,
                vertex,
                "273.15 more than degrees Celsius",
            );
            let found = pressurization(|fluid| fluid.hydraulic_diffusivity = value(1e-4));
            expect(
                found,
                "hydraulic diffusivity",
                wrong,
                vertex,
                "and 0 is undrained",
            );
            let found = pressurization(|fluid| fluid.pressurization_coefficient = value(1e5));
            expect(
                found,
                "pressurization coefficient",
                wrong,
                vertex,
                "by `ShearHeating`",
            );
        }
    }
}

#[test]
fn zero_is_refused_where_it_divides() {
    let plane = "half width is 0e0 m at vertex 0, must be finite and above 0: use a half width of 1e-5 m for a plane";
    assert_eq!(heating(|zone| zone.half_width = 0.0.into()), plane);
    let found = heating(|zone| zone.volumetric_heat_capacity = 0.0.into());
    assert!(
        found.starts_with("volumetric heat capacity is 0e0 J/(m^3 K) at vertex 0"),
        "{found}"
    );
    let found = heating(|zone| zone.initial_temperature = 0.0.into());
    assert!(
        found.starts_with("initial temperature is 0e0 K at vertex 0"),
        "{found}"
    );
}

#[test]
fn numbers_of_values_are_those_of_the_vertices() {
    let values: PerVertex = [1e-2, 2e-2][..].into();
    let expected =
        |what: &str| format!("{what} has 2 values for 3 vertices: pass one, or one per vertex");
    let found = heating(|zone| zone.half_width = values.clone());
    assert_eq!(found, expected("half width"));
    let found = heating(|zone| zone.volumetric_heat_capacity = values.clone());
    assert_eq!(found, expected("volumetric heat capacity"));
    let found = heating(|zone| zone.thermal_diffusivity = values.clone());
    assert_eq!(found, expected("thermal diffusivity"));
    let found = heating(|zone| zone.initial_temperature = values.clone());
    assert_eq!(found, expected("initial temperature"));
    let found = pressurization(|fluid| fluid.hydraulic_diffusivity = values.clone());
    assert_eq!(found, expected("hydraulic diffusivity"));
    let found = pressurization(|fluid| fluid.pressurization_coefficient = Vec::new().into());
    assert!(
        found.starts_with("pressurization coefficient has 0 values"),
        "{found}"
    );
}

#[test]
fn vertices_and_modes_are_in_range() {
    let none = ShearHeating::new(0, zone(0.01, 1e-6));
    assert_eq!(none.err(), Some(ThermalError::NoVertices));
    for modes in [0, 1, 65, usize::MAX] {
        let expected = ThermalError::Modes { modes, largest: 64 };
        let heating = ShearHeating::new(1, zone(0.01, 1e-6));
        assert_eq!(
            heating.and_then(|field| field.with_modes(modes)).err(),
            Some(expected)
        );
        let field = ThermalPressurization::new(1, zone(0.01, 1e-6), fluid(1e-4));
        assert_eq!(
            field.and_then(|field| field.with_modes(modes)).err(),
            Some(expected)
        );
        assert!(expected.to_string().contains("must be from 2 to 64"));
    }
}
