//! The state at constant slip rate, for laws with a closed form and for those without.

use stickslip_state::{StateError, StateLaw, StateVariable};

/// The largest distance of the last two extrapolations of a piece, see [`StateVariable::distance`].
const TOLERANCE: f64 = 1e-12;
/// The number of extrapolations of a piece: steps of backward Euler of 1, 1/2, ... of its length.
const COLUMNS: usize = 8;
/// The share of the whole time below which a piece is not halved: it contains a jump of the law.
const SMALLEST: f64 = 1e-13;

/// The solution after the time `dt` \[s\]: the closed form, or else backward Euler extrapolated to zero step size, on
/// pieces that are halved until the extrapolations agree.
///
/// With `T_j1` by `j` steps, `T_jk = T_j(k-1) + (T_j(k-1) - T_(j-1)(k-1)) (j-k+1)/(k-1)` is of order `k`. Source:
/// P. Deuflhard, "Recent progress in extrapolation methods for ordinary differential equations", SIAM Review 27
/// (1985).
pub(super) fn advance_exactly<S: StateLaw>(
    law: &S,
    from: S::State,
    slip_rate: f64,
    dt: f64,
) -> Result<S::State, StateError> {
    if let Some(to) = law.advance_exact(from, slip_rate, dt) {
        return Ok(to);
    }
    let (mut state, mut done, mut piece) = (from, 0.0, dt);
    while done < dt {
        piece = piece.min(dt - done);
        match extrapolated(law, state, slip_rate, piece)? {
            Some(next) => state = next,
            None if piece > SMALLEST * dt => {
                piece *= 0.5;
                continue;
            }
            None => state = law.advance(state, slip_rate, piece)?,
        }
        done += piece;
        piece *= 2.0;
    }
    Ok(state)
}

/// One piece, `None` where extrapolations do not agree.
fn extrapolated<S: StateLaw>(
    law: &S,
    from: S::State,
    slip_rate: f64,
    dt: f64,
) -> Result<Option<S::State>, StateError> {
    let mut row = [0.0; COLUMNS];
    for j in 1..=COLUMNS {
        let mut state = from;
        for _ in 0..j {
            state = law.advance(state, slip_rate, dt / j as f64)?;
        }
        let mut value = state.value();
        let mut last = value;
        for k in 2..=j {
            // The entry of the row before, which the next one replaces.
            let before = std::mem::replace(&mut row[k - 2], value);
            last = value;
            value += (value - before) * (j - k + 1) as f64 / (k - 1) as f64;
        }
        row[j - 1] = value;
        let (finer, coarser) = (S::State::from_value(value), S::State::from_value(last));
        if j > 1 && finer.distance(coarser) <= TOLERANCE {
            return Ok(Some(finer));
        }
    }
    Ok(None)
}

#[cfg(test)]
#[path = "../../tests/unit/constant_rate.rs"]
mod tests;
