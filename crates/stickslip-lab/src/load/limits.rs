//! The limits between pieces, where the sum of squares is least.

use super::line::Line;
use super::pieces::{FIRST, Pieces};

impl Pieces<'_> {
    /// Moves all limits once; whether one has moved.
    pub(super) fn move_limits(&mut self) -> bool {
        let mut moved = false;
        let mut at = self.left().next();
        while let Some(k) = at {
            at = self.pieces[k].behind;
            if let Some(behind) = at {
                moved |= self.move_limit(k, behind);
            }
        }
        moved
    }

    /// The limit between two lines, each of which is extended to it, with the least sum of squares, and that.
    pub(super) fn best_limit(
        &self,
        before: Line,
        behind: Line,
        from: usize,
        to: usize,
    ) -> (usize, f64) {
        let mut squares = Vec::with_capacity(to - from + 1);
        let mut line = behind;
        squares.push(line.squares);
        for n in (from..to).rev() {
            line = self.sample(n).joined(&line).0;
            squares.push(line.squares);
        }
        let mut line = before;
        let mut best = (from, line.squares + squares[to - from]);
        for n in from..to {
            line = line.joined(&self.sample(n)).0;
            let sum = line.squares + squares[to - n - 1];
            if sum < best.1 {
                best = (n + 1, sum);
            }
        }
        best
    }

    fn sample(&self, n: usize) -> Line {
        Line::sample(self.times[n], self.displacements[n])
    }

    /// Moves the limit between two neighbours to where the sum of squares is least, and whether that lowers it; each keeps two
    /// samples.
    fn move_limit(&mut self, before: usize, behind: usize) -> bool {
        let (from, to) = (self.pieces[before].from, self.pieces[behind].to);
        if to - from <= 2 * FIRST {
            return false;
        }
        let of = |from, to| Line::of(&self.times[from..to], &self.displacements[from..to]);
        let (start, end) = (of(from, from + FIRST), of(to - FIRST, to));
        let (limit, squares) = self.best_limit(start, end, from + FIRST, to - FIRST);
        let old = self.pieces[before].line.squares + self.pieces[behind].line.squares;
        // Rounding moves no limit.
        if limit == self.pieces[before].to
            || squares >= old * (1.0 - f64::EPSILON * (to - from) as f64)
        {
            return false;
        }
        let lines = (of(from, limit), of(limit, to));
        (self.pieces[before].line, self.pieces[before].to) = (lines.0, limit);
        (self.pieces[behind].line, self.pieces[behind].from) = (lines.1, limit);
        true
    }
}
