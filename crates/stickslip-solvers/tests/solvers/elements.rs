//! The stiffness by elements beside the matrix that it stands for.

use std::collections::BTreeSet;

use nalgebra::{Matrix2, Matrix3, SMatrix, SVector};
use proptest::prelude::*;
use stickslip_fem::{
    Assembled, BlockMatrix, Elastic, GridDiagonal, Mesh, P1, Viscous, elasticity_by_cell,
    element_stiffness_by_cell, lumped_mass, viscosity_by_cell,
};
use stickslip_solvers::{
    Basis, ElementOperator, IntoOperator, Link, Links, MassMatrix, Matrix, Operator,
};

/// A grid whose inner vertices are anywhere within a third of a cell, with its numbering shuffled.
fn space<const D: usize>(cells: [usize; D], random: &[f64]) -> P1<D> {
    let size = cells.map(|count| count as f64);
    let grid = P1::grid(size, cells).expect("a grid");
    let mut turn = random.iter().cycle();
    let mut next = || *turn.next().expect("numbers");
    let mesh = grid.mesh();
    let count = mesh.vertex_count();
    // A permutation by keys that random numbers make.
    let mut order: Vec<usize> = (0..count).collect();
    let keys: Vec<f64> = (0..count)
        .map(|k| (next() * 97.0 + k as f64 * 0.618).fract())
        .collect();
    order.sort_by(|&i, &j| keys[i].total_cmp(&keys[j]));
    let mut place = vec![0; count];
    for (k, &i) in order.iter().enumerate() {
        place[i] = k as u32;
    }
    let vertices = order.iter().map(|&i| {
        let x = mesh.vertices()[i];
        SVector::from_fn(|c, _| {
            let inside = x[c] > 0.0 && x[c] < size[c];
            x[c] + if inside { 0.3 * (next() - 0.5) } else { 0.0 }
        })
    });
    let corners = mesh.cells().flatten().map(|&p| place[p as usize]);
    P1::new(Mesh::new(vertices.collect(), corners.collect()).expect("a mesh"))
}

/// Vectors and numbers from a list of numbers, again and again.
fn field<const D: usize>(count: usize, random: &[f64]) -> Vec<SVector<f64, D>> {
    let at = |k: usize| random[k % random.len()] - 0.5 + 0.01 * (k as f64 * 0.7).sin();
    (0..count)
        .map(|i| SVector::from_fn(|c, _| at(D * i + c)))
        .collect()
}

fn rock(random: &[f64], cell: usize) -> Elastic {
    let at = |k: usize| random[(3 * cell + k) % random.len()];
    Elastic {
        young_modulus: 10_f64.powf(2.0 * at(0)),
        poisson_ratio: 0.49 * at(1) - 0.1,
    }
}

/// `(A x)_i` and the sum of the sizes of its terms.
fn row<const D: usize>(
    matrix: &BlockMatrix<D>,
    i: usize,
    x: &[SVector<f64, D>],
) -> (SVector<f64, D>, f64) {
    let row = matrix.outer_view(i).expect("a row");
    let terms = row
        .iter()
        .map(|(j, block)| (block * x[j], block.amax() * x[j].amax()));
    terms.fold((SVector::zeros(), 0.0), |(sum, size), (term, own)| {
        (sum + term, size + own)
    })
}

const ROUNDING: f64 = 1e-13;

/// Products, rows and diagonals of an operator are those of a matrix.
fn is_same<const D: usize>(
    operator: &ElementOperator<D>,
    matrix: &BlockMatrix<D>,
    x: &[SVector<f64, D>],
) -> Result<(), TestCaseError> {
    let mut y = vec![SVector::repeat(1.0); x.len()];
    operator.multiply_add(-2.0, x, &mut y);
    let largest = (0..x.len())
        .map(|i| row(matrix, i, x).1)
        .fold(0.0, f64::max);
    let mut square = 0.0;
    for i in 0..x.len() {
        let (expected, size) = row(matrix, i, x);
        let found = (SVector::repeat(1.0) - y[i]) / 2.0;
        prop_assert!((found - expected).amax() <= ROUNDING * size.max(1.0));
        let single = operator.product_at(i, x);
        prop_assert!((single - expected).amax() <= ROUNDING * size.max(1e-3 * largest));
        let block = matrix.diagonal_block(i);
        let error = (operator.diagonal_block(i) - block).amax();
        prop_assert!(error <= ROUNDING * block.amax());
        square += x[i].dot(&expected);
    }
    let error = (operator.quadratic(x) - square).abs();
    prop_assert!(error <= 1e-12 * largest * x.len() as f64);
    Ok(())
}

