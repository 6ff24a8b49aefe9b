//! The best graph of all, by dynamic programming over subsets (Silander and Myllymaki, UAI 2006).

use super::constraints::Constraints;
use super::score::{Families, Score};
use super::states::{row_bits, tables};
use super::subsets::{Subsets, Wanted};
use crate::dag::{Dag, bits};
use crate::data::Data;
use std::fmt;

/// Bounds of the search, which are looked at before it begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The most variables, at most 26.
    pub variables: usize,
    /// The most bytes.
    pub bytes: u64,
}

impl Default for Limits {
    /// 22 variables and 1 GiB.
    fn default() -> Self {
        Self { variables: 22, bytes: 1 << 30 }
    }
}

/// The most variables that any limit allows.
const MOST: usize = 26;

/// Reasons for which the search does not begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TooMuch {
    /// There are more variables than the limit.
    Variables {
        /// Number that there are.
        are: usize,
        /// Number that may be.
        limit: usize,
    },
    /// More memory than the limit would be taken.
    Bytes {
        /// Bytes that would be taken.
        are: u64,
        /// Bytes that may be taken.
        limit: u64,
    },
    /// The states of a row, and the number of rows, take more than 63 bits together.
    States,
}

impl fmt::Display for TooMuch {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Variables { are, limit } => {
                write!(to, "{are} variables, and the limit of exact search is {limit}")
            }
            Self::Bytes { are, limit } => {
                let mib = |it: u64| it.div_ceil(1 << 20);
                write!(to, "it takes {} MiB, and the limit is {} MiB", mib(*are), mib(*limit))
            }
            Self::States => write!(
                to,
                "the states of a row and the number of rows take more than 63 bits together"
            ),
        }
    }
}

/// The best graph.
#[derive(Clone, Debug, PartialEq)]
pub struct Exact {
    /// A graph of the highest score that meets the constraints. Of equal ones, within 1e-9, one
    /// with the fewest arcs; of its class the [canonical](Dag::canonical) one, if that meets the
    /// constraints too.
    pub dag: Dag,
    /// The score.
    pub score: f64,
    /// Bytes that the search took at most.
    pub bytes: u64,
}

/// Each arc costs so much more, so that of equal scores the fewest arcs win.
const ARC: f64 = 1.0 / (1_u64 << 34) as f64;

/// Returns the bytes that the search takes at most for this data.
pub fn memory(data: &Data, score: Score) -> u64 {
    let count = data.variables().len().min(60) as u32;
    let subsets = 1_u64 << count;
    let tables = (tables(data, score) as u64).saturating_mul(8 * (data.rows() as u64 + 1));
    // While counting: values, configurations, light cells, tables, entries of a path.
    let entries = 16 * data.rows() as u64 * u64::from(count + 2);
    let counting =
        subsets.saturating_mul(8 + 8 + 32).saturating_add(tables).saturating_add(entries);
    // After: values, configurations, the best parents of each variable, the best graphs.
    let best = subsets.saturating_mul(8 + 8 + 8 + 4 * u64::from(count));
    counting.max(best)
}

/// An upper bound of the score of every graph: no family is more likely than with all others as
/// parents, and no penalty is below that of no parents.
///
/// # Panics
/// When the families are of more than 64 variables.
pub fn upper_bound(families: &Families<'_>) -> f64 {
    let data = families.data();
    let count = data.variables().len();
    let half = libm::log(data.rows() as f64) / 2.0;
    let mut bound = 0.0;
    for child in 0..count {
        let fit = families.likelihood(child, crate::dag::all(count) & !(1 << child));
        bound += match families.score() {
            Score::Bic => fit - half * (data.states(child) as f64 - 1.0),
            Score::Bdeu { .. } => fit,
        };
    }
    bound
}

/// Searches all graphs.
///
/// # Errors
/// When a limit is passed, before the search begins; [`memory`] says how much it takes.
///
/// # Panics
/// When the constraints are of another number of variables.
pub fn exact(
    families: &mut Families<'_>,
    constraints: &Constraints,
    limits: Limits,
) -> Result<Exact, TooMuch> {
    let (data, score) = (families.data(), families.score());
    let count = data.variables().len();
    let limit = limits.variables.min(MOST);
    if count > limit {
        return Err(TooMuch::Variables { are: count, limit });
    }
    let bytes = memory(data, score);
    if bytes > limits.bytes {
        return Err(TooMuch::Bytes { are: bytes, limit: limits.bytes });
    }
    if row_bits(data) > 63 {
        return Err(TooMuch::States);
    }
    if count < 2 {
        let dag = constraints.least();
        let score = families.of(&dag);
        return Ok(Exact { dag, score, bytes });
    }
    let prices = Prices::new(families, constraints);
    let subsets = Subsets::count(data, score, prices.wanted(data, constraints));
    let search = Search::new(subsets, &prices, constraints);
    let dag = search.graph();
    debug_assert!(constraints.meets(&dag), "an arc that is not allowed");
    let canonical = dag.canonical();
    let dag = if constraints.meets(&canonical) { canonical } else { dag };
    let score = families.of(&dag);
    Ok(Exact { dag, score, bytes })
}

/// Penalties, and how much of them can pay.
struct Prices {
    /// For each variable the penalty of one configuration of its parents; 0 for `BDeu`.
    each: Vec<f64>,
    /// For each variable the penalty from which on no set of parents can be the best: even a
    /// likelihood of 1 leaves it below the least set of parents.
    most: Vec<f64>,
}

