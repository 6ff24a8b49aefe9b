//! Rules by which transitions go.

use super::Goal;
use super::draft::{Draft, Move, Row};
use super::places::{COMPARED, normal};
use std::collections::BTreeMap;

/// Transitions that can never fire.
pub(super) fn dead(draft: &mut Draft) -> usize {
    let mut missing: Vec<usize> = vec![0; draft.moves.len()];
    let mut open = Vec::new();
    for (at, it) in draft.transitions() {
        let lacks = it.needs.iter().filter(|it| draft.initial[it.0 as usize] < it.1).count();
        missing[at as usize] = lacks;
        if lacks == 0 {
            open.push(at);
        }
    }
    let mut fires = vec![false; draft.moves.len()];
    let mut grows = vec![false; draft.present.len()];
    while let Some(at) = open.pop() {
        fires[at as usize] = true;
        for &(place, by) in draft.moves[at as usize].iter().flat_map(|it| &it.effects) {
            if by < 0 || std::mem::replace(&mut grows[place as usize], true) {
                continue;
            }
            for (user, it) in draft.users(place) {
                if it.need(place) > draft.initial[place as usize] {
                    missing[user as usize] -= 1;
                    if missing[user as usize] == 0 {
                        open.push(user);
                    }
                }
            }
        }
    }
    let dead: Vec<u32> =
        draft.transitions().map(|it| it.0).filter(|&it| !fires[it as usize]).collect();
    for &transition in &dead {
        draft.remove(transition);
    }
    dead.len()
}

/// Transitions that another does the work of: at once if not `repeated`, else firing at least
/// twice.
pub(super) fn equal(draft: &mut Draft, repeated: bool) -> usize {
    let mut groups: BTreeMap<Row, Vec<(i64, u64, u32)>> = BTreeMap::new();
    for (at, it) in draft.transitions() {
        let (row, factor) = normal(&it.effects);
        let needs = it.needs.iter().map(|it| u64::from(it.1)).sum();
        groups.entry(row).or_default().push((factor, needs, at));
    }
    let mut count = 0;
    for mut group in groups.into_values().filter(|it| it.len() > 1) {
        group.sort_unstable();
        let mut kept: Vec<(i64, u32)> = Vec::new();
        for (factor, _, at) in group {
            let covered = |&(times, by): &(i64, u32)| match (
                &draft.moves[by as usize],
                &draft.moves[at as usize],
            ) {
                (Some(by), Some(it)) => {
                    let times = if times == 0 { 1 } else { divided(factor, times) };
                    (times > 1) == repeated && covers(draft, by, times, it)
                }
                _ => false,
            };
            if kept[kept.len().saturating_sub(COMPARED)..].iter().any(covered) {
                draft.remove(at);
                count += 1;
            } else {
                kept.push((factor, at));
            }
        }
    }
    count
}

/// The quotient; 0 where there is a rest.
fn divided(a: i64, b: i64) -> i64 {
    if a % b == 0 { a / b } else { 0 }
}

fn covers(draft: &Draft, by: &Move, times: i64, it: &Move) -> bool {
    let Ok(times @ 1..) = u32::try_from(times) else { return false };
    let unseen = times == 1 || draft.goal != Goal::StutterInvariantLtl || !draft.is_visible(by);
    let needs = || by.needs_of_times(times);
    unseen && needs().is_some_and(|needs| needs.iter().all(|&(place, need)| need <= it.need(place)))
}

/// A transition that needs nothing, alone.
pub(super) fn always_enabled(draft: &mut Draft) -> usize {
    let Some(always) = draft.transitions().find(|(_, it)| it.needs.is_empty()).map(|it| it.0)
    else {
        return 0;
    };
    let all: Vec<u32> = draft.transitions().map(|it| it.0).filter(|&it| it != always).collect();
    for &transition in &all {
        draft.remove(transition);
    }
    let Some(it) = draft.remove(always) else { return 0 };
    let more = all.len() + it.effects.len();
    draft.put(always, Move { effects: Vec::new(), ..it });
    more
}
