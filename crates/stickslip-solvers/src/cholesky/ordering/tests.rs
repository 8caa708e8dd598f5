//! Orders are permutations with the frictional vertices last, their fill is that of elimination, and each of them
//! solves.

use std::collections::BTreeSet;

use nalgebra::{Matrix2, SVector};
use proptest::prelude::*;

#[cfg(feature = "dissection")]
use super::dissection::nested_dissection;
use super::elimination_order;
use super::fill::Fill;
use super::minimum_degree::minimum_degree;
use crate::block_matrix::{Graph, Rows};
use crate::cholesky::{Analysis, Factored, Layout, Memory, tallest};
use crate::{BlockMatrix, Matrix};

/// The Laplacian of a graph in each of two components that it couples weakly, and the identity: no eigenvalue is
/// below 1.
fn operator(size: usize, edges: &BTreeSet<(usize, usize)>) -> BlockMatrix<2> {
    let coupling = Matrix2::new(1.0, 0.5, 0.5, 1.0);
    let mut blocks = sprs::TriMatI::new((size, size));
    for i in 0..size {
        blocks.add_triplet(i, i, Matrix2::identity());
    }
    for &(i, j) in edges {
        for (row, column, sign) in [(i, i, 1.0), (j, j, 1.0), (i, j, -1.0), (j, i, -1.0)] {
            blocks.add_triplet(row, column, sign * coupling);
        }
    }
    blocks.to_csr()
}

/// The vertices of a grid of `cells` a side, each coupled with all in the same cell of the one below, as on Kuhn's
/// simplices.
fn grid(cells: &[usize]) -> BlockMatrix<2> {
    let size = cells.iter().map(|n| n + 1).product();
    let mut edges = BTreeSet::new();
    for vertex in 0..size {
        for corner in 1..1_usize << cells.len() {
            let (mut rest, mut stride, mut other, mut inside) = (vertex, 1, vertex, true);
            for (d, n) in cells.iter().enumerate() {
                if corner >> d & 1 == 1 {
                    other += stride;
                    inside &= rest % (n + 1) < *n;
                }
                rest /= n + 1;
                stride *= n + 1;
            }
            if inside {
                edges.insert((vertex, other));
            }
        }
    }
    operator(size, &edges)
}

/// A graph of up to 500 vertices, in up to three parts without a connection, and some of its vertices in order.
fn graphs() -> impl Strategy<Value = (BlockMatrix<2>, Vec<usize>)> {
    let size = prop_oneof![Just(0_usize), Just(1), 2..40_usize, 300..500_usize];
    (size, 1..4_usize, 0..4_usize, any::<bool>()).prop_flat_map(|(size, parts, degree, hub)| {
        let ends = prop::collection::vec((0..size.max(1), 0..size.max(1)), size * degree);
        (
            ends,
            prop::collection::btree_set(0..size.max(1), 0..=size / 4),
        )
            .prop_map(move |(ends, frictional)| {
                let connected = |&(i, j): &(usize, usize)| i < j && i % parts == j % parts;
                let mut edges: BTreeSet<_> = ends.into_iter().filter(connected).collect();
                if hub {
                    edges.extend((1..size).map(|j| (0, j)));
                }
                let frictional = frictional.into_iter().filter(|&vertex| vertex < size);
                (operator(size, &edges), frictional.collect())
            })
    })
}

/// The orders that there are, with the frictional vertices last.
fn orders(graph: &Graph<'_>, frictional: &[usize]) -> Vec<Vec<u32>> {
    [
        minimum_degree(graph, frictional).expect("there is memory"),
        elimination_order(graph, frictional, 3).expect("there is memory"),
        #[cfg(feature = "dissection")]
        nested_dissection(graph, frictional).expect("it is small"),
    ]
    .to_vec()
}

/// The blocks of the factor by eliminating one vertex after the other.
fn eliminated(matrix: &BlockMatrix<2>, order: &[u32]) -> usize {
    let mut places = vec![0; order.len()];
    for (place, &vertex) in order.iter().enumerate() {
        places[vertex as usize] = place;
    }
    let mut later: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); order.len()];
    for (_, (i, j)) in matrix.iter() {
        let (i, j) = (places[i as usize], places[j as usize]);
        if i < j {
            later[i].insert(j);
        }
    }
    for k in 0..later.len() {
        let coupled = std::mem::take(&mut later[k]);
        if let Some(&first) = coupled.first() {
            // The others become neighbours of each other; it is enough to say so to the first of them.
            later[first].extend(coupled.iter().skip(1));
        }
        later[k] = coupled;
    }
    later.iter().map(|below| 1 + below.len()).sum()
}

