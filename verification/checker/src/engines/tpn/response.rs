//! Response times: how long from a firing until a place is marked.

use super::bound::Bound;
use super::classes::{ClassId, Classes};
use super::domain::Domain;
use super::markings::ANEW;
use super::{Limit, Limits};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::time::TimeNet;
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, HashSet};
use std::fmt;

/// How long, in the unit of the net.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Time {
    /// So long.
    Finite(u64),
    /// For ever, or without bound.
    Infinite,
}

impl fmt::Display for Time {
    /// A number or `inf`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finite(time) => time.fmt(f),
            Self::Infinite => f.write_str("inf"),
        }
    }
}

/// The time from each firing of a transition to the first instant, then or later, at which a place
/// is marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Response {
    /// The transition fires in no run, so there is nothing to measure.
    NeverFires,
    /// Over all runs and all firings.
    Between {
        /// The greatest lower bound; infinite when the place is marked after no firing.
        min: Time,
        /// The least upper bound; infinite when after some firing of some run the place is never
        /// marked, or as late as one likes.
        max: Time,
    },
    /// The work was cut short.
    Unknown {
        /// The limit that was reached.
        limit: Limit,
        /// How many classes, and times to reach them, were met.
        explored: usize,
    },
}

/// The least and the most time from a firing of `from` to the first marking, right after it or
/// later, with a token in `to`.
///
/// All runs count that cannot be extended: without end, also in finite time, or up to a deadlock.
/// Each firing starts its own measurement. Bounds are exact, whether a run attains them or not.
///
/// ```
/// use cotama_verification::tina;
/// use cotama_verification::tpn::{Limits, Response, Time, bound};
///
/// let text = b"pl idle (1)  tr ask [0,w[ idle -> asked  tr think ]1,4] asked -> known  \
///              tr tell [2,3] known -> idle";
/// let net = tina::read("oracle.net", text).unwrap();
/// let (ask, idle) = (net.transition("ask").unwrap(), net.place("idle").unwrap());
/// let known = Response::Between { min: Time::Finite(3), max: Time::Finite(7) };
/// assert_eq!(bound(&net, ask, idle, &Limits::default()), known);
/// ```
pub fn bound(net: &TimeNet, from: TransitionId, to: PlaceId, limits: &Limits) -> Response {
    measured(net, Some(from), to, limits).0
}

/// The least and the most time from the start to the first marking with a token in `to`; else as
/// [`bound`].
///
/// ```
/// use cotama_verification::tina;
/// use cotama_verification::tpn::{Limits, Response, Time, bound_from_start};
/// let net = b"tr a [1,2] p -> q  tr b [3,4] q -> r  pl p (1)";
/// let net = tina::read("chain.net", net).unwrap();
/// let within = bound_from_start(&net, net.place("r").unwrap(), &Limits::default());
/// assert_eq!(within, Response::Between { min: Time::Finite(4), max: Time::Finite(6) });
/// ```
pub fn bound_from_start(net: &TimeNet, to: PlaceId, limits: &Limits) -> Response {
    measured(net, None, to, limits).0
}

/// The same, and how many classes there are, or were met.
pub(crate) fn measured(
    net: &TimeNet,
    from: Option<TransitionId>,
    to: PlaceId,
    limits: &Limits,
) -> (Response, usize) {
    let mut classes = Classes::none(net);
    let ended = classes.explore(limits, true, |_| false);
    let explored = classes.classes();
    let response = match ended {
        Ok(_) => response(&classes, from, to, limits),
        Err(limit) => Response::Unknown { limit, explored },
    };
    (response, explored)
}

fn response(
    classes: &Classes,
    from: Option<TransitionId>,
    to: PlaceId,
    limits: &Limits,
) -> Response {
    let mut entered = HashSet::new();
    let entries: Vec<ClassId> = match from {
        None => vec![0],
        Some(from) => (0..classes.classes() as ClassId)
            .flat_map(|class| classes.successors(class))
            .filter(|&&(fired, target)| fired == from && entered.insert(target))
            .map(|&(_, target)| target)
            .collect(),
    };
    if entries.is_empty() {
        return Response::NeverFires;
    }
    let mut search = Search::new(classes, |tokens| tokens[to.0 as usize] > 0, limits);
    match search.min(&entries).and_then(|min| Ok((min, search.max(&entries)?))) {
        Ok((min, max)) => Response::Between { min, max },
        Err(limit) => Response::Unknown { limit, explored: search.met },
    }
}

