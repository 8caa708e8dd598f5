//! The vertices of a coarser level, and the interpolation to the others.

use nalgebra::SVector;

use super::graph::Graph;
use super::twins::Twins;
use super::weights::Weights;

/// A coarser level.
#[derive(Debug)]
pub(super) struct Choice {
    /// The vertices that it keeps, increasing.
    pub(super) chosen: Vec<u32>,
    /// The graph of their neighbours.
    pub(super) graph: Graph,
    /// The start of each row of the interpolation, and the end of the last.
    pub(super) starts: Vec<usize>,
    /// Its columns, positions in `chosen`.
    pub(super) columns: Vec<u32>,
    pub(super) weights: Vec<f64>,
}

/// Number of rounds after which all vertices without an interpolation are kept.
const ROUNDS: usize = 4;

impl Choice {
    /// Chooses among vertices with their features and neighbours.
    pub(super) fn among<const D: usize>(
        points: &[SVector<f64, D>],
        features: &[u8],
        graph: &Graph,
        twins: &Twins,
    ) -> Self {
        let mut kept = independent(features, graph, twins);
        for round in 0.. {
            let (choice, lost) = Self::interpolating(&kept, points, graph);
            if lost.is_empty() {
                return choice;
            }
            let mut added = vec![false; kept.len()];
            for p in lost {
                let alone = |p: usize| graph.around(p).iter().all(|&q| !added[q as usize]);
                if twins.with(p).all(alone) || round >= ROUNDS {
                    for p in twins.with(p) {
                        (added[p], kept[p]) = (true, true);
                    }
                }
            }
        }
        unreachable!("rounds end when no vertex is left to be kept")
    }

    /// The level of some vertices, and the other vertices that they do not determine.
    fn interpolating<const D: usize>(
        kept: &[bool],
        points: &[SVector<f64, D>],
        graph: &Graph,
    ) -> (Self, Vec<usize>) {
        let chosen: Vec<u32> = (0..)
            .zip(kept)
            .filter(|(_, kept)| **kept)
            .map(|(p, _)| p)
            .collect();
        let groups = groups(kept, points, graph);
        let mut choice = Self {
            graph: graph.contracted(&groups, chosen.len()),
            starts: vec![0],
            columns: Vec::new(),
            weights: Vec::new(),
            chosen,
        };
        let mut lost = Vec::new();
        let mut weights = Weights::default();
        let mut candidates = Vec::new();
        for (p, &own) in groups.iter().enumerate() {
            if kept[p] {
                choice.columns.push(own);
                choice.weights.push(1.0);
            } else {
                candidates.clear();
                candidates.push(own);
                candidates.extend(choice.graph.around(own as usize));
                let around = candidates
                    .iter()
                    .map(|&q| points[choice.chosen[q as usize] as usize] - points[p]);
                if weights.find(around) {
                    let found = candidates
                        .iter()
                        .zip(weights.found())
                        .filter(|(_, w)| *w != 0.0);
                    for (&column, weight) in found {
                        choice.columns.push(column);
                        choice.weights.push(weight);
                    }
                    sort_row(&mut choice, p);
                } else {
                    lost.push(p);
                }
            }
            choice.starts.push(choice.columns.len());
        }
        (choice, lost)
    }
}

/// Sorts the last row by its columns.
fn sort_row(choice: &mut Choice, row: usize) {
    let start = choice.starts[row];
    let entries = choice.columns[start..].iter().copied();
    let mut entries: Vec<(u32, f64)> = entries
        .zip(choice.weights[start..].iter().copied())
        .collect();
    entries.sort_unstable_by_key(|&(column, _)| column);
    for (k, (column, weight)) in entries.into_iter().enumerate() {
        choice.columns[start + k] = column;
        choice.weights[start + k] = weight;
    }
}

/// A maximal independent set: no two vertices are neighbours, those with the most features first. Vertices that coincide
/// count as one, with the features of the first that is asked.
fn independent(features: &[u8], graph: &Graph, twins: &Twins) -> Vec<bool> {
    let most = features.iter().copied().max().unwrap_or(0);
    let mut kept = vec![false; features.len()];
    for feature in (0..=most).rev() {
        for p in (0..features.len()).filter(|&p| features[p] == feature) {
            let free = |p: usize| graph.around(p).iter().all(|&q| !kept[q as usize]);
            if !kept[p] && twins.with(p).all(free) {
                twins.with(p).for_each(|p| kept[p] = true);
            }
        }
    }
    // A vertex without a kept neighbour whose twin has one.
    for p in 0..kept.len() {
        if !kept[p] && graph.around(p).iter().all(|&q| !kept[q as usize]) {
            twins.with(p).for_each(|p| kept[p] = true);
        }
    }
    kept
}

/// The nearest kept vertex of each vertex, counted among the kept; every other vertex has a kept neighbour.
fn groups<const D: usize>(kept: &[bool], points: &[SVector<f64, D>], graph: &Graph) -> Vec<u32> {
    let mut numbers = vec![0; kept.len()];
    for (number, p) in (0..kept.len()).filter(|&p| kept[p]).enumerate() {
        numbers[p] = number as u32;
    }
    let nearest = |p: usize| {
        let around = graph
            .around(p)
            .iter()
            .map(|&q| q as usize)
            .filter(|&q| kept[q]);
        let distances = around.map(|q| ((points[q] - points[p]).norm_squared(), q));
        distances
            .fold((f64::INFINITY, p), |a, b| if b < a { b } else { a })
            .1
    };
    (0..kept.len())
        .map(|p| numbers[if kept[p] { p } else { nearest(p) }])
        .collect()
}
