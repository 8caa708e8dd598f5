//! The same bits on any number of threads.

use nalgebra::Vector1;
use stickslip_fem::{Constraints, GridDiagonal, Mesh, P1, antiplane};
use stickslip_friction::{DieterichRuina, Radial, Tresca};
use stickslip_solvers::{
    Basis, DenseNewton, Energy, LinearSolver, Link, Links, Matrix, MultigridSolver,
    NonsmoothSolver, Operator, Stopping, Symmetric, Tnnmg,
};
use stickslip_state::LogTheta;

const LAW: DieterichRuina = DieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};

/// The velocity, its energy and the solution of a linear problem.
type Solved = (Vec<Vector1<f64>>, f64, Vec<Vector1<f64>>);

/// In a pool of so many threads.
fn inside<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads");
    pool.install(work)
}

/// A layer of 33 000 vertices whose base slides where its weight is small, by both multigrid solvers.
fn solve(single_precision: bool) -> Solved {
    let space = P1::grid([2.0, 1.0], [2, 1])
        .and_then(|space| space.refined(7))
        .expect("a layer");
    assert!(space.vertex_count() > 30_000);
    let base = space.trace(|x| x[1] == 0.0).expect("base");
    let top = space.trace(|x| x[1] == 1.0).expect("top");
    let operator = antiplane(&space, 1.0).expect("stiffness").into_matrix();
    let mut fixed = Constraints::none(&space);
    fixed.fix(&top, [true]).expect("held");
    let load = vec![Vector1::new(0.0); space.vertex_count()];
    let mut v = load.clone();
    top.vertices().iter().for_each(|&p| v[p][0] = 1.0);
    let law = Tresca { coefficient: 1.0 };
    let strength = base
        .vertices()
        .iter()
        .map(|&p| 0.4 + 0.8 * space.mesh().vertices()[p][0]);
    let friction: Vec<_> = (base.weights().iter().zip(strength))
        .map(|(weight, strength)| Radial {
            law,
            force: weight * strength,
            state: (),
        })
        .collect();
    let energy = Energy {
        operator: &operator,
        load: &load,
        potentials: &friction,
        vertices: base.vertices(),
        fixed: fixed.as_slice(),
    };
    let stopping = Stopping {
        norm: &operator,
        tolerance: 1e-10,
        relative: 0.0,
        equivalence: 1.0,
        max_iterations: 100,
    };
    let mut solver = Tnnmg::new(space.transfers());
    if single_precision {
        solver = solver.in_single_precision();
    }
    solver.prepare(&energy).expect("prepared");
    solver.minimize(&energy, &stopping, &mut v).expect("solved");

    let mut linear = MultigridSolver::new(space.transfers());
    linear
        .prepare(&operator, fixed.as_slice())
        .expect("prepared");
    let mut x = load.clone();
    let mut forces = load.clone();
    operator.multiply_add(1.0, &v, &mut forces);
    linear.solve(&operator, &forces, &mut x).expect("solved");
    (v.clone(), operator.norm(&v), x)
}

