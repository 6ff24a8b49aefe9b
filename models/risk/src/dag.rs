//! Directed acyclic graphs over up to 64 variables, and the classes of those that no data tells
//! apart.

/// The most variables of a graph that is learned.
pub const MAX_LEARNED: usize = 64;

/// Numbers of the bits of a mask, rising.
pub(crate) fn bits(mut mask: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        (mask != 0).then(|| {
            let at = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            at
        })
    })
}

/// A directed acyclic graph: for each variable its parents, as bits.
///
/// ```
/// use cotama_risk::Dag;
/// let chain = Dag::new(vec![0b000, 0b001, 0b010]).unwrap(); // 0 -> 1 -> 2
/// assert_eq!(chain.order(), [0, 1, 2]);
/// assert!(chain.compelled().is_empty()); // no data tells it from 2 -> 1 -> 0
/// let collider = Dag::new(vec![0b000, 0b101, 0b000]).unwrap(); // 0 -> 1 <- 2
/// assert_eq!(collider.compelled(), [(0, 1), (2, 1)]);
/// assert!(Dag::new(vec![0b10, 0b01]).is_none()); // a cycle
/// ```
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Dag {
    /// Invariant: no cycle, at most [`MAX_LEARNED`].
    parents: Vec<u64>,
}

impl Dag {
    /// A graph with these parents; none if they make a cycle, or name more than there are.
    pub fn new(parents: Vec<u64>) -> Option<Self> {
        let all = all(parents.len());
        let fits = parents.len() <= MAX_LEARNED && parents.iter().all(|it| it & !all == 0);
        let dag = Self { parents };
        (fits && dag.order().len() == dag.parents.len()).then_some(dag)
    }

    /// A graph without arcs.
    pub(crate) fn empty(variables: usize) -> Self {
        Self { parents: vec![0; variables.min(MAX_LEARNED)] }
    }

    /// For each variable its parents, as bits.
    pub fn parents(&self) -> &[u64] {
        &self.parents
    }

    /// Replaces parents by ones that make no cycle.
    pub(crate) fn set(&mut self, child: usize, parents: u64) {
        self.parents[child] = parents;
        debug_assert_eq!(self.order().len(), self.parents.len(), "a cycle");
    }

    /// The arcs, by child and parent.
    pub fn arcs(&self) -> impl Iterator<Item = (usize, usize)> {
        self.parents.iter().enumerate().flat_map(|(to, it)| bits(*it).map(move |from| (from, to)))
    }

    /// All variables, parents before their children, the smallest number first wherever there is a
    /// choice.
    pub fn order(&self) -> Vec<usize> {
        let (mut order, mut done) = (Vec::with_capacity(self.parents.len()), 0);
        let is_free = |at: usize, done: u64| done >> at & 1 == 0 && self.parents[at] & !done == 0;
        while let Some(next) = (0..self.parents.len()).find(|it| is_free(*it, done)) {
            done |= 1 << next;
            order.push(next);
        }
        order
    }

    /// Ancestors of each variable, as bits.
    pub(crate) fn ancestors(&self) -> Vec<u64> {
        let mut all = vec![0; self.parents.len()];
        for at in self.order() {
            all[at] = bits(self.parents[at]).fold(self.parents[at], |mask, it| mask | all[it]);
        }
        all
    }

    /// The arcs that every graph has to which all data gives the same likelihood, by their ends.
    pub fn compelled(&self) -> Vec<(usize, usize)> {
        let class = Class::of(self);
        let directed = class.into.iter().enumerate();
        let mut arcs: Vec<_> =
            directed.flat_map(|(to, it)| bits(*it).map(move |from| (from, to))).collect();
        arcs.sort_unstable();
        arcs
    }

    /// The graph of the same class in which each arc that is free points from the smaller number
    /// to the larger, as far as the arcs before it allow, in the order of their numbers.
    #[must_use]
    pub fn canonical(&self) -> Self {
        let mut class = Class::of(self);
        for from in 0..self.parents.len() {
            for to in from + 1..self.parents.len() {
                if class.free[from] >> to & 1 == 1 {
                    class.direct(from, to);
                    class.close();
                }
            }
        }
        let dag = Self { parents: class.into };
        debug_assert_eq!(dag.order().len(), dag.parents.len(), "a cycle");
        dag
    }
}

