//! Random tables, and all their assignments.

use crate::draw::Draw;
use cotama_core::team::{Cost, Costs};

/// A number below another one.
pub(crate) fn below(draw: &mut Draw, end: u64) -> u64 {
    draw.between(0, end - 1)
}

/// A table with so many percent of its edges missing.
pub(crate) fn table(
    draw: &mut Draw,
    rows: usize,
    columns: usize,
    most: u64,
    missing: u64,
) -> Vec<Option<Cost>> {
    let entry = |draw: &mut Draw| {
        let cost = Cost::new(below(draw, most) as u32);
        if below(draw, 100) < missing { None } else { cost }
    };
    (0..rows * columns).map(|_| entry(draw)).collect()
}

/// The least of all assignments, by the set of columns that the first rows have; `join` puts a cost
/// to those before it.
pub(crate) fn least(costs: &Costs<'_>, join: impl Fn(u64, u64) -> u64) -> Option<u64> {
    let mut best = vec![None; 1 << costs.columns()];
    best[0] = Some(0_u64);
    for row in 0..costs.rows() {
        let mut next = vec![None; best.len()];
        for (set, total) in best.iter().enumerate().filter_map(|(set, it)| Some((set, (*it)?))) {
            for (column, cost) in costs.row(row).enumerate() {
                let (Some(cost), true) = (cost, set & (1 << column) == 0) else { continue };
                let slot: &mut Option<u64> = &mut next[set | (1 << column)];
                let total = join(total, u64::from(cost.get()));
                *slot = Some(slot.map_or(total, |it| it.min(total)));
            }
        }
        best = next;
    }
    best.into_iter().flatten().min()
}
