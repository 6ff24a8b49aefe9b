//! The loops over a row in which an assignment spends its time, sixteen columns at a time.
//!
//! Loops that only take minima become vector operations; so the place of the minimum is looked for
//! afterwards, among the columns where it was met.

use super::amount::Amount;
use super::cost::{Cost, Costs};

/// Columns that are looked at together.
const LANES: usize = 16;
/// Whether there are vectors; without them columns are looked at one by one, with the same result.
const VECTORS: bool = cfg!(any(target_feature = "sse2", target_feature = "neon"));
/// Columns of a block: a bit for each of its chunks.
const BLOCK: usize = 32 * LANES;
/// Chunks in which the nearest column is looked for once it is known how near that is.
const SHORT: usize = 8;

/// A row at the prices of its columns; an entry counts if it is stored as `least` or more.
#[derive(Clone, Copy)]
pub(super) struct Row<'r, N> {
    entries: &'r [Option<Cost>],
    least: i32,
    prices: &'r [N],
    /// Whether an entry may be missing.
    lacks_any: bool,
}

/// The nearest columns of a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearest<N> {
    /// How far the nearest is; [`FAR`](super::amount::sealed::Arithmetic::FAR) where there is none.
    pub(super) away: N,
    /// Which it is, unless the second one is as near.
    pub(super) column: Option<usize>,
    /// How far the second one is.
    pub(super) second: N,
}

impl<'r, N: Amount> Row<'r, N> {
    pub(super) fn new(costs: &Costs<'r>, row: usize, prices: &'r [N]) -> Self {
        let (least, lacks_any) = (costs.least(), costs.lacks_any());
        Self { entries: costs.entries(row), least, prices, lacks_any }
    }

    /// The nearest two columns.
    #[inline]
    pub(super) fn two_nearest(&self) -> Nearest<N> {
        let full = VECTORS && !self.lacks_any; // not to ask each entry makes vectors quicker
        let of_block = |block: &Self| {
            if full { block.two_of_block::<true>() } else { block.two_of_block::<false>() }
        };
        if self.entries.len() <= BLOCK {
            let (best, second, column) = of_block(self);
            let (away, second) = (N::away(best), N::away(second));
            return Nearest { away, column: (away < second).then_some(column), second };
        }
        let (mut best, mut second, mut column, mut start) = (N::DONE, N::DONE, 0, 0_usize);
        let prices = self.prices.get(..self.entries.len()).unwrap_or(&[]);
        for (entries, prices) in self.entries.chunks(BLOCK).zip(prices.chunks(BLOCK)) {
            let (first, next, at) = of_block(&Row { entries, prices, ..*self });
            second = more(more(second, next), less(best, first));
            column = if first > best { start.wrapping_add(at) } else { column };
            best = more(best, first);
            start = start.wrapping_add(BLOCK);
        }
        let (away, second) = (N::away(best), N::away(second));
        Nearest { away, column: (away < second).then_some(column), second }
    }

