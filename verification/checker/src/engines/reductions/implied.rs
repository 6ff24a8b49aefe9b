//! Places that several others imply.

use super::draft::{Draft, Row};
use std::collections::BTreeMap;

/// The most transitions of a place, and places of a transition, that are looked at.
const WIDTH: usize = 64;
/// The most places that are summed up.
const TERMS: usize = 64;

/// Places that hold a constant more or less than others together, and never hold anything up beside
/// those.
pub(super) fn implied(draft: &mut Draft) -> usize {
    let mut count = 0;
    for place in draft.places() {
        let Some((constant, sum)) = summed(draft, place) else { continue };
        draft.record.value(place, constant, &sum);
        for &(term, _) in &sum {
            draft.visible[term as usize] |= draft.visible[place as usize];
        }
        draft.drop_place(place);
        count += 1;
    }
    count
}

/// A sum of places that changes like this one, found step by step: the place is chosen that leaves
/// the least.
fn summed(draft: &mut Draft, place: u32) -> Option<(i64, Row)> {
    let row = draft.row(place);
    if row.is_empty() || row.len() > WIDTH {
        return None;
    }
    let mut left: BTreeMap<u32, i64> = row.into_iter().collect();
    let mut sum: BTreeMap<u32, i64> = BTreeMap::new();
    let mut terms = 0;
    while let Some((&at, &by)) = left.first_key_value() {
        terms += 1;
        let it = draft.moves[at as usize].as_ref()?;
        if terms > TERMS || it.effects.len() > WIDTH || left.len() > 2 * WIDTH {
            return None;
        }
        let fitting = |term: &&(u32, i64)| {
            term.0 != place
                && term.1.signum() == by.signum()
                && term.1.unsigned_abs() <= by.unsigned_abs()
        };
        let candidates: Vec<u32> = it.effects.iter().filter(fitting).map(|it| it.0).collect();
        let mut best: Option<(u64, u32, Row)> = None;
        for term in candidates {
            if draft.users[term as usize].len() > WIDTH {
                continue;
            }
            let row = draft.row(term);
            if !draft.spend(row.len()) {
                return None;
            }
            let old = |at: u32| left.get(&at).copied().unwrap_or(0);
            // The change of the sum of absolute values; the total is the same for all.
            let cost = row.iter().try_fold(0_i64, |cost, &(at, by)| {
                let after = old(at).checked_sub(by)?;
                cost.checked_add(after.checked_abs()?.checked_sub(old(at).checked_abs()?)?)
            })?;
            let cost = cost.cast_unsigned() ^ (1 << 63);
            if best.as_ref().is_none_or(|best| (cost, term) < (best.0, best.1)) {
                best = Some((cost, term, row));
            }
        }
        let (_, term, row) = best?;
        for (at, by) in row {
            let entry = left.entry(at).or_insert(0);
            *entry = entry.checked_sub(by)?;
            if *entry == 0 {
                left.remove(&at);
            }
        }
        *sum.entry(term).or_insert(0) += 1;
    }
    let sum: Row = sum.into_iter().collect();
    let tokens = |place: u32| i64::from(draft.initial[place as usize]);
    let constant = sum.iter().try_fold(tokens(place), |all, &(term, weight)| {
        all.checked_sub(weight.checked_mul(tokens(term))?)
    })?;
    let enough = draft.users(place).all(|(_, it)| {
        let given =
            sum.iter().map(|&(term, weight)| i128::from(weight) * i128::from(it.need(term)));
        let need = it.need(place);
        need == 0 || i128::from(need) <= i128::from(constant) + given.sum::<i128>()
    });
    enough.then_some((constant, sum))
}
