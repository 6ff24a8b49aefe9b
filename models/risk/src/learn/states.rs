//! Numbers of states: bits and products of them, and the tables that depend on these.

use super::score::{Score, n_log_n};
use crate::data::Data;

/// Bits that the states of all variables and a number of rows take together.
pub(super) fn row_bits(data: &Data) -> u32 {
    let states = (0..data.variables().len()).map(|it| width(data.states(it)));
    states.sum::<u32>() + weight_bits(data)
}

/// Bits that a number of rows takes.
pub(super) fn weight_bits(data: &Data) -> u32 {
    usize::BITS - data.rows().leading_zeros()
}

pub(super) fn width(states: usize) -> u32 {
    usize::BITS - (states.max(2) - 1).leading_zeros()
}

/// Different numbers of states, and how many variables have each.
fn groups(data: &Data) -> Vec<(usize, usize)> {
    let mut counts: Vec<usize> = (0..data.variables().len()).map(|it| data.states(it)).collect();
    counts.sort_unstable();
    let mut groups: Vec<(usize, usize)> = Vec::new();
    for states in counts {
        match groups.last_mut() {
            Some(last) if last.0 == states => last.1 += 1,
            _ => groups.push((states, 1)),
        }
    }
    groups
}

/// Returns the number of tables of `f`: for `BDeu` one for each product of states.
pub(super) fn tables(data: &Data, score: Score) -> usize {
    match score {
        Score::Bic => 1,
        Score::Bdeu { .. } => {
            groups(data).iter().fold(1, |all: usize, it| all.saturating_mul(it.1 + 1))
        }
    }
}

/// `f` of each size of a cell: `n ln n`; of `BDeu` the rise of the logarithm of the gamma function,
/// less what `n` cells of one row have.
pub(super) fn table(score: Score, rows: usize, configurations: f64) -> Vec<f64> {
    match score {
        Score::Bic => (0..=rows as u32).map(n_log_n).collect(),
        Score::Bdeu { ess } => {
            let prior = ess / configurations;
            let (first, mut sum) = (libm::log(prior), 0.0);
            let rise = |it: usize| {
                let value = sum;
                sum += libm::log(prior + it as f64) - first;
                value
            };
            (0..=rows).map(rise).collect()
        }
    }
}

/// Entropy of a column.
pub(super) fn evenness(data: &Data, variable: usize) -> f64 {
    let mut counts = vec![0_u32; data.states(variable)];
    data.column(variable).iter().for_each(|it| counts[usize::from(*it)] += 1);
    -counts.iter().map(|it| n_log_n(*it)).sum::<f64>()
}

/// For each level how far its variable moves the number of a table.
pub(super) fn strides(data: &Data, score: Score, states: &[usize]) -> Vec<usize> {
    if score == Score::Bic {
        return vec![0; states.len()];
    }
    let (mut far, mut all) = (1, Vec::new());
    for (states, count) in groups(data) {
        all.push((states, far));
        far *= count + 1;
    }
    let stride = |it: &usize| all.iter().find(|group| group.0 == *it).map_or(0, |it| it.1);
    states.iter().map(stride).collect()
}

/// The product of states of each mask; the first level has the most significant bit.
pub(super) fn products(states: &[usize]) -> Vec<f64> {
    let mut all = vec![1.0; 1 << states.len()];
    for mask in 1..all.len() {
        let low = mask.trailing_zeros() as usize;
        all[mask] = all[mask & (mask - 1)] * states[states.len() - 1 - low] as f64;
    }
    all
}