    /// How near the nearest two columns are, and the place of the first unless they are equal.
    #[inline(never)]
    fn two_of_block<const FULL: bool>(&self) -> (N, N, usize) {
        let prices = self.prices.get(..self.entries.len()).unwrap_or(&[]);
        let ((rows, rest), (costs, prices)) = (chunks(self.entries), chunks(prices));
        let (mut best, mut second, mut column) = (N::DONE, N::DONE, 0);
        let mut at = rows.len().wrapping_mul(LANES);
        for (entry, price) in rest.iter().zip(prices) {
            let value = self.near::<FULL>(*entry, *price);
            second = more(second, less(best, value));
            column = if value > best { at } else { column };
            best = more(best, value);
            at = at.wrapping_add(1);
        }
        if rows.is_empty() {
            return (best, second, column);
        }
        // The nearest of each sixteenth column.
        let mut firsts = [N::DONE; LANES];
        for (row, prices) in rows.iter().zip(costs) {
            for lane in 0..LANES {
                firsts[lane] = more(firsts[lane], self.near::<FULL>(row[lane], prices[lane]));
            }
        }
        let first = most(firsts);
        let met = lanes(&firsts, first);
        if best >= first {
            return (best, more(second, first), column);
        }
        if met.count_ones() > 1 {
            return (first, first, 0);
        }
        // The second one is in the same lane, or the nearest of the others.
        let lane = met.trailing_zeros() as usize % LANES;
        second = more(best, most(firsts.map(|it| if it == first { N::DONE } else { it })));
        let (mut met, mut bit) = (0_u32, 1_u32);
        for (row, prices) in rows.iter().zip(costs) {
            let value = self.near::<FULL>(row[lane], prices[lane]);
            met |= if value == first { bit } else { 0 };
            second = more(second, if value == first { N::DONE } else { value });
            bit = bit.wrapping_shl(1);
        }
        second = if met.count_ones() > 1 { first } else { second };
        (first, second, (met.trailing_zeros() as usize).wrapping_mul(LANES).wrapping_add(lane))
    }

    /// How near a column is: what it lacks is how far it is. Costs are stored upside down.
    #[inline]
    fn near<const FULL: bool>(&self, entry: Option<Cost>, price: N) -> N {
        let stored = Cost::upside_down(entry);
        if FULL || stored >= self.least { N::twice_stored(stored).plus(price) } else { N::DONE }
    }

    /// How near the columns of a chunk are.
    #[inline]
    fn nears(&self, entries: &[Option<Cost>; LANES], prices: &[N; LANES]) -> [N; LANES] {
        let mut all = [N::DONE; LANES];
        for lane in 0..LANES {
            all[lane] = self.near::<false>(entries[lane], prices[lane]);
        }
        all
    }

    /// The first column from this one on that is so far away.
    #[inline]
    pub(super) fn equal(&self, away: N, from: usize) -> Option<usize> {
        let near = N::away(away); // the way back is the same
        let (entries, prices) = (self.entries.get(from..)?, self.prices.get(from..)?);
        let ((rows, rest), (costs, prices)) = (chunks(entries), chunks(prices));
        let mut start = from;
        for (row, prices) in rows.iter().zip(costs) {
            let met = lanes(&self.nears(row, prices), near);
            if met != 0 {
                return Some(start.wrapping_add(met.trailing_zeros() as usize));
            }
            start = start.wrapping_add(LANES);
        }
        let met = rest
            .iter()
            .zip(prices)
            .map(|(entry, price)| self.near::<false>(*entry, *price) == near);
        place(met).map(|it| start.wrapping_add(it))
    }

    /// How near a column is.
    pub(super) fn near_of(&self, column: usize) -> N {
        let entry = self.entries.get(column).copied().flatten();
        let price = self.prices.get(column).copied().unwrap_or(N::ZERO);
        self.near::<false>(entry, price)
    }

    /// How far a column is; none if it is missing.
    #[inline]
    pub(super) fn away_of(&self, column: usize) -> Option<N> {
        let cost = N::twice(self.entries.get(column).copied().flatten(), self.least)?;
        Some(cost.minus(*self.prices.get(column)?))
    }