/// All variables, as bits.
pub(crate) const fn all(variables: usize) -> u64 {
    if variables >= 64 { u64::MAX } else { (1 << variables) - 1 }
}

/// A class of graphs: arcs that all have, and edges that some direct one way, some the other.
struct Class {
    /// For each variable the variables whose arcs point at it in all graphs.
    into: Vec<u64>,
    /// Ends of the edges of each variable.
    free: Vec<u64>,
}

impl Class {
    /// The class of a graph: its edges, its colliders whose parents are not joined, and all that
    /// follows from these (Meek, UAI 1995, rules 1 to 4).
    fn of(dag: &Dag) -> Self {
        let variables = dag.parents.len();
        let mut class = Self { into: vec![0; variables], free: vec![0; variables] };
        for (from, to) in dag.arcs() {
            class.free[from] |= 1 << to;
            class.free[to] |= 1 << from;
        }
        let joined = class.free.clone();
        for (to, parents) in dag.parents.iter().enumerate() {
            for from in bits(*parents) {
                if parents & !joined[from] & !(1 << from) != 0 {
                    class.direct(from, to);
                }
            }
        }
        class.close();
        class
    }

    fn direct(&mut self, from: usize, to: usize) {
        self.free[from] &= !(1 << to);
        self.free[to] &= !(1 << from);
        self.into[to] |= 1 << from;
    }

    fn joined(&self, at: usize) -> u64 {
        let out = (0..self.into.len()).filter(|it| self.into[*it] >> at & 1 == 1);
        out.fold(self.free[at] | self.into[at], |mask, it| mask | 1 << it)
    }

    /// Directs all edges that have but one way left.
    fn close(&mut self) {
        while let Some((from, to)) = self.next() {
            self.direct(from, to);
        }
    }

    fn next(&self) -> Option<(usize, usize)> {
        let joined: Vec<u64> = (0..self.into.len()).map(|it| self.joined(it)).collect();
        let edges = self.free.iter().enumerate().flat_map(|(b, it)| bits(*it).map(move |c| (b, c)));
        // From b to c, as the other way makes a new collider or a cycle.
        let mut edges = edges;
        edges.find(|&(b, c)| {
            let new_collider = self.into[b] & !joined[c] & !(1 << c) != 0;
            let cycle = bits(self.into[c]).any(|a| self.into[a] >> b & 1 == 1);
            let sides = self.free[b] & self.into[c];
            let two = bits(sides).any(|a| sides & !joined[a] & !(1 << a) != 0);
            // a - b, a -> d, d -> c, and a not joined to c.
            let around = bits(self.into[c] & joined[b])
                .any(|d| self.into[d] & self.free[b] & !joined[c] & !(1 << c) != 0);
            new_collider || cycle || two || around
        })
    }
}

/// Returns the number of directed acyclic graphs over so many variables (Robinson 1973;
/// Rohrmueller 2011, eq. 4.6); none beyond 128 bits.
///
/// ```
/// use cotama_risk::dags;
/// assert_eq!(dags(5), Some(29_281));
/// assert_eq!(dags(10), Some(4_175_098_976_430_598_143));
/// assert_eq!(dags(100), None);
/// ```
pub fn dags(variables: u32) -> Option<u128> {
    let mut counts = vec![1_i128];
    for n in 1..=variables {
        let (mut sum, mut choose) = (0_i128, 1_i128);
        for k in 1..=n {
            choose = choose.checked_mul(i128::from(n - k + 1))? / i128::from(k);
            let arcs = 1_i128.checked_shl(k * (n - k)).filter(|it| *it > 0)?;
            let rest = *counts.get((n - k) as usize)?;
            let term = choose.checked_mul(arcs)?.checked_mul(rest)?;
            sum = if k % 2 == 1 { sum.checked_add(term)? } else { sum.checked_sub(term)? };
        }
        counts.push(sum);
    }
    counts.last().and_then(|it| u128::try_from(*it).ok())
}