impl Prices {
    fn new(families: &mut Families<'_>, constraints: &Constraints) -> Self {
        let data = families.data();
        let (mut each, mut most) = (Vec::new(), Vec::new());
        let half = libm::log(data.rows() as f64) / 2.0;
        for child in 0..data.variables().len() {
            let (price, pays) = match families.score() {
                Score::Bic => {
                    let least = families.family(child, constraints.required()[child]);
                    (half * (data.states(child) as f64 - 1.0), 1e-3 - least)
                }
                Score::Bdeu { .. } => (0.0, f64::INFINITY),
            };
            each.push(price);
            most.push(pays);
        }
        Self { each, most }
    }

    /// Subsets of which a family may be the best.
    fn wanted(&self, data: &Data, constraints: &Constraints) -> Wanted {
        let largest = |child: usize| {
            let (price, states) = (self.each[child], data.states(child) as f64);
            // A variable of one state has its required parents, and no others.
            let parents = if price > 0.0 { self.most[child] / price } else { f64::INFINITY };
            if states > 1.0 { parents * states * (1.0 + 1e-9) } else { 1.0 }
        };
        Wanted {
            configurations: (0..self.each.len()).map(largest).collect(),
            variables: constraints.max_parents().saturating_add(1),
        }
    }
}

struct Search {
    /// The variable of each bit.
    variables: Vec<usize>,
    /// For each bit the highest score of a family over each set of others, its bit left out.
    best: Vec<Vec<f64>>,
    /// The highest score of a graph over each set.
    top: Vec<f64>,
}

impl Search {
    fn new(subsets: Subsets, prices: &Prices, constraints: &Constraints) -> Self {
        let Subsets { variables, values, configurations } = subsets;
        let count = variables.len();
        let local = |mask: u64| {
            let places = variables.iter().enumerate();
            places.filter(|it| mask >> *it.1 & 1 == 1).fold(0_usize, |all, it| all | 1 << it.0)
        };
        let mut best = Vec::with_capacity(count);
        for (bit, &variable) in variables.iter().enumerate() {
            let required = local(constraints.required()[variable]);
            let states = configurations[1 << bit];
            // No other parent of a variable of one state pays.
            let allowed =
                if states > 1.0 { local(constraints.allowed()[variable]) } else { required };
            let (price, most) = (prices.each[variable], prices.most[variable]);
            let family = |set: usize| {
                let penalty = configurations[set] * price;
                let arcs = set.count_ones() as usize;
                let is_allowed = set & !allowed == 0
                    && required & !set == 0
                    && arcs <= constraints.max_parents()
                    && (penalty < most || set == required);
                if is_allowed && states <= 1.0 {
                    -ARC * arcs as f64
                } else if is_allowed {
                    values[set | 1 << bit] - values[set] - penalty - ARC * arcs as f64
                } else {
                    f64::NEG_INFINITY
                }
            };
            let mut own: Vec<f64> = (0..1 << (count - 1)).map(|it| family(wide(it, bit))).collect();
            raise(&mut own);
            best.push(own);
        }
        drop((values, configurations));
        let mut top = vec![0.0; 1 << count];
        for set in 1..top.len() {
            let mut most = f64::NEG_INFINITY;
            let mut rest = set;
            while rest != 0 {
                let bit = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                let other = set & !(1 << bit);
                let score = top[other] + best[bit][narrow(other, bit)];
                if score > most {
                    most = score;
                }
            }
            top[set] = most;
        }
        Self { variables, best, top }
    }

    /// The graph of the highest score: from the whole set, the sink of which the rest is best.
    fn graph(&self) -> Dag {
        let mut dag = Dag::empty(self.variables.len());
        let mut set = self.top.len() - 1;
        let mut families = Vec::new();
        while set != 0 {
            let is_sink = |bit: &usize| {
                let other = set & !(1 << bit);
                set != other
                    && self.top[other] + self.best[*bit][narrow(other, *bit)] >= self.top[set]
            };
            let Some(bit) = (0..self.variables.len()).find(is_sink) else { break };
            set &= !(1 << bit);
            families.push((bit, self.parents(bit, set)));
        }
        for (bit, parents) in families.into_iter().rev() {
            let mask = bits(parents as u64).fold(0, |all, it| all | 1 << self.variables[it]);
            dag.set(self.variables[bit], mask);
        }
        dag
    }

    /// The smallest set of parents among others that has the best score.
    fn parents(&self, bit: usize, mut among: usize) -> usize {
        let own = &self.best[bit];
        let best = own[narrow(among, bit)];
        loop {
            let less = bits(among as u64).map(|it| among & !(1 << it));
            match less.into_iter().find(|it| own[narrow(*it, bit)] >= best) {
                Some(smaller) => among = smaller,
                None => return among,
            }
        }
    }
}

/// A set without the place of a bit, and with it again.
const fn narrow(set: usize, bit: usize) -> usize {
    let low = (1 << bit) - 1;
    set & low | (set >> 1) & !low
}

const fn wide(set: usize, bit: usize) -> usize {
    let low = (1 << bit) - 1;
    set & low | (set & !low) << 1
}

/// Gives each set the highest value of its subsets.
fn raise(values: &mut [f64]) {
    let mut half = 1;
    while half < values.len() {
        for block in values.chunks_mut(2 * half) {
            let (without, with) = block.split_at_mut(half);
            for (with, without) in with.iter_mut().zip(without) {
                *with = if *without > *with { *without } else { *with };
            }
        }
        half *= 2;
    }
}