    /// The first column that is as near as this, which nobody has; those before that somebody has
    /// are met and made too dear to be met again, until one that is met ends it.
    #[inline(never)]
    pub(super) fn equals(
        &self,
        near: N,
        prices: &mut [N],
        mut meet: impl FnMut(usize) -> bool,
    ) -> Option<usize> {
        let low = near.minus(N::HALF);
        // Whether it ends here, and which column nobody has.
        let mut at = |column, price: &mut N| {
            if *price == price.whole() {
                return Some(Some(column));
            }
            *price = N::ZERO.minus(N::ROOM).minus(N::ROOM).minus(N::ROOM).minus(N::ROOM);
            meet(column).then_some(None)
        };
        let ((rows, rest), (costs, prices)) = (chunks(self.entries), chunks_mut(prices));
        let mut start = 0_usize;
        for (row, prices) in rows.iter().zip(costs) {
            let (mut met, mut bit) = (0_u32, 1_u32);
            for lane in 0..LANES {
                met |= if self.near::<false>(row[lane], prices[lane]) >= low { bit } else { 0 };
                bit = bit.wrapping_shl(1);
            }
            while met != 0 {
                let lane = met.trailing_zeros() as usize % LANES;
                if let Some(end) = at(start.wrapping_add(lane), &mut prices[lane]) {
                    return end;
                }
                met &= met.wrapping_sub(1);
            }
            start = start.wrapping_add(LANES);
        }
        for (entry, price) in rest.iter().zip(prices) {
            if self.near::<false>(*entry, *price) >= low
                && let Some(end) = at(start, price)
            {
                return end;
            }
            start = start.wrapping_add(1);
        }
        None
    }

    /// The next column behind this one that is so far away, the first again after the last.
    pub(super) fn next_equal(&self, away: N, behind: usize) -> usize {
        let next = self.equal(away, behind.wrapping_add(1));
        next.or_else(|| self.equal(away, 0)).unwrap_or(behind)
    }
}

/// Chunks of columns, and the rest.
#[inline]
fn chunks<T>(columns: &[T]) -> (&[[T; LANES]], &[T]) {
    if VECTORS { columns.as_chunks() } else { (&[], columns) }
}

#[inline]
fn chunks_mut<T>(columns: &mut [T]) -> (&mut [[T; LANES]], &mut [T]) {
    if VECTORS { columns.as_chunks_mut() } else { (&mut [], columns) }
}

/// In which lanes there is this value: a bit for each.
#[inline]
fn lanes<N: Amount>(values: &[N; LANES], value: N) -> u32 {
    let (mut met, mut bit) = (0, 1_u32);
    for it in values {
        met |= if *it == value { bit } else { 0 };
        bit = bit.wrapping_shl(1);
    }
    met
}

/// The most of all lanes.
#[inline]
fn most<N: Amount>(all: [N; LANES]) -> N {
    let mut best = [N::DONE; 4];
    for four in all.as_chunks::<4>().0 {
        best.iter_mut().zip(four).for_each(|(best, it)| *best = more(*best, *it));
    }
    best.into_iter().fold(N::DONE, more)
}

#[inline]
fn less<N: Amount>(a: N, b: N) -> N {
    if a < b { a } else { b }
}

#[inline]
fn more<N: Amount>(a: N, b: N) -> N {
    if a < b { b } else { a }
}

/// The place of the first that is true. Unlike `position` it counts without a check.
#[inline]
pub(super) fn place(all: impl Iterator<Item = bool>) -> Option<usize> {
    let mut at = 0_usize;
    for it in all {
        if it {
            return Some(at);
        }
        at = at.wrapping_add(1);
    }
    None
}

/// How many entries of a row are stored as `least` or more.
#[inline]
pub(super) fn present(row: &[Option<Cost>], least: i32) -> u32 {
    let counts = |entry: &Option<Cost>| u32::from(Cost::upside_down(*entry) >= least);
    let (entries, rest) = chunks(row);
    let mut all = [0_u32; LANES];
    for row in entries {
        all.iter_mut().zip(row).for_each(|(all, it)| *all = all.wrapping_add(counts(it)));
    }
    all.into_iter().chain(rest.iter().map(counts)).fold(0, u32::wrapping_add)
}

/// Keeps of each column what it costs its cheapest row so far, as that is stored, and which row is
/// that, the first of equal ones.
#[inline(never)]
pub(super) fn cheapest(row: &[Option<Cost>], from: u32, most: &mut [u32], rows: &mut [u32]) {
    for (entry, (most, row)) in row.iter().zip(most.iter_mut().zip(rows)) {
        // Costs are stored upside down, and what is missing as the least of all.
        let (stored, known) = (Cost::upside_down(*entry), most.cast_signed());
        *row = if stored > known { from } else { *row };
        *most = if stored > known { stored } else { known }.cast_unsigned();
    }
}

