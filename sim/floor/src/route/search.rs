//! A* over the cells of a field. (Hart, Nilsson, Raphael, IEEE Trans. SSC 4(2), 1968)

use super::Needs;
use crate::field::Field;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Lengths of a step along an axis and of a diagonal one, in thousandths of a cell.
const STRAIGHT: u64 = 1_000;
const DIAGONAL: u64 = 1_414;

/// The eight steps: columns, rows, length.
const STEPS: [(isize, isize, u64); 8] = [
    (1, 0, STRAIGHT),
    (0, 1, STRAIGHT),
    (-1, 0, STRAIGHT),
    (0, -1, STRAIGHT),
    (1, 1, DIAGONAL),
    (-1, 1, DIAGONAL),
    (-1, -1, DIAGONAL),
    (1, -1, DIAGONAL),
];

/// The price of room, in thousandths: 1000 for the liked room, 3000 where there is just enough,
/// nothing where there is too little.
fn price(room: f32, needs: Needs) -> Option<u64> {
    let (room, radius) = (f64::from(room), needs.radius_m);
    if room < radius {
        return None;
    }
    let wanted = needs.liked_m - radius;
    let missing = if wanted > 0.0 { (needs.liked_m - room) / wanted } else { 0.0 };
    Some(1_000 + (missing.clamp(0.0, 1.0) * 2_000.0).round() as u64)
}

/// Returns the cells of the cheapest way, both ends included; else how many cells are reached.
pub(super) fn search(
    room: &Field,
    needs: Needs,
    first: usize,
    last: usize,
) -> Result<Vec<usize>, usize> {
    let (columns, rows) = (room.columns().cast_signed(), room.rows().cast_signed());
    let prices: Vec<u16> =
        room.values().iter().map(|it| price(*it, needs).unwrap_or(0) as u16).collect();
    let is_open = |at: usize| prices.get(at).is_some_and(|it| *it > 0);
    let place = |at: usize| (at.cast_signed() % columns, at.cast_signed() / columns);
    let goal = place(last);
    let ahead = |at: usize| {
        let (x, y) = place(at);
        let (x, y) = (x.abs_diff(goal.0) as u64, y.abs_diff(goal.1) as u64);
        // No cell costs less than its length.
        (x.max(y) - x.min(y)) * STRAIGHT + x.min(y) * DIAGONAL
    };
    let mut costs = vec![u64::MAX; prices.len()];
    // The step that led to a cell.
    let mut came = vec![u8::MAX; prices.len()];
    let mut open = BinaryHeap::new();
    let mut reached = 0;
    if let Some(cost) = costs.get_mut(first) {
        *cost = 0;
        open.push(Reverse((ahead(first), first)));
    }
    while let Some(Reverse((total, at))) = open.pop() {
        let cost = costs[at];
        if total > cost + ahead(at) {
            continue;
        }
        reached += 1;
        if at == last {
            return Ok(back(&came, columns, first, last));
        }
        let (x, y) = place(at);
        for (number, (right, up, length)) in STEPS.into_iter().enumerate() {
            let (to_x, to_y) = (x + right, y + up);
            if !(0..columns).contains(&to_x) || !(0..rows).contains(&to_y) {
                continue;
            }
            let to = (to_y * columns + to_x) as usize;
            let beside = [(y * columns + to_x) as usize, (to_y * columns + x) as usize];
            if !is_open(to) || !beside.into_iter().all(is_open) {
                continue;
            }
            let both = u64::from(prices[at]) + u64::from(prices[to]);
            let next = cost + length * both / 2_000;
            if next < costs[to] {
                costs[to] = next;
                came[to] = number as u8;
                open.push(Reverse((next + ahead(to), to)));
            }
        }
    }
    Err(reached)
}

/// Returns the cells from first to last, by the steps that led to them.
fn back(came: &[u8], columns: isize, first: usize, last: usize) -> Vec<usize> {
    let mut cells = vec![last];
    let mut at = last;
    while at != first {
        let Some((right, up, _)) = came.get(at).and_then(|it| STEPS.get(*it as usize)) else {
            break;
        };
        at = at.wrapping_add_signed(-(up * columns + right));
        cells.push(at);
    }
    cells.reverse();
    cells
}