/// The most time that passes in any run from a time at which a cause holds to the first time, then
/// or later, at which an effect does. `at_start` asks about the start alone. The classes are all
/// that there are.
///
/// Between firings a marking stays, so it is enough to measure from each class whose marking holds
/// the cause and not the effect, when it is entered; and of these from those that are entered from
/// another one, as the others are met later in a run that is measured already.
pub(crate) fn longest(
    classes: &Classes,
    cause: impl Fn(&[u32]) -> bool,
    effect: impl Fn(&[u32]) -> bool,
    at_start: bool,
    limits: &Limits,
) -> Result<Time, Limit> {
    let mut search = Search::new(classes, effect, limits);
    let all = 0..classes.classes() as ClassId;
    let waits: Vec<bool> =
        all.clone().map(|it| !search.marked(it) && cause(classes.marking(it))).collect();
    let mut is_entered = vec![false; waits.len()];
    is_entered[0] = waits[0];
    if !at_start {
        for from in all.clone().filter(|it| !waits[*it as usize]) {
            for &(_, to) in classes.successors(from) {
                is_entered[to as usize] = waits[to as usize];
            }
        }
    }
    let entries: Vec<ClassId> = all.filter(|it| is_entered[*it as usize]).collect();
    if entries.is_empty() { Ok(Time::Finite(0)) } else { search.max(&entries) }
}

/// A search through classes in which the place is not marked, with one more variable y: minus the
/// time since the firing.
struct Search<'c> {
    classes: &'c Classes,
    /// For each class whether what is waited for is there.
    is_over: Vec<bool>,
    limits: &'c Limits,
    /// Classes and rows of y that were met.
    met: usize,
    bytes: usize,
}

/// For zero and each enabled transition i of a class, a bound of xᵢ - y or of y - xᵢ.
type Row = Vec<Bound>;

/// A firing out of a class.
struct Firing<'c> {
    /// Column of the transition in the domain.
    column: usize,
    target: ClassId,
    /// For each transition enabled after it, the position that it had before.
    kept: &'c [u32],
    /// These transitions.
    enabled: &'c [u32],
}

impl<'c> Search<'c> {
    fn new(classes: &'c Classes, is_over: impl Fn(&[u32]) -> bool, limits: &'c Limits) -> Self {
        let all = 0..classes.classes() as ClassId;
        let is_over = all.map(|it| is_over(classes.marking(it))).collect();
        Self { classes, is_over, limits, met: classes.classes(), bytes: classes.bytes() }
    }

    fn marked(&self, class: ClassId) -> bool {
        self.is_over[class as usize]
    }

    fn load(&self, class: ClassId, into: &mut Domain) {
        let (marking, domain) = self.classes.list[class as usize];
        self.classes.domains.load(domain, self.classes.markings.enabled(marking).len(), into);
    }

    fn firings(&self, class: ClassId) -> impl Iterator<Item = Firing<'c>> + use<'c> {
        let classes = self.classes;
        let marking = classes.list[class as usize].0;
        classes.successors(class).iter().filter_map(move |&(fired, target)| {
            let (position, step) = classes.markings.known_step(marking, fired.0)?;
            let (kept, enabled) =
                (classes.markings.kept(step), classes.markings.enabled(step.target));
            Some(Firing { column: position + 1, target, kept, enabled })
        })
    }

    /// Counts a row that is kept.
    fn count(&mut self, row: &Row) -> Result<(), Limit> {
        self.met += 1;
        self.bytes += size_of::<Row>() + size_of_val(&**row);
        if self.met as u64 > self.limits.states {
            return Err(Limit::States);
        }
        self.limits.check(self.met as u32, || self.bytes)
    }

    /// The least time, the earliest class first.
    ///
    /// A row bounds y - xᵢ, which bounds the time from below; a larger bound allows more. Firing f
    /// makes f the new zero, and a shortest path from y may go through f to any other transition.
    fn min(&mut self, entries: &[ClassId]) -> Result<Time, Limit> {
        let useful = self.leading();
        let mut rows: HashMap<ClassId, Vec<Row>> = HashMap::new();
        let mut queue = BinaryHeap::new();
        let (mut domain, mut first) = (Domain::default(), Vec::new());
        let mut order = 0_usize;
        for &class in entries {
            if self.marked(class) {
                return Ok(Time::Finite(0));
            }
            if useful[class as usize] {
                self.load(class, &mut domain);
                let row: Row = domain.row(0).iter().map(|it| it.closed()).collect();
                self.count(&row)?;
                queue.push(Reverse((0, order, class, row)));
                order += 1;
            }
        }
        while let Some(Reverse((elapsed, _, class, row))) = queue.pop() {
            if self.marked(class) {
                return Ok(Time::Finite(elapsed));
            }
            let known = rows.entry(class).or_default();
            if known.iter().any(|it| at_most(&row, it)) {
                continue;
            }
            known.retain(|it| !at_most(it, &row));
            known.push(row.clone());
            self.load(class, &mut domain);
            domain.first(&mut first);
            for Firing { column, target, kept, enabled } in self.firings(class) {
                if !useful[target as usize] {
                    continue;
                }
                let zero = row[column];
                let mut next = vec![zero];
                for (&before, &transition) in kept.iter().zip(enabled) {
                    next.push(if before == ANEW {
                        sum(zero, self.classes.rules.intervals[transition as usize].0)?
                    } else {
                        let column = before as usize + 1;
                        row[column].min(sum(zero, first[column])?)
                    });
                }
                let elapsed = zero.value().map_or(0, |(value, _)| value.unsigned_abs());
                self.count(&next)?;
                queue.push(Reverse((elapsed, order, target, next)));
                order += 1;
            }
        }
        Ok(Time::Infinite)
    }