/// `B^-1 r` by a factor in an order.
fn solved(
    matrix: &BlockMatrix<2>,
    order: &[u32],
    load: &[SVector<f64, 2>],
) -> Vec<SVector<f64, 2>> {
    let free = vec![[false; 2]; matrix.rows()];
    let (layout, upper) = Layout::ordered(matrix, &[], &free, order);
    let memory = Memory {
        allowed: usize::MAX,
        beside: 0,
    };
    let analysis = Analysis::new(&layout, &upper, &memory).expect("there is memory");
    let mut factored = Factored {
        entries: vec![0.0; analysis.symbolic.len_val()],
        x: vec![0.0; layout.unknowns()],
        work: vec![0.0; tallest(&analysis.symbolic)],
        layout,
        analysis,
    };
    factored.factorize(matrix).expect("it is definite");
    let mut x = vec![SVector::zeros(); matrix.rows()];
    let gathered = (factored.layout).gather(matrix, load, &x, &mut factored.x);
    gathered.expect("the load is finite");
    factored.solve();
    factored.layout.scatter(&factored.x, &mut x);
    x
}

fn norm(field: &[SVector<f64, 2>]) -> f64 {
    field.iter().map(SVector::norm_squared).sum::<f64>().sqrt()
}

proptest! {
    #[test]
    fn orders_are_permutations_that_end_with_friction((matrix, frictional) in graphs()) {
        let graph = Rows::of(&matrix).graph();
        for order in orders(&graph, &frictional) {
            let mut sorted = order.clone();
            sorted.sort_unstable();
            prop_assert!(sorted.into_iter().eq(0..matrix.rows() as u32));
            let end = &order[order.len() - frictional.len()..];
            prop_assert!(end.iter().map(|&v| v as usize).eq(frictional.iter().copied()));
            prop_assert_eq!(Fill::of(&graph, &order)?.entries(), eliminated(&matrix, &order));
        }
    }

    /// Solutions of `L L^T` in `n` unknowns have a backward error of `(3 n + 1) eps |L| |L^T|`, which is at most `n`
    /// times the matrix in norm (Higham, Accuracy and Stability of Numerical Algorithms, theorem 10.4); two of them, of
    /// a matrix without eigenvalues below 1, are apart by twice that of the solution.
    #[test]
    fn each_order_has_the_same_solution((matrix, _) in graphs(), seed in 0.0..6.0_f64) {
        let rows = Rows::of(&matrix);
        let graph = rows.graph();
        let load: Vec<_> = (0..matrix.rows())
            .map(|i| SVector::from([(seed + i as f64).sin(), (seed * i as f64).cos()]))
            .collect();
        let unordered: Vec<u32> = (0..matrix.rows() as u32).collect();
        let natural = solved(&matrix, &unordered, &load);
        let largest = (0..matrix.rows())
            .map(|i| rows.row(i).map(|(_, block)| 2.0 * block.amax()).sum::<f64>())
            .fold(0.0, f64::max);
        let unknowns = 2.0 * matrix.rows() as f64;
        let bound = 2.0 * (3.0 * unknowns + 1.0) * f64::EPSILON * unknowns * largest;
        for order in orders(&graph, &[]) {
            let solution = solved(&matrix, &order, &load);
            let apart: Vec<_> = solution.iter().zip(&natural).map(|(a, b)| a - b).collect();
            prop_assert!(norm(&apart) <= bound * norm(&solution));
            // And it is one.
            let mut residual = load.clone();
            matrix.multiply_add(-1.0, &solution, &mut residual);
            prop_assert!(norm(&residual) <= bound * norm(&solution));
        }
    }
}

/// In space separators grow as the area, and their factor with the power of 4/3 of the vertices; minimum degree does
/// not find them.
#[cfg(feature = "dissection")]
#[test]
fn dissection_fills_less_in_space_and_is_taken() {
    let cube = grid(&[14, 14, 14]);
    let graph = Rows::of(&cube).graph();
    let bottom: Vec<usize> = (0..15 * 15).collect();
    for frictional in [&[][..], &bottom] {
        let by_degree = minimum_degree(&graph, frictional).expect("there is memory");
        let dissected = nested_dissection(&graph, frictional).expect("it is small");
        let [degree, dissection] =
            [&by_degree, &dissected].map(|order| Fill::of(&graph, order).expect("there is memory"));
        assert!(dissection.entries() < degree.entries());
        assert!(dissection.multiplications(3) < degree.multiplications(3));
        assert_eq!(elimination_order(&graph, frictional, 3), Ok(dissected));
    }
}

/// In the plane minimum degree is as good, at a tenth of the time.
#[test]
fn minimum_degree_stays_in_the_plane() {
    let square = grid(&[60, 60]);
    let graph = Rows::of(&square).graph();
    let bottom: Vec<usize> = (0..61).collect();
    let by_degree = minimum_degree(&graph, &bottom);
    assert_eq!(elimination_order(&graph, &bottom, 2), by_degree);
}

#[test]
fn blocks_are_counted_by_their_components() {
    // A path of three vertices from one end: columns of 2, 2 and 1 blocks.
    let path = operator(3, &BTreeSet::from([(0, 1), (1, 2)]));
    let fill = Fill::of(&Rows::of(&path).graph(), &[0, 1, 2]).expect("there is memory");
    assert_eq!((fill.entries(), fill.multiplications(2)), (5, 72.0));
}
