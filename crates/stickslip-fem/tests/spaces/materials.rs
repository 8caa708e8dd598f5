//! Materials that depend on the cell, and viscosity.

use approx::assert_relative_eq;
use nalgebra::SVector;
use stickslip_fem::{
    BlockMatrix, Elastic, FemError, Impedance, P1, Viscous, antiplane, antiplane_by_cell,
    antiplane_dashpot, dashpot, elasticity, elasticity_by_cell, lumped_mass, lumped_mass_by_cell,
    mass, mass_by_cell, viscosity, viscosity_by_cell,
};

const SOFT: Elastic = Elastic {
    young_modulus: 2.5,
    poisson_ratio: 0.25,
};
const HARD: Elastic = Elastic {
    young_modulus: 7.0,
    poisson_ratio: 0.1,
};
use crate::{negative, not_positive};
const OIL: Viscous = Viscous {
    shear_viscosity: 0.7,
    bulk_viscosity: 0.2,
};

fn bar<const D: usize>() -> P1<D> {
    let size = std::array::from_fn(|axis| if axis == 0 { 4.0 } else { 1.0 });
    let cells = std::array::from_fn(|axis| if axis == 0 { 4 } else { 2 });
    P1::grid(size, cells).unwrap()
}

fn product<const C: usize>(
    matrix: &BlockMatrix<C>,
    field: &[SVector<f64, C>],
) -> Vec<SVector<f64, C>> {
    let rows = matrix.outer_iterator();
    rows.map(|row| row.iter().map(|(q, block)| block * field[q]).sum())
        .collect()
}

/// A bar of two layers that meet at x = 1, pulled by the displacement 1 of its end at x = 4, along `component` alone:
/// the stress s is constant, and 1 = s (1 / m_1 + 3 / m_2) with the moduli of the component.
fn check_two_layers<const D: usize, const C: usize>(
    stiffness: &BlockMatrix<C>,
    space: &P1<D>,
    component: usize,
    moduli: [f64; 2],
) {
    let stress = 1.0 / (1.0 / moduli[0] + 3.0 / moduli[1]);
    let field = space.interpolate(|x| {
        let u = x[0].min(1.0) * stress / moduli[0] + (x[0] - 1.0).max(0.0) * stress / moduli[1];
        SVector::from_fn(|c, _| if c == component { u } else { 0.0 })
    });
    let force = product(stiffness, &field);
    let (mut pull, mut hold) = (0.0, 0.0);
    for (force, x) in force.iter().zip(space.mesh().vertices()) {
        match x[0] {
            4.0 => pull += force[component],
            0.0 => hold += force[component],
            _ => assert!(force[component].abs() < 1e-14, "{x}: {force}"),
        }
    }
    // The cross-section is 1.
    assert_relative_eq!(pull, stress, max_relative = 1e-13);
    assert_relative_eq!(hold, -stress, max_relative = 1e-13);
}

fn two_layers<const D: usize>() {
    let space = bar::<D>();
    let choose = |x: &SVector<f64, D>| if x[0] < 1.0 { SOFT } else { HARD };
    let [(soft_lambda, soft_mu), (hard_lambda, hard_mu)] = [SOFT, HARD].map(|m| m.lame().unwrap());
    let stiffness = elasticity_by_cell(&space, |x, _| choose(x)).unwrap();
    let pressure = [soft_lambda + 2.0 * soft_mu, hard_lambda + 2.0 * hard_mu];
    check_two_layers(&stiffness, &space, 0, pressure);
    check_two_layers(&stiffness, &space, D - 1, [soft_mu, hard_mu]);
    // The same by the index of the cell.
    let soft: Vec<bool> = (space.mesh().cells())
        .map(|cell| {
            cell.iter()
                .all(|&p| space.mesh().vertices()[p as usize][0] <= 1.0)
        })
        .collect();
    let by_index = elasticity_by_cell(&space, |_, cell| if soft[cell] { SOFT } else { HARD });
    assert_eq!(by_index.unwrap(), stiffness);
    let shear = antiplane_by_cell(&space, |x, _| choose(x).lame().unwrap().1).unwrap();
    check_two_layers(&shear, &space, 0, [soft_mu, hard_mu]);

    let oil = |x: &SVector<f64, D>| Viscous {
        shear_viscosity: if x[0] < 1.0 { 0.5 } else { 2.0 },
        bulk_viscosity: 0.0,
    };
    let damping = viscosity_by_cell(&space, |x, _| oil(x)).unwrap();
    check_two_layers(&damping, &space, D - 1, [0.5, 2.0]);
    // 2 eta (1 - 1/3) of what is stretched along one axis alone.
    check_two_layers(&damping, &space, 0, [0.5 * 4.0 / 3.0, 2.0 * 4.0 / 3.0]);
}

#[test]
fn a_bar_of_two_layers_has_one_stress() {
    two_layers::<2>();
    two_layers::<3>();
}