    /// From which classes one with the place marked can be reached, itself included.
    fn leading(&self) -> Vec<bool> {
        let count = self.classes.classes();
        let mut starts = vec![0_usize; count + 1];
        let edges = || {
            (0..count as ClassId).flat_map(|from| {
                self.classes.successors(from).iter().map(move |&(_, to)| (from, to))
            })
        };
        edges().for_each(|(_, to)| starts[to as usize + 1] += 1);
        for at in 0..count {
            starts[at + 1] += starts[at];
        }
        let mut ends = starts.clone();
        let mut sources = vec![0; self.classes.edges()];
        for (from, to) in edges() {
            sources[ends[to as usize]] = from;
            ends[to as usize] += 1;
        }
        let mut leading: Vec<bool> =
            (0..count as ClassId).map(|class| self.marked(class)).collect();
        let mut open: Vec<ClassId> =
            (0..count as ClassId).filter(|&class| leading[class as usize]).collect();
        while let Some(class) = open.pop() {
            for &from in &sources[starts[class as usize]..ends[class as usize]] {
                if !std::mem::replace(&mut leading[from as usize], true) {
                    open.push(from);
                }
            }
        }
        leading
    }

    /// The most time: infinite with a cycle or a dead class on the way, else along the longest
    /// path.
    ///
    /// A row bounds xᵢ - y, which bounds the time from above; a larger bound allows more. Firing f
    /// makes f the new zero, and its shortest path to y may go through any other transition.
    fn max(&mut self, entries: &[ClassId]) -> Result<Time, Limit> {
        let Some(order) = self.order(entries) else { return Ok(Time::Infinite) };
        let mut rows: HashMap<ClassId, Vec<Row>> = HashMap::new();
        let mut domain = Domain::default();
        for &class in entries {
            if self.marked(class) {
                continue;
            }
            self.load(class, &mut domain);
            let row: Row = (0..domain.size).map(|row| domain.at(row, 0).closed()).collect();
            self.count(&row)?;
            rows.insert(class, vec![row]);
        }
        let mut most = 0;
        for class in order {
            let here = rows.remove(&class).unwrap_or_default();
            self.load(class, &mut domain);
            for Firing { column, target, kept, enabled } in self.firings(class) {
                for row in &here {
                    let zero = row[1..].iter().copied().min().unwrap_or(Bound::INFINITE);
                    let Some((elapsed, _)) = zero.value() else { return Ok(Time::Infinite) };
                    if self.marked(target) {
                        most = most.max(elapsed.unsigned_abs());
                        continue;
                    }
                    let mut next = vec![zero];
                    for (&before, &transition) in kept.iter().zip(enabled) {
                        next.push(if before == ANEW {
                            sum(zero, self.classes.rules.intervals[transition as usize].1)?
                        } else {
                            let before = before as usize + 1;
                            row[before].min(sum(zero, domain.at(before, column).closed())?)
                        });
                    }
                    let known = rows.entry(target).or_default();
                    if !known.iter().any(|it| at_most(&next, it)) {
                        known.retain(|it| !at_most(it, &next));
                        self.count(&next)?;
                        known.push(next);
                    }
                }
            }
        }
        Ok(Time::Finite(most))
    }

    /// The classes that are reached without a marked place, each before those that it leads to;
    /// `None` when there is a cycle or a dead class among them.
    fn order(&self, entries: &[ClassId]) -> Option<Vec<ClassId>> {
        #[derive(Clone, Copy, PartialEq, Eq)]
        enum State {
            New,
            Open,
            Done,
        }
        let mut states = vec![State::New; self.classes.classes()];
        let mut done = Vec::new();
        let mut path: Vec<(ClassId, usize)> = Vec::new();
        for &entry in entries {
            let mut next = Some(entry);
            loop {
                if let Some(class) = next.take().filter(|&class| !self.marked(class)) {
                    match states[class as usize] {
                        State::Done => {}
                        State::Open => return None,
                        State::New if self.classes.successors(class).is_empty() => return None,
                        State::New => {
                            states[class as usize] = State::Open;
                            path.push((class, 0));
                        }
                    }
                }
                let Some((class, edge)) = path.last_mut() else { break };
                next = self.classes.successors(*class).get(*edge).map(|&(_, target)| target);
                *edge += 1;
                if next.is_none() {
                    states[*class as usize] = State::Done;
                    done.push(*class);
                    path.pop();
                }
            }
        }
        done.reverse();
        Some(done)
    }
}

fn sum(a: Bound, b: Bound) -> Result<Bound, Limit> {
    a.closed().checked_plus(b.closed()).ok_or(Limit::Tokens)
}

/// Whether no bound of a row is larger than that of another one.
fn at_most(row: &Row, other: &Row) -> bool {
    row.iter().zip(other).all(|(a, b)| a <= b)
}
