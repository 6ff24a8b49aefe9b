//! The state class graph.

use super::Limit;
use super::domain::Domains;
use super::index::taken;
use super::markings::{Markings, Rules};
use cotama_core::net::TransitionId;
use cotama_property::time::TimeNet;

/// A class, by its number; 0 is the first.
pub type ClassId = u32;

/// The linear state class graph of a net (Berthomieu and Menasche 1983, Berthomieu and Diaz 1991),
/// or the part of it that the limits allowed.
///
/// A class is a marking and the set of times left that its enabled transitions can have just after
/// some firing sequence. Two classes are one iff both are equal; none is merged into a larger one.
/// The first has the intervals of the net. The firing sequences of the net are the paths of the
/// graph. Classes are numbered breadth first, transitions in their order.
///
/// ```
/// use cotama_verification::tina;
/// use cotama_verification::tpn::{Limits, classes};
/// // `late` can never fire: `early` is always first, and takes the token.
/// let net = b"tr early [1,2] p -> q  tr late [3,4] p -> r  pl p (1)";
/// let net = tina::read("race.net", net).unwrap();
/// let graph = classes(&net, &Limits::default());
/// assert_eq!((graph.classes(), graph.edges(), graph.dead_markings()), (2, 1, 1));
/// assert_eq!((graph.stopped(), graph.bounded()), (None, Some(true)));
/// ```
#[derive(Debug)]
pub struct Classes {
    pub(super) rules: Rules,
    pub(super) markings: Markings,
    pub(super) domains: Domains,
    /// Marking and domain of each class.
    pub(super) list: Vec<(u32, u32)>,
    /// From which class each was met first, and by which transition.
    pub(super) parents: Vec<(ClassId, TransitionId)>,
    /// Start of the edges of each class, and the end of the last ones. Unexplored classes have
    /// none.
    pub(super) starts: Vec<usize>,
    pub(super) edges: Vec<(TransitionId, ClassId)>,
    pub(super) stopped: Option<Limit>,
    pub(super) bounded: Option<bool>,
}

impl Classes {
    /// For each transition whether some class fires it.
    pub(crate) fn fired(&self, transitions: usize) -> Vec<bool> {
        let mut fires = vec![false; transitions];
        for class in 0..self.classes() as u32 {
            for (transition, _) in self.successors(class) {
                fires[transition.0 as usize] = true;
            }
        }
        fires
    }

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

    /// The firings that led to a class when it was met first: a shortest path.
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
        taken(&self.list)
            + taken(&self.parents)
            + taken(&self.starts)
            + taken(&self.edges)
            + self.markings.bytes()
            + self.domains.bytes()
    }

    /// Why the graph is not complete; `None` when it is.
    pub fn stopped(&self) -> Option<Limit> {
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

    /// Returns the firings from a class, each with its successor; empty when a limit was reached
    /// before the class was explored.
    pub fn successors(&self, class: ClassId) -> &[(TransitionId, ClassId)] {
        match (self.starts.get(class as usize), self.starts.get(class as usize + 1)) {
            (Some(&start), Some(&end)) => &self.edges[start..end],
            _ => &[],
        }
    }
}
