//! The state class graph, class by class.

use super::bound::Bound;
use super::classes::{ClassId, Classes};
use super::domain::Domain;
use super::growth;
use super::index::{Index, hash, room};
use super::untimed;
use super::{Limit, Limits};
use cotama_core::net::TransitionId;
use cotama_property::time::TimeNet;

/// Builds the state class graph of a net.
///
/// ```
/// use cotama_verification::{tina, tpn};
///
/// let net = tina::read(
///     "race.net",
///     b"tr fast [1,2] idle -> won  tr slow ]2,3] idle -> lost  pl idle (1)",
/// )
/// .unwrap();
/// let classes = tpn::classes(&net, &tpn::Limits::default());
/// // slow never fires
/// assert_eq!((classes.classes(), classes.edges(), classes.markings()), (2, 1, 2));
/// assert_eq!((classes.bounded(), classes.dead_markings()), (Some(true), 1));
/// ```
pub fn classes(net: &TimeNet, limits: &Limits) -> Classes {
    let mut classes = Classes::none(net);
    classes.stopped = classes.explore(limits, true, |_| false).err();
    classes.bounded = match classes.stopped {
        None => Some(true),
        Some(Limit::Unbounded) => Some(false),
        // Finitely many markings without time are finitely many with it.
        Some(_) => {
            // Beside the classes, which are kept, a part of the memory is used for once more.
            let left = limits.bytes.saturating_sub(classes.bytes() as u64);
            let limits = Limits { bytes: left.max(limits.bytes / 32), ..*limits };
            untimed::markings(&classes.rules.pt, &limits).bounded().filter(|&it| it)
        }
    };
    classes
}

impl Classes {
    /// Adds classes until there are no more, or one has a marking that is sought: that one is
    /// returned. With `growth` it also stops when the net is unbounded.
    pub(super) fn explore(
        &mut self,
        limits: &Limits,
        growth: bool,
        mut sought: impl FnMut(&[u32]) -> bool,
    ) -> Result<Option<ClassId>, Limit> {
        let most = limits.states.min(u64::from(u32::MAX) - 1);
        let fits = |transitions: usize| {
            Domain::bytes(transitions).is_some_and(|bytes| bytes as u64 <= limits.bytes)
        };
        if most == 0 {
            return Err(Limit::States);
        }
        if !fits(self.markings.enabled(0).len()) {
            return Err(Limit::Bytes);
        }
        let mut domain = Domain::of_new(&self.rules, self.markings.enabled(0));
        self.list.push((0, self.domains.number(&domain)));
        self.parents.push((0, TransitionId(u32::MAX)));
        if sought(self.markings.tokens(0)) {
            return Ok(Some(0));
        }
        let mut index = Index::new();
        index.find_or_insert(key(self.list[0]), 0, |_| false);
        let (mut after, mut first, mut bounds) = (Domain::default(), Vec::new(), Vec::new());
        while self.starts.len() <= self.list.len() {
            let class = self.starts.len() as ClassId - 1;
            limits.check(class, || 0)?;
            room(&mut self.edges, self.rules.pt.transitions.len());
            room(&mut self.starts, 1);
            let (marking, number) = self.list[class as usize];
            let transitions = self.markings.enabled(marking).len();
            self.domains.load(number, transitions, &mut domain);
            domain.first(&mut first);
            for position in 0..transitions {
                if first[position + 1] != Bound::ZERO {
                    continue;
                }
                let known = self.markings.len();
                let fired = TransitionId(self.markings.enabled(marking)[position]);
                let step =
                    self.markings.step(&self.rules, marking, position).ok_or(Limit::Tokens)?;
                let kept = (self.markings.kept(step), self.markings.enabled(step.target));
                if !fits(kept.1.len()) {
                    return Err(Limit::Bytes);
                }
                domain.fire(&self.rules, (position + 1, &first), kept, &mut bounds, &mut after);
                let pair = (step.target, self.domains.number(&after));
                let next = self.list.len() as ClassId;
                let found =
                    index.find_or_insert(key(pair), next, |it| self.list[it as usize] == pair);
                if found.is_none() {
                    if self.list.len() as u64 >= most {
                        return Err(Limit::States);
                    }
                    if (self.bytes() + index.bytes()) as u64 > limits.bytes {
                        return Err(Limit::Bytes);
                    }
                    room(&mut self.list, 1);
                    room(&mut self.parents, 1);
                    self.list.push(pair);
                    self.parents.push((class, fired));
                }
                self.edges.push((fired, found.unwrap_or(next)));
                if found.is_none() {
                    if self.markings.len() > known && sought(self.markings.tokens(pair.0)) {
                        return Ok(Some(next));
                    }
                    if growth && growth::repeats(self, next) {
                        return Err(Limit::Unbounded);
                    }
                }
            }
            self.starts.push(self.edges.len());
        }
        Ok(None)
    }
}

fn key((marking, domain): (u32, u32)) -> u64 {
    hash([u64::from(marking) << 32 | u64::from(domain)])
}
