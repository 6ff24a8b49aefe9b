//! Sparse rows of integers.

use crate::bounds;
use cotama_property::integer::gcd;
use std::cmp::Ordering;

/// Numbers by column, sorted, none of them zero.
pub(super) type Row = Vec<(u32, i64)>;

/// The number in a column.
pub(super) fn at(row: &[(u32, i64)], column: u32) -> i64 {
    row.binary_search_by_key(&column, |it| it.0).map_or(0, |at| row[at].1)
}

/// `a` times the first row plus `b` times the second, divided by the greatest common divisor of its
/// numbers; `None` when a number is beyond 64 bits.
pub(super) fn combined(first: &[(u32, i64)], a: i64, second: &[(u32, i64)], b: i64) -> Option<Row> {
    let Some(mut all) = bounds::combined(first, a, second, b) else {
        return wide(first, a, second, b);
    };
    let mut divisor = 0;
    for (_, number) in &all {
        divisor = gcd(number.unsigned_abs(), divisor);
        if divisor == 1 {
            return Some(all);
        }
    }
    if let Ok(divisor @ 2..) = i64::try_from(divisor) {
        for (_, number) in &mut all {
            *number /= divisor;
        }
    }
    Some(all)
}

/// The same with 128 bits on the way.
#[cold]
fn wide(first: &[(u32, i64)], a: i64, second: &[(u32, i64)], b: i64) -> Option<Row> {
    let sum = |x, y| i128::from(a) * i128::from(x) + i128::from(b) * i128::from(y);
    let all: Vec<_> = aligned(first, second).map(|(column, x, y)| (column, sum(x, y))).collect();
    let common = |divisor, number| if divisor == 1 { 1 } else { gcd(divisor, number) };
    let divisor = all.iter().fold(0_u128, |divisor, it| common(divisor, it.1.unsigned_abs()));
    let divisor = i128::try_from(divisor.max(1)).ok()?;
    let narrow =
        |&(column, number): &(u32, i128)| Some((column, i64::try_from(number / divisor).ok()?));
    all.iter().filter(|it| it.1 != 0).map(narrow).collect()
}

/// Both rows column by column.
fn aligned<'a>(
    first: &'a [(u32, i64)],
    second: &'a [(u32, i64)],
) -> impl Iterator<Item = (u32, i64, i64)> + 'a {
    let (mut i, mut j) = (0, 0);
    std::iter::from_fn(move || {
        let order = match (first.get(i), second.get(j)) {
            (Some(x), Some(y)) => x.0.cmp(&y.0),
            (Some(_), None) => Ordering::Less,
            (None, Some(_)) => Ordering::Greater,
            (None, None) => return None,
        };
        let x = if order == Ordering::Greater { None } else { first.get(i) };
        let y = if order == Ordering::Less { None } else { second.get(j) };
        i += usize::from(x.is_some());
        j += usize::from(y.is_some());
        Some((x.or(y)?.0, x.map_or(0, |it| it.1), y.map_or(0, |it| it.1)))
    })
}

/// Factors of two numbers that are not zero with which the sum is zero, the first one positive;
/// `None` beyond 64 bits.
pub(super) fn cancelling(x: i64, y: i64) -> Option<(i64, i64)> {
    let divisor = i64::try_from(gcd(x.unsigned_abs(), y.unsigned_abs())).ok()?;
    let (x, y) = (x / divisor, y / divisor);
    if y > 0 { Some((y, x.checked_neg()?)) } else { Some((y.checked_neg()?, x)) }
}
