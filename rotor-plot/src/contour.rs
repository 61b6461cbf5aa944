//! Contour lines by marching squares.

use std::collections::BTreeMap;

use crate::figure::Map;
use crate::geometry::{Point, Rect};

/// A point where a contour crosses a side of the grid: the indices of the side's ends, and where it lies.
type Crossing = ((usize, usize), Point);

/// A corner of a square: its index in the grid, where it lies, and the value there.
type Corner = (usize, Point, f64);

/// Finds the contour lines of a level, in the units of the axes, by linear interpolation. There is none in a square that has
/// a corner outside the window or where the quantity does not exist.
pub(crate) fn lines(map: &Map, level: f64, window: &Rect) -> Vec<Vec<Point>> {
    let columns = map.x_values.len();
    let corner = |i: usize, j: usize| -> Option<Corner> {
        let at = (*map.x_values.get(i)?, *map.y_values.get(j)?);
        let index = j * columns + i;
        window
            .holds(at)
            .then_some((index, at, map.values.get(index).copied().flatten()?))
    };
    let mut pieces = Vec::new();
    for j in 0..map.y_values.len() {
        for i in 0..columns {
            // The corners in the order in which one walks around the square.
            let square = [
                corner(i, j),
                corner(i + 1, j),
                corner(i + 1, j + 1),
                corner(i, j + 1),
            ];
            if let [Some(a), Some(b), Some(c), Some(d)] = square {
                pieces.extend(in_square([a, b, c, d], level));
            }
        }
    }
    joined(&pieces)
}

/// Finds the pieces of a contour line in one square.
fn in_square([a, b, c, d]: [Corner; 4], level: f64) -> Vec<[Crossing; 2]> {
    let crossing = |from: Corner, to: Corner| {
        let t = (level - from.2) / (to.2 - from.2);
        let along = |u: f64, v: f64| u + t * (v - u);
        let at = (along(from.1.0, to.1.0), along(from.1.1, to.1.1));
        let side = (from.0.min(to.0), from.0.max(to.0));
        ((from.2 < level) != (to.2 < level)).then_some((side, at))
    };
    let sides = [
        crossing(a, b),
        crossing(b, c),
        crossing(c, d),
        crossing(d, a),
    ];
    if let [Some(ab), Some(bc), Some(cd), Some(da)] = sides {
        // At a saddle two pairs of corners could be joined; the mean of all four decides which are.
        let high_middle = 0.25 * (a.2 + b.2 + c.2 + d.2) >= level;
        return if (a.2 >= level) == high_middle {
            vec![[ab, bc], [cd, da]]
        } else {
            vec![[da, ab], [bc, cd]]
        };
    }
    let found: Vec<Crossing> = sides.into_iter().flatten().collect();
    found.as_chunks::<2>().0.to_vec()
}

/// Joins pieces that meet on a side of the grid to lines, so that a dash runs on along them. At a side at most two
/// pieces meet.
fn joined(pieces: &[[Crossing; 2]]) -> Vec<Vec<Point>> {
    let mut at_side: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
    for (index, piece) in pieces.iter().enumerate() {
        for (side, _) in piece {
            at_side.entry(*side).or_default().push(index);
        }
    }
    let mut used = vec![false; pieces.len()];
    let mut lines = Vec::new();
    // Lines that have ends are followed from one end first; all lines that are left are closed.
    let ends = at_side.iter().filter(|(_, meeting)| meeting.len() == 1);
    for start in ends.chain(&at_side).map(|(side, _)| *side) {
        let (mut side, mut line) = (start, Vec::new());
        while let Some(index) = at_side.get(&side).and_then(|meeting| {
            meeting
                .iter()
                .find(|&&index| used.get(index) == Some(&false))
        }) && let (Some(used), Some(&[first, second])) =
            (used.get_mut(*index), pieces.get(*index))
        {
            *used = true;
            let [here, next] = if first.0 == side {
                [first, second]
            } else {
                [second, first]
            };
            if line.is_empty() {
                line.push(here.1);
            }
            line.push(next.1);
            side = next.0;
        }
        if !line.is_empty() {
            lines.push(line);
        }
    }
    lines
}