/// Paths to all columns that go on by a row: what comes before it is `base` long.
pub(super) struct Reach<'r, N> {
    pub(super) row: Row<'r, N>,
    pub(super) base: N,
    pub(super) from: u32,
}

/// Shortens the paths to columns that are nearer by this row, and finds the nearest column that is
/// not done, the first of equal ones: how far it is, and which it is.
#[inline]
pub(super) fn reach<N: Amount>(
    by: &Reach<'_, N>,
    distances: &mut [N],
    before: &mut [u32],
) -> (N, usize) {
    if VECTORS && !by.row.lacks_any {
        reach_by::<N, true>(by, distances, before)
    } else {
        reach_by::<N, false>(by, distances, before)
    }
}

#[inline(never)]
fn reach_by<N: Amount, const FULL: bool>(
    by: &Reach<'_, N>,
    distances: &mut [N],
    before: &mut [u32],
) -> (N, usize) {
    let Reach { row: Row { entries, least, prices, .. }, base, from } = *by;
    let base = N::away(N::ZERO).plus(base);
    let value = move |entry, price: N| {
        let stored = Cost::upside_down(entry);
        let near = N::twice_stored(stored).plus(price);
        if FULL || stored >= least { base.minus(near) } else { N::FAR }
    };
    let (rows, rest) = chunks(entries);
    let (costs, prices) = chunks(prices);
    let (lengths, others) = chunks_mut(distances);
    let (befores, before) = chunks_mut(before);
    // A column that is done is nearer than any path, so no path shortens it; less a half it is
    // further than all others.
    let (mut best, mut block, mut number) = (N::FAR, 0, 0_usize);
    let blocks = rows.chunks(SHORT).zip(costs.chunks(SHORT));
    let blocks = blocks.zip(lengths.chunks_mut(SHORT)).zip(befores.chunks_mut(SHORT));
    for (((rows, costs), lengths), befores) in blocks {
        let mut firsts = [N::FAR; LANES];
        let chunks = rows.iter().zip(costs).zip(lengths).zip(befores);
        for (((row, prices), distances), before) in chunks {
            let (mut lengths, mut rows) = (*distances, *before);
            for lane in 0..LANES {
                let value = value(row[lane], prices[lane]);
                rows[lane] = if value < lengths[lane] { from } else { rows[lane] };
                lengths[lane] = less(lengths[lane], value);
                firsts[lane] = less(firsts[lane], lengths[lane].minus(N::HALF));
            }
            (*distances, *before) = (lengths, rows);
        }
        let first = firsts.into_iter().fold(N::FAR, less);
        (best, block) = if first < best { (first, number) } else { (best, block) };
        number = number.wrapping_add(SHORT);
    }
    let rest = rest.iter().zip(prices).zip(others.iter_mut().zip(before));
    for ((entry, price), (distance, before)) in rest {
        let value = value(*entry, *price);
        *before = if value < *distance { from } else { *before };
        *distance = less(*distance, value);
        best = less(best, distance.minus(N::HALF));
    }
    let away = if best >= N::FAR.minus(N::HALF) { N::FAR } else { best.plus(N::HALF) };
    let (whole, rest) = chunks(distances);
    let mut start = block.wrapping_mul(LANES);
    for chunk in whole.get(block..).unwrap_or(&[]) {
        let met = lanes(chunk, away);
        if met != 0 {
            return (away, start.wrapping_add(met.trailing_zeros() as usize));
        }
        start = start.wrapping_add(LANES);
    }
    let at = place(rest.iter().map(|it| *it == away));
    (away, start.wrapping_add(at.unwrap_or(0)))
}