fn operators<const D: usize>(space: &P1<D>, random: &[f64]) -> (ElementOperator<D>, Assembled<D>) {
    let elements = element_stiffness_by_cell(space, |_, cell| rock(random, cell)).expect("rock");
    let matrix = elasticity_by_cell(space, |_, cell| rock(random, cell)).expect("rock");
    (elements.into_operator(), matrix)
}

/// Many simplices, each cut into cells around a vertex inside: the first and the last cell of a chain share vertices, too.
fn cut_simplices<const D: usize>(random: &[f64]) -> P1<D> {
    let (mut vertices, mut cells) = (Vec::new(), Vec::new());
    for k in 0..17 {
        let begin = vertices.len() as u32;
        let origin = SVector::<f64, D>::repeat(2.0 * k as f64);
        let at = |c: usize| 0.1 + 0.3 * random[(D * k + c) % random.len()];
        vertices.push(origin + SVector::from_fn(|c, _| at(c) / D as f64));
        vertices.push(origin);
        for c in 0..D {
            vertices.push(origin + SVector::from_fn(|r, _| if r == c { 1.0 } else { 0.0 }));
        }
        for left_out in 0..=D {
            let others = (0..=D).filter(|&c| c != left_out);
            let corners = others.map(|c| begin + 1 + c as u32);
            cells.extend(std::iter::once(begin).chain(corners));
            if left_out % 2 == 1 {
                // Volumes are positive.
                let last = cells.len() - 1;
                cells.swap(last - 1, last);
            }
        }
    }
    P1::new(Mesh::new(vertices, cells).expect("a mesh"))
}

fn numbers() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(0.0..1.0, 50..200)
}

proptest! {
    #[test]
    fn cells_around_a_vertex_add_up(random in numbers()) {
        let space = cut_simplices::<2>(&random);
        let (operator, matrix) = operators(&space, &random);
        is_same(&operator, &matrix, &field(space.vertex_count(), &random))?;
        let space = cut_simplices::<3>(&random);
        let (operator, matrix) = operators(&space, &random);
        is_same(&operator, &matrix, &field(space.vertex_count(), &random))?;
    }

    #[test]
    fn products_are_those_of_the_matrix(
        random in numbers(),
        (a, b, c) in (1..5_usize, 1..5_usize, 1..5_usize),
    ) {
        let plane = space([a, b], &random);
        let (elements, matrix) = operators(&plane, &random);
        is_same(&elements, &matrix, &field(plane.vertex_count(), &random))?;
        let solid = space([a, b, c], &random);
        let (elements, matrix) = operators(&solid, &random);
        is_same(&elements, &matrix, &field(solid.vertex_count(), &random))?;
    }

    #[test]
    fn viscosities_share_the_cells(random in numbers(), factor in 0.1..10.0) {
        let solid = space([2, 2, 1], &random);
        let viscous = |cell: usize| Viscous {
            shear_viscosity: if cell.is_multiple_of(3) { 0.0 } else { random[cell % random.len()] },
            bulk_viscosity: random[(cell + 7) % random.len()],
        };
        let stiffness = element_stiffness_by_cell(&solid, |_, cell| rock(&random, cell))?;
        let x = field(solid.vertex_count(), &random);
        let viscosity = stiffness.viscosity_by_cell(viscous)?.into_operator();
        let matrix = viscosity_by_cell(&solid, |_, cell| viscous(cell))?;
        is_same(&viscosity, &matrix, &x)?;
        let matrix = elasticity_by_cell(&solid, |_, cell| rock(&random, cell))?;
        is_same(&(&stiffness * factor).into_operator(), &(&matrix * factor), &x)?;
    }

    /// Turned axes, jumps across a fault, and sums with matrices and masses.
    #[test]
    fn other_unknowns_and_sums_are_those_of_the_matrix(
        random in numbers(),
        angle in 0.0..3.0,
        share in 0.0..0.9,
        reversed in any::<bool>(),
    ) {
        let (sin, cos) = f64::sin_cos(angle);
        let plane = space([3, 2], &random);
        changed(&plane, &random, Matrix2::new(cos, -sin, sin, cos), (share, reversed))?;
        let solid = space([2, 2, 1], &random);
        let axes = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
        changed(&solid, &random, axes, (share, reversed))?;
    }
}

