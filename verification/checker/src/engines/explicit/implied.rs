//! Places whose tokens follow from those of others: they need not be stored.

use crate::bounds::combined;
use cotama_property::integer::gcd;
use cotama_property::pt::Pt;

/// Numbers that may be looked at: some tenths of a second.
const WORK: usize = 50_000_000;

type Row = Vec<(u32, i64)>;

/// `tokens of place = constant + sum of weight * tokens`, always.
#[derive(Clone, Debug)]
pub(super) struct Implied {
    pub(super) place: u32,
    pub(super) constant: i64,
    pub(super) terms: Row,
}

/// Returns those of these places that others imply, the earlier ones first. None occurs in the
/// terms of another.
pub(super) fn implied(pt: &Pt, candidates: &[u32]) -> Vec<Implied> {
    let mut free = invariants(pt);
    let mut used: Vec<(u32, Row)> = Vec::new();
    let mut work = 0;
    for &place in candidates {
        if free.is_empty() || work > WORK {
            break;
        }
        let Some(at) = free.iter().position(|it| weight(it, place).abs() == 1) else { continue };
        let pivot = free.swap_remove(at);
        let by = |row: &Row| weight(row, place);
        let without = |(at, row): (usize, &Row)| {
            let by = by(row).checked_mul(-weight(&pivot, place))?;
            Some((at, combined(row, 1, &pivot, by)?))
        };
        let with = |at: &(usize, &Row)| by(at.1) != 0;
        let rest: Option<Vec<_>> = free.iter().enumerate().filter(with).map(without).collect();
        let rows = used.iter().map(|it| &it.1).enumerate();
        let solved: Option<Vec<_>> = rows.filter(with).map(without).collect();
        work += free.len() + used.len();
        if let Some((rest, solved)) = rest.zip(solved) {
            work += rest.iter().chain(&solved).map(|it| it.1.len()).sum::<usize>();
            rest.into_iter().for_each(|(at, row)| free[at] = row);
            solved.into_iter().for_each(|(at, row)| used[at].1 = row);
            used.push((place, pivot));
        } else {
            free.push(pivot);
        }
    }
    used.into_iter().filter_map(|(place, row)| solved(pt, place, &row)).collect()
}

fn solved(pt: &Pt, place: u32, row: &Row) -> Option<Implied> {
    let sign = weight(row, place);
    let mut constant = 0_i64;
    for &(place, weight) in row {
        constant = constant.checked_add(weight.checked_mul(pt.initial[place as usize].into())?)?;
    }
    let scaled = |it: &(u32, i64)| Some((it.0, it.1.checked_mul(-sign)?));
    let terms = row.iter().filter(|it| it.0 != place).map(scaled).collect::<Option<_>>()?;
    Some(Implied { place, constant: constant.checked_mul(sign)?, terms })
}

/// Weighted sums of tokens that no transition changes: as many as are independent, as far as they
/// are found.
fn invariants(pt: &Pt) -> Vec<Row> {
    let mut rows: Vec<(Row, Row)> = (0..pt.places.len() as u32)
        .map(|it| (pt.changers.of(it).to_vec(), vec![(it, 1)]))
        .collect();
    let mut work = 0;
    for transition in 0..pt.transitions.len() as u32 {
        work += rows.len();
        if work > WORK {
            break;
        }
        let mut with: Vec<usize> =
            (0..rows.len()).filter(|&at| weight(&rows[at].0, transition) != 0).collect();
        let size = |(changes, weights): &(Row, Row)| changes.len() + weights.len();
        let Some(&pivot) =
            with.iter().min_by_key(|&&at| (weight(&rows[at].0, transition).abs(), size(&rows[at])))
        else {
            continue;
        };
        with.retain(|&at| at != pivot);
        let mut lost = vec![pivot];
        for at in with {
            work += size(&rows[at]) + size(&rows[pivot]);
            match eliminated(&rows[at], &rows[pivot], transition) {
                Some(row) if work < WORK => rows[at] = row,
                _ => lost.push(at),
            }
        }
        lost.sort_unstable();
        for at in lost.into_iter().rev() {
            rows.swap_remove(at);
        }
    }
    rows.into_iter().filter(|it| it.0.is_empty()).map(|(_, weights)| weights).collect()
}

fn eliminated(row: &(Row, Row), pivot: &(Row, Row), transition: u32) -> Option<(Row, Row)> {
    let (a, b) = (weight(&pivot.0, transition), weight(&row.0, transition));
    let divisor = gcd(a.unsigned_abs(), b.unsigned_abs()).cast_signed();
    let (a, b) = (a / divisor, b.checked_neg()? / divisor);
    let mut changes = combined(&row.0, a, &pivot.0, b)?;
    let mut weights = combined(&row.1, a, &pivot.1, b)?;
    let all = changes
        .iter()
        .chain(&weights)
        .fold(0, |all, it| gcd(all, it.1.unsigned_abs()))
        .cast_signed();
    if all > 1 {
        changes.iter_mut().chain(&mut weights).for_each(|it| it.1 /= all);
    }
    Some((changes, weights))
}

fn weight(row: &[(u32, i64)], id: u32) -> i64 {
    row.binary_search_by_key(&id, |it| it.0).map_or(0, |at| row[at].1)
}
