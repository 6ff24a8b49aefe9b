//! Largest sets in which every two are alike.

use super::set::Set;

/// The most members that all groups have together; more are not told.
pub const MAX_GROUPED: usize = 100_000;
/// The most words of sets that are looked at: a fraction of a second.
const MAX_WORK: usize = 100_000_000;

/// The largest groups.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Groups {
    /// The places of the members of each; sorted.
    pub list: Vec<Vec<usize>>,
    /// Whether these are all. There can be as many as two to the half of the failure modes, so the
    /// search has a limit.
    pub complete: bool,
}

/// All largest sets, of two and more, in which every two are near to each other; `near` holds the
/// neighbours of each place. Method: Bron and Kerbosch, Commun. ACM 16, 1973, with the pivot of
/// Tomita, Tanaka, Takahashi, Theor. Comput. Sci. 363, 2006.
pub(super) fn largest(near: &[Set]) -> Groups {
    let places = (0..near.len()).filter(|&it| near.get(it).is_some_and(|near| !near.is_empty()));
    let open = Set::of(near.len(), places);
    let mut search = Search { near, list: Vec::new(), members: 0, work: 0 };
    let done = Set::none(near.len());
    let complete = search.grow(&mut Vec::new(), open, done);
    search.list.iter_mut().for_each(|it| it.sort_unstable());
    search.list.sort_unstable();
    Groups { list: search.list, complete }
}

struct Search<'a> {
    near: &'a [Set],
    list: Vec<Vec<usize>>,
    members: usize,
    work: usize,
}

impl Search<'_> {
    /// Tells all largest groups that hold `group`, some of `open` and none of `done`; `false` when
    /// a limit is reached.
    fn grow(&mut self, group: &mut Vec<usize>, mut open: Set, mut done: Set) -> bool {
        let before = group.len();
        let mut pivot = None;
        // A node near all others belongs to every group, which needs no branch.
        loop {
            let mut most = None;
            for at in open.iter().chain(done.iter()) {
                let near = self.near[at].common(&open).len();
                self.work += open.words();
                if most.is_none_or(|(most, _)| near > most) {
                    most = Some((near, at));
                }
                if open.has(at) && near + 1 == open.len() {
                    break;
                }
            }
            let Some((near, at)) = most.filter(|_| self.work <= MAX_WORK) else { break };
            if !(open.has(at) && near + 1 == open.len()) {
                pivot = Some(at);
                break;
            }
            group.push(at);
            open.remove(at);
            done = done.common(&self.near[at]);
        }
        let complete = self.work <= MAX_WORK && self.branch(group, open, done, pivot);
        group.truncate(before);
        complete
    }

    fn branch(
        &mut self,
        group: &mut Vec<usize>,
        mut open: Set,
        mut done: Set,
        pivot: Option<usize>,
    ) -> bool {
        if open.is_empty() {
            if done.is_empty() && group.len() > 1 {
                self.members += group.len();
                if self.members > MAX_GROUPED {
                    return false;
                }
                self.list.push(group.clone());
            }
            return true;
        }
        let next = pivot.map_or_else(|| open.clone(), |it| open.without(&self.near[it]));
        for at in next.iter() {
            group.push(at);
            let near = &self.near[at];
            if !self.grow(group, open.common(near), done.common(near)) {
                return false;
            }
            group.pop();
            open.remove(at);
            done.insert(at);
        }
        true
    }
}