fn masses<const D: usize>() {
    let space = bar::<D>();
    let density = |x: &SVector<f64, D>, _| if x[0] < 1.0 { 2.0 } else { 5.0 };
    let total = |matrix: &BlockMatrix<1>| matrix.data().iter().map(|block| block[0]).sum::<f64>();
    let weight = |matrix: &BlockMatrix<1>| {
        let ends = space.interpolate(|x| SVector::from([x[0]]));
        product(matrix, &ends)
            .iter()
            .map(|force| force[0])
            .sum::<f64>()
    };
    let consistent = mass_by_cell::<D, 1>(&space, density).unwrap();
    let lumped = lumped_mass_by_cell::<D, 1>(&space, density).unwrap();
    for matrix in [consistent, lumped] {
        // The first moment is 2/2 + 5 (16 - 1)/2.
        assert_relative_eq!(weight(&matrix), 1.0 + 37.5, max_relative = 1e-13);
        assert_relative_eq!(total(&matrix), 2.0 + 3.0 * 5.0, max_relative = 1e-13);
    }
}

#[test]
fn masses_add_up_over_their_layers() {
    masses::<2>();
    masses::<3>();
}

fn uniform<const D: usize>() {
    let space = bar::<D>();
    let same = elasticity_by_cell(&space, |_, _| HARD).unwrap();
    assert_eq!(same, elasticity(&space, &HARD).unwrap());
    let same = antiplane_by_cell(&space, |_, _| 0.3).unwrap();
    assert_eq!(same, antiplane(&space, 0.3).unwrap());
    let same = mass_by_cell::<D, D>(&space, |_, _| 0.3).unwrap();
    assert_eq!(same, mass(&space, 0.3).unwrap());
    let same = lumped_mass_by_cell::<D, D>(&space, |_, _| 0.3).unwrap();
    assert_eq!(same, lumped_mass(&space, 0.3).unwrap());
    let same = viscosity_by_cell(&space, |_, _| OIL).unwrap();
    assert_eq!(same, viscosity(&space, &OIL).unwrap());
    // With eta_b = lambda + 2/3 mu and eta_s = mu it is the elastic form.
    let (lambda, mu) = SOFT.lame().unwrap();
    let viscous = Viscous {
        shear_viscosity: mu,
        bulk_viscosity: lambda + 2.0 / 3.0 * mu,
    };
    let (form, elastic) = (
        viscosity(&space, &viscous).unwrap(),
        elasticity(&space, &SOFT).unwrap(),
    );
    for (a, b) in form.data().iter().zip(elastic.data()) {
        assert_relative_eq!(a, b, epsilon = 1e-14);
    }
}

#[test]
fn one_material_everywhere_is_the_uniform_one_to_the_bit() {
    uniform::<2>();
    uniform::<3>();
}

#[test]
fn what_is_out_of_range_is_named_with_its_cell() {
    let space = bar::<2>();
    let in_cell_3 = |source| {
        let FemError::Value {
            what,
            requirement,
            value,
            cell: None,
        } = source
        else {
            panic!("{source}")
        };
        let cell = Some(3);
        let error = FemError::Value {
            what,
            requirement,
            value,
            cell,
        };
        assert!(error.to_string().ends_with(" in cell 3"), "{error}");
        Err(error)
    };
    let value = |cell: usize, wrong: f64| if cell < 3 { 1.0 } else { wrong };
    let elastic = elasticity_by_cell(&space, |_, cell| Elastic {
        young_modulus: value(cell, 0.0),
        ..SOFT
    });
    assert_eq!(
        elastic.map(|_| ()),
        in_cell_3(not_positive("Young's modulus [Pa]", 0.0))
    );
    let shear = antiplane_by_cell(&space, |_, cell| value(cell, -1.0));
    assert_eq!(
        shear.map(|_| ()),
        in_cell_3(not_positive("shear modulus [Pa]", -1.0))
    );
    let heavy = mass_by_cell::<2, 2>(&space, |_, cell| value(cell, f64::INFINITY));
    let error = not_positive("density [kg/m^D]", f64::INFINITY);
    assert_eq!(heavy.map(|_| ()), in_cell_3(error));
    let oil = viscosity_by_cell(&space, |_, cell| Viscous {
        shear_viscosity: value(cell, -1.0),
        ..OIL
    });
    assert_eq!(
        oil.map(|_| ()),
        in_cell_3(negative("viscosity [Pa s]", -1.0))
    );

    let bulk_viscosity = f64::INFINITY;
    let oil = viscosity(
        &space,
        &Viscous {
            bulk_viscosity,
            ..OIL
        },
    );
    let error = negative("viscosity [Pa s]", bulk_viscosity);
    assert_eq!(oil.map(|_| ()), Err(error));
    let side = space.trace(|x| x[0] == 0.0).unwrap();
    let wrong = |normal, tangential| {
        dashpot(&space, &side, |_| Impedance { normal, tangential }).map(|_| ())
    };
    assert_eq!(wrong(0.0, 0.0), Ok(()));
    assert_eq!(wrong(-1.0, 1.0), Err(negative("impedance [Pa s/m]", -1.0)));
    assert_eq!(wrong(1.0, -2.0), Err(negative("impedance [Pa s/m]", -2.0)));
    assert_eq!(
        antiplane_dashpot(&space, &side, |_| -3.0).map(|_| ()),
        Err(negative("impedance [Pa s/m]", -3.0))
    );
    assert_eq!(
        Impedance::of(&SOFT, 0.0),
        Err(not_positive("density [kg/m^D]", 0.0))
    );
}
