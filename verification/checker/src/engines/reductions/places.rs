//! Rules by which places go, each for itself or because of one other.

use super::draft::{Draft, Row};
use cotama_property::integer::gcd;
use std::collections::BTreeMap;

/// How many places or transitions of a kind one is compared with.
pub(super) const COMPARED: usize = 16;

/// A row divided by its greatest common divisor, and that; 0 for an empty row.
pub(super) fn normal(row: &[(u32, i64)]) -> (Row, i64) {
    let divisor = row.iter().fold(0, |all, it| gcd(all, it.1.unsigned_abs()));
    let divisor = i64::try_from(divisor).unwrap_or(1);
    (row.iter().map(|&(at, by)| (at, by / divisor.max(1))).collect(), divisor)
}

/// Places that no transition changes.
pub(super) fn constant(draft: &mut Draft) -> usize {
    let mut count = 0;
    for place in draft.places() {
        if draft.users(place).any(|(_, it)| it.effect(place) != 0) {
            continue;
        }
        let tokens = draft.initial[place as usize];
        let dead: Vec<u32> =
            draft.users(place).filter(|(_, it)| it.need(place) > tokens).map(|it| it.0).collect();
        for transition in dead {
            draft.remove(transition);
        }
        draft.record.value(place, tokens.into(), &[]);
        draft.drop_place(place);
        count += 1;
    }
    count
}

/// Invisible places that never hold anything up.
pub(super) fn unlimited(draft: &mut Draft) -> usize {
    let mut count = 0;
    for place in draft.places() {
        let tokens = draft.initial[place as usize];
        let harmless =
            draft.users(place).all(|(_, it)| it.effect(place) >= 0 && it.need(place) <= tokens);
        if harmless && !draft.visible[place as usize] {
            draft.drop_place(place);
            count += 1;
        }
    }
    count
}

/// Places whose changes have a common divisor.
pub(super) fn scaled(draft: &mut Draft) -> usize {
    let mut count = 0;
    for place in draft.places() {
        let (_, divisor) = normal(&draft.row(place));
        let Ok(divisor @ 2..) = u32::try_from(divisor) else { continue };
        let tokens = draft.initial[place as usize];
        let rest = tokens % divisor;
        draft.initial[place as usize] = tokens / divisor;
        for at in draft.users[place as usize].clone() {
            let Some(mut it) = draft.remove(at) else { continue };
            for (_, need) in it.needs.iter_mut().filter(|it| it.0 == place) {
                *need = need.saturating_sub(rest).div_ceil(divisor);
            }
            for (_, by) in it.effects.iter_mut().filter(|it| it.0 == place) {
                *by /= i64::from(divisor);
            }
            it.needs.retain(|it| it.1 > 0);
            draft.put(at, it);
        }
        draft.record.value(place, rest.into(), &[(place, divisor.into())]);
        count += 1;
    }
    count
}

/// Places that change in proportion to another.
pub(super) fn proportional(draft: &mut Draft) -> usize {
    let mut groups: BTreeMap<Row, Vec<(i64, u32)>> = BTreeMap::new();
    for place in draft.places() {
        let (row, factor) = normal(&draft.row(place));
        if factor > 0 {
            groups.entry(row).or_default().push((factor, place));
        }
    }
    let mut count = 0;
    for mut group in groups.into_values().filter(|it| it.len() > 1) {
        group.sort_unstable();
        let mut kept: Vec<(i64, u32)> = Vec::new();
        for place in group {
            let first = kept.len().saturating_sub(COMPARED);
            if let Some(&by) = kept[first..].iter().find(|&&by| follows(draft, place, by)) {
                drop_follower(draft, place, by);
                count += 1;
                continue;
            }
            let mut at = first;
            while at < kept.len() {
                if follows(draft, kept[at], place) {
                    drop_follower(draft, kept.remove(at), place);
                    count += 1;
                } else {
                    at += 1;
                }
            }
            kept.push(place);
        }
    }
    count
}

/// Whether the first place need not be there beside the second: `b * m0 + a * (m2 - m2 at the
/// start)` are its tokens times b, and where the second has what is needed, so has it.
fn follows(draft: &Draft, (a, place): (i64, u32), (b, by): (i64, u32)) -> bool {
    let (a_wide, b_wide) = (i128::from(a), i128::from(b));
    let [tokens, start] = [place, by].map(|it| i128::from(draft.initial[it as usize]));
    let enough = draft.users(place).all(|(_, it)| {
        let [need, given] = [place, by].map(|at| i128::from(it.need(at)));
        need == 0 || b_wide * need <= b_wide * tokens + a_wide * (given - start)
    });
    enough && (a % b == 0 || !draft.visible[place as usize])
}

fn drop_follower(draft: &mut Draft, (a, place): (i64, u32), (b, by): (i64, u32)) {
    if a % b == 0 {
        let [tokens, start] = [place, by].map(|it| i64::from(draft.initial[it as usize]));
        if let Some(constant) = start.checked_mul(a / b).and_then(|it| tokens.checked_sub(it)) {
            draft.record.value(place, constant, &[(by, a / b)]);
        }
    }
    draft.visible[by as usize] |= draft.visible[place as usize];
    draft.drop_place(place);
}