fn changed<const D: usize>(
    space: &P1<D>,
    random: &[f64],
    axes: SMatrix<f64, D, D>,
    (share, reversed): (f64, bool),
) -> Result<(), TestCaseError> {
    let size = space.vertex_count();
    let mut basis = Basis::none(size);
    basis.axes.set(2, axes);
    basis.axes.set(5, axes.transpose());
    let link = Link {
        reversed,
        share,
        ..Link::new(2, vec![7])
    };
    basis.links = Links::new([link, Link::new(3, vec![8])]);
    let (mut elements, matrix) = operators(space, random);
    let mut matrix = matrix.into_matrix();
    let diagonal = |i: usize| SMatrix::from_diagonal_element(1.0 + random[i % random.len()]);
    let starts = (0..=size as u32).collect();
    let columns = (0..size as u32).collect();
    let dashpots = BlockMatrix::new(
        (size, size),
        starts,
        columns,
        (0..size).map(diagonal).collect(),
    );
    prop_assert!(elements.change_basis(&basis) && matrix.change_basis(&basis));
    let x = field(size, random);
    is_same(&elements, &matrix, &x)?;
    let own = ElementOperator::from(dashpots.clone());
    let mass: MassMatrix<D> = dashpots.clone().into_mass();
    let mut sum =
        ElementOperator::combination_with(&[(1.0, &elements), (1.0, &own)], Some((1.0, &mass)));
    sum.set_combination_with(&[(0.5, &elements), (3.0, &own)], Some((2.0, &mass)));
    let expected =
        BlockMatrix::combination_with(&[(0.5, &matrix), (3.0, &dashpots)], Some((2.0, &mass)));
    is_same(&sum, &expected, &x)
}

/// A body of several groups of cells, and one whose number of cells is no multiple of four.
#[test]
fn groups_of_cells_add_up() -> Result<(), TestCaseError> {
    let random: Vec<f64> = (0..101).map(|k| (f64::from(k) * 0.618).fract()).collect();
    let solid = P1::grid([3.0, 2.0, 1.0], [24, 16, 9])?;
    let (elements, matrix) = operators(&solid, &random);
    is_same(&elements, &matrix, &field(solid.vertex_count(), &random))?;
    let plane = P1::new(Mesh::<2>::grid([3.0, 1.0], [3, 1], GridDiagonal::Rising)?);
    let (elements, matrix) = operators(&plane, &random);
    is_same(&elements, &matrix, &field(plane.vertex_count(), &random))?;
    Ok(())
}

/// A mesh without order: nothing depends on the number of threads.
#[cfg(feature = "rayon")]
#[test]
fn bits_are_those_of_one_thread() -> Result<(), Box<dyn std::error::Error>> {
    let random: Vec<f64> = (0..997).map(|k| (f64::from(k) * 0.618).fract()).collect();
    let solid = space([20, 20, 30], &random);
    let (elements, _) = operators(&solid, &random);
    let x = field(solid.vertex_count(), &random);
    let product = |threads: usize| -> Result<Vec<u64>, rayon::ThreadPoolBuildError> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()?;
        let mut y = vec![SVector::zeros(); x.len()];
        pool.install(|| elements.multiply_add(1.0, &x, &mut y));
        Ok(y.iter().flatten().map(|y| y.to_bits()).collect())
    };
    let alone = product(1)?;
    for threads in [2, 4] {
        assert!(product(threads)? == alone, "{threads}");
    }
    Ok(())
}

/// The vertices of the cells of each vertex.
fn around<const D: usize>(space: &P1<D>) -> Vec<BTreeSet<usize>> {
    let mut around = vec![BTreeSet::new(); space.vertex_count()];
    for cell in space.mesh().cells() {
        for &p in cell {
            around[p as usize].extend(cell.iter().map(|&q| q as usize));
        }
    }
    around
}

