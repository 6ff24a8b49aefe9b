//! Rules by which parts of the net go that do not matter to the rest.

use super::draft::Draft;
use crate::components::components;

/// The places and transitions that matter to given ones.
struct Matter {
    places: Vec<bool>,
    transitions: Vec<bool>,
}

impl Matter {
    /// A transition matters when it changes a place that matters in a way that `counts`, and then
    /// also what it needs.
    fn of(
        draft: &Draft,
        places: Vec<bool>,
        transitions: &[u32],
        counts: impl Fn(&Draft, u32, i64) -> bool,
    ) -> Self {
        let mut all = Self { transitions: vec![false; draft.moves.len()], places };
        let mut open: Vec<u32> =
            draft.places().into_iter().filter(|&it| all.places[it as usize]).collect();
        let mut users = transitions.to_vec();
        loop {
            for at in users.drain(..) {
                if std::mem::replace(&mut all.transitions[at as usize], true) {
                    continue;
                }
                for &(place, _) in draft.moves[at as usize].iter().flat_map(|it| &it.needs) {
                    if !std::mem::replace(&mut all.places[place as usize], true) {
                        open.push(place);
                    }
                }
            }
            let Some(place) = open.pop() else { return all };
            let matters =
                draft.users(place).filter(|(_, it)| counts(draft, place, it.effect(place)));
            users.extend(matters.map(|it| it.0));
        }
    }

    /// Takes away what does not matter; gives the steps of transitions that went.
    fn keep(&self, draft: &mut Draft) -> (usize, Vec<u32>) {
        let lost: Vec<u32> = draft
            .transitions()
            .map(|it| it.0)
            .filter(|&it| !self.transitions[it as usize])
            .collect();
        let steps: Vec<u32> = lost.iter().filter_map(|&it| Some(draft.remove(it)?.step)).collect();
        let places: Vec<u32> =
            draft.places().into_iter().filter(|&it| !self.places[it as usize]).collect();
        for &place in &places {
            draft.drop_place(place);
        }
        (steps.len() + places.len(), steps)
    }
}

/// Removes the parts that cannot matter to the visible places.
pub(super) fn slice(draft: &mut Draft) -> usize {
    let counts =
        |draft: &Draft, place: u32, by: i64| by > 0 || (by < 0 && draft.visible[place as usize]);
    Matter::of(draft, draft.visible.clone(), &[], counts).keep(draft).0
}

/// Removes the parts that come to rest whatever the remaining net does.
pub(super) fn suffix(draft: &mut Draft) -> usize {
    // Places, after them transitions.
    let mut edges = vec![Vec::new(); draft.present.len() + draft.moves.len()];
    let mut lasting = Vec::new();
    for (at, it) in draft.transitions() {
        let (lost, gained): (Vec<_>, Vec<_>) = it.effects.iter().partition(|it| it.1 < 0);
        if lost.is_empty() {
            lasting.push(at);
        }
        let node = draft.present.len() as u32 + at;
        for &(from, _) in &lost {
            edges[from as usize].push(node);
        }
        edges[node as usize].extend(gained.iter().map(|it: &(u32, i64)| it.0));
    }
    let component =
        components(edges.len(), |node, at| edges[node as usize].get(at as usize).copied()).of;
    let mut sizes = vec![0; edges.len()];
    for &it in &component {
        sizes[it as usize] += 1;
    }
    let core = draft
        .visible
        .iter()
        .zip(&component)
        .map(|(&seen, &it)| seen || sizes[it as usize] > 1)
        .collect();
    let (count, steps) = Matter::of(draft, core, &lasting, |_, _, by| by != 0).keep(draft);
    if !steps.is_empty() {
        draft.record.at_rest(steps);
    }
    count
}
