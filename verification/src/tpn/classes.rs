//! The state class graph.

use super::bound::Bound;
use super::domain::{Domain, Domains};
use super::growth;
use super::index::{Index, hash};
use super::markings::{Markings, Rules};
use super::net::TimeNet;
use super::untimed;
use super::{Limits, Stop};
use cotama_core::net::TransitionId;

/// A class, by its number; 0 is the first.
pub type ClassId = u32;

/// The linear state class graph of a net (Berthomieu and Menasche 1983, Berthomieu and Diaz 1991),
/// or the part of it that the limits allowed.
///
/// A class is a marking and the set of times left that its enabled transitions can have just after
/// some firing sequence. Two classes are one iff both are equal; none is merged into a larger one.
/// The first has the intervals of the net. The firing sequences of the net are the paths of the
/// graph. Classes are numbered breadth first, transitions in their order.
#[derive(Debug)]
pub struct Classes {
    pub(super) rules: Rules,
    pub(super) markings: Markings,
    pub(super) domains: Domains,
    /// Marking and domain of each class.
    pub(super) list: Vec<(u32, u32)>,
    /// From which class each was met first, and by which transition.
    pub(super) parents: Vec<(ClassId, TransitionId)>,
    /// Where the edges of each class start, and where the last ones end. Classes that were not
    /// looked at have none.
    starts: Vec<usize>,
    edges: Vec<(TransitionId, ClassId)>,
    stopped: Option<Stop>,
    bounded: Option<bool>,
}

/// Builds the state class graph of a net.
///
/// ```
/// use cotama_verification::{tina, tpn};
///
/// let net = tina::read("race.net", b"tr fast [1,2] idle -> won  tr slow ]2,3] idle -> lost  pl idle (1)").unwrap();
/// let classes = tpn::classes(&net, &tpn::Limits::default());
/// assert_eq!((classes.classes(), classes.edges(), classes.markings()), (2, 1, 2)); // slow never fires
/// assert_eq!((classes.bounded(), classes.dead_markings()), (Some(true), 1));
/// ```
pub fn classes(net: &TimeNet, limits: &Limits<'_>) -> Classes {
    let mut classes = Classes::none(net);
    classes.stopped = classes.explore(limits, true, |_| false).err();
    classes.bounded = match classes.stopped {
        None => Some(true),
        Some(Stop::Unbounded) => Some(false),
        // Finitely many markings without time are finitely many with it.
        Some(_) => untimed::markings(&classes.rules.pt, limits).bounded().filter(|&it| it),
    };
    classes
}

impl Classes {
    /// No class yet.
    pub(super) fn none(net: &TimeNet) -> Self {
        let rules = Rules::new(net);
        Self {
            markings: Markings::new(&rules),
            domains: Domains::new(&rules),
            rules,
            list: Vec::new(),
            parents: Vec::new(),
            starts: vec![0],
            edges: Vec::new(),
            stopped: None,
            bounded: None,
        }
    }

    /// Adds classes until there are no more, or one has a marking that is sought: that one is
    /// returned. With `growth` it also stops when the net is unbounded.
    pub(super) fn explore(
        &mut self,
        limits: &Limits<'_>,
        growth: bool,
        mut sought: impl FnMut(&[u32]) -> bool,
    ) -> Result<Option<ClassId>, Stop> {
        let most = limits.classes.min(u32::MAX as usize - 1);
        let fits = |transitions: usize| {
            Domain::bytes(transitions).is_some_and(|bytes| bytes <= limits.bytes)
        };
        if most == 0 {
            return Err(Stop::Classes);
        }
        if !fits(self.markings.enabled(0).len()) {
            return Err(Stop::Bytes);
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
            limits.check(class, || self.bytes() + index.bytes())?;
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
                    self.markings.step(&self.rules, marking, position).ok_or(Stop::Overflow)?;
                let kept = (self.markings.kept(step), self.markings.enabled(step.target));
                if !fits(kept.1.len()) {
                    return Err(Stop::Bytes);
                }
                domain.fire(&self.rules, (position + 1, &first), kept, &mut bounds, &mut after);
                let pair = (step.target, self.domains.number(&after));
                let next = self.list.len() as ClassId;
                let found =
                    index.find_or_insert(key(pair), next, |it| self.list[it as usize] == pair);
                if found.is_none() {
                    if self.list.len() >= most {
                        return Err(Stop::Classes);
                    }
                    self.list.push(pair);
                    self.parents.push((class, fired));
                }
                self.edges.push((fired, found.unwrap_or(next)));
                if found.is_none() {
                    if self.markings.len() > known && sought(self.markings.tokens(pair.0)) {
                        return Ok(Some(next));
                    }
                    if growth && growth::repeats(self, next) {
                        return Err(Stop::Unbounded);
                    }
                }
            }
            self.starts.push(self.edges.len());
        }
        Ok(None)
    }

    /// The firings that led to a class when it was met first: a shortest way.
    pub(super) fn path(&self, mut class: ClassId) -> Vec<TransitionId> {
        let mut path = Vec::new();
        while class != 0 {
            let (before, fired) = self.parents[class as usize];
            path.push(fired);
            class = before;
        }
        path.reverse();
        path
    }

    /// About how many bytes it takes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.list)
            + size_of_val(&*self.parents)
            + size_of_val(&*self.starts)
            + size_of_val(&*self.edges)
            + self.markings.bytes()
            + self.domains.bytes()
    }

    /// Why the graph is not complete; `None` when it is.
    pub fn stopped(&self) -> Option<Stop> {
        self.stopped
    }

    /// Whether the net has finitely many markings; `None` when that is not known.
    ///
    /// It is known to be bounded when the graph is complete, or when the net without time is
    /// bounded. It is known to be unbounded when some firing sequence leads to a larger marking
    /// with the same times, and no transition that it leaves disabled on the way waits for the
    /// tokens that it adds: then it can be repeated for ever. That is a proof, and a larger marking
    /// alone would not be one. There is no procedure that decides every net.
    pub fn bounded(&self) -> Option<bool> {
        self.bounded
    }

    /// How many classes there are, or were met.
    pub fn classes(&self) -> usize {
        self.list.len()
    }

    /// How many edges (class, transition, class) there are, or were met.
    pub fn edges(&self) -> usize {
        self.edges.len()
    }

    /// How many different markings the classes have.
    pub fn markings(&self) -> usize {
        self.markings.len()
    }

    /// How many of the markings enable nothing.
    pub fn dead_markings(&self) -> usize {
        (0..self.markings() as u32)
            .filter(|&marking| self.markings.enabled(marking).is_empty())
            .count()
    }

    /// The marking of a class; empty beyond the last.
    pub fn marking(&self, class: ClassId) -> &[u32] {
        self.list.get(class as usize).map_or(&[], |&(marking, _)| self.markings.tokens(marking))
    }

    /// Where firings lead from a class; empty when it was not looked at before a limit was reached.
    pub fn successors(&self, class: ClassId) -> &[(TransitionId, ClassId)] {
        match (self.starts.get(class as usize), self.starts.get(class as usize + 1)) {
            (Some(&start), Some(&end)) => &self.edges[start..end],
            _ => &[],
        }
    }

    /// Whether a class has a token in this place.
    pub(super) fn marked(&self, class: ClassId, place: u32) -> bool {
        self.marking(class).get(place as usize).is_some_and(|&tokens| tokens > 0)
    }
}

fn key((marking, domain): (u32, u32)) -> u64 {
    hash([u64::from(marking) << 32 | u64::from(domain)])
}
