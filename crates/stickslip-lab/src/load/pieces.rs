//! Pieces of samples with a line each, and the removal of the piece that the data defend least.

use std::collections::BinaryHeap;

use super::line::Line;
use super::removal::Removal;

/// The samples of the first pieces: two have a line.
pub(super) const FIRST: usize = 2;
/// The samples of a piece up to which its removal tries each division among its neighbours at first: longer pieces go to
/// one of them until [`Pieces::settle`], which tries each division again. It bounds the work of a removal.
const DIVIDED: usize = 32;

/// Pieces of samples, in a list that is linked in both directions.
#[derive(Clone)]
pub(super) struct Pieces<'a> {
    pub(super) times: &'a [f64],
    pub(super) displacements: &'a [f64],
    pub(super) pieces: Vec<Piece>,
    queue: BinaryHeap<Removal>,
    /// The samples of a piece up to which it is divided.
    divided: usize,
}

/// The samples from one to another, in the list of all pieces.
#[derive(Clone)]
pub(super) struct Piece {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) line: Line,
    before: Option<usize>,
    pub(super) behind: Option<usize>,
    /// The number of changes of the cost of its removal.
    version: usize,
    removed: bool,
}

impl<'a> Pieces<'a> {
    /// A piece for each two samples; there are at least two samples, and as many displacements as times.
    pub(super) fn new(times: &'a [f64], displacements: &'a [f64]) -> Self {
        let count = times.len() / FIRST;
        let pieces = (0..count).map(|k| {
            let from = FIRST * k;
            // The last one has what is left.
            let to = if k + 1 == count {
                times.len()
            } else {
                from + FIRST
            };
            Piece {
                from,
                to,
                line: Line::of(&times[from..to], &displacements[from..to]),
                before: k.checked_sub(1),
                behind: (k + 1 < count).then_some(k + 1),
                version: 0,
                removed: false,
            }
        });
        let mut pieces = Self {
            times,
            displacements,
            pieces: pieces.collect(),
            queue: BinaryHeap::with_capacity(count),
            divided: DIVIDED,
        };
        for k in 0..count {
            pieces.queue.extend(pieces.cheapest(k));
        }
        pieces
    }

    /// Removes pieces, the cheapest first, as long as each raises the sum of squares by at most `penalty` [m^2].
    pub(super) fn remove(&mut self, penalty: f64) {
        while let Some(&next) = self.queue.peek() {
            let piece = &self.pieces[next.piece];
            let outdated = piece.removed || piece.version != next.version;
            if !outdated && next.cost > penalty {
                return;
            }
            self.queue.pop();
            if !outdated {
                self.apply(next);
            }
        }
    }

    /// Divides pieces of any length among their neighbours as [`remove`](Self::remove) does, and moves the limits of
    /// neighbours to where the sum of squares is least.
    pub(super) fn settle(&mut self, penalty: f64) {
        self.divided = usize::MAX;
        self.queue.clear();
        let left: Vec<usize> = self.left().collect();
        for k in left {
            self.queue.extend(self.cheapest(k));
        }
        self.remove(penalty);
        // Each move lowers the sum of squares.
        while self.move_limits() {}
    }

    /// Removes a piece although that may raise the sum of squares, and moves the limits of the others.
    pub(super) fn remove_one(&mut self, removal: Removal) {
        self.apply(removal);
        while self.move_limits() {}
    }

    /// The indices of the pieces that are left, in order.
    pub(super) fn left(&self) -> impl Iterator<Item = usize> {
        let first = (0..self.pieces.len()).find(|&k| !self.pieces[k].removed);
        std::iter::successors(first, |&k| self.pieces[k].behind)
    }

    /// The lines of the pieces and their samples, in order.
    pub(super) fn lines(&self) -> Vec<(Line, usize, usize)> {
        let pieces = self.left().map(|k| &self.pieces[k]);
        pieces
            .map(|piece| (piece.line, piece.from, piece.to))
            .collect()
    }

    /// The cheapest removal of a piece; None of the only one.
    pub(super) fn cheapest(&self, k: usize) -> Option<Removal> {
        let piece = &self.pieces[k];
        let [before, behind] = [piece.before, piece.behind].map(|other| {
            let other = &self.pieces[other?];
            Some(other.line)
        });
        let removal = |split, cost| Removal {
            piece: k,
            version: piece.version,
            split,
            cost,
        };
        let to_before = before.map(|line| removal(piece.to, line.joined(&piece.line).1));
        let to_behind = behind.map(|line| removal(piece.from, piece.line.joined(&line).1));
        let mut best = to_before.into_iter().chain(to_behind).max()?;
        if let (Some(before), Some(behind)) = (before, behind)
            && piece.to - piece.from <= self.divided
        {
            let inner = self.best_limit(before, behind, piece.from, piece.to);
            // Beside two neighbours a piece had a line of its own.
            let (split, squares) = inner;
            let cost = squares - (before.squares + piece.line.squares + behind.squares);
            best = best.max(removal(split, cost));
        }
        Some(best)
    }

    fn apply(&mut self, removal: Removal) {
        let Removal { piece, split, .. } = removal;
        let Piece {
            from,
            to,
            line,
            before,
            behind,
            ..
        } = self.pieces[piece];
        self.pieces[piece].removed = true;
        // A whole piece has its line: one of many samples is not summed again.
        let part = |from, to, whole| {
            if whole {
                line
            } else {
                Line::of(&self.times[from..to], &self.displacements[from..to])
            }
        };
        let to_before = (split > from).then(|| part(from, split, split == to));
        let to_behind = (split < to).then(|| part(split, to, split == from));
        if let Some(k) = before {
            let other = &mut self.pieces[k];
            other.behind = behind;
            other.to = split;
            other.line = to_before.map_or(other.line, |part| other.line.joined(&part).0);
        }
        if let Some(k) = behind {
            let other = &mut self.pieces[k];
            other.before = before;
            other.from = split;
            other.line = to_behind.map_or(other.line, |part| part.joined(&other.line).0);
        }
        let around = [
            before.and_then(|k| self.pieces[k].before),
            before,
            behind,
            behind.and_then(|k| self.pieces[k].behind),
        ];
        for k in around.into_iter().flatten() {
            self.pieces[k].version += 1;
            let cheapest = self.cheapest(k);
            self.queue.extend(cheapest);
        }
    }
}
