//! Scores of families: a variable with its parents.

use crate::dag::{Dag, bits};
use crate::data::Data;
use std::collections::BTreeMap;

/// A score, higher is better; natural logarithms, no term for the prior of the structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Score {
    /// The Bayesian information criterion (Schwarz, Ann. Statist. 6, 1978): the log likelihood less
    /// half the logarithm of the rows for each free parameter, whether its row occurs or not.
    Bic,
    /// The logarithm of the Bayesian Dirichlet equivalent uniform score (Heckerman, Geiger,
    /// Chickering, Mach. Learn. 20, 1995).
    Bdeu {
        /// The equivalent sample size of the prior, above 0.
        ess: f64,
    },
}

/// Codes of more configurations than this are made dense before they are counted.
const DENSE: usize = 1 << 16;
/// Tables with more cells than this hold those alone that occur.
const MOST_DENSE: usize = 1 << 20;

/// Scores of families of one data set, each computed once.
#[derive(Clone, Debug)]
pub struct Families<'d> {
    data: &'d Data,
    score: Score,
    known: BTreeMap<(usize, u64), f64>,
}

impl<'d> Families<'d> {
    /// Scores of this data.
    pub fn new(data: &'d Data, score: Score) -> Self {
        Self { data, score, known: BTreeMap::new() }
    }

    /// The data.
    pub fn data(&self) -> &'d Data {
        self.data
    }

    /// The score.
    pub fn score(&self) -> Score {
        self.score
    }

    /// Number of families that were scored.
    pub fn scored(&self) -> usize {
        self.known.len()
    }

    /// The score of a graph: the sum of its families.
    ///
    /// # Panics
    /// When the graph has more variables than the data.
    pub fn of(&mut self, dag: &Dag) -> f64 {
        dag.parents().iter().enumerate().map(|(child, it)| self.family(child, *it)).sum()
    }

    /// The score of a family.
    ///
    /// # Panics
    /// When the data has no such variable.
    pub fn family(&mut self, child: usize, parents: u64) -> f64 {
        if let Some(known) = self.known.get(&(child, parents)) {
            return *known;
        }
        let (data, counts) = (self.data, counts(self.data, child, parents));
        // Of all configurations, not of those alone that occur.
        let q: f64 = bits(parents).map(|it| data.states(it) as f64).product();
        let r = data.states(child) as f64;
        let value = match self.score {
            Score::Bic => {
                let rows = libm::log(data.rows() as f64);
                counts.likelihood() - rows / 2.0 * q * (r - 1.0)
            }
            Score::Bdeu { ess } => {
                let rise = |prior: f64, count: u32| {
                    libm::lgamma(prior + f64::from(count)) - libm::lgamma(prior)
                };
                let fit = |(row, sum): (&[u32], u32)| {
                    let some = row.iter().filter(|it| **it > 0);
                    some.map(|it| rise(ess / (q * r), *it)).sum::<f64>() - rise(ess / q, sum)
                };
                counts.rows().map(fit).sum()
            }
        };
        self.known.insert((child, parents), value);
        value
    }

    /// The log likelihood of a family.
    pub(super) fn likelihood(&self, child: usize, parents: u64) -> f64 {
        counts(self.data, child, parents).likelihood()
    }
}

/// Counts of the states of a variable, for each configuration of its parents.
struct Table {
    cells: Vec<u32>,
    /// Ends of the counts of each configuration.
    ends: Vec<usize>,
}

impl Table {
    /// The configurations that occur, and their sums; states that do not occur may be left out.
    fn rows(&self) -> impl Iterator<Item = (&[u32], u32)> {
        let starts = std::iter::once(&0).chain(&self.ends);
        let rows = starts.zip(&self.ends).map(|(start, end)| &self.cells[*start..*end]);
        rows.map(|it| (it, it.iter().sum::<u32>())).filter(|it| it.1 > 0)
    }

    fn likelihood(&self) -> f64 {
        let fit = |(row, sum): (&[u32], u32)| {
            row.iter().map(|it| n_log_n(*it)).sum::<f64>() - n_log_n(sum)
        };
        self.rows().map(fit).sum()
    }
}

fn counts(data: &Data, child: usize, parents: u64) -> Table {
    let states = data.states(child);
    let (codes, configurations) = codes(data, parents);
    let rows = codes.iter().zip(data.column(child));
    if configurations * states <= MOST_DENSE {
        let mut cells = vec![0_u32; configurations * states];
        rows.for_each(|it| cells[*it.0 as usize * states + usize::from(*it.1)] += 1);
        return Table { cells, ends: (1..=configurations).map(|it| it * states).collect() };
    }
    let mut pairs: Vec<(u32, u16)> = rows.map(|it| (*it.0, *it.1)).collect();
    pairs.sort_unstable();
    let (mut cells, mut ends) = (Vec::new(), Vec::new());
    for same in pairs.chunk_by(|a, b| a.0 == b.0) {
        cells.extend(same.chunk_by(|a, b| a == b).map(|it| it.len() as u32));
        ends.push(cells.len());
    }
    Table { cells, ends }
}

/// `n ln n`, 0 for 0.
pub(super) fn n_log_n(count: u32) -> f64 {
    if count < 2 { 0.0 } else { f64::from(count) * libm::log(f64::from(count)) }
}

/// For each row the number of the configuration of these variables, and how many numbers there are.
fn codes(data: &Data, variables: u64) -> (Vec<u32>, usize) {
    let (mut codes, mut count) = (vec![0_u32; data.rows()], 1);
    for variable in bits(variables) {
        let states = data.states(variable);
        if count * states > DENSE {
            // As many numbers as occur.
            let mut some = codes.clone();
            some.sort_unstable();
            some.dedup();
            let number = |it: &u32| some.binary_search(it).unwrap_or(0) as u32;
            codes = codes.iter().map(number).collect();
            count = some.len();
        }
        for (code, state) in codes.iter_mut().zip(data.column(variable)) {
            *code = *code * states as u32 + u32::from(*state);
        }
        count *= states;
    }
    (codes, count)
}