/// The layer cut at half its height by a fault that ends inside, which slides under the shear of its top.
fn solve_two_sides() -> (Vec<Vector1<f64>>, usize) {
    let mesh = Mesh::<2>::grid([2.0, 1.0], [4, 2], GridDiagonal::Rising)
        .and_then(|mesh| mesh.with_surface_where("fault", |x| x[1] == 0.5 && x[0] <= 1.5))
        .and_then(|mesh| mesh.split("fault"))
        .expect("a fault");
    let space = P1::new(mesh).refined(6).expect("a layer");
    assert!(space.vertex_count() > 30_000);
    let plus = space.part("fault+").expect("plus side");
    let opposite = plus.opposite().expect("a pair for each vertex");
    let pairs = plus.vertices().iter().zip(opposite);
    let pairs: Vec<_> = pairs.filter(|(plus, minus)| plus != minus).collect();
    let mut basis = Basis::none(space.vertex_count());
    basis.links = Links::new(pairs.iter().map(|&(&plus, &minus)| Link {
        share: 0.5,
        ..Link::new(plus, vec![minus])
    }));
    let mut operator = antiplane(&space, 1.0).expect("stiffness").into_matrix();
    assert!(operator.change_basis(&basis));
    let mut fixed = Constraints::none(&space);
    let [base, top] = [0.0, 1.0].map(|y| space.trace(|x| x[1] == y).expect("a side"));
    fixed.fix(&top, [true]).expect("held");
    fixed.fix(&base, [true]).expect("held");
    let load = vec![Vector1::new(0.0); space.vertex_count()];
    let mut v = load.clone();
    top.vertices().iter().for_each(|&p| v[p][0] = 1.0);
    let mut slides: Vec<_> = (plus.vertices().iter().zip(plus.weights()))
        .filter(|(p, _)| pairs.iter().any(|(plus, _)| plus == p))
        .map(|(&p, &weight)| (p, weight * (0.4 + 0.8 * space.mesh().vertices()[p][0])))
        .collect();
    slides.sort_by_key(|&(p, _)| p);
    let (vertices, friction): (Vec<_>, Vec<_>) = (slides.into_iter())
        .map(|(p, force)| {
            let law = Tresca { coefficient: 1.0 };
            (
                p,
                Radial {
                    law,
                    force,
                    state: (),
                },
            )
        })
        .unzip();
    let energy = Energy {
        operator: &operator,
        load: &load,
        potentials: &friction,
        vertices: &vertices,
        fixed: fixed.as_slice(),
    };
    let stopping = Stopping {
        norm: &operator,
        tolerance: 1e-10,
        relative: 0.0,
        equivalence: 1.0,
        max_iterations: 100,
    };
    let mut solver = Tnnmg::new(space.transfers());
    NonsmoothSolver::change_basis(&mut solver, &basis);
    solver.prepare(&energy).expect("prepared");
    solver.minimize(&energy, &stopping, &mut v).expect("solved");
    let slipping = vertices.iter().filter(|&&p| v[p][0] != 0.0).count();
    (v, slipping)
}

#[test]
fn the_bits_of_two_sides_do_not_depend_on_the_threads() {
    let [alone, two, three] = [1, 2, 3].map(|threads| inside(threads, solve_two_sides));
    assert!(alone.1 > 10, "{}", alone.1);
    assert!(alone == two && alone == three);
    assert!(alone == solve_two_sides());
}

#[test]
fn the_bits_do_not_depend_on_the_threads() {
    for single_precision in [false, true] {
        let solve = || solve(single_precision);
        let [alone, two, three] = [1, 2, 3].map(|threads| inside(threads, solve));
        assert!(alone.0.iter().any(|v| v[0] > 0.0 && v[0] < 1.0));
        assert!(alone == two && alone == three);
        // From outside, in the pool that there is for all.
        assert!(alone == solve());
    }
}

/// A long contact: a dense operator that couples all of its vertices, a part of which slides, another one at rest.
fn slide() -> Vec<Vector1<f64>> {
    const COUNT: usize = 2100;
    let operator = Symmetric::new(&[[true]; COUNT], |i, j| {
        if i == j {
            2.0
        } else {
            0.2 / ((i - j) as f64).powi(2)
        }
    });
    let place = |k: usize| k as f64 / COUNT as f64;
    let friction: Vec<_> = (0..COUNT)
        .map(|k| Radial {
            law: LAW,
            force: 1.0 + place(k),
            state: LogTheta(2.0),
        })
        .collect();
    let load: Vec<_> = (0..COUNT).map(|_| Vector1::new(1.0)).collect();
    let vertices: Vec<_> = (0..COUNT).collect();
    let energy = Energy {
        operator: &operator,
        load: &load,
        potentials: &friction,
        vertices: &vertices,
        fixed: &[[false]; COUNT],
    };
    let stopping = Stopping::in_energy_norm(&operator, 1e-10);
    let mut v = vec![Vector1::new(0.0); COUNT];
    let mut solver = DenseNewton::new();
    solver.prepare(&energy).expect("prepared");
    solver.minimize(&energy, &stopping, &mut v).expect("solved");
    v
}

#[test]
fn the_bits_of_a_long_contact_do_not_depend_on_the_threads() {
    let [alone, two, three] = [1, 2, 3].map(|threads| inside(threads, slide));
    assert!(alone.iter().any(|v| v[0] > 0.01) && alone.iter().any(|v| v[0] < 1e-6));
    assert!(alone == two && alone == three);
    assert!(alone == slide());
}
