//! The two loops over a row in which an assignment spends its time, eight columns at a time.
//!
//! Loops that only take minima become vector operations; so the place of the minimum is looked for
//! afterwards, in the block of columns where it was met.

use super::amount::Amount;
use super::cost::Cost;

/// Columns that are looked at together.
const LANES: usize = 8;
/// Columns of a block.
const BLOCK: usize = 8 * LANES;

/// The nearest column of a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearest<N> {
    /// How far it is; [`FAR`](super::amount::sealed::Arithmetic::FAR) where there is none.
    pub(super) away: N,
    pub(super) column: usize,
    /// How far the second one is.
    pub(super) second: N,
}

#[inline]
fn less<N: Amount>(a: N, b: N) -> N {
    if a < b { a } else { b }
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

#[inline]
fn more<N: Amount>(a: N, b: N) -> N {
    if a < b { b } else { a }
}

/// The nearest two columns at these prices; of equal ones the first.
#[inline]
pub(super) fn two_nearest<N: Amount>(row: &[Option<Cost>], least: i32, prices: &[N]) -> Nearest<N> {
    let away = |entry, price: N| N::twice(entry, least).map_or(N::FAR, |it| it.minus(price));
    let (mut best, mut second, mut block, mut number) = (N::FAR, N::FAR, 0, 0_usize);
    for (row, prices) in row.chunks(BLOCK).zip(prices.chunks(BLOCK)) {
        let ((rows, row), (costs, prices)) =
            (row.as_chunks::<LANES>(), prices.as_chunks::<LANES>());
        let (mut first, mut next) = (N::FAR, N::FAR);
        if !rows.is_empty() {
            let (mut firsts, mut nexts) = ([N::FAR; LANES], [N::FAR; LANES]);
            for (row, prices) in rows.iter().zip(costs) {
                for lane in 0..LANES {
                    let value = away(row[lane], prices[lane]);
                    nexts[lane] = less(nexts[lane], more(firsts[lane], value));
                    firsts[lane] = less(firsts[lane], value);
                }
            }
            for lane in 0..LANES {
                next = less(less(next, nexts[lane]), more(first, firsts[lane]));
                first = less(first, firsts[lane]);
            }
        }
        for (entry, price) in row.iter().zip(prices) {
            let value = away(*entry, *price);
            next = less(next, more(first, value));
            first = less(first, value);
        }
        second = less(less(second, next), more(best, first));
        if first < best {
            (best, block) = (first, number);
        }
        number = number.wrapping_add(1);
    }
    let from = block.wrapping_mul(BLOCK);
    let met = row.iter().zip(prices).skip(from);
    let at = place(met.map(|(entry, price)| away(*entry, *price) == best));
    Nearest { away: best, column: from.wrapping_add(at.unwrap_or(0)), second }
}

/// The next column behind this one that is so far away, the first again after the last.
pub(super) fn next_equal<N: Amount>(
    row: &[Option<Cost>],
    least: i32,
    prices: &[N],
    away: N,
    behind: usize,
) -> usize {
    let value = |entry, price: N| N::twice(entry, least).map_or(N::FAR, |it| it.minus(price));
    let equal = |it: (&Option<Cost>, &N)| value(*it.0, *it.1) == away;
    let from = behind.wrapping_add(1);
    let next = place(row.iter().zip(prices).skip(from).map(equal));
    let next = next.map(|it| it.wrapping_add(from));
    next.or_else(|| place(row.iter().zip(prices).map(equal))).unwrap_or(behind)
}

/// Paths to all columns that go on by a row: what comes before it is `base` long.
pub(super) struct Reach<'r, N> {
    pub(super) row: &'r [Option<Cost>],
    pub(super) least: i32,
    pub(super) prices: &'r [N],
    pub(super) base: N,
    pub(super) from: u32,
}

/// Shortens the paths to columns that are nearer by this row, and finds the nearest column that is
/// not done, the first of equal ones.
#[inline]
pub(super) fn reach<N: Amount>(
    by: &Reach<'_, N>,
    distances: &mut [N],
    before: &mut [u32],
) -> Nearest<N> {
    let Reach { least, base, from, .. } = *by;
    let value = move |entry, price: N| {
        let cost = N::twice(entry, least);
        cost.map_or(N::FAR, |it| it.plus(base).minus(price))
    };
    // A column that is done is nearer than any path, so no path shortens it; less a half it is
    // further than all others.
    let (mut best, mut block, mut number) = (N::FAR, 0, 0_usize);
    let blocks = by.row.chunks(BLOCK).zip(by.prices.chunks(BLOCK));
    let blocks = blocks.zip(distances.chunks_mut(BLOCK)).zip(before.chunks_mut(BLOCK));
    for (((row, prices), distances), before) in blocks {
        let (rows, row) = row.as_chunks::<LANES>();
        let (costs, prices) = prices.as_chunks::<LANES>();
        let (lengths, distances) = distances.as_chunks_mut::<LANES>();
        let (befores, before) = before.as_chunks_mut::<LANES>();
        let mut first = N::FAR;
        if !rows.is_empty() {
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
            first = firsts.into_iter().fold(N::FAR, less);
        }
        let rest = row.iter().zip(prices).zip(distances.iter_mut().zip(before));
        for ((entry, price), (distance, before)) in rest {
            let value = value(*entry, *price);
            if value < *distance {
                (*distance, *before) = (value, from);
            }
            first = less(first, distance.minus(N::HALF));
        }
        if first < best {
            (best, block) = (first, number);
        }
        number = number.wrapping_add(1);
    }
    let start = block.wrapping_mul(BLOCK);
    let away = if best >= N::FAR.minus(N::HALF) { N::FAR } else { best.plus(N::HALF) };
    let at = place(distances.iter().skip(start).map(|it| *it == away));
    Nearest { away, column: start.wrapping_add(at.unwrap_or(0)), second: N::FAR }
}