/// The levels of local steps add up to the stiffness, and the vertices within two rings of cells around a vertex of cells of level
/// `l` are `2^l` times slower than the fastest; returns the number of levels.
fn has_levels<const D: usize>(
    space: &P1<D>,
    random: &[f64],
    levels: usize,
) -> Result<usize, TestCaseError> {
    let whole = element_stiffness_by_cell(space, |_, cell| rock(random, cell)).expect("rock");
    let mass = lumped_mass::<D, D>(space, 2.0).expect("a mass");
    let count = space.vertex_count();
    let finest = [count / 2, (random[0] * count as f64) as usize];
    let own = whole
        .with_local_steps(space, &mass, &finest, levels)
        .expect("levels");
    let squares: Vec<f64> = (0..count)
        .map(|i| whole.diagonal_block(i).diagonal().max() / mass.data()[i][(0, 0)])
        .collect();
    let highest = squares.iter().copied().fold(0.0, f64::max);
    let around = around(space);
    for i in 0..count {
        let interval = f64::from(1 << own.level_at(i));
        for &j in around[i].iter().flat_map(|&k| &around[k]) {
            prop_assert!(interval.powi(2) * squares[j] <= highest * (1.0 + 1e-8));
            prop_assert!(interval == 1.0 || j != finest[0] && j != finest[1]);
        }
    }
    prop_assert!(own.levels() <= levels);
    let cells: usize = own.cells_of_levels().iter().sum();
    prop_assert_eq!(cells, space.mesh().cell_count());
    let matrix = elasticity_by_cell(space, |_, cell| rock(random, cell)).expect("rock");
    let x = field(count, random);
    let weights: Vec<f64> = random
        .iter()
        .take(levels)
        .map(|x| (4.0 * x).floor())
        .collect();
    let by_weights = |weights: &[f64]| {
        let mut y = vec![SVector::<f64, D>::zeros(); count];
        own.multiply_add_levels(weights, 1.0, &x, &mut y);
        y
    };
    let found = by_weights(&weights);
    // By parts: each vertex is in one part, which begins before its sums and ends behind them.
    let [mut y, mut copy, mut places] = [(); 3].map(|()| field(count, random));
    places.fill(SVector::zeros());
    own.multiply_add_by_parts(
        &weights,
        1.0,
        &x,
        [&mut y, &mut copy, &mut places],
        &|_, y| y.fill(SVector::zeros()),
        &|first, [y, copy, places]| {
            copy.copy_from_slice(y);
            for (place, i) in places.iter_mut().zip(first + 1..) {
                place[0] += i as f64;
            }
        },
    );
    prop_assert_eq!(&y, &found);
    prop_assert_eq!(&copy, &found);
    let all = (1..=count).map(|i| i as f64);
    prop_assert!(places.iter().map(|place| place[0]).eq(all));
    let mut expected = vec![SVector::<f64, D>::zeros(); count];
    for (level, weight) in weights.iter().enumerate() {
        let mut one = vec![0.0; level + 1];
        one[level] = 1.0;
        let part = by_weights(&one);
        expected
            .iter_mut()
            .zip(part)
            .for_each(|(sum, part)| *sum += part * *weight);
    }
    let largest = (0..count)
        .map(|i| row(&matrix, i, &x).1)
        .fold(0.0, f64::max);
    for (found, expected) in found.iter().zip(&expected) {
        prop_assert!((found - expected).amax() <= 4.0 * ROUNDING * largest);
    }
    let count = own.levels();
    is_same(&own.into_operator(), &matrix, &x)?;
    Ok(count)
}

proptest! {
    #[test]
    fn levels_add_up_in_the_plane(random in numbers(), cells in [3_usize..12, 2_usize..12], levels in 1_usize..6) {
        has_levels(&space(cells, &random), &random, levels)?;
    }

    #[test]
    fn levels_add_up_in_space(
        random in numbers(), cells in [2_usize..5, 2_usize..5, 2_usize..5], levels in 1_usize..6,
    ) {
        has_levels(&space(cells, &random), &random, levels)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn levels_add_up_in_graded_bodies(
        random in numbers(), finest in [0.0..12.0_f64, 0.0..12.0_f64], levels in 2_usize..6,
    ) {
        let grid = P1::<2>::grid([12.0; 2], [12; 2]).expect("a grid");
        let edge = |x: &SVector<f64, 2>| 0.0625 + 0.3 * (x - SVector::from(finest)).norm();
        let space = grid.graded(edge).expect("graded");
        prop_assert!(has_levels(&space, &random, levels)? > 1);
    }
}
